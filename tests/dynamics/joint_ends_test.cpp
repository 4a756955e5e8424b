// Balls stop at the ends of their swing and of their twist, as hinges do.
#include "generator/dynamics/joint_ends.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "generator/built_in.h"
#include "generator/motion/joint_clamp.h"

namespace contort {
namespace {

Joint ball_with(double a_rad, double b_rad, double twist_rad) {
  Joint ball;
  ball.kind = JointKind::ball;
  ball.axis = Vec3(0.0, 0.0, -1.0), ball.swing_axis = Vec3(1.0, 0.0, 0.0);
  ball.swing_a_rad = a_rad, ball.swing_b_rad = b_rad, ball.low = -twist_rad, ball.high = twist_rad;
  return ball;
}

std::array<double, 4> coords_of(const Joint& ball, const SwingTwist& at) {
  std::array<double, 4> coords{};
  set_swing_twist(ball, at, coords.data());
  return coords;
}

// The angle by which a ball is outside of its range after a turn.
double beyond_rad(const Joint& ball, const std::array<double, 4>& coords, const Vec3& turn_rad) {
  const Quat q = Quat(coords[0], coords[1], coords[2], coords[3]) * from_rotation_vector(turn_rad);
  double inside[4] = {q.w, q.x, q.y, q.z};
  clamp_to_range(ball, inside);
  return rotation_angle(glm::conjugate(q) * quat_at(inside));
}

double thousandths(int from_milli, int to_milli) { return *rc::gen::inRange(from_milli, to_milli + 1) / 1000.0; }

TEST(BallEnds, AreWhereSwingOrTwistLeaveTheirRange) {
  const Joint ball = ball_with(1.0, 0.5, 0.3);
  const std::array<double, 4> rest = coords_of(ball, {});
  EXPECT_EQ(ball_ends(ball, rest.data(), Vec3(0.05, 0.0, 0.0)).count, 0);
  const std::array<double, 4> swung = coords_of(ball, {0.9, 0.0, 0.0});
  const BallEnds swing = ball_ends(ball, swung.data(), Vec3(0.15, 0.0, 0.0));
  ASSERT_EQ(swing.count, 2);
  EXPECT_NEAR(swing.ends[0].out.x, 1.0, 1e-4);
  EXPECT_NEAR(swing.ends[0].room_rad, 0.1, 1e-4);
  const std::array<double, 4> twisted = coords_of(ball, {0.0, 0.01, 0.25});
  const BallEnds twist = ball_ends(ball, twisted.data(), Vec3(0.0, 0.0, -0.1));
  ASSERT_EQ(twist.count, 2);
  EXPECT_NEAR(twist.ends[1].out.z, -1.0, 1e-3) << "the twist axis points along -z";
  EXPECT_NEAR(twist.ends[1].room_rad, 0.05, 1e-3);
}

TEST(BallEnds, HaveNoRoomForABallThatIsOutside) {
  const Joint ball = ball_with(1.0, 0.5, 0.3);
  const std::array<double, 4> outside = coords_of(ball, {1.1, 0.0, 0.0});
  const BallEnds ends = ball_ends(ball, outside.data(), Vec3(0.0));
  ASSERT_EQ(ends.count, 2);
  EXPECT_NEAR(ends.ends[0].room_rad, -0.1, 1e-4);
}

// A rotation in one tick that goes no farther than each end stays inside, apart from the curvature of the range.
RC_GTEST_PROP(BallEnds, KeepATurnOfATickInside, ()) {
  const Joint ball = ball_with(thousandths(300, 1500), thousandths(300, 1500), thousandths(100, 1500));
  const double share = thousandths(-1000, 1000), across = thousandths(-1000, 1000), twist = thousandths(-1000, 1000);
  const double scale = 0.999 / std::max(1.0, std::sqrt(share * share + across * across));
  const SwingTwist at{scale * share * ball.swing_a_rad, scale * across * ball.swing_b_rad, 0.999 * twist * ball.high};
  const std::array<double, 4> coords = coords_of(ball, at);
  Vec3 turn(thousandths(-10, 10), thousandths(-10, 10), thousandths(-10, 10));
  const BallEnds ends = ball_ends(ball, coords.data(), turn);
  for (int pass = 0; pass < 10; ++pass)
    for (const BallEnd& end : ends.all())
      turn += std::min(0.0, std::max(0.0, end.room_rad) - glm::dot(turn, end.out)) * end.out;
  RC_ASSERT(beyond_rad(ball, coords, turn) < 2e-3);
}

// A blow on the tail while a hind leg is lifted topples the dog; the tail whips about, within its ranges, also where a
// contact turns it.
TEST(BallEnds, HoldTheTailOfADogThatFalls) {
  Spec spec;
  spec.character.name = "quadruped";
  spec.dynamics.mode = Mode::dynamic;
  ImpactDesc blow;
  blow.slot = "tail", blow.impulse_N_s = Vec3(-18.0, 0.0, 0.0);
  spec.dynamics.impacts = {blow};
  ActionUse use;
  use.action = "reach", use.slot = "leg_hind_right";
  spec.sequences.push_back({"", 0, {{}}});
  spec.sequences[0].clips[0].actions = {use};
  spec.hold_frames = 22;
  BuiltInGenerator generator(stock_library());
  const Result<Execution> made = execute(generator, spec);
  ASSERT_TRUE(made) << to_line(made.issue());
  double least = 1.0, most_rad = 0.0;
  for (int frame = 0; frame < made->motion.frame_count; ++frame)
    for (const Joint& joint : made->character->joints())
      if (joint.kind == JointKind::ball) {
        const double* coords = made->motion.row(frame).data() + joint.coord;
        least = std::min(least, normalised_margin(joint, coords));
        most_rad = std::max(most_rad, rotation_angle(quat_at(coords)));
      }
  EXPECT_GT(least, -0.01);
  EXPECT_GT(most_rad, 0.5) << "it does not whip about at all";
}

// The greatest angle by which a joint is off its target, after a blow that is too weak to move it, while a pose takes
// it to the end of its range.
double greatest_error_rad(const std::string& character, const std::string& slot, const std::string& joint_name,
                          const std::string& params) {
  const Result<Spec> spec = parse_spec(R"({"format": "contort.spec/1", "character": {"name": ")" +
                                         character + R"("}, "dynamics":
      {"mode": "dynamic", "impacts": [{"slot": "head", "impulse_N_s": [0.0, 0.0, 0.5]}]}, "sequences": [{"clips":
      [{"actions": [{"action": "pose", "slot": ")" + slot + R"(", "speed": 2, "params": )" + params +
                                R"(}]}]}]})");
  if (!spec) throw std::logic_error(to_line(spec.issue()));
  const Result<Stage> stage = build_stage(*spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  const Motion motion = generate(*stage);
  const Joint& joint = stage->character->joint(stage->character->find_joint(slot + "/" + joint_name));
  double greatest = 0.0;
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    const std::size_t at = static_cast<std::size_t>(frame * motion.coord_count + joint.coord);
    const double *now = &motion.coords[at], *goal = &motion.response.target_coords[at];
    greatest = std::max(greatest, joint.kind == JointKind::ball
                                      ? rotation_angle(glm::conjugate(quat_at(now)) * quat_at(goal))
                                      : std::fabs(now[0] - goal[0]));
  }
  return greatest;
}

// Joints that looked ahead for their ends without regard to their target were up to 10 degrees late.
TEST(JointEnds, AFigureThatWasStruckReachesThemTogetherWithItsTarget) {
  EXPECT_LT(greatest_error_rad("human", "hand_right", "wrist_flex", R"({"wrist_flex_deg": 72})"), 1.0 * kRadPerDeg);
  EXPECT_LT(greatest_error_rad("human", "arm_right", "elbow", R"({"elbow_deg": 149})"), 1.0 * kRadPerDeg);
  EXPECT_LT(greatest_error_rad("quadruped", "tail", "tail_2", R"({"tail_2_deg": [39, 0, 0]})"), 1.5 * kRadPerDeg);
}

}  // namespace
}  // namespace contort
