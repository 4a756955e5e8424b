// From stage to motion: the action that moves a part, the movement, and its frames.
#include "generator/generate.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

#include "fuzz/draw.h"
#include "generator/motion/gait.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::coord;
using fixtures::elbow;
using fixtures::human;
using fixtures::sequence;
using fixtures::stage_of;
using fixtures::use;

constexpr double kDeg = kRadPerDeg;
const char* const kElbow = "arm_left/elbow";
const int kArm = human().find_part("arm_left");

// One rounding of a + (b - a) * 1: measured 2.2e-16 rad.
TEST(Generate, PosesReachTheirKeyPoseInTheLastFrame) {
  const Motion motion = generate(stage_of({sequence({elbow(0, 30, 90), elbow(30, 12, 20)})}));
  ASSERT_EQ(motion.frame_count, 43);
  EXPECT_EQ(coord(motion, 0, human(), kElbow), 0.0);
  EXPECT_NEAR(coord(motion, 15, human(), kElbow), 45 * kDeg, 1e-15);
  EXPECT_NEAR(coord(motion, 30, human(), kElbow), 90 * kDeg, 1e-15);  // before this test: 0.03 degrees short
  EXPECT_NEAR(coord(motion, 36, human(), kElbow), 55 * kDeg, 1e-15);
  EXPECT_NEAR(coord(motion, 42, human(), kElbow), 20 * kDeg, 1e-15);
}

TEST(Generate, EvenActionsOfOneFrameAreSeen) {
  const auto character = std::make_shared<const Character>(fixtures::built({}, fixtures::tireless_library()));
  const Motion motion = generate(
      stage_of({sequence({elbow(0, 1, 90), elbow(1, 1, 20)}), sequence({elbow(0, 1, 50)})}, 0, character));
  EXPECT_NEAR(coord(motion, 1, human(), kElbow), 90 * kDeg, 1e-15);
  EXPECT_NEAR(coord(motion, 2, human(), kElbow), 20 * kDeg, 1e-15);
  EXPECT_NEAR(coord(motion, 3, human(), kElbow), 50 * kDeg, 1e-15);
}

TEST(Generate, SpeedTwoReachesTheTargetHalfwayAndHolds) {
  ActionUse fast = elbow(0, 30, 90);
  fast.speed = 2;
  const Motion motion = generate(stage_of({sequence({fast})}));
  EXPECT_LT(coord(motion, 14, human(), kElbow), 90 * kDeg);
  for (int frame = 15; frame <= 30; ++frame) EXPECT_NEAR(coord(motion, frame, human(), kElbow), 90 * kDeg, 1e-15);
}

TEST(Generate, FrameZeroIsRest) {
  const Motion motion = generate(stage_of({sequence({elbow(0, 30, 90)})}));
  const auto rest = human().rest_coords();
  EXPECT_TRUE(std::equal(rest.begin(), rest.end(), motion.row(0).begin()));
  EXPECT_EQ(motion.root.front(), human().rest_root());
  EXPECT_EQ(generate(stage_of({})).frame_count, 1);
}

TEST(Generate, PartsWithoutActionsHold) {
  const Motion motion = generate(stage_of({sequence({elbow(5, 10, 90)})}, 20));
  const auto own = static_cast<std::size_t>(fixtures::joint(human(), kElbow).coord);
  for (int frame = 0; frame < motion.frame_count; ++frame)
    for (std::size_t i = 0; i < static_cast<std::size_t>(motion.coord_count); ++i)
      ASSERT_TRUE(i == own || motion.row(frame)[i] == human().rest_coords()[i]) << frame << " " << i;
  for (int frame = 0; frame <= 5; ++frame) EXPECT_EQ(coord(motion, frame, human(), kElbow), 0.0);
  for (int frame = 15; frame < 36; ++frame)
    EXPECT_EQ(coord(motion, frame, human(), kElbow), coord(motion, 15, human(), kElbow));
}

TEST(Generate, JointsWithoutAValueHoldInsideAnAction) {
  const ActionUse shoulder = use("pose", "arm_left", 10, 10, {{"shoulder_deg", Vec3(0, 0, 40)}});
  const Motion motion = generate(stage_of({sequence({elbow(0, 10, 90), shoulder})}));
  EXPECT_NEAR(coord(motion, 20, human(), kElbow), 90 * kDeg, 1e-15);
  EXPECT_NEAR(2 * std::acos(coord(motion, 20, human(), "arm_left/shoulder")), 40 * kDeg, 1e-12);
}

std::vector<ActionSpan> spans_of(const Stage& stage) { return generate(stage).spans; }

TEST(Generate, OfTwoPosesTheLaterStartWins) {
  const Stage stage = stage_of({sequence({elbow(0, 40, 90), elbow(10, 10, 20)})});
  const Motion motion = generate(stage);
  EXPECT_NEAR(coord(motion, 20, human(), kElbow), 20 * kDeg, 1e-15);
  // The first action was replaced and does not come back.
  EXPECT_NEAR(coord(motion, 40, human(), kElbow), 20 * kDeg, 1e-15);
  EXPECT_EQ(motion.spans, (std::vector<ActionSpan>{{0, 10, 0, 0, 0, kArm}, {11, 20, 0, 0, 1, kArm}}));
  const std::vector<ActionSpan> swapped = spans_of(stage_of({sequence({elbow(10, 10, 20), elbow(0, 40, 90)})}));
  EXPECT_EQ(swapped, (std::vector<ActionSpan>{{0, 10, 0, 0, 1, kArm}, {11, 20, 0, 0, 0, kArm}}));
}

TEST(Generate, OfTwoPosesWithOneStartTheLaterInTheSpecWins) {
  const Motion motion = generate(stage_of({sequence({elbow(0, 20, 90), elbow(0, 20, 30)})}));
  EXPECT_NEAR(coord(motion, 20, human(), kElbow), 30 * kDeg, 1e-15);
  EXPECT_EQ(motion.spans, (std::vector<ActionSpan>{{0, 20, 0, 0, 1, kArm}}));
}

TEST(Generate, ReachingWinsOverPosingEvenIfThePoseStartedLater) {
  const ActionUse reach = use("reach", "arm_left", 0, 30, {{"target_m", Vec3(0.2, 1.2, 0.3)}});
  const Stage stage = stage_of({sequence({reach, elbow(10, 15, 90)})});
  EXPECT_EQ(spans_of(stage), (std::vector<ActionSpan>{{0, 30, 0, 0, 0, kArm}, {10, 25, 0, 0, 1, kArm}}));
  const Motion motion = generate(stage);
  std::vector<Rigid> world(human().joints().size());
  forward_kinematics(human(), motion.root[30], motion.row(30), world);
  const Vec3 wrist_m = world_from_socket(human(), world, human().find_socket("arm_left/wrist")).p_m;
  EXPECT_LT(length(wrist_m - Vec3(0.2, 1.2, 0.3)), 1e-9);
}

TEST(Generate, ATargetIsReachedWhileTheCarrierMoves) {
  const ActionUse reach = use("reach", "arm_left", 0, 30, {{"target_m", Vec3(0.2, 1.2, 0.3)}});
  const ActionUse bow = use("pose", "torso", 0, 60, {{"lumbar_flex_deg", 30.0}, {"lumbar_rot_deg", 10.0}});
  const Motion motion = generate(stage_of({sequence({reach, bow})}));
  std::vector<Rigid> world(human().joints().size());
  forward_kinematics(human(), motion.root[30], motion.row(30), world);
  const Vec3 wrist_m = world_from_socket(human(), world, human().find_socket("arm_left/wrist")).p_m;
  EXPECT_LT(length(wrist_m - Vec3(0.2, 1.2, 0.3)), 1e-9);
}

// A hinge below the shoulder, in the same part: the chain hangs on a joint of its own part.
std::shared_ptr<const Character> with_clavicle() {
  Library library = stock_library();
  PartDesc& arm = library.parts.at("human_arm");
  JointDesc clavicle;
  clavicle.name = "clavicle";
  arm.joints.insert(arm.joints.begin(), clavicle);
  arm.joints[1].parent = "clavicle";
  arm.joints[1].position_m = Vec3(0.1, 0, 0);
  return std::make_shared<const Character>(fixtures::built({}, library));
}

TEST(Generate, ChainsMayHangOnAJointOfTheirOwnPart) {
  const auto character = with_clavicle();
  const ActionUse turn = use("pose", "arm_left", 0, 10, {{"clavicle_deg", 40.0}});
  const ActionUse reach = use("reach", "arm_left", 10, 10, {{"target_m", Vec3(0.2, 1.2, 0.3)}});
  const Motion motion = generate(stage_of({sequence({turn, reach})}, 0, character));
  std::vector<Rigid> world(character->joints().size());
  forward_kinematics(*character, motion.root[20], motion.row(20), world);
  const Vec3 wrist_m = world_from_socket(*character, world, character->find_socket("arm_left/wrist")).p_m;
  EXPECT_LT(length(wrist_m - Vec3(0.2, 1.2, 0.3)), 1e-9);
  EXPECT_NEAR(coord(motion, 20, *character, "arm_left/clavicle"), 40 * kDeg, 1e-15);
}

Stage drawn_stage(std::int64_t index, bool interrupted = true) {
  Spec spec = draw_spec({{"human", "mech", "quadruped"}}, stock_generator(), 11, index);
  if (!interrupted) spec.interrupts.clear();
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) ADD_FAILURE() << to_line(stage.issue());
  return stage ? *stage : stage_of({});
}

TEST(Generate, MotionsArePureFunctionsOfTheirStage) {
  GenerateScratch scratch;
  Motion reused;
  for (std::int64_t i = 0; i < 40; ++i) {
    const Stage stage = drawn_stage(i);
    const Motion fresh = generate(stage);
    generate(stage, scratch, reused);  // after another character's stage
    ASSERT_EQ(reused, fresh) << i;
    generate(stage, scratch, reused);
    ASSERT_EQ(reused, fresh) << i;
  }
}

void expect_sound(const Motion& motion, const Character& character) {
  for (int frame = 0; frame < motion.frame_count; ++frame)
    for (const Joint& joint : character.joints()) {
      const double* q = motion.row(frame).data() + joint.coord;
      for (int k = 0; k < coord_size(joint.kind); ++k) ASSERT_TRUE(std::isfinite(q[k])) << joint.name;
      if (joint.kind != JointKind::ball) continue;
      const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      ASSERT_NEAR(norm, 1.0, 1e-14) << joint.name << " in frame " << frame;  // measured 4.4e-16
    }
}

TEST(Generate, BallsStayUnitQuaternionsAndAllIsFinite) {
  for (std::int64_t i = 0; i < 40; ++i) {
    const Stage stage = drawn_stage(i);
    expect_sound(generate(stage), *stage.character);
  }
}

// The rule of docs/reference/timeline.md, by counting: in each layer the latest action that has started controls the
// part while it lasts. Further actions, which an aim acquires, take nothing from actions of the spec. A leg goes back
// to the course that the root follows when its own action is over or fades. An additive may last up to half a second
// longer, while its part is on its way back; one that moves a leg ends when a course takes the legs over.
class SpanRule {
 public:
  explicit SpanRule(const Stage& stage) : actions_(stage.timeline.actions) {
    for (int start = 0; const PlannedSequence& sequence : stage.timeline.sequences)  // no interrupt cuts here
      offset_.push_back(start), start += sequence.length;
  }
  int offset(const PlannedAction& a) const { return offset_[static_cast<std::size_t>(a.sequence)]; }
  double starts(const PlannedAction& a) const { return offset(a) + a.start; }

  bool has(const PlannedAction& a, int frame) const {
    const PlannedAction* course = a.def->layer == Layer::ik ? course_of(a.part, frame) : nullptr;
    if (course == nullptr) return is_last(a, frame);
    if (a.def->spread != Spread::legs) return is_last(a, frame) && !fades(a, frame);
    if (a.use != course->use) return false;
    return std::ranges::none_of(actions_, [&](const PlannedAction& b) {
      return b.further < 0 && b.part == a.part && b.def->layer == Layer::ik && b.def->spread != Spread::legs &&
             is_last(b, frame) && !fades(b, frame);
    });
  }

 private:
  bool is_last(const PlannedAction& a, int frame) const {
    if (frame < a.first_frame + offset(a) || frame > a.last_frame + offset(a)) return false;
    // An action that has moved already and started later.
    return std::ranges::all_of(actions_, [&](const PlannedAction& b) {
      const bool competes = b.further < 0 && a.def->layer != Layer::additive && &a != &b && a.part == b.part &&
                            a.def->layer == b.def->layer && starts(b) < frame;
      return !competes ||
             ((starts(a) > starts(b) || (starts(a) == starts(b) && &a > &b)) && starts(a) < frame);
    });
  }
  bool fades(const PlannedAction& a, int frame) const { return not_blended_out(a, frame - offset(a)) < 1.0; }
  // Returns the course of a leg or foot.
  const PlannedAction* course_of(int part, int frame) const {
    for (const PlannedAction& root : actions_)
      if (root.part == 0 && root.further < 0 && root.def->spread == Spread::legs && is_last(root, frame))
        for (const PlannedAction& a : actions_)
          if (part != 0 && a.part == part && a.use == root.use) return &a;
    return nullptr;
  }

  std::span<const PlannedAction> actions_;
  std::vector<int> offset_;
};

void expect_spans_fit(const Stage& stage) {
  const Motion motion = generate(stage);
  const SpanRule rule(stage);
  for (const PlannedAction& a : stage.timeline.actions)
    for (int frame = 0; a.further < 0 && frame < motion.frame_count; ++frame) {
      const bool has = rule.has(a, frame);
      const bool may_be_taken_over =
          is_of_leg(stage.legs, a.part) && std::ranges::any_of(stage.timeline.actions, [&](const PlannedAction& b) {
            return b.def->spread == Spread::legs && (a.def->layer == Layer::additive || b.further >= 0) &&
                   rule.starts(a) < rule.starts(b) && rule.starts(b) <= frame;
          });
      int covered = 0;
      for (const ActionSpan& span : motion.spans)
        covered += span.sequence == a.sequence && span.clip == a.clip && span.action == a.action &&
                   span.part == a.part && span.first_frame <= frame && frame <= span.last_frame;
      const int over = frame - (a.last_frame + rule.offset(a));
      const bool may_linger = a.def->layer == Layer::additive && over > 0 && over <= 30;
      if (may_be_taken_over) {
        ASSERT_LE(covered, has || may_linger ? 1 : 0) << "action " << a.use << " frame " << frame;
      } else if (rule.starts(a) < frame && !may_linger) {
        ASSERT_EQ(covered, has ? 1 : 0) << "action " << a.use << " frame " << frame;
      }
    }
}

TEST(Generate, SpansCoverTheFramesInWhichAnActionHasItsLayer) {
  for (std::int64_t i = 0; i < 15; ++i) expect_spans_fit(drawn_stage(i, false));
}

Motion two_parts() {
  return generate(stage_of({sequence({elbow(0, 30, 90), use("direction", "head", 5, 20, {{"azimuth_deg", 40.0}})})}));
}

TEST(MotionHash, AnyChangedBitOfACoordinateShowsInItsFrame) {
  const Motion before = two_parts();
  const std::uint64_t hash = motion_hash(before);
  for (std::size_t i = 3; i < before.coords.size(); i += 17)
    for (const int bit : {0, 31, 52, 61}) {
      Motion after = before;
      after.coords[i] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(after.coords[i]) ^ std::uint64_t{1} << bit);
      ASSERT_NE(motion_hash(after), hash) << i << " " << bit;
      ASSERT_EQ(first_difference(before, after), static_cast<int>(i) / before.coord_count) << i << " " << bit;
    }
}

TEST(MotionHash, FollowsRateRootAndLength) {
  const Motion before = two_parts();
  Motion after = before;
  after.rate_hz = 30;
  EXPECT_NE(motion_hash(after), motion_hash(before));
  after = before;
  after.root[7].p_m.x += 1e-12;
  EXPECT_NE(motion_hash(after), motion_hash(before));
  EXPECT_EQ(first_difference(before, after), 7);
  EXPECT_EQ(first_difference(before, before), -1);
}

TEST(MotionHash, AShorterMotionDiffersAtItsEnd) {
  const Motion whole = two_parts();
  Motion cut = whole;
  cut.frame_count -= 4;
  EXPECT_EQ(first_difference(whole, cut), cut.frame_count);
  EXPECT_EQ(first_difference(cut, whole), cut.frame_count);
  EXPECT_NE(motion_hash(cut), motion_hash(whole));
}

}  // namespace
}  // namespace contort
