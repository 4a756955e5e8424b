// ASF and AMC: reading, refusals, and conversion to an asset.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <tuple>

#include "formats/mocap/amc.h"
#include "formats/mocap/asf.h"
#include "model/asset/sample.h"
#include "tests/mocap/asf_text.h"
#include "tests/mocap/bvh_text.h"

namespace contort {
namespace {

AsfSkeleton skeleton_of(const std::string& text = small_asf()) {
  Result<AsfSkeleton> skeleton = parse_asf(text);
  if (!skeleton) throw std::runtime_error(to_line(skeleton.issue()));
  return std::move(skeleton).value();
}

AmcMotion motion_of(const std::string& text = small_amc()) {
  Result<AmcMotion> motion = parse_amc(text, skeleton_of());
  if (!motion) throw std::runtime_error(to_line(motion.issue()));
  return std::move(motion).value();
}

TEST(Asf, BonesHaveTheirFramesAndLimits) {
  const AsfSkeleton skeleton = skeleton_of();
  EXPECT_EQ(skeleton.name, "tiny");
  EXPECT_EQ(skeleton.length_unit, 0.45);
  EXPECT_EQ(skeleton.root_position, Vec3(0, 1, 0));
  ASSERT_EQ(skeleton.bones.size(), 4U);
  EXPECT_EQ(skeleton.order, (std::vector<int>{0, 1, 2, 3}));
  const AsfBone& arm = skeleton.bones[1];
  EXPECT_EQ(arm.name, "arm");
  EXPECT_EQ(arm.parent, 0);
  EXPECT_EQ(arm.direction, Vec3(1, 0, 0));
  EXPECT_EQ(arm.length, 2.5);
  EXPECT_LT(rotation_angle(glm::conjugate(arm.axis) * axis_angle(Vec3(0, 0, 1), kPi / 2)), 1e-15);
  const double inf = std::numeric_limits<double>::infinity();
  ASSERT_EQ(arm.dofs.size(), 3U);
  EXPECT_EQ(arm.dofs[1], (AsfDof{DofKind::ry, -30 * kRadPerDeg, 30 * kRadPerDeg}));
  EXPECT_EQ(arm.dofs[2], (AsfDof{DofKind::rz, -inf, inf}));
  EXPECT_TRUE(skeleton.bones[3].dofs.empty());
  EXPECT_EQ(skeleton.bones[0].dofs.size(), 6U);
}

TEST(Asf, RadiansAreReadAsRadians) {
  const AsfSkeleton skeleton = skeleton_of(replaced(small_asf(), "angle deg", "angle rad"));
  EXPECT_EQ(skeleton.bones[2].dofs[0].high, 45.0);
}

TEST(Amc, NumbersAreInTheSkeletonsOrder) {
  const AmcMotion motion = motion_of();
  EXPECT_EQ(motion.first_frame, 6);
  EXPECT_EQ(motion.frame_count, 4);
  EXPECT_EQ(motion.dof_count, 10);
  EXPECT_EQ(motion.row(0)[2], 3.0) << "lengths are no angles";
  EXPECT_EQ(motion.row(0)[6], 90 * kRadPerDeg);
  EXPECT_EQ(motion.row(0)[9], 45 * kRadPerDeg);
  EXPECT_EQ(motion.row(3)[9], -2 * kRadPerDeg);
}

TEST(Amc, AsAnAssetABoneTurnsAboutItsOwnAxis) {
  const Asset asset = to_asset(skeleton_of(), motion_of(), 50.0, "take");
  ASSERT_EQ(asset.nodes.size(), 4U);
  EXPECT_EQ(asset.nodes[2].parent, 1);
  EXPECT_EQ(asset.nodes[2].rest.translation, Vec3(2.5, 0, 0)) << "a bone begins where its parent ends";
  EXPECT_EQ(asset.clips[0].last_s, 3 / 50.0);
  const std::vector<Trs> first = pose(asset, asset.clips[0], 0.0);
  // The arm's x axis is the world's y: C turns x to y.
  EXPECT_LT(rotation_angle(glm::conjugate(first[1].rotation) * axis_angle(Vec3(0, 1, 0), kPi / 2)), 1e-15);
  EXPECT_EQ(first[0].translation, Vec3(1, 3, 3));
  EXPECT_EQ(first[3].rotation, kNoRotation);
}

TEST(Amc, RotationsAreAppliedInTheOrderOfTheAxis) {
  const std::string amc = "1\nroot 0 0 0 90 90 0\narm 0 0 0\nhand 0\n";
  for (const auto& [order, a, b] :
       {std::tuple("XYZ", Vec3(0, 1, 0), Vec3(1, 0, 0)), std::tuple("YXZ", Vec3(1, 0, 0), Vec3(0, 1, 0))}) {
    const AsfSkeleton skeleton = skeleton_of(replaced(small_asf(), "axis XYZ", std::string("axis ") + order));
    const Result<AmcMotion> motion = parse_amc(amc, skeleton);
    ASSERT_TRUE(motion);
    const Asset asset = to_asset(skeleton, *motion, 120.0, "");
    const Quat q = sample_rotation(asset.clips[0].channels[0], 0.0);
    EXPECT_LT(rotation_angle(glm::conjugate(q) * axis_angle(a, kPi / 2) * axis_angle(b, kPi / 2)), 1e-15) << order;
  }
}

struct Hostile {
  const char* name;
  const char* what;
  const char* by;
  const char* code;
};

const Hostile kHostileAsf[] = {
    {"no section", ":version 1.10", "version", "asf.bad_syntax"},
    {"an unknown unit", "angle deg", "angle gon", "asf.bad_syntax"},
    {"no length", "length 0.45", "length 0", "asf.out_of_range"},
    {"an unknown degree of freedom", "dof ry\n", "dof rq\n", "asf.bad_dof"},
    {"a degree of freedom twice", "dof rx ry rz", "dof rx rx rz", "asf.bad_dof"},
    {"no order of rotations", "0 0 90  XYZ", "0 0 90  XXZ", "asf.bad_syntax"},
    {"a direction of two numbers", "direction 0 0 1", "direction 0 1", "asf.bad_number"},
    {"a direction of no sense", "direction 0 0 1", "direction 0 0 1e7", "asf.out_of_range"},
    {"limits the wrong way round", "(0.0 45.0)", "(45.0 0.0)", "asf.bad_limit"},
    {"a limit that is none", "(0.0 45.0)", "(nan 45.0)", "asf.out_of_range"},
    {"limits too few", "           (-inf inf)\n", "", "asf.bad_number"},
    {"limits too many", "(0.0 45.0)", "(0.0 45.0) (0.0 1.0)", "asf.wrong_count"},
    {"limits without degrees of freedom", "    dof ry\n", "", "asf.wrong_count"},
    {"two bones of one name", "name hand", "name arm", "asf.bad_bone"},
    {"a bone without a name", "name hand", "name", "asf.bad_bone"},
    {"an unknown child", "root arm nose", "root arm ear", "asf.unknown_bone"},
    {"two parents", "root arm nose", "root arm nose hand", "asf.bad_hierarchy"},
    {"the root as a child", "arm hand", "arm hand root", "asf.bad_hierarchy"},
    {"a ring", "root arm nose\n    arm hand", "root nose\n    arm hand\n    hand arm", "asf.bad_hierarchy"},
    {"a bone in no tree", "root arm nose", "root arm", "asf.bad_hierarchy"},
    {"no root", "order TX TY TZ RX RY RZ", "order", "asf.truncated"},
};

TEST(HostileAsf, IsRefusedByName) {
  for (const Hostile& hostile : kHostileAsf) {
    const auto result = parse_asf(replaced(small_asf(), hostile.what, hostile.by));
    ASSERT_FALSE(result.ok()) << hostile.name;
    EXPECT_EQ(result.issue().code, hostile.code) << hostile.name << ": " << to_line(result.issue());
  }
  EXPECT_EQ(parse_asf("").issue().code, "asf.truncated");
  EXPECT_EQ(read_asf("/dev/zero").issue().code, "asf.unreadable");
}

const Hostile kHostileAmc[] = {
    {"no frame number", "6\n", "", "amc.bad_number"},
    {"a gap in the frames", "8\n", "9\n", "amc.bad_frame"},
    {"frames that overflow", "6\n", "99999999999999999999\n", "amc.bad_number"},
    {"an unknown bone", "hand 45", "foot 45", "amc.unknown_bone"},
    {"a bone that does not move", "hand 45", "nose 45", "amc.bad_bone"},
    {"a bone twice", "hand 45", "hand 45\nhand 45", "amc.bad_bone"},
    {"a bone too few", "hand 45\n", "", "amc.too_few_values"},
    {"a number too few", "arm 90 0 0", "arm 90 0", "amc.too_few_values"},
    {"a number too many", "hand 45", "hand 45 1", "amc.too_many_values"},
    {"an angle that is none", "hand 45", "hand nan", "amc.out_of_range"},
    {"an endless angle", "hand 45", "hand 1e300", "amc.out_of_range"},
    {"a word for a number", "hand 45", "hand x", "amc.bad_number"},
};

TEST(HostileAmc, IsRefusedByName) {
  for (const Hostile& hostile : kHostileAmc) {
    const auto result = parse_amc(replaced(small_amc(), hostile.what, hostile.by), skeleton_of());
    ASSERT_FALSE(result.ok()) << hostile.name;
    EXPECT_EQ(result.issue().code, hostile.code) << hostile.name << ": " << to_line(result.issue());
  }
  EXPECT_EQ(parse_amc(":DEGREES\n", skeleton_of()).issue().code, "amc.truncated");
  EXPECT_EQ(read_amc("/dev/zero", skeleton_of()).issue().code, "amc.unreadable");
}

TEST(HostileAsf, ATextThatEndsEarlyIsReadOrRefused) {
  const auto is_read_or_refused_by = [](const auto& result, const char* area) {
    return result.ok() || result.issue().code.starts_with(area);
  };
  const std::string asf = small_asf();
  for (std::size_t size = 0; size < asf.size(); ++size)
    EXPECT_TRUE(is_read_or_refused_by(parse_asf(asf.substr(0, size)), "asf.")) << size;
  const std::string amc = small_amc();
  for (std::size_t size = 0; size < amc.size(); ++size)
    EXPECT_TRUE(is_read_or_refused_by(parse_amc(amc.substr(0, size), skeleton_of()), "amc.")) << size;
}

std::string changed(std::string text) {
  const auto changes = *rc::gen::container<std::vector<std::pair<std::uint16_t, char>>>(
      rc::gen::arbitrary<std::pair<std::uint16_t, char>>());
  for (const auto& [place, value] : changes) text[place % text.size()] = value;
  return text;
}

RC_GTEST_PROP(HostileAsfProperty, ChangedBytesNeverCrash, ()) {
  const Result<AsfSkeleton> skeleton = parse_asf(changed(small_asf()));
  if (!skeleton) RC_ASSERT(skeleton.issue().code.starts_with("asf."));
  const Result<AmcMotion> motion = parse_amc(changed(small_amc()), skeleton ? *skeleton : skeleton_of());
  if (!motion) RC_ASSERT(motion.issue().code.starts_with("amc."));
}

}  // namespace
}  // namespace contort
