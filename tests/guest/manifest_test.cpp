// Manifests of generators that are programs of their own: each fault is reported at its place.
#include "guest/manifest.h"

#include <gtest/gtest.h>

#include <string>

#include "guest/guest_figure.h"
#include "guest/manifest_check.h"

namespace contort {
namespace {

std::string manifest_with(const std::string& joints, const std::string& actions, const std::string& more = "") {
  return R"({"contort":1,"name":"g","characters":[{"name":"hero","joints":[)" + joints + R"(]}],"actions":[)" +
         actions + "]" + more + "}";
}

const std::string kHips = R"({"name":"hips","position":[0,1,0]})";
const std::string kArm = R"({"name":"arm","parent":"hips","slot":"arm_l","position":[0.2,0.4,0]})";
const std::string kWave = R"({"name":"wave","slots":["arm_l"]})";

std::string refusal_of(const std::string& json) {
  const Result<GuestManifest> manifest = parse_manifest(json);
  return manifest ? "" : manifest.issue().code + " at " + manifest.issue().pointer;
}

// Two hinges; the arm follows as declared.
std::string with_follower(const std::string& follows, const std::string& more_of_tail = "") {
  return manifest_with(kHips + R"(,{"name":"arm","parent":"hips","slot":"arm_l","type":"hinge","follows":)" + follows +
                           R"(},{"name":"tail","parent":"hips","slot":"tail","type":"hinge")" + more_of_tail + "}",
                       kWave);
}

TEST(GuestManifests, SayWhichJointsFollowOthers) {
  const Result<GuestManifest> manifest =
      parse_manifest(with_follower(R"({"joint":"tail","multiplier":-0.5,"offset_deg":10})"));
  ASSERT_TRUE(manifest) << to_line(manifest.issue());
  const GuestCharacter& hero = manifest->characters[0];
  EXPECT_EQ(hero.joints[1].follows, (GuestFollow{"tail", -0.5, 10.0}));
  const std::vector<Coupling> couplings = couplings_of(hero, {0, 5, 7});
  ASSERT_EQ(couplings.size(), 1U);
  EXPECT_EQ(couplings[0].joint, 5);
  EXPECT_EQ(couplings[0].leader, 7);
  EXPECT_EQ(couplings[0].multiplier, -0.5);
  EXPECT_NEAR(couplings[0].offset, 10.0 * kRadPerDeg, 1e-12);
  EXPECT_EQ(print_manifest(*manifest).find("\"follows\":null"), std::string::npos) << "the others say nothing";
}

TEST(GuestManifests, MayLeaveOutWhatHasADefault) {
  const Result<GuestManifest> manifest = parse_manifest(manifest_with(kHips + "," + kArm, kWave));
  ASSERT_TRUE(manifest) << to_line(manifest.issue());
  EXPECT_EQ(manifest->rate_hz, 60.0);
  EXPECT_EQ(manifest->characters[0].joints[1].type, GuestJointType::ball);
  EXPECT_EQ(slots_of(manifest->characters[0]), (std::vector<std::string>{"body", "arm_l"}));
}

TEST(GuestManifests, TellFaultsWhereTheyStand) {
  const std::string both = kHips + "," + kArm;
  const std::pair<std::string, std::string> faults[] = {
      {"nonsense", "json.syntax at "},
      {"[1]", "generator.wrong_type at "},
      {R"({"contort":2,"name":"g","characters":[],"actions":[]})", "generator.out_of_range at /contort"},
      {R"({"contort":1,"name":"g","characters":[],"actions":[]})", "generator.no_character at /characters"},
      {manifest_with(both, ""), "generator.no_action at /actions"},
      {manifest_with(both, kWave, R"(,"colour":"red")"), "generator.unknown_field at /colour"},
      {manifest_with(kArm, kWave), "generator.bad_root at /characters/0/joints/0/parent"},
      {manifest_with(kHips + R"(,{"name":"arm"})", kWave), "generator.bad_root at /characters/0/joints/1/parent"},
      {manifest_with(kHips + R"(,{"name":"arm","parent":"hip"})", kWave),
       "generator.unknown_joint at /characters/0/joints/1/parent"},
      {manifest_with(kHips + "," + kHips, kWave), "generator.duplicate_name at /characters/0/joints/1/name"},
      {manifest_with(kHips + R"(,{"name":"arm","parent":"hips","rotation":[0,0,0,0.5]})", kWave),
       "generator.bad_rotation at /characters/0/joints/1/rotation"},
      {manifest_with(kHips + R"(,{"name":"arm","parent":"hips","axis":[0,0,0]})", kWave),
       "generator.bad_axis at /characters/0/joints/1/axis"},
      {manifest_with(kHips + R"(,{"name":"arm","parent":"hips","low_deg":20,"high_deg":10})", kWave),
       "generator.bad_range at /characters/0/joints/1/low_deg"},
      {manifest_with(kHips + R"(,{"name":"arm","parent":"hips","low_deg":5,"high_deg":10})", kWave),
       "generator.bad_range at /characters/0/joints/1/low_deg"},
      {manifest_with(both, R"({"name":"wave","params":{"how":{"type":"choice","choices":["Upper"]}}})"),
       "generator.bad_text at /actions/0/params/how/choices/0"},
      {manifest_with(both + R"(,{"name":"chest","parent":"hips"},{"name":"other","parent":"chest","slot":"arm_l"})", kWave),
       "generator.split_slot at /characters/0/joints/3/slot"},
      {manifest_with(both, kWave, R"(,"channels":[{"name":"c","contact":"arm"}])"),
       "generator.bad_channel at /channels/0/contact"},
      {manifest_with(both, kWave, R"(,"channels":[{"name":"c","type":"flag","contact":"leg"}])"),
       "generator.unknown_joint at /channels/0/contact"},
      {manifest_with(both, R"({"name":"wave","mirror":"nod"})"), "generator.unknown_action at /actions/0/mirror"},
      {manifest_with(both, R"({"name":"wave","returns_s":-1})"), "generator.out_of_range at /actions/0/returns_s"},
      {manifest_with(both, kWave, R"(,"relations":["mirror"])"), "generator.not_symmetric at /characters/0/mirror"},
      {manifest_with(both, R"({"name":"wave","slots":["arm_x"]})"), "generator.unknown_slot at /actions/0/slots/0"},
      {manifest_with(both, R"({"name":"wave","duration_s":[2,1]})"), "generator.bad_range at /actions/0/duration_s"},
      {manifest_with(both, R"({"name":"wave","params":{"how":{"type":"choice"}}})"),
       "generator.bad_choice at /actions/0/params/how/choices"},
      {manifest_with(both, R"({"name":"wave","params":{"how":{"low":1,"high":0}}})"),
       "generator.bad_range at /actions/0/params/how/low"},
      {manifest_with(both, R"({"name":"wave","params":{"how":{"low":0,"high":1,"default":2}}})"),
       "generator.bad_value at /actions/0/params/how/default"},
      {manifest_with(both, R"({"name":"wave","params":{"how":{"special":[true]}}})"),
       "generator.bad_value at /actions/0/params/how/special/0"},
      {manifest_with(both, R"({"name":"wave","goal":{"param":"to","tip":"arm"}})"),
       "generator.unknown_param at /actions/0/goal/param"},
      {manifest_with(both, R"({"name":"wave","params":{"to":{"type":"vec3"}},"goal":{"param":"to","tip":"leg"}})"),
       "generator.unknown_joint at /actions/0/goal/tip"},
      {manifest_with(both, kWave, R"(,"relations":["echo"])"), "generator.bad_relation at /relations/0"},
      {R"({"contort":1,"name":"g","actions":[)" + kWave + R"(],"characters":[{"name":"hero","joints":[)" + both +
           R"(],"may_touch":[["one","two"]]}]})",
       "generator.unknown_collider at /characters/0/may_touch/0"},
      {manifest_with(kHips + R"(,{"name":"arm","parent":"hips","slot":"arm_l","swing_axis":[0,1,0]})", kWave),
       "generator.bad_axis at /characters/0/joints/1/swing_axis"},
      {with_follower(R"({"joint":"arms"})"), "generator.unknown_joint at /characters/0/joints/1/follows/joint"},
      {with_follower(R"({"multiplier":2})"), "generator.missing_field at /characters/0/joints/1/follows"},
      {with_follower(R"("tail")"), "generator.wrong_type at /characters/0/joints/1/follows"},
      {with_follower(R"({"joint":"tail","multiplier":1e9})"),
       "generator.out_of_range at /characters/0/joints/1/follows/multiplier"},
      {with_follower(R"({"joint":"tail","offset_deg":"much"})"),
       "generator.wrong_type at /characters/0/joints/1/follows/offset_deg"},
      {with_follower(R"({"joint":"tail","ratio":2})"), "generator.unknown_field at /characters/0/joints/1/follows/ratio"},
      {with_follower(R"({"joint":"hips"})"), "generator.bad_follower at /characters/0/joints/1/follows/joint"},
      {with_follower(R"({"joint":"arm"})"), "generator.bad_follower at /characters/0/joints/1/follows/joint"},
      {with_follower(R"({"joint":"tail"})", R"(,"follows":{"joint":"arm"})"),
       "generator.bad_follower at /characters/0/joints/1/follows/joint"},
      {manifest_with(kHips + R"(,{"name":"arm","parent":"hips","follows":{"joint":"hips"}})", kWave),
       "generator.bad_follower at /characters/0/joints/1/follows"},
      {manifest_with(both, kWave, R"(,"convention":{"up":"+z","forward":"-z"})"),
       "generator.bad_convention at /convention/forward"},
  };
  for (const auto& [json, refusal] : faults) EXPECT_EQ(refusal_of(json), refusal) << json;
}

// Build and token do not make another generator.
TEST(GuestManifests, AreNamedByWhatTheyOffer) {
  const auto hash_of = [](const std::string& more) {
    return manifest_hash(*parse_manifest(manifest_with(kHips + "," + kArm, kWave, more)));
  };
  EXPECT_EQ(hash_of(""), hash_of(R"(,"build":"7","token":"x")"));
  EXPECT_NE(hash_of(""), hash_of(R"(,"rate_hz":30)"));
}

}  // namespace
}  // namespace contort
