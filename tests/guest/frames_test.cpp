// Frames as numbers of another program: conventions, hinges, and values that are no rotations.
#include "guest/frames.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <limits>

#include "guest/guest_figure.h"
#include "model/motion/kinematics.h"

namespace contort {
namespace {

GuestManifest manifest_of(const GuestConvention& convention, GuestJointType type) {
  GuestManifest manifest;
  manifest.convention = convention;
  GuestJoint root, limb;
  root.name = "hips", root.position = Vec3(0.0, 1.0, 0.0);
  limb.name = "limb", limb.parent = "hips", limb.position = Vec3(0.1, 0.2, 0.3), limb.type = type;
  manifest.characters = {{"hero", {root, limb}, {}, {}}};
  return manifest;
}

struct Read {
  std::shared_ptr<Library> library;
  std::shared_ptr<Character> character;
  Motion motion;
  ForeignFacts facts;
};

Read read_rows(const GuestManifest& manifest, const std::vector<double>& numbers) {
  Read out;
  out.library = std::make_shared<Library>(library_of(manifest));
  out.character = std::make_shared<Character>(build_character({"hero", {}, {}}, *out.library).value());
  const std::vector<int> joints = joints_of(manifest.characters.front(), *out.character);
  const FrameLayout layout{*out.character, joints, Basis(manifest.convention), FrameFormat::f64};
  std::string bytes(numbers.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  read_frames(bytes, layout, static_cast<int>(numbers.size() / 11), out.motion, out.facts);
  return out;
}

std::vector<double> row(const Vec3& root, const Quat& turn, const Quat& limb) {
  return {root.x, root.y, root.z, turn.x, turn.y, turn.z, turn.w, limb.x, limb.y, limb.z, limb.w};
}

std::vector<double> many(const std::vector<Quat>& limb) {
  std::vector<double> numbers;
  for (const Quat& q : limb) {
    const std::vector<double> one = row(Vec3(0.0), kNoRotation, q);
    numbers.insert(numbers.end(), one.begin(), one.end());
  }
  return numbers;
}

Quat drawn_rotation() {
  const auto part = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  return glm::normalize(Quat(1.001 + part(), part(), part(), part()));
}

// The places of joints do not depend on the convention: converting frames and placing joints equals placing joints in
// the convention and converting the points.
RC_GTEST_PROP(GuestFrames, PlaceJointsAlikeInEveryConvention, ()) {
  GuestConvention convention;
  convention.up = static_cast<Axis>(*rc::gen::inRange(0, 6));
  convention.forward = static_cast<Axis>((static_cast<int>(convention.up) / 2 * 2 + *rc::gen::inRange(2, 6)) % 6);
  convention.handed = *rc::gen::element(Hand::right, Hand::left);
  convention.unit_m = *rc::gen::element(1.0, 0.01, 100.0);
  const GuestManifest manifest = manifest_of(convention, GuestJointType::ball);
  const Vec3 place(0.5, -0.25, 2.0);
  const Quat turn = drawn_rotation(), limb = drawn_rotation();
  const Vec3 on_limb(0.3, 0.7, -0.2);
  const Read read = read_rows(manifest, row(place, turn, limb));
  std::vector<Rigid> world(2);
  forward_kinematics(*read.character, read.motion.root[0], read.motion.row(0), world);
  const Basis basis(convention);
  const Vec3 theirs = place + turn * (Vec3(0.1, 0.2, 0.3) + limb * on_limb);
  const Vec3 difference = world[1] * basis.point_m(on_limb) - basis.point_m(theirs);
  RC_ASSERT(length(difference) < 1e-9 * convention.unit_m);
}

TEST(GuestFrames, SeeAHingeTurnBeyondHalfATurn) {
  std::vector<Quat> turning;
  for (int i = 0; i < 40; ++i) turning.push_back(axis_angle(Vec3(0.0, 1.0, 0.0), 0.2 * i));
  const Read read = read_rows(manifest_of({}, GuestJointType::hinge), many(turning));
  for (int i = 0; i < 40; ++i) EXPECT_NEAR(read.motion.row(i)[0], 0.2 * i, 1e-9);
}

TEST(GuestFrames, KeepWhatAHingeCannotHold) {
  const Quat slanted = axis_angle(Vec3(0.0, 1.0, 0.0), 0.5) * axis_angle(Vec3(1.0, 0.0, 0.0), 0.125);
  const Read read = read_rows(manifest_of({}, GuestJointType::hinge), many({kNoRotation, slanted}));
  EXPECT_NEAR(read.facts.off_axis_rad[1], 0.0, 1e-9);
  EXPECT_NEAR(read.facts.off_axis_rad[3], 0.125, 1e-9);
  EXPECT_NEAR(read.motion.row(1)[0], 0.5, 1e-9);
}

TEST(GuestFrames, TellTheLengthOfQuaternions) {
  const Read read = read_rows(manifest_of({}, GuestJointType::ball), many({Quat(0.5, 0, 0, 0), Quat(0, 0, 0, 0)}));
  EXPECT_EQ(read.facts.quaternion_lengths[1], 0.5);
  EXPECT_EQ(read.facts.quaternion_lengths[3], 0.0);
  EXPECT_EQ(read.motion.row(0)[0], 1.0);
  EXPECT_EQ(read.motion.row(1)[0], 1.0) << "a quaternion of length 0 stands for rest";
}

TEST(GuestFrames, LeaveNaNToTheChecks) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const GuestJointType type : {GuestJointType::ball, GuestJointType::hinge}) {
    const Read read = read_rows(manifest_of({}, type), many({Quat(nan, 0, 0, 0), kNoRotation}));
    EXPECT_TRUE(std::isnan(read.motion.row(0)[0]));
    EXPECT_FALSE(std::isnan(read.motion.row(1)[0])) << "the next frame is read as if nothing had happened";
  }
}

}  // namespace
}  // namespace contort
