// Case files: valid ones are read back unchanged, and all others are refused.
#include "corpus/case.h"
#include "corpus/ending_case.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "checks/circumstances.h"
#include "process/isolate.h"
#include "fuzz/draw.h"
#include "model/core/hash.h"
#include "tests/checks/family_text.h"
#include "tests/corpus/sample_cases.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

std::string draw_text(const std::string& alphabet, int least, int most) {
  const auto size = static_cast<std::size_t>(*rc::gen::inRange(least, most + 1));
  return *rc::gen::container<std::string>(size, rc::gen::elementOf(alphabet));
}

double draw_margin() {
  const int kind = *rc::gen::inRange(0, 6);
  if (kind == 0) return std::numeric_limits<double>::quiet_NaN();
  if (kind == 1) return -5e-324;
  if (kind == 2) return -1e300;
  return -std::ldexp(static_cast<double>(*rc::gen::inRange(1, 1 << 30)), *rc::gen::inRange(-80, 10));
}

Case draw_case() {
  Case c;
  c.spec = draw_spec({{"human", "mech", "quadruped"}}, stock_generator(), *rc::gen::inRange(0, 1000),
                     *rc::gen::inRange(0, 1000));
  Expectation& e = c.expect;
  e.check = draw_text("abcxyz_09", 1, 20);
  e.subject = draw_text("arm_left/ ~\"\\<>", 1, 60);
  e.unit = draw_text("rad/sm", 0, 6);
  e.first_frame = *rc::gen::inRange(0, 36000);
  e.worst_frame = *rc::gen::inRange(0, 36000);
  e.last_frame = *rc::gen::inRange(0, 36001);
  e.worst_margin = draw_margin();
  e.depth = std::isnan(e.worst_margin) ? 0.0 : std::min(1e300, -e.worst_margin / 0.1);
  e.motion_hash = to_hex(*rc::gen::arbitrary<std::uint64_t>());
  e.character_hash = to_hex(*rc::gen::arbitrary<std::uint64_t>());
  e.trace = draw_text("0123456789abcdef", 0, 400);
  e.phase = draw_text("abc_", 0, 12);
  c.provenance = {draw_text("0.1-beta", 0, 12),
                  *rc::gen::inRange<std::int64_t>(-1, (1LL << 53) + 1),
                  *rc::gen::inRange<std::int64_t>(-1, 99),
                  draw_text("0123456789abcdef", 0, 32),
                  *rc::gen::inRange(0, 36001),
                  draw_text("fixpoint", 0, 10),
                  std::ldexp(static_cast<double>(*rc::gen::inRange(0, 1000)), -4),
                  *rc::gen::inRange(0, 1001),
                  draw_text("tame_2-x.", 0, 20),
                  *rc::gen::inRange(0, 2) == 0 ? Family{}
                                               : Family{"check", draw_text("abc_", 1, 20), draw_text("abc|/ ~", 1, 40)},
                  draw_text("0123456789. abcdef", 0, 40),
                  draw_text("passes_check", 0, 12),
                  std::ldexp(static_cast<double>(*rc::gen::inRange(-1000, 1000)), -4)};
  for (int i = *rc::gen::inRange(0, 4); i > 0; --i) {
    c.free_fields.push_back("/" + draw_text("abc/_0", 1, 60));
    c.co_failures.push_back({"check", draw_text("abc/_ ~", 1, 60), "a"});
  }
  return c;
}

bool same(Case a, Case b) {
  const bool both = std::isnan(a.expect.worst_margin) && std::isnan(b.expect.worst_margin);
  if (both) a.expect.worst_margin = b.expect.worst_margin = 0.0;
  return a == b;
}

RC_GTEST_PROP(CaseFile, ReadsBackWhatWasWritten, ()) {
  const Case written = draw_case();
  const std::string text = print_case(written);
  const Result<Case> read = parse_case(text);
  if (!read) RC_FAIL(to_line(read.issue()));
  RC_ASSERT(same(*read, written));
  RC_ASSERT(print_case(*read) == text);
}

TEST(CaseFile, SaysWhatWasGoingOnInTheWorstFrame) {
  const Case c = failing_case(bent_elbow(158), "joint_range", kElbow);
  const Result<Stage> stage = build_stage(c.spec, stock_library());
  ASSERT_TRUE(stage);
  StageEvaluator evaluator;
  evaluator.run(*stage);
  EXPECT_EQ(c.expect.phase, phase_name(phase_of(*evaluator.execution().intent, evaluator.motion(), c.expect.worst_frame)));
  EXPECT_FALSE(c.expect.phase.empty());
  // Cases of older builds do not have this field.
  std::string text = print_case(c);
  const std::size_t at = text.find("\"phase\"");
  text.erase(at, text.find('\n', at) - at);
  const Result<Case> read = parse_case(text);
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_EQ(read->expect.phase, "");
}

// Names may have 64 letters; a pair of bodies is named by four of them.
TEST(CaseFile, ASubjectOfTheLongestNamesIsReadBack) {
  Case c = elbow_case();
  const std::string name(64, 'n');
  c.expect.subject = name + "/" + name + " ~ " + name + "/" + name;
  const Result<Case> read = parse_case(print_case(c));
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_EQ(*read, c);
}

TEST(CaseFile, AMarginThatIsNoNumberIsWrittenAsText) {
  Case c = elbow_case();
  c.expect.worst_margin = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(print_case(c).find("\"worst_margin\": \"nan\""), std::string::npos);
  const Result<Case> read = parse_case(print_case(c));
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::isnan(read->expect.worst_margin));
}

// JSON has no infinity either; a case that could not be read again would be reported as nondeterminism.
TEST(CaseFile, AnInfinitelyDeepFindingMakesACaseThatCanBeReadBack) {
  const Result<Stage> stage = build_stage(bent_elbow(100), stock_library());
  ASSERT_TRUE(stage);
  StageEvaluator evaluator;
  const Evaluation evaluation = evaluator.run(*stage);
  const double endless = std::numeric_limits<double>::infinity();
  const Case c{bent_elbow(100),
               expectation_of(evaluator.execution(), evaluation,
                              {"joint_range", kElbow, "rad", 1, 2, 3, -endless, endless}),
               {}};
  const Result<Case> read = parse_case(print_case(c));
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_TRUE(same(*read, c));
}

TEST(CaseFile, AnExpectationTracesEveryFrameWithFourDigits) {
  const Case c = elbow_case();
  EXPECT_EQ(c.expect.trace.size(), 4U * 61U);  // 60 periods have 61 frames
  EXPECT_EQ(c.expect.motion_hash.size(), 16U);
  EXPECT_NEAR(c.expect.worst_margin, -40 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(c.expect.depth, 400 * kRadPerDeg, 1e-11);
  EXPECT_EQ(family_of(c), family("joint_range|human|arm_left/elbow max"));
}

// A crash has no motion; anything else that has no hash was cut off or made up.
TEST(CaseFile, OnlyACaseThatEndedItsProcessMayHaveNoHashes) {
  for (const Ending::Kind kind : {Ending::Kind::crash, Ending::Kind::timeout, Ending::Kind::memory}) {
    const Case c = ending_case(bent_elbow(100), {kind, "exit 1", ""});
    const Result<Case> read = parse_case(print_case(c));
    ASSERT_TRUE(read) << to_line(read.issue());
    EXPECT_EQ(*read, c);
  }
  for (std::string Expectation::*hash : {&Expectation::motion_hash, &Expectation::character_hash}) {
    Case c = elbow_case();
    (c.expect.*hash).clear();
    const Result<Case> read = parse_case(print_case(c));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.issue().code, "case.bad_text");
    EXPECT_TRUE(read.issue().pointer.starts_with("/expect/")) << read.issue().pointer;
  }
}

struct Refusal {
  const char* from;  // replaced in a good file
  const char* to;
  const char* code;
  const char* pointer;
};

class RefusedCase : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedCase, IsRefusedWithCodeAndPlace) {
  const Refusal& refusal = GetParam();
  std::string text = print_case(elbow_case());
  const std::size_t at = text.find(refusal.from);
  ASSERT_NE(at, std::string::npos) << refusal.from << " is not in\n" << text;
  text.replace(at, std::string(refusal.from).size(), refusal.to);
  const Result<Case> read = parse_case(text);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.issue().code, refusal.code);
  EXPECT_EQ(read.issue().pointer, refusal.pointer);
  EXPECT_EQ(read.issue().text.find('\n'), std::string::npos);
  EXPECT_FALSE(read.issue().text.empty());
}

INSTANTIATE_TEST_SUITE_P(
    CaseFile, RefusedCase,
    testing::Values(
        Refusal{"\"format\": \"contort.case/1\"", "\"format\": \"contort.case/2\"", "case.wrong_format", "/format"},
        Refusal{"\"format\": \"contort.case/1\"", "\"formal\": 1", "case.wrong_format", ""},
        Refusal{"\"check\": \"joint_range\",", "", "case.missing_field", "/expect"},
        Refusal{"\"check\": \"joint_range\"", "\"check\": \"Joint Range\"", "case.bad_text", "/expect/check"},
        Refusal{"\"check\": \"joint_range\"", "\"check\": 7", "case.wrong_type", "/expect/check"},
        Refusal{"\"check\": \"joint_range\"", "\"check\": \"a\", \"cheque\": 1", "case.unknown_field",
                "/expect/cheque"},
        Refusal{"\"check\": \"joint_range\"", "\"check\": \"a\", \"check\": \"b\"", "json.duplicate_key", ""},
        Refusal{"\"worst_margin\": -", "\"worst_margin\": ", "case.out_of_range", "/expect/worst_margin"},
        Refusal{"\"worst_margin\": -", "\"worst_margin\": \"inf\", \"depth2\": -", "case.wrong_type",
                "/expect/worst_margin"},
        Refusal{"\"elbow_deg\": 190.0", "\"elbow_deg\": null", "case.wrong_type",
                "/spec/sequences/0/clips/0/actions/0/params/elbow_deg"},
        Refusal{"\"slot\": \"arm_left\"", "\"slot\": \"../arm\"", "case.bad_text",
                "/spec/sequences/0/clips/0/actions/0/slot"},
        Refusal{"{", "", "json.syntax", ""}, Refusal{"}", "", "json.syntax", ""}));

TEST(CaseFile, EveryPrefixOfAFileIsRefusedAndNoneCrashes) {
  const std::string text = print_case(elbow_case());
  const std::string whole = text.substr(0, text.find_last_of('}') + 1);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Result<Case> read = parse_case(std::string_view(whole).substr(0, size));
    ASSERT_FALSE(read) << size;
    ASSERT_EQ(read.issue().code, "json.syntax") << size;
  }
  EXPECT_TRUE(parse_case(whole));
}

TEST(CaseFile, DeepAndLongDocumentsAreRefused) {
  const Result<Case> deep = parse_case(std::string(100000, '['));
  ASSERT_FALSE(deep);
  EXPECT_EQ(deep.issue().code, "json.too_deep");
  const Result<Case> large = parse_case(std::string((16 << 20) + 1, ' '));
  ASSERT_FALSE(large);
  EXPECT_EQ(large.issue().code, "json.too_large");
}

}  // namespace

}  // namespace contort
