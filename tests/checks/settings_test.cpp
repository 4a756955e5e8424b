// Settings: allowed contents of a file, moved limits, and waivers.
#include "checks/settings.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "checks/waive.h"
#include "tests/stage_evaluator.h"
#include "generator/execute.h"
#include "tests/checks/small_character.h"

namespace contort {
namespace {

std::string code_of(const std::string& text) {
  const Result<CheckSettings> settings = parse_settings(text);
  return settings ? "" : settings.issue().code + " " + settings.issue().pointer;
}

std::string with(const std::string& list, const std::string& entry) {
  return R"({"format": "contort.settings/1", ")" + list + R"(": [)" + entry + "]}";
}

const std::string kWaiver = R"("check": "joint_range", "reason": "r", "owner": "ana")";

TEST(Settings, SayWhereTheyAreWrong) {
  EXPECT_EQ(code_of(R"({"format": "contort.settings/1"})"), "");
  EXPECT_EQ(code_of(with("limits", R"({"check": "joint_rage", "reason": "r"})")),
            "settings.unknown_check /limits/0/check");
  EXPECT_EQ(code_of(with("limits", R"({"check": "pop", "phase": "lunch", "reason": "r"})")),
            "settings.unknown_phase /limits/0/phase");
  EXPECT_EQ(code_of(with("limits", R"({"check": "pop", "use": "forget", "reason": "r"})")),
            "settings.unknown_name /limits/0/use");
  EXPECT_EQ(code_of(with("limits", R"({"check": "pop"})")), "settings.missing_field /limits/0");
  EXPECT_EQ(code_of(with("waivers", "{" + kWaiver + "}")), "settings.missing_field /waivers/0");
  EXPECT_EQ(code_of(with("waivers", "{" + kWaiver + R"(, "expires": "2027-02-29"})")),
            "settings.no_day /waivers/0/expires");
  EXPECT_EQ(code_of(with("waivers", "{" + kWaiver + R"(, "expires": "2028-02-29"})")), "");
  EXPECT_EQ(code_of(with("waivers", "{" + kWaiver + R"(, "expires": "2028-02-29", "phase": "impact"})")), "");
  for (const char* day :
       {"2027-13-01", "2027-00-01", "2027-04-31", "27-04-01", "2027/04/01", "2027-4-1", "", "tomorrow"})
    EXPECT_FALSE(is_day(day)) << day;
}

// Tries all texts that a star can match.
bool matches_by_trial(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  if (pattern.front() != '*')
    return !text.empty() && pattern.front() == text.front() && matches_by_trial(pattern.substr(1), text.substr(1));
  for (std::size_t skip = 0; skip <= text.size(); ++skip)
    if (matches_by_trial(pattern.substr(1), text.substr(skip))) return true;
  return false;
}

RC_GTEST_PROP(Settings, AStarIsAnyRunOfCharacters, ()) {
  const auto pattern = *rc::gen::resize(8, rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab*"))));
  const auto text = *rc::gen::resize(10, rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab"))));
  const bool expected = matches_by_trial(pattern, text);
  RC_TAG(expected);
  RC_ASSERT(matches(pattern, text) == expected);
}

// Both arms lifted this far out of range, degrees.
Motion lifted(const Character& character, double left_deg, double right_deg) {
  Motion motion = small::at_rest(character);
  small::set(motion, 0, small::joint_of(character, "arm_left/lift"), (50 + left_deg) * kRadPerDeg);
  small::set(motion, 0, small::joint_of(character, "arm_right/lift"), (50 + right_deg) * kRadPerDeg);
  return motion;
}

std::vector<std::string> subjects_found(const CheckSettings& settings, const Motion& motion) {
  std::vector<std::string> subjects;
  for (const Finding& f : StageEvaluator(settings).judge(small::build(), motion)) subjects.push_back(f.subject);
  return subjects;
}

using Subjects = std::vector<std::string>;

TEST(Settings, AChangedLimitCountsForTheSubjectsThatItNames) {
  const Motion motion = lifted(small::build(), 2, 2);
  EXPECT_EQ(subjects_found({}, motion), (Subjects{"arm_left/lift max", "arm_right/lift max"}));
  CheckSettings settings;
  settings.limits = {{"joint_range", "arm_left/*", "", LimitUse::change, 2.1 * kRadPerDeg, "soft"}};
  EXPECT_EQ(subjects_found(settings, motion), (Subjects{"arm_right/lift max"}));
  settings.limits[0].tolerance = 1.9 * kRadPerDeg;
  EXPECT_EQ(subjects_found(settings, motion).size(), 2U);
  settings.limits[0].tolerance = -1.0 * kRadPerDeg;
  EXPECT_EQ(subjects_found(settings, lifted(small::build(), -0.5, -0.5)), (Subjects{"arm_left/lift max"}))
      << "stricter";
  settings.limits.push_back({"joint_range", "arm_left/lift *", "", LimitUse::ignore, 0.0, "broken"});
  EXPECT_EQ(subjects_found(settings, motion), (Subjects{"arm_right/lift max"})) << "the last one counts";
}

TEST(Settings, WhatIsIgnoredMayBeNoNumber) {
  const Character character = small::build();
  Motion motion = small::at_rest(character, 2);
  small::set(motion, 1, small::joint_of(character, "arm_left/lift"), std::numeric_limits<double>::quiet_NaN());
  CheckSettings settings;
  settings.limits = {{"non_finite", "arm_left/lift", "", LimitUse::ignore, 0.0, "r"}};
  for (const Finding& f : StageEvaluator(settings).judge(character, motion)) EXPECT_NE(f.check, "non_finite");
  EXPECT_FALSE(StageEvaluator().judge(character, motion, "non_finite").empty());
}

// One second at rest, then an elbow bent too far for a second.
Stage bent_too_far() {
  const Result<Spec> spec = parse_spec(
      R"({"format": "contort.spec/1", "character": {"name": "human"}, "hold_frames": 30, "sequences": [{"clips": [
    {"actions": [{"action": "pose", "slot": "arm_left", "start_frame": 30, "duration_frames": 60,
                  "params": {"elbow_deg": 170}}]}]}]})");
  EXPECT_TRUE(spec) << to_line(spec.issue());
  return *build_stage(*spec, stock_library());
}

TEST(Settings, ALimitOfOnePhaseCountsInItsFramesOnly) {
  const Stage stage = bent_too_far();
  const std::vector<Finding> all = StageEvaluator().run(stage, "joint_range").findings;
  ASSERT_EQ(all.size(), 1U);
  CheckSettings settings;
  settings.limits = {{"joint_range", "*", "at_rest", LimitUse::ignore, 0.0, "r"}};
  const std::vector<Finding> moving = StageEvaluator(settings).run(stage, "joint_range").findings;
  ASSERT_EQ(moving.size(), 1U);
  EXPECT_EQ(moving[0].first_frame, all[0].first_frame);
  EXPECT_LT(moving[0].last_frame, all[0].last_frame);
  const Motion motion = generate(stage);
  EXPECT_EQ(phase_of(intent_of(stage), motion, moving[0].last_frame + 1), Phase::at_rest);
}

CheckSettings waiving(const Waiver& waiver, const std::string& today) {
  CheckSettings settings;
  settings.waivers = {waiver};
  settings.today = today;
  return settings;
}

TEST(Waivers, HideUntilTheirLastDayAndNoLonger) {
  const Stage stage = bent_too_far();
  const Waiver waiver{"joint_range", "arm_left/*", "", 0.0, "ticket", "ana", "2027-03-01"};
  for (const char* day : {"2026-11-21", "2027-03-01", ""}) {
    const Evaluation hidden = StageEvaluator(waiving(waiver, day)).run(stage, "joint_range");
    EXPECT_TRUE(hidden.findings.empty()) << day;
    ASSERT_EQ(hidden.waived.size(), 1U);
    EXPECT_EQ(hidden.waived[0].finding, StageEvaluator().run(stage, "joint_range").findings.at(0));
    EXPECT_EQ(hidden.waivers, (std::vector<WaiverUse>{{1, false}}));
  }
  const Evaluation expired = StageEvaluator(waiving(waiver, "2027-03-02")).run(stage, "joint_range");
  EXPECT_EQ(expired.findings.size(), 1U);
  EXPECT_EQ(expired.waivers, (std::vector<WaiverUse>{{1, true}}));
}

TEST(Waivers, HideOnlyWhatTheyAreAbout) {
  const Stage stage = bent_too_far();
  const Waiver fits{"joint_range", "*", "", 0.0, "r", "ana", "2099-01-01"};
  const auto is_hidden = [&](Waiver waiver) {
    return StageEvaluator(waiving(waiver, "2026-11-21")).run(stage, "joint_range").findings.empty();
  };
  EXPECT_TRUE(is_hidden(fits));
  Waiver other = fits;
  other.check = "pop";
  EXPECT_FALSE(is_hidden(other));
  other = fits, other.subject = "arm_right/*";
  EXPECT_FALSE(is_hidden(other));
  other = fits, other.phase = "impact";
  EXPECT_FALSE(is_hidden(other));
  const double margin = StageEvaluator().run(stage, "joint_range").findings.at(0).worst_margin;
  other = fits, other.deepest = -1.01 * margin;
  EXPECT_TRUE(is_hidden(other));
  other.deepest = -0.99 * margin;
  EXPECT_FALSE(is_hidden(other)) << "it has become worse than what was agreed";
}

TEST(Waivers, ThatHideNothingAreKnown) {
  const Waiver idle{"pop", "*", "", 0.0, "r", "ana", "2099-01-01"};
  EXPECT_EQ(StageEvaluator(waiving(idle, "2026-11-21")).run(bent_too_far()).waivers, (std::vector<WaiverUse>{{0, false}}));
}

TEST(Waivers, TheFirstThatFitsHidesAndNoNumberIsOnlyHiddenHoweverDeep) {
  const std::vector<Waiver> waivers = {{"pop", "*", "", 5.0, "r", "ana", "2099-01-01"},
                                       {"pop", "a", "", 0.0, "r", "ben", "2099-01-01"},
                                       {"pop", "*", "", 0.0, "r", "eve", "2099-01-01"}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto finding = [](const char* subject, double margin) {
    return Finding{"pop", subject, "rad/s", 0, 0, 0, margin, -margin};
  };
  const Waived waived = waive(waivers, {finding("a", -4), finding("a", -6), finding("b", nan)}, {}, "2026-11-21");
  EXPECT_EQ(waived.by, (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace contort
