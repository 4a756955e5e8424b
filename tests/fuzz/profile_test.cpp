// Profiles: the effects of their rules, and refused ones.
#include "fuzz/profile.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/stage_evaluator.h"
#include "fuzz/draw.h"
#include "generator/stage.h"

namespace contort {
namespace {

std::string profile_json(const std::string& fields) {
  return R"({"format":"contort.profile/1","name":"x")" + (fields.empty() ? "" : "," + fields) + "}";
}

Profile profile(const std::string& fields) {
  Result<Profile> parsed = parse_profile(profile_json(fields));
  if (!parsed) throw std::logic_error(to_line(parsed.issue()));
  return std::move(parsed).value();
}

// "code at pointer", or "" where it is accepted.
std::string refused(const std::string& fields) {
  Result<Profile> parsed = parse_profile(profile_json(fields));
  const Result<Done> good =
      parsed ? validate(*parsed, {"human", "mech"}, stock_generator()) : Result<Done>(parsed.issue());
  return good ? "" : good.issue().code + " at " + good.issue().pointer;
}

// Calls visit(use) for each action of `count` specs drawn by a profile.
template <class Visit>
int for_uses(const Profile& profile, int count, Visit visit) {
  int uses = 0;
  for (int i = 0; i < count; ++i) {
    const Spec spec = draw_spec({{"human"}, profile}, stock_generator(), 1, i);
    for (const SequenceDesc& sequence : spec.sequences)
      for (const ClipDesc& clip : sequence.clips)
        for (const ActionUse& use : clip.actions) visit(use), ++uses;
  }
  return uses;
}

TEST(Profile, ARuleKeepsAnActionFromASlot) {
  const Profile narrow = profile(R"("rules":[{"slots":["leg_left","leg_right"],"actions":["pose"],"never":true}])");
  int others = 0;
  for_uses(narrow, 300, [&](const ActionUse& use) {
    EXPECT_FALSE(use.action == "pose" && use.slot.starts_with("leg_"));
    others += use.action == "pose" || use.slot.starts_with("leg_");
  });
  EXPECT_GT(others, 50);
}

// The last rule that speaks of an action counts.
TEST(Profile, AWeightHasAnActionDrawnMoreOften) {
  const std::string of_head = R"("slots":["head"],"actions":["look_at"],)";
  const auto share = [](const Profile& profile) {
    int looks = 0, all = 0;
    for_uses(profile, 2000, [&](const ActionUse& use) {
      all += use.slot == "head", looks += use.slot == "head" && use.action == "look_at";
    });
    EXPECT_GT(all, 300);
    return static_cast<double>(looks) / all;
  };
  const double even = share(profile("")), often = share(profile("\"rules\":[{" + of_head + "\"weight\":10}]"));
  EXPECT_NEAR(often / (1.0 - often), 10.0 * even / (1.0 - even), 3.0);
  EXPECT_EQ(share(profile("\"rules\":[{" + of_head + "\"weight\":10},{\"weight\":1}]")), even);
}

TEST(Profile, ARuleNarrowsAParameter) {
  const Profile narrow = profile(
      R"("rules":[{"actions":["look_at"],"param":"target_m","low":[-1,1,2],"high":[1,2,3]},
                  {"slots":["head"],"actions":["look_at"],"param":"target_m","low":[0,1,2],"high":[1,2,3]},
                  {"param":"blend_in_frames","low":[7],"high":[9]}])");
  int seen = 0, right_of_middle = 0;
  for_uses(narrow, 500, [&](const ActionUse& use) {
    if (use.action != "look_at") return;
    const auto at = use.params.find("target_m");
    if (at == use.params.end()) return;
    const Vec3 target = std::get<Vec3>(at->second);
    EXPECT_TRUE(target.y >= 1 && target.y <= 2 && target.z >= 2 && target.z <= 3 && target.x <= 1) << use.slot;
    EXPECT_GE(target.x, use.slot == "head" ? 0.0 : -1.0) << "the last rule counts";
    EXPECT_TRUE(use.blend_in_frames >= 7 && use.blend_in_frames <= 9) << use.blend_in_frames;
    ++seen, right_of_middle += target.x < 0.0;
  });
  EXPECT_GT(seen, 50);
  EXPECT_GT(right_of_middle, 5);
}

// The greatest number of the spec's actions that move one part at a time, by the time line.
int most_at_once(const Profile& profile, int specs) {
  int most = 0;
  for (int i = 0; i < specs; ++i) {
    const Spec spec = draw_spec({{"human"}, profile}, stock_generator(), 1, i);
    const Result<Stage> stage = build_stage(spec, stock_library());
    if (!stage) throw std::logic_error(to_line(stage.issue()));
    const std::vector<PlannedAction>& actions = stage->timeline.actions;
    for (const PlannedAction& one : actions)
      most = std::max(most, static_cast<int>(std::ranges::count_if(actions, [&](const PlannedAction& other) {
                        return one.further < 0 && other.further < 0 && other.sequence == one.sequence &&
                               other.part == one.part && other.start <= one.start && other.end > one.start;
                      })));
  }
  return most;
}

TEST(Profile, WithoutOverlapsEachPartIsMovedByOneActionAtATime) {
  EXPECT_EQ(most_at_once(profile(R"("overlaps":false)"), 200), 1);
  EXPECT_GT(most_at_once(profile(""), 200), 1);
}

// A spec that does not build is skipped, and a motion in which nothing moves is clean. A rule may cause neither.
TEST(Profile, RulesThatWouldTestNothingAreRefused) {
  EXPECT_EQ(refused(R"("rules":[{"never":true}])"), "profile.nothing_moves at ");
  EXPECT_EQ(refused(R"("actions":["walk"],"slots":["head"])"), "profile.nothing_moves at ");
  EXPECT_EQ(refused(R"("rules":[{"param":"lead","low":[0],"high":[1]}])"), "profile.bad_rule at /rules/0/param");
  EXPECT_EQ(refused(R"("rules":[{"param":"speed_m_s","low":[1,1,1],"high":[1,1,1]}])"),
            "profile.bad_rule at /rules/0/low");
  EXPECT_EQ(refused(R"("rules":[{"param":"speed_m_s","low":[900],"high":[950]}])"),
            "profile.no_range at /rules/0/low/0");
  EXPECT_EQ(refused(R"("rules":[{"slots":["head"],"param":"speed_m_s","low":[1],"high":[1]}])"),
            "profile.unknown_name at /rules/0/param");
  for (const char* rule : {R"("never":true)", R"("param":"blend_in_frames","low":[1],"high":[2])"})
    EXPECT_EQ(refused(R"("rules":[{"slots":["head"],"actions":["walk"],)" + std::string(rule) + "}]"),
              "profile.unknown_name at /rules/0/actions");
  for (const char* frames : {"-5", "601", "2.5"})
    EXPECT_EQ(refused(R"("rules":[{"param":"blend_in_frames","low":[)" + std::string(frames) + R"(],"high":[800]}])"),
              "profile.bad_rule at /rules/0/low");
  EXPECT_EQ(refused(R"("rules":[{"param":"blend_in_frames","low":[1,1,1],"high":[2,2,2]}])"),
            "profile.bad_rule at /rules/0/low");
}

// The rule's range is half beyond the range of walk, and between two steps of 0.1 m/s.
TEST(Profile, ARuleIsKeptWithinWhatTheActionDeclares) {
  int seen = 0;
  for (const char* range : {R"("low":[-900],"high":[900])", R"("low":[0.33],"high":[0.36])"}) {
    const Profile walks =
        profile(R"("slots":["waist"],"actions":["walk"],"rules":[{"actions":["walk"],"param":"speed_m_s",)" +
                std::string(range) + "}]");
    for (int i = 0; i < 200; ++i) {
      const Spec spec = draw_spec({{"human"}, walks}, stock_generator(), 1, i);
      EXPECT_TRUE(build_stage(spec, stock_library())) << print_spec(spec);
    }
    const bool between_steps = std::string_view(range).starts_with(R"("low":[0.33])");
    for_uses(walks, 200, [&](const ActionUse& use) {
      if (use.action != "walk" || !between_steps) return;
      EXPECT_EQ(std::get<double>(use.params.at("speed_m_s")), 0.33);
      ++seen;
    });
  }
  EXPECT_GT(seen, 100);
}

TEST(Profile, WhatCannotBeMeantIsRefused) {
  EXPECT_EQ(refused(""), "");
  EXPECT_EQ(refused(R"("rules":[{}])"), "profile.bad_rule at /rules/0");
  EXPECT_EQ(refused(R"("rules":[{"never":true,"param":"speed_m_s","low":[0],"high":[1]}])"),
            "profile.bad_rule at /rules/0");
  EXPECT_EQ(refused(R"("rules":[{"never":true,"weight":2}])"), "profile.bad_rule at /rules/0");
  EXPECT_EQ(refused(R"("rules":[{"param":"speed_m_s"}])"), "profile.bad_rule at /rules/0/low");
  EXPECT_EQ(refused(R"("rules":[{"param":"speed_m_s","low":[1,2],"high":[3,4]}])"), "profile.bad_rule at /rules/0/low");
  EXPECT_EQ(refused(R"("rules":[{"param":"speed_m_s","low":[2],"high":[1]}])"), "profile.no_range at /rules/0/high/0");
  EXPECT_EQ(refused(R"("rules":[{"param":"sped_m_s","low":[0],"high":[1]}])"),
            "profile.unknown_name at /rules/0/param");
  EXPECT_EQ(refused(R"("rules":[{"slots":["wing"],"never":true}])"), "profile.unknown_name at /rules/0/slots/0");
  EXPECT_EQ(refused(R"("rules":[{"actions":["fly"],"never":true}])"), "profile.unknown_name at /rules/0/actions/0");
  EXPECT_EQ(refused(R"("shortest_frames":30,"longest_frames":20)"), "profile.no_range at /longest_frames");
}

TEST(Profile, WhatAFileSaysNothingOfIsAsInItsBase) {
  const Profile tame = load_profile("tame").value();
  const Profile mine =
      profile(R"("base":"tame","range":0.25,"grounds":[],"rules":[{"param":"elbow_deg","low":[5],"high":[6]}])");
  EXPECT_EQ(mine.name, "x");
  EXPECT_EQ(mine.base + mine.about, "");
  EXPECT_EQ(mine.range, 0.25);
  EXPECT_TRUE(mine.grounds.empty()) << "said, so not as in the base, though it is what a profile without base has";
  EXPECT_EQ(mine.characters, tame.characters);
  EXPECT_EQ(mine.longest_frames, tame.longest_frames);
  ASSERT_EQ(mine.rules.size(), tame.rules.size() + 1);
  EXPECT_EQ(mine.rules.front(), tame.rules.front());
  EXPECT_EQ(mine.rule_for("arm_left", "pose", "elbow_deg")->high, std::vector<double>{6.0})
      << "its own rules come last";
  EXPECT_EQ(profile(R"("base":"tame","grounds":["plane"])").rules, tame.rules) << "a file without rules";
}

TEST(Profile, ABaseThatIsNotBuiltInIsRefused) {
  EXPECT_EQ(refused(R"("base":"tamer")"), "profile.unknown at /base");
  EXPECT_EQ(refused(R"("base":"../tame.json")"), "profile.bad_text at /base");
  EXPECT_EQ(refused(R"("base":"tame","longest_frames":7)"), "profile.no_range at /longest_frames")
      << "checked as a whole";
  EXPECT_EQ(load_profile("tamer").issue().text,
            "no profile is called \"tamer\"; there are guest, nightly, pr, smoke, stress, tame, and files; did you mean \"tame\"?");
}

// Any finding is a fault of the generator. 100,000 cases were clean; these are some that ran for a second or two.
TEST(Profile, TameFindsNothing) {
  const Profile tame = load_profile("tame").value();
  StageEvaluator evaluator;
  for (int i = 0; i < 96; ++i) {
    const Spec spec = draw_spec({{"human"}, tame}, stock_generator(), 99, i);
    const Result<Stage> stage = build_stage(spec, stock_library());
    ASSERT_TRUE(stage) << to_line(stage.issue());
    for (const Finding& finding : evaluator.run(*stage).findings)
      ADD_FAILURE() << finding.check << " " << finding.subject << "\n" << print_spec(spec);
  }
}

TEST(Profile, BuiltInOnesAreGoodAndReadBack) {
  for (const Profile& built_in : built_in_profiles()) {
    const Result<Profile> read = parse_profile(print_profile(built_in));
    ASSERT_TRUE(read) << built_in.name << to_line(read.issue());
    EXPECT_EQ(*read, built_in);
    const std::vector<std::string> all = {"human", "mech", "quadruped"};
    EXPECT_TRUE(validate(built_in, built_in.characters.empty() ? all : built_in.characters, stock_generator()))
        << built_in.name;
  }
}

}  // namespace
}  // namespace contort
