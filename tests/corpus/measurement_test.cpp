// Measurements of specs, and the lines with which builds exchange them.
#include "corpus/measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/hash.h"
#include "tests/corpus/sample_cases.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

Measurement measured_elbow(double elbow_deg, bool margins, const std::string& check = "") {
  Evaluator evaluator(stock_generator());
  MeasureRequest request{7, bent_elbow(elbow_deg), check, margins, true};
  return measure(request, evaluator);
}

const SubjectMargin* find_elbow(const std::vector<SubjectMargin>& margins) {
  const auto found = std::ranges::find_if(
      margins, [](const SubjectMargin& one) { return one.check == "joint_range" && one.subject == kElbow; });
  return found == margins.end() ? nullptr : &*found;
}

TEST(Measurements, HaveTheDeepestFailureOfEachFamily) {
  const Case failing = failing_case(bent_elbow(170), "joint_range", kElbow);
  const Measurement measured = measured_elbow(170, false);
  EXPECT_EQ(measured.id, 7);
  EXPECT_EQ(measured.motion_hash, failing.expect.motion_hash);
  EXPECT_EQ(measured.trace, failing.expect.trace);
  ASSERT_NE(find_elbow(measured.findings), nullptr);
  EXPECT_DOUBLE_EQ(find_elbow(measured.findings)->margin, -failing.expect.depth);
  EXPECT_TRUE(measured.margins.empty()) << "nobody asked for them";
  const auto name = [](const SubjectMargin& one) { return std::pair(one.check, one.subject); };
  EXPECT_TRUE(std::ranges::is_sorted(measured.findings, {}, name));
}

TEST(Measurements, HaveMarginsOfSubjectsThatPassIfAskedFor) {
  const Measurement measured = measured_elbow(120, true);
  EXPECT_EQ(find_elbow(measured.findings), nullptr);
  ASSERT_NE(find_elbow(measured.margins), nullptr);
  EXPECT_GT(find_elbow(measured.margins)->margin, 1.0) << "30 degrees in scales of 0.1 rad";
  const Measurement failing = measured_elbow(170, true);
  EXPECT_EQ(find_elbow(failing.margins), nullptr) << "a subject is in one list alone";
  EXPECT_FALSE(failing.margins.empty());
  for (const SubjectMargin& one : failing.margins) EXPECT_GE(one.margin, 0.0) << one.check << " " << one.subject;
}

TEST(Measurements, OfOneCheckHaveNoOther) {
  const Measurement measured = measured_elbow(170, true, "joint_range");
  EXPECT_NE(find_elbow(measured.findings), nullptr);
  for (const auto* list : {&measured.findings, &measured.margins})
    for (const SubjectMargin& one : *list) EXPECT_EQ(one.check, "joint_range");
}

TEST(Measurements, MarkWhatAWaiverHides) {
  CheckSettings settings;
  Waiver waiver;
  waiver.check = "joint_range", waiver.reason = "known";
  settings.waivers = {waiver};
  Evaluator evaluator(stock_generator(), settings);
  const Measurement measured = measure({1, bent_elbow(170), "", false, false}, evaluator);
  ASSERT_NE(find_elbow(measured.findings), nullptr);
  EXPECT_TRUE(find_elbow(measured.findings)->waived);
}

TEST(Measurements, SayWhyASpecIsRefused) {
  Evaluator evaluator(stock_generator());
  Spec unknown = bent_elbow(100);
  unknown.character.name = "nobody";
  const Measurement refused = measure({3, unknown, "", false, false}, evaluator);
  ASSERT_TRUE(refused.refusal);
  EXPECT_FALSE(refused.refusal->code.empty());
  const Result<Measurement> read = parse_measurement(print_line(refused));
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_EQ(read->refusal, refused.refusal);
  EXPECT_EQ(read->id, 3);
}

TEST(MeasureLines, AreReadAsTheyWereWritten) {
  Measurement measured = measured_elbow(170, true);
  measured.findings.push_back({"pop", "knee", std::numeric_limits<double>::quiet_NaN(), true});
  const std::string line = print_line(measured);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const Result<Measurement> read = parse_measurement(line);
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_EQ(print_line(*read), line);
  EXPECT_EQ(read->margins, measured.margins);
  EXPECT_TRUE(std::isnan(read->findings.back().margin));
  EXPECT_TRUE(read->findings.back().waived);

  const MeasureRequest request{9, bent_elbow(100), "pop", true, true};
  EXPECT_EQ(*parse_request(print_line(request)), request);
  const Result<MeasureHello> hello = parse_hello(print_line(own_hello("1.2.3")));
  ASSERT_TRUE(hello) << to_line(hello.issue());
  EXPECT_EQ(hello->version, "1.2.3");
  EXPECT_EQ(hello->checks, own_hello("").checks);
  EXPECT_NE(std::ranges::find(hello->checks, "joint_range"), hello->checks.end());
}

TEST(MeasureLines, MayBeABareSpec) {
  const Result<MeasureRequest> request = parse_request(print_spec(bent_elbow(100)));
  ASSERT_TRUE(request) << to_line(request.issue());
  EXPECT_EQ(*request, (MeasureRequest{0, bent_elbow(100), "", false, false}));
}

TEST(MeasureLines, ThatAreNoRequestAreRefusedWithTheirPlace) {
  const std::string spec = print_spec(bent_elbow(100));
  const auto refused = [](const std::string& line) {
    const Result<MeasureRequest> request = parse_request(line);
    return request ? "" : request.issue().code + " " + request.issue().pointer;
  };
  EXPECT_EQ(refused(""), "json.syntax ");
  EXPECT_EQ(refused("nonsense"), "json.syntax ");
  EXPECT_EQ(refused("{\"spec\":" + spec + ",\"id\":\"one\"}"), "measure.bad_request /id");
  EXPECT_EQ(refused("{\"spec\":" + spec + ",\"more\":1}"), "measure.bad_request /more");
  EXPECT_EQ(refused("{\"spec\":" + spec + ",\"check\":\"beauty\"}"), "measure.unknown_check /check");
  EXPECT_EQ(refused("{\"spec\":{\"format\":\"contort.spec/9\"}}"), "spec.wrong_format /spec/format");
  EXPECT_EQ(refused("[1]").substr(0, 5), "spec.");
}

TEST(MeasureLines, OfAnAnswerNeedAMotionOrARefusal) {
  EXPECT_EQ(parse_measurement("{}").issue().code, "measure.bad_answer");
  EXPECT_EQ(parse_measurement("{\"frames\":-1}").issue().pointer, "/frames");
  EXPECT_TRUE(parse_measurement("{\"error\":{\"code\":\"spec.odd\"}}"));
  EXPECT_EQ(parse_hello("{\"format\":\"contort.measure/2\",\"version\":\"1\"}").issue().code, "measure.wrong_format");
}

}  // namespace
}  // namespace contort
