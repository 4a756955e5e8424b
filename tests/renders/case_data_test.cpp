// The data that the viewer gets of a failure.
#include "renders/case_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/corpus/sample_cases.h"
#include "tests/scenes.h"

namespace contort {
namespace {

using Json = nlohmann::json;

Json data_of(std::vector<ShownCase> shown) {
  const Result<std::string> text = case_data("joint_range-0123", shown, stock_generator(), {});
  if (!text) throw std::logic_error(to_line(text.issue()));
  EXPECT_EQ(text->find('<'), std::string::npos);
  return Json::parse(*text);
}

// A case with an expectation that its spec may not show.
Case made_up(const Spec& spec, const std::string& check, const std::string& subject) {
  Case stored;
  stored.spec = spec, stored.expect.check = check, stored.expect.subject = subject, stored.expect.unit = "rad";
  return stored;
}

TEST(CaseData, TheFailuresCurveIsFirstAndAsDeepAsItsFinding) {
  const Case stored = failing_case(bent_elbow(158), "joint_range", kElbow);
  const Json data = data_of({{"minimal", stored}});
  const Json& motion = data["motions"][0];
  const Json& curve = motion["curves"][0];
  EXPECT_EQ(curve["subject"], kElbow);
  EXPECT_EQ(curve["unit"], "rad");
  const std::vector<double> margins = curve["margins"];
  ASSERT_EQ(margins.size(), motion["frame_count"]);
  const auto deepest = std::ranges::min_element(margins);
  EXPECT_NEAR(*deepest, -8 * kRadPerDeg, 1e-6);
  EXPECT_EQ(deepest - margins.begin(), motion["worst_frame"]);
  EXPECT_EQ(motion["worst_frame"], stored.expect.worst_frame);
  EXPECT_LT(margins[motion["first_frame"]], 0.0);
  EXPECT_GE(margins[motion["first_frame"].get<std::size_t>() - 1], 0.0);
}

// Curves are compared in units of their checks: an elbow 5 degrees in its range is safer than solids 1 mm apart.
TEST(CaseData, OtherCurvesFollowByHowNearTheyCame) {
  const Json data = data_of({{"minimal", failing_case(bent_elbow(158), "joint_range", kElbow)}});
  const Json& curves = data["motions"][0]["curves"];
  ASSERT_EQ(curves.size(), kMostCurves);
  double before = -1e9;
  for (std::size_t i = 1; i < curves.size(); ++i) {
    double smallest = 1e9;
    for (const Json& margin : curves[i]["margins"])
      if (!margin.is_null()) smallest = std::min(smallest, margin.get<double>());
    const double nearness = smallest / curves[i]["scale"].get<double>();
    EXPECT_GE(nearness, before - 1e-5) << curves[i]["subject"];
    EXPECT_NE(curves[i]["subject"], kElbow);
    before = nearness;
  }
}

TEST(CaseData, HoldsTheMotionAndWhatItIsAbout) {
  const Json motion = data_of({{"minimal", failing_case(bent_elbow(158), "joint_range", kElbow)}})["motions"][0];
  EXPECT_TRUE(motion["glb"].get<std::string>().starts_with("H4sI")) << "gzip in base64";
  EXPECT_EQ(motion["ghost_glb"], "");
  EXPECT_EQ(motion["highlight"]["joints"], Json({"arm_left/elbow"}));
  EXPECT_EQ(motion["ground"], Json({{"level", 0.0}}));
  EXPECT_EQ(motion["spans"][0]["name"], "pose");
  EXPECT_EQ(motion["spans"][0]["slot"], "arm_left");
  EXPECT_EQ(parse_spec(motion["spec"].dump()).value(), bent_elbow(158));
  EXPECT_TRUE(motion["balance"].empty());
  EXPECT_GT(motion["colliders"].size(), 10U);
}

TEST(CaseData, ShowsTheOthersBesideTheMinimalOne) {
  const Case minimal = failing_case(bent_elbow(158), "joint_range", kElbow);
  const Case worst = failing_case(bent_elbow(170), "joint_range", kElbow);
  const Json data = data_of({{"minimal", minimal}, {"worst", worst}});
  EXPECT_EQ(data["motions"][1]["role"], "worst");
  EXPECT_EQ(data["worst_frame"], minimal.expect.worst_frame) << "told by the first";
  EXPECT_NE(data["motions"][0]["glb"], data["motions"][1]["glb"]);
}

TEST(CaseData, TellsWhatDynamicsDid) {
  const Json motion = data_of({{"minimal", made_up(scene("human_dynamic"), "balance", "human")}})["motions"][0];
  EXPECT_EQ(motion["first_frame"], -1) << "this one does not fail";
  EXPECT_EQ(motion["balance"].size(), motion["frame_count"]);
  EXPECT_EQ(motion["balance"][0]["zmp"].size(), 3U);
  EXPECT_TRUE(motion["ghost_glb"].get<std::string>().starts_with("H4sI"));
  EXPECT_NE(motion["ghost_glb"], motion["glb"]);
  const auto is_blow = [](const Json& mark) { return mark["kind"] == "impact" && mark["frame"] == 10; };
  EXPECT_EQ(std::ranges::count_if(motion["marks"], is_blow), 1);
}

TEST(CaseData, GroundThatIsNotLevelIsAMesh) {
  const Json motion = data_of({{"minimal", made_up(scene("mech_falls"), "balance", "mech")}})["motions"][0];
  const Json& ground = motion["ground"];
  EXPECT_EQ(ground["positions"].size() % 3, 0U);
  EXPECT_GE(ground["indices"].size(), 6U);
  for (const Json& index : ground["indices"]) EXPECT_LT(index.get<std::size_t>() * 3, ground["positions"].size());
}

TEST(CaseData, SaysWhyWhereACaseCannotBeShown) {
  EXPECT_EQ(Json::parse(case_problem("k", "no </script>"))["problem"], "no </script>");
  EXPECT_EQ(case_problem("k", "no </script>").find('<'), std::string::npos);
  Case unknown = failing_case(bent_elbow(158), "joint_range", kElbow);
  unknown.expect.check = "of_tomorrow";
  EXPECT_EQ(data_of({{"minimal", unknown}})["meaning"], "");
}

TEST(CaseData, SaysWhatTheMinimalSpecNeeds) {
  const Case minimal = failing_case(bent_elbow(158), "joint_range", kElbow);
  Case original = minimal;
  original.spec.environment.ground = StepsGround{};
  EXPECT_EQ(data_of({{"minimal", minimal}, {"original", original}})["needs"], "pose");
}

TEST(CaseData, AKeyStaysAString) {
  EXPECT_EQ(case_script("a\"</script>\xE2\x80\xA8", "{}"), "contortCase(\"a\\\"\\u003c/script>\\u2028\", {});\n");
}

TEST(CaseData, IsFoundAgainInItsScript) {
  for (const char* key : {"a", "a\"b"}) EXPECT_EQ(data_of_script(key, case_script(key, "{\"x\": 1}")), "{\"x\": 1}");
  EXPECT_EQ(data_of_script("a", case_script("b", "{}")), "");
  EXPECT_EQ(data_of_script("a", ""), "");
}

TEST(CaseData, ALibraryWithoutTheCharacterIsAnIssue) {
  const Case stored = made_up(spec_of({}, "nobody"), "joint_range", "x");
  const std::vector<ShownCase> shown = {{"minimal", stored}};
  const Result<std::string> data = case_data("k", shown, stock_generator(), {});
  ASSERT_FALSE(data);
  EXPECT_EQ(data.issue().code, "character.unknown_character");
}

}  // namespace
}  // namespace contort
