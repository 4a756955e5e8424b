// Rules that users write in Lua: their results, their inputs and their restrictions.
#include <gtest/gtest.h>

#include <cmath>

#include "generator/execute.h"
#include "model/character/action_rules.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::coord;
using fixtures::use;

// An action file with a script; each line of `script` is a line of it.
std::string script_file(const std::string& fields, const std::vector<std::string>& script) {
  std::string lines;
  for (const std::string& line : script) lines += (lines.empty() ? "\"" : ", \"") + line + "\"";
  return R"({"format": "contort.action/1", "name": "own", )" + fields + R"(, "script": [)" + lines + "]}";
}

const std::string kSetsElbow = R"("kinds": ["arm"], "sets": ["elbow_deg"])";

Library with_script(const std::string& file) {
  Library library = fixtures::tireless_library();
  const Result<ActionDesc> action = parse_action(file);
  EXPECT_TRUE(action.ok()) << (action.ok() ? "" : to_line(action.issue())) << file;
  if (action) library.actions.push_back(*action);
  return library;
}

std::string refusal_of_script(const std::string& fields, const std::vector<std::string>& script) {
  const std::string file = script_file(fields, script);
  const Result<ActionDesc> action = parse_action(file);
  if (!action) return action.issue().code;
  if (const Result<Done> fits = check_action(*action); !fits) return fits.issue().code;
  const Result<Done> done = check_actions(with_script(file));
  return done ? "" : done.issue().code + " " + done.issue().pointer;
}

struct ScriptedMotion {
  std::shared_ptr<const Character> human;
  Motion motion;
  Intent intent;
  double elbow_deg(int frame, const char* name = "arm_left/elbow") const {
    return coord(motion, frame, *human, name) / kRadPerDeg;
  }
};

// One use of the action on a human, over 60 frames at 60 Hz.
ScriptedMotion play_script(const std::string& file, std::vector<ActionUse> uses = {use("own", "arm_left", 0, 60, {})}) {
  const Library library = with_script(file);
  const Result<Done> fits = check_actions(library);
  EXPECT_TRUE(fits.ok()) << (fits.ok() ? "" : to_line(fits.issue()));
  ScriptedMotion out{std::make_shared<const Character>(fixtures::built({}, library)), {}, {}};
  GenerateScratch scratch;
  Execution execution;
  execute(fixtures::stage_of({fixtures::sequence(std::move(uses))}, 0, out.human), scratch, execution);
  out.motion = execution.motion, out.intent = *execution.intent;
  return out;
}

TEST(Scripts, SetAJointInEachFrame) {
  const ScriptedMotion played = play_script(script_file(kSetsElbow, {"elbow_deg = 40 + 20 * sin(2 * pi * time_s) + period_s"}));
  for (const int frame : {15, 30, 45, 60})
    EXPECT_NEAR(played.elbow_deg(frame), 41.0 + 20.0 * std::sin(2.0 * kPi * frame / 60.0), 1e-9) << frame;
  EXPECT_TRUE(played.intent.unmet.empty());
}

TEST(Scripts, ReadTheirParametersAndWhereTheJointIs) {
  const std::string file = script_file(
      kSetsElbow + R"(, "parameters": [{"name": "more_deg", "low": 0, "high": 50, "preset": 10}])",
      {"local before = elbow_deg", "elbow_deg = before + more_deg"});
  const ScriptedMotion preset = play_script(file, {fixtures::elbow(0, 20, 30.0), use("own", "arm_left", 20, 60, {})});
  EXPECT_NEAR(preset.elbow_deg(80), 40.0, 1e-9);
  const ScriptedMotion given = play_script(file, {use("own", "arm_left", 0, 60, {{"more_deg", 50.0}})});
  EXPECT_NEAR(given.elbow_deg(60), 50.0, 1e-9);
}

TEST(Scripts, AddToWhatIsThere) {
  const ScriptedMotion played = play_script(script_file(kSetsElbow + R"(, "adds": true)", {"elbow_deg = 10 * progress"}),
                             {fixtures::elbow(0, 20, 30.0), use("own", "arm_left", 20, 60, {})});
  EXPECT_NEAR(played.elbow_deg(50), 35.0, 1e-9);
}

TEST(Scripts, AreMirroredOnTheRight) {
  const std::string file = script_file(R"("kinds": ["arm"], "sets": ["shoulder_deg"])",
                                       {"shoulder_deg = {-20, 10, 40 * progress}"});
  const ScriptedMotion left = play_script(file), right = play_script(file, {use("own", "arm_right", 0, 60, {})});
  for (int frame = 0; frame <= 60; ++frame) {
    const double* l = left.motion.row(frame).data() + fixtures::joint(*left.human, "arm_left/shoulder").coord;
    const double* r = right.motion.row(frame).data() + fixtures::joint(*right.human, "arm_right/shoulder").coord;
    EXPECT_NEAR(l[0], r[0], 1e-12);
    EXPECT_NEAR(l[1], r[1], 1e-12);
    EXPECT_NEAR(l[2], -r[2], 1e-12);
    EXPECT_NEAR(l[3], -r[3], 1e-12);
  }
}

TEST(Scripts, ComputeTheParametersOfABuiltInAction) {
  const ScriptedMotion played = play_script(script_file(R"("kinds": ["arm"], "of": "reach", "sets": ["target_m"])",
                                                        {"target_m = {0.3, 1.0 + 0.2 * progress, 0.25}"}));
  ASSERT_EQ(played.intent.goals.size(), 1U);
  const Goal& goal = played.intent.goals.front();
  EXPECT_EQ(goal.first_frame, 60);
  EXPECT_NEAR(goal.target_m.y, 1.2, 1e-12);
  EXPECT_TRUE(played.intent.unmet.empty());
}

TEST(Scripts, KeepNothingFromOneRunToTheNext) {
  const std::string count = script_file(kSetsElbow, {"local n = elbow_deg", "local function next() n = n + 1; return n end",
                                                 "next()", "elbow_deg = 20 + next() - n"});
  EXPECT_NEAR(play_script(count).elbow_deg(60), 20.0, 1e-9);
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"", "count = 1"}), "action.script_failed /script/1");
}

TEST(Scripts, HaveTheSameBitsEachTime) {
  const std::string file = script_file(kSetsElbow, {"elbow_deg = 50 + 20 * exp(-progress) * cos(20 * time_s)"});
  EXPECT_EQ(play_script(file).motion, play_script(file).motion);
}

TEST(Scripts, KeepTheJointInItsRangeAndTellOfIt) {
  const ScriptedMotion played = play_script(script_file(kSetsElbow, {"elbow_deg = 300"}));
  EXPECT_LT(played.elbow_deg(60), 180.0);
  ASSERT_FALSE(played.intent.unmet.empty());
  EXPECT_EQ(played.intent.unmet.back().why, Shortfall::joint_range);
}

TEST(Scripts, ThatStopInAFrameLeaveThePartAndAreTold) {
  const ScriptedMotion played = play_script(script_file(kSetsElbow, {"local t", "if progress > 0.6 and progress < 0.8 then t = t + 1 end"}));
  ASSERT_EQ(played.intent.unmet.size(), 1U);
  const UnmetRequest& unmet = played.intent.unmet.front();
  EXPECT_EQ(unmet.why, Shortfall::rule_failed);
  EXPECT_GE(unmet.first_frame, 36);
    EXPECT_LE(unmet.last_frame, 48);
  EXPECT_NEAR(played.elbow_deg(60), 0.0, 1e-9);
}

TEST(Scripts, MeasureTheGround) {
  const Library library = with_script(script_file(kSetsElbow, {"elbow_deg = 100 * ground_height_m(0, 1)"}));
  Spec spec;
  spec.character = {"human", {}, {}};
  spec.environment.ground = SlopeGround{20.0, 0.0};
  spec.sequences = {fixtures::sequence({use("own", "arm_left", 0, 60, {})})};
  const Result<Stage> stage = build_stage(spec, library);
  ASSERT_TRUE(stage.ok()) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  EXPECT_NEAR(coord(motion, 60, *stage->character, "arm_left/elbow") / kRadPerDeg,
              100.0 * std::tan(20.0 * kRadPerDeg), 0.5);
}

TEST(Scripts, ReachNothingOutsideThemselves) {
  for (const char* line :
       {"io.open('x')", "os.exit(1)", "require('os')", "load('x = 1')()", "print(1)", "getmetatable('').__index = 1",
        "('x'):rep(10)", "collectgarbage()", "dofile('x')", "local t = tostring({})", "pairs({})", "setmetatable({}, {})",
        "debug.getregistry()", "coroutine.create(sin)", "string.dump(sin)", "math.random()", "rawset(_G, 'a', 1)"})
    EXPECT_EQ(refusal_of_script(kSetsElbow, {line}), "action.script_failed /script/0") << line;
}

TEST(Scripts, End) {
  for (const char* line : {"while true do end", "repeat until false", "local function f() return f() end f()"})
    EXPECT_EQ(refusal_of_script(kSetsElbow, {"", line}), "action.script_failed /script/1") << line;
}

// Lua reports no line for errors of memory.
TEST(Scripts, StayWithinTheirMemory) {
  for (const char* line : {"local s = 'x' while true do s = s .. s end", "local function f() return 1 + f() end f()",
                           "local t = {} for i = 1, 1e9 do t[i] = i end"})
    EXPECT_TRUE(refusal_of_script(kSetsElbow, {line}).starts_with("action.script_failed /script")) << line;
}

TEST(Scripts, AreRefusedWithACodeAndALine) {
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"", "elbow_deg = = 3"}), "action.bad_script /script/1");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"elbow_deg = 2 ^ 3"}), "action.bad_script /script/0");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {std::string(1000, '(')}), "action.bad_script /script");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"\\u001bLua"}), "action.bad_script /script");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"elbow_deg = 'x'"}), "action.script_failed /script");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"elbow_deg = nil"}), "action.script_failed /script");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"elbow_deg = 0 / 0"}), "action.script_failed /script");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"elbow_deg = 1e9"}), "action.script_failed /script");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"elbow_deg = other"}), "action.script_failed /script");
  EXPECT_EQ(refusal_of_script(kSetsElbow, {"elbow_deg = 1 + other"}), "action.script_failed /script/0");
  EXPECT_EQ(refusal_of_script(R"("kinds": ["arm"], "sets": ["shoulder_deg"])", {"shoulder_deg = {1, 2}"}),
            "action.script_failed /script");
  EXPECT_EQ(refusal_of_script(R"("parts": ["human_arm"], "sets": ["knee_deg"])", {"knee_deg = 1"}),
            "action.unknown_param /sets/0");
  EXPECT_EQ(refusal_of_script(R"("kinds": ["waist"], "of": "walk", "sets": ["speed_m_s"])", {"speed_m_s = 1"}),
            "action.unsupported /script");
  EXPECT_EQ(refusal_of_script(R"("kinds": ["arm"], "of": "reach", "sets": ["elbow_deg"])", {"elbow_deg = 1"}),
            "action.unknown_param /sets/0");
}

TEST(Scripts, FilesMustFitTogether) {
  EXPECT_EQ(refusal_of_script(R"("kinds": ["arm"])", {"elbow_deg = 1"}), "action.bad_params");
  EXPECT_EQ(refusal_of_script(R"("kinds": ["arm"], "sets": ["elbow_deg", "elbow_deg"])", {""}), "action.duplicate_name");
  EXPECT_EQ(refusal_of_script(R"("kinds": ["arm"], "sets": ["target_m"], "of": "reach", "adds": true)", {""}),
            "action.bad_params");
  EXPECT_EQ(refusal_of_script(kSetsElbow + R"(, "keys": [{"at": 1, "pose": {"elbow_deg": 1}}])", {""}), "action.two_rules");
  EXPECT_EQ(refusal_of_script(kSetsElbow + R"(, "parameters": [{"name": "a", "low": 1, "high": 2, "preset": 3}])", {""}),
            "action.bad_params");
  EXPECT_EQ(refusal_of_script(kSetsElbow + R"(, "parameters": [{"name": "elbow_deg", "low": 1, "high": 3, "preset": 2}])",
                              {""}),
            "action.duplicate_name");
  const Result<ActionDesc> alone =
      parse_action(R"({"format": "contort.action/1", "name": "own", "kinds": ["arm"], "of": "reach", "sets": ["target_m"]})");
  ASSERT_TRUE(alone.ok());
  EXPECT_FALSE(check_action(*alone).ok());
}

}  // namespace
}  // namespace contort
