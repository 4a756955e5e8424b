// Names of causes, and how they group buckets.
#include "corpus/cause.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "corpus/causes.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {
namespace {

Cause cause_by(CauseScope scope, std::vector<std::string> names) {
  return {.scheme = kCauseScheme, .scope = scope, .names = std::move(names)};
}

ActionUse named_use(const std::string& action) {
  ActionUse use;
  use.action = action;
  return use;
}

TEST(Cause, LimbsHaveNoSideAndNoBody) {
  EXPECT_EQ(limbs_of("arm_left/hand ~ leg_right/thigh"), (std::vector<std::string>{"arm", "leg"}));
  EXPECT_EQ(limbs_of("arm_left/elbow max"), limbs_of("arm_right/wrist min"));
  EXPECT_EQ(limbs_of("leg_left/foot ~ leg_right/foot"), (std::vector<std::string>{"leg"}));
  EXPECT_EQ(limbs_of("figure"), (std::vector<std::string>{"figure"}));
}

TEST(Cause, HeadlinesAreSentences) {
  EXPECT_EQ(cause_headline(cause_by(CauseScope::alone, {"aim"}), "self_collision", "arm_left/hand ~ leg_right/thigh"),
            "Left hand goes through right thigh during aim");
  EXPECT_EQ(cause_headline(cause_by(CauseScope::company, {"aim", "crouch"}), "joint_range", "arm_left/elbow max"),
            "Left elbow leaves its range during aim together with crouch");
  EXPECT_EQ(cause_headline(cause_by(CauseScope::company, {"a", "b", "c", "d", "e", "f"}), "pop", "head/neck"),
            "Neck jumps during a together with b together with c together with d and 2 others");
  Cause impact = cause_by(CauseScope::setting, {"impact"});
  impact.is_simulated = true;
  EXPECT_EQ(cause_headline(impact, "balance", "figure"), "Figure loses balance after an impact, simulated");
  EXPECT_EQ(cause_headline(cause_by(CauseScope::alone, {"walk"}), "residue", "leg_left"),
            "Left leg does not return to its earlier posture during walk");
  EXPECT_EQ(cause_headline(cause_by(CauseScope::alone, {"walk"}), "self_collision", "hand"),
            "Hand goes through an obstacle during walk");
}

TEST(Cause, HeadlinesSayASideOnce) {
  EXPECT_EQ(failure_in_words("foot_slide", "foot_right/ball_r"), "Right ball slides on the ground");
  EXPECT_EQ(failure_in_words("foot_slide", "foot_left/toe.L"), "Left toe slides on the ground");
  EXPECT_EQ(failure_in_words("joint_range", "leg_left/LeftFoot swing"), "LeftFoot swing leaves its range");
  EXPECT_EQ(failure_in_words("joint_range", "hand_right/ring_02_r swing"), "Right ring 02 swing leaves its range");
  EXPECT_EQ(failure_in_words("joint_range", "tail/ring_02_r swing"), "Ring 02 r swing leaves its range");
}

TEST(Cause, HeadlinesOfSeveralPlacesNameThem) {
  const auto headline = [](std::string_view check, std::vector<std::string> subjects) {
    return cause_headline(cause_by(CauseScope::alone, {"track"}), check, subjects, nullptr);
  };
  EXPECT_EQ(headline("angular_velocity", {"body/pan", "body/tilt"}), "Pan and tilt turn too fast during track");
  EXPECT_EQ(headline("angular_acceleration", {"leg_left/knee", "leg_right/knee"}),
            "Left knee and right knee change their speed too abruptly during track");
  EXPECT_EQ(headline("joint_range", {"arm_left/elbow min", "arm_left/elbow max"}),
            "Left elbow leaves its range during track");
  EXPECT_EQ(headline("mimic_error", {"a/b", "a/c", "a/d", "a/e"}),
            "B, c and 2 others do not follow their leading joint during track");
  EXPECT_EQ(headline("self_collision", {"arm_left/hand ~ leg_right/thigh", "arm_right/hand ~ leg_left/thigh"}),
            "Left hand goes through right thigh (and 1 other pair) during track");
}

TEST(Cause, HeadlinesTellASlopeFromUnevenGround) {
  const std::string subject = "foot_left/foot";
  EnvironmentDesc slope;
  slope.ground = SlopeGround{};
  EXPECT_EQ(cause_headline(cause_by(CauseScope::setting, {"ground"}), "ground_penetration", std::span(&subject, 1), &slope),
            "Left foot sinks into the ground on a slope");
}

TEST(Cause, IdsDependOnWhatExplainsAFailureAndOnNothingElse) {
  const Cause aim = cause_by(CauseScope::alone, {"aim"});
  Cause with_others = aim;
  with_others.also = {"walk"};
  EXPECT_EQ(cause_id(aim, CheckKind::speed), cause_id(with_others, CheckKind::speed));
  Cause simulated = aim, of_other_rules = aim;
  simulated.is_simulated = true, of_other_rules.scheme = kCauseScheme + 1;
  std::set<std::string> ids = {cause_id(aim, CheckKind::speed), cause_id(aim, CheckKind::range),
                               cause_id(simulated, CheckKind::speed), cause_id(of_other_rules, CheckKind::speed),
                               cause_id(cause_by(CauseScope::company, {"aim"}), CheckKind::speed),
                               cause_id(cause_by(CauseScope::alone, {"walk"}), CheckKind::speed)};
  EXPECT_EQ(ids.size(), 6u);
  for (const std::string& id : ids) EXPECT_EQ(id.size(), 12u);
}

TEST(Cause, ASpecAloneTellsItsActionsOrItsSurroundings) {
  EXPECT_EQ(cause_without_experiments(spec_of({named_use("walk")})).scope, CauseScope::alone);
  const Cause two = cause_without_experiments(spec_of({named_use("walk"), named_use("aim"), named_use("walk")}));
  EXPECT_EQ(two.scope, CauseScope::company);
  EXPECT_EQ(two.names, (std::vector<std::string>{"aim", "walk"}));
  Spec still = spec_of({});
  EXPECT_EQ(cause_without_experiments(still).names, (std::vector<std::string>{"pose"}));
  still.environment.ground = SlopeGround{};
  EXPECT_EQ(cause_without_experiments(still).scope, CauseScope::setting);
  EXPECT_EQ(cause_without_experiments(still).names, (std::vector<std::string>{"ground"}));
}

// The reaction of a simulated figure is one cause, whatever the figure did when it was hit.
TEST(Cause, AnImpactOnASimulatedFigureExplainsMoreThanItsActions) {
  Spec struck = spec_of({named_use("walk")});
  struck.dynamics.impacts.resize(1);
  EXPECT_EQ(cause_without_experiments(struck).names, (std::vector<std::string>{"walk"})) << "it is kinematic";
  struck.dynamics.mode = Mode::dynamic;
  const Cause cause = cause_without_experiments(struck);
  EXPECT_EQ(cause.scope, CauseScope::setting);
  EXPECT_EQ(cause.names, (std::vector<std::string>{"impact"}));
  EXPECT_EQ(cause.also, (std::vector<std::string>{"walk"}));
}

TEST(Cause, IsStoredWithTheMinimalCase) {
  Case minimal = made_up(170, 60, 1);
  minimal.cause = {kCauseScheme, CauseScope::company, {"aim", "walk"}, {}, true};
  const Result<Case> read = parse_case(print_case(minimal));
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_EQ(*read, minimal);
  EXPECT_EQ(cause_id_of(*read), cause_id(minimal.cause, CheckKind::range));
  EXPECT_EQ(cause_of(made_up(170, 60, 1)).scheme, kCauseScheme) << "older cases have none";
}

TEST(Causes, GroupBucketsInAnyOrderIntoTheSameRows) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  for (int i = 0; i < 3; ++i) {
    Found one = found(160 + 10 * i, 60 + i, i);
    one.minimal.spec.sequences[0].clips[0].actions[0].action = i < 2 ? "pose" : "walk";
    ASSERT_TRUE(corpus.add(one));
    one.minimal.expect.subject = "arm_right/elbow max";
    one.original.expect.subject = one.minimal.expect.subject;
    ASSERT_TRUE(corpus.add(one));
  }
  RunRecord run;
  run.cases = 100;
  run.families[{"joint_range", "human", kElbow}].cases = 25;
  std::vector<Issue> damaged;
  std::vector<CauseMember> members = cause_members(corpus, corpus.buckets(damaged), damaged);
  ASSERT_TRUE(damaged.empty());
  const std::vector<CauseRow> rows = causes_of(members, std::span(&run, 1));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_GE(rows[0].severity, rows[1].severity);
  for (const CauseRow& row : rows) {
    EXPECT_EQ(row.cases, 25);
    EXPECT_EQ(row.characters, std::set<std::string>{"human"});
    EXPECT_TRUE(std::ranges::is_sorted(row.members, std::greater(), [](const CauseMember& member) {
      return depth_of(member.minimal.expect);
    }));
  }
  RunRecord other = run;
  other.families.clear();
  for (const CauseRow& row : causes_of(members, std::span(&other, 1))) {
    EXPECT_EQ(row.cases, 1) << "no whole case showed it, but one was shrunk to it";
    EXPECT_GT(row.severity, 0.0);
  }
  for (const CauseRow& row : causes_of(members, {})) EXPECT_EQ(row.cases, 0) << "nothing is known of any run";
  std::ranges::reverse(members);
  const std::vector<CauseRow> again = causes_of(members, std::span(&run, 1));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(again[i].id, rows[i].id);
    EXPECT_EQ(again[i].headline, rows[i].headline);
    EXPECT_EQ(again[i].severity, rows[i].severity);
  }
}

TEST(Causes, AreMoreSevereIfTheyAreDeeperMoreFrequentOrEasierToMeet) {
  const double some = severity_of(CheckKind::range, 1.0, CauseScope::company, 0.1);
  EXPECT_GT(severity_of(CheckKind::range, 2.0, CauseScope::company, 0.1), some);
  EXPECT_GT(severity_of(CheckKind::range, 1.0, CauseScope::alone, 0.1), some);
  EXPECT_GT(severity_of(CheckKind::range, 1.0, CauseScope::company, 0.2), some);
  EXPECT_GT(severity_of(CheckKind::ground, 1.0, CauseScope::company, 0.1), some);
  EXPECT_GT(severity_of(CheckKind::broken, 1.0, CauseScope::company, 0.1), some);
  EXPECT_DOUBLE_EQ(severity_of(CheckKind::broken, std::numeric_limits<double>::infinity(), CauseScope::setting, 1.0),
                   100.0);
}

}  // namespace
}  // namespace contort
