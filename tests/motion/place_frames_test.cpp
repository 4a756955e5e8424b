// Whole motions placed at once: the bits of one frame at a time, by every set of instructions that the machine has.
#include "model/motion/place_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "model/character/library.h"
#include "model/motion/kinematics.h"
#include "tests/checks/small_character.h"
#include "tests/geometry/solids.h"

namespace contort {

namespace {

using test_solids::Random;

Motion any_motion(const Character& character, int frames, Random& random) {
  Motion motion = small::at_rest(character, frames);
  for (int frame = 0; frame < frames; ++frame) {
    motion.root[static_cast<std::size_t>(frame)] = random.rigid(10.0);
    for (const Joint& joint : character.joints())
      if (joint.kind == JointKind::ball)
        small::set(motion, frame, joint, random.rigid(1.0).q);
      else if (joint.kind != JointKind::root)
        small::set(motion, frame, joint, random.uniform(-4.0, 4.0));
  }
  return motion;
}

std::vector<Rigid> frame_by_frame(const Character& character, const Motion& motion) {
  std::vector<Rigid> world(character.joints().size() * static_cast<std::size_t>(motion.frame_count));
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    const auto f = static_cast<std::size_t>(frame);
    forward_kinematics(character, motion.root[f], motion.row(frame),
                       std::span(world).subspan(f * character.joints().size(), character.joints().size()));
  }
  return world;
}

void expect_same_bits(const Character& character, const Motion& motion, const PlacingKernel& kernel) {
  std::vector<Rigid> world;
  place_frames(character, motion, world, kernel);
  const std::vector<Rigid> one_by_one = frame_by_frame(character, motion);
  ASSERT_EQ(world.size(), one_by_one.size());
  if (world.empty()) return;  // and no address
  EXPECT_EQ(std::memcmp(world.data(), one_by_one.data(), world.size() * sizeof(Rigid)), 0)
      << kernel.name << ", " << motion.frame_count << " frames";
}

TEST(Kinematics, OfChosenJointsHasTheBitsOfAWholePass) {
  Random random(5);
  for (const char* name : {"human", "mech", "quadruped"}) {
    const Character character = *build_character({name, {}, {}}, stock_library());
    const Motion motion = any_motion(character, 1, random);
    const std::vector<Rigid> whole = frame_by_frame(character, motion);
    for (int step = 1; step <= 3; ++step) {
      std::vector<int> chosen;
      for (int j = step; j < static_cast<int>(whole.size()); j += step) chosen.push_back(j);
      std::vector<Rigid> world = whole;
      for (const int j : chosen) world[static_cast<std::size_t>(j)] = {};
      forward_kinematics(character, motion.row(0), chosen, world);
      EXPECT_EQ(std::memcmp(world.data(), whole.data(), whole.size() * sizeof(Rigid)), 0) << name << ", " << step;
    }
  }
}

TEST(PlaceFrames, HasTheBitsOfOneFrameAtATime) {
  Random random(3);
  for (const char* name : {"human", "mech", "quadruped"}) {
    const Character character = *build_character({name, {}, {}}, stock_library());
    for (int frames = 0; frames <= 9; ++frames)
      for (const PlacingKernel& kernel : placing_kernels())
        expect_same_bits(character, any_motion(character, frames, random), kernel);
  }
  const Character with_all_kinds = small::build();
  for (const PlacingKernel& kernel : placing_kernels())
    expect_same_bits(with_all_kinds, any_motion(with_all_kinds, 6, random), kernel);
}

TEST(PlaceFrames, AnAngleThatIsNoneHasNoPlaceInItsFrameAlone) {
  const Character character = *build_character({"human", {}, {}}, stock_library());
  const auto hinge = std::ranges::find(character.joints(), JointKind::hinge, &Joint::kind);
  Random random(4);
  Motion motion = any_motion(character, 4, random);
  small::set(motion, 2, *hinge, std::numeric_limits<double>::infinity());
  for (const PlacingKernel& kernel : placing_kernels()) {
    std::vector<Rigid> world;
    place_frames(character, motion, world, kernel);
    const auto joint = static_cast<std::size_t>(hinge - character.joints().begin());
    for (std::size_t frame = 0; frame < 4; ++frame)
      EXPECT_EQ(std::isnan(world[frame * character.joints().size() + joint].q.w), frame == 2);
  }
}

}  // namespace

}  // namespace contort
