// Models that lie, and animals and rigs with unusual names or bones.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "import/roles.h"
#include "import/skeleton.h"
#include "tests/import/rigged_model.h"

namespace contort {
namespace {

using fixtures::RiggedBone;
using fixtures::RigOptions;

RiggedFigure figure_of(const std::vector<RiggedBone>& bones, const RigOptions& options = {}) {
  RiggedFigure figure = *read_figure(*parse_skinned_glb(fixtures::rigged(bones, options).glb()), {.name = "m"});
  find_roles(figure);
  return figure;
}

BoneRole role_of(const RiggedFigure& figure, const std::string& label) {
  for (const Bone& bone : figure.bones)
    if (bone.label == label) return bone.role;
  throw std::runtime_error("no bone " + label);
}

TEST(Posture, LyingPersonIsStoodUpAndThisIsSaid) {
  const double half = std::sqrt(0.5);
  const double height_m = figure_of(fixtures::person()).height_m;
  for (const Quat& turned :
       {Quat(half, half, 0, 0), Quat(half, -half, 0, 0), Quat(half, 0, 0, half), Quat(0, 1, 0, 0)}) {
    const RiggedFigure figure = figure_of(fixtures::person(), {.units_per_metre = 1.0, .turned = turned});
    EXPECT_TRUE(figure.is_humanoid);
    EXPECT_NEAR(figure.height_m, height_m, 1e-5);
    EXPECT_FALSE(figure.notes.empty());
    EXPECT_NEAR(rotation_angle(figure.world_from_model * turned), 0.0, 1e-9) << "it faces +Z again";
  }
}

// Four legs on the ground, all of them called legs.
std::vector<RiggedBone> fox() {
  std::vector<RiggedBone> bones = {{"Hips", -1, {0, 0.5, -0.4}, {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}},
                                   {"Spine_1", 0, {0, 0.5, 0.0}, {-0.1, -0.1, -0.3}, {0.1, 0.1, 0.4}},
                                   {"Head", 1, {0, 0.6, 0.5}, {-0.1, -0.1, 0.0}, {0.1, 0.1, 0.3}}};
  for (const double s : {1.0, -1.0})
    for (const bool front : {true, false}) {
      const std::string end = s > 0.0 ? "_L" : "_R", start = front ? "Front_Leg_" : "Back_Leg_";
      const double x = 0.1 * s, z = front ? 0.4 : -0.4;
      const int first = static_cast<int>(bones.size());
      const Vec3 low(-0.03, -0.15, -0.03), high(0.03, 0.0, 0.03);
      bones.push_back({start + (front ? "Shoulder" : "Pelvis") + end, front ? 1 : 0, {x, 0.5, z}, low, high});
      bones.push_back({start + "Upper" + end, first, {x, 0.4, z}, low, high});
      bones.push_back({start + "Lower" + end, first + 1, {x, 0.25, z}, low, high});
      bones.push_back({start + "Foot" + end, first + 2, {x, 0.05, z}, {-0.03, -0.05, -0.03}, high});
    }
  return bones;
}

TEST(Posture, ForelegsThatAreCalledLegsMakeAQuadruped) {
  const RiggedFigure figure = figure_of(fox());
  EXPECT_TRUE(figure.is_quadruped);
  EXPECT_FALSE(figure.is_humanoid);
  for (const char* leg : {"Front_Leg_", "Back_Leg_"})
    for (const char* side : {"_L", "_R"}) {
      EXPECT_EQ(role_of(figure, leg + std::string("Upper") + side), BoneRole::thigh);
      EXPECT_EQ(role_of(figure, leg + std::string("Lower") + side), BoneRole::shank);
      EXPECT_EQ(role_of(figure, leg + std::string("Foot") + side), BoneRole::foot);
    }
}

TEST(Posture, TwistBonesLeaveKneesToTheShins) {
  std::vector<RiggedBone> bones = fixtures::person();
  const auto index_of = [&](const std::string& name) {
    const auto found = std::ranges::find_if(bones, [&](const RiggedBone& bone) { return bone.name == name; });
    return static_cast<int>(found - bones.begin());
  };
  const int thigh = index_of("LeftUpLeg"), shin = index_of("LeftLeg");
  ASSERT_LT(shin, static_cast<int>(bones.size()));
  bones[static_cast<std::size_t>(thigh)].name = "DEF-thigh.L";
  bones[static_cast<std::size_t>(shin)].name = "DEF-shin.L";
  RiggedBone twist = bones[static_cast<std::size_t>(thigh)];
  twist.name = "DEF-thigh.L.001", twist.parent = thigh;
  twist.place = 0.5 * (bones[static_cast<std::size_t>(thigh)].place + bones[static_cast<std::size_t>(shin)].place);
  bones.insert(bones.begin() + thigh + 1, twist);
  for (RiggedBone& bone : bones)
    if (bone.name != twist.name && bone.parent > thigh) ++bone.parent;
  bones[static_cast<std::size_t>(shin + 1)].parent = thigh + 1;
  const RiggedFigure figure = figure_of(bones);
  EXPECT_EQ(role_of(figure, "DEF-thigh.L"), BoneRole::thigh);
  EXPECT_EQ(role_of(figure, "DEF-thigh.L.001"), BoneRole::other);
  EXPECT_EQ(role_of(figure, "DEF-shin.L"), BoneRole::shank);
}

TEST(Posture, PersonOfUnusualSizeIsRemarked) {
  const auto remarks = [](double units) {
    const RiggedFigure figure = figure_of(fixtures::person(), {.units_per_metre = units, .turned = kNoRotation});
    return std::ranges::any_of(figure.notes, [](const std::string& note) { return note.find("unusual") != note.npos; });
  };
  EXPECT_FALSE(remarks(1.0));
  EXPECT_TRUE(remarks(2.5));
}

}  // namespace
}  // namespace contort
