// Promises of programs under test, played by a program that keeps or breaks each on request.
#include <gtest/gtest.h>

#include <set>

#include "checks/judge.h"
#include "guest/guest_generator.h"

namespace contort {
namespace {

constexpr char kPromises[] = "/usr/bin/python3 " CONTORT_SOURCE_DIR "/tests/guest/broken/promises.py";

std::unique_ptr<GuestGenerator> promising(const std::string& more = "") {
  Result<std::unique_ptr<GuestGenerator>> started = GuestGenerator::start(kPromises + more);
  if (!started) ADD_FAILURE() << to_line(started.issue());
  return started ? std::move(started).value() : nullptr;
}

// The figure bends, and after ten frames it is asked for the action.
Spec bend_and(const std::string& action, bool keeps) {
  Spec spec;
  spec.character.name = "hero", spec.hold_frames = action == "pass" ? 10 : 0;
  ClipDesc clip;
  for (const std::string& name : {std::string("bend"), action}) {
    ActionUse use;
    use.action = name, use.slot = "body", use.start_frame = name == "bend" ? 0 : 10, use.duration_frames = name == "pass" ? 10 : 20;
    if (name == "lean") use.params["side"] = 0.5;
    use.params["keeps"] = std::string(name == "bend" || keeps ? "true" : "false");
    clip.actions.push_back(use);
  }
  spec.sequences.push_back({"", 0, {clip}});
  return spec;
}

std::set<std::string> checks_that_find(GuestGenerator& guest, const Spec& spec) {
  const Result<Execution> made = execute(guest, spec);
  std::set<std::string> checks;
  if (!made) return checks.insert(to_line(made.issue())), checks;
  for (const Finding& finding : Judge().evaluate(*made).findings) checks.insert(finding.check);
  return checks;
}

const std::pair<const char*, const char*> kBroken[] = {
    {"rest", "rest_error"},         {"fresh", "fresh_error"},       {"nothing", "none_error"},
    {"reach", "reach_error"},       {"remember", "history_error"},  {"depend_on_rate", "rate_error"},
    {"pass", "undo_error"},         {"near", "gain_error"},         {"lean", "mirror_error"},
};

// Continuous actions may jump here; these tests do not judge that.
TEST(GuestPromises, AreFoundWhereTheyAreBrokenAndNowhereElse) {
  const auto guest = promising();
  ASSERT_NE(guest, nullptr);
  for (const auto& [action, check] : kBroken) {
    EXPECT_FALSE(checks_that_find(*guest, bend_and(action, true)).contains(check)) << action;
    EXPECT_TRUE(checks_that_find(*guest, bend_and(action, false)).contains(check)) << action;
  }
}

TEST(GuestPromises, ExcuseAJumpOnlyOfActionsThatMayCut) {
  const auto guest = promising();
  ASSERT_NE(guest, nullptr);
  EXPECT_TRUE(checks_that_find(*guest, bend_and("rest", true)).empty()) << "from 30 degrees to rest in one frame";
  EXPECT_TRUE(checks_that_find(*guest, bend_and("remember", true)).contains("pop")) << "the same, but continuous";
}

// A later use that takes over is not blamed for a goal, and neither is the earlier one.
TEST(GuestPromises, GoalsThatAreTakenOverAreNotJudged) {
  const auto guest = promising();
  ASSERT_NE(guest, nullptr);
  Spec spec = bend_and("reach", false);
  std::vector<ActionUse>& uses = spec.sequences[0].clips[0].actions;
  uses.push_back(uses[0]);
  uses.back().start_frame = 15;
  EXPECT_FALSE(checks_that_find(*guest, spec).contains("reach_error"));
}

TEST(GuestPromises, PartsAreAskedForByTheNamesOfTheManifest) {
  const auto guest = promising();
  ASSERT_NE(guest, nullptr);
  Spec spec;
  spec.character.name = "hero", spec.hold_frames = 2;
  EXPECT_NEAR(execute(*guest, spec)->motion.row(0)[0], 0.0, 1e-9);
  spec.character.parts["body"] = "hero_body_bent";
  EXPECT_NEAR(execute(*guest, spec)->motion.row(0)[0], 10.0 * kRadPerDeg, 1e-9);
}

TEST(GuestConnections, OverTcpGiveTheSameFrames) {
  const auto here = promising(), connected = promising(" --tcp");
  ASSERT_TRUE(here != nullptr && connected != nullptr);
  const Spec spec = bend_and("fresh", true);
  EXPECT_EQ(*here->raw_frames(spec), *connected->raw_frames(spec));
}

TEST(GuestConnections, WithoutTheTokenAreRefused) {
  const auto stranger = GuestGenerator::start(std::string(kPromises) + " --tcp --forget");
  ASSERT_FALSE(stranger);
  EXPECT_EQ(stranger.issue().code, "generator.bad_token");
}

// The last words of a program go to terminals and into files.
TEST(GuestConnections, TellWhatWasPrintedInOneLineOfAscii) {
  const Issue ended = GuestGenerator::start("printf 'a\\033[31mb\\n\\377c' >&2; exit 3").issue();
  EXPECT_NE(ended.text.find("exit 3; it printed: a [31mb c"), std::string::npos) << ended.text;
}

}  // namespace
}  // namespace contort
