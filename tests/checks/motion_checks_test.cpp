// foot_slide, bind_pose_flash, pop, angular_acceleration, residue, reach_error, stuck and queue_gap on motions that are
// known: made by hand for one property, or generated from specs that must be quiet.
#include <gtest/gtest.h>

#include <algorithm>

#include "generator/execute.h"
#include "tests/checks/small_character.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

Stage staged(const std::string& spec) {
  const Result<Spec> parsed = parse_spec(spec);
  EXPECT_TRUE(parsed) << to_line(parsed.issue());
  Result<Stage> stage = build_stage(*parsed, stock_library());
  EXPECT_TRUE(stage) << to_line(stage.issue());
  return std::move(stage).value();
}

std::string playing(const std::string& actions, const std::string& more = R"("character": {"name": "human"}, )") {
  return R"({"format": "contort.spec/1", "hold_frames": 20, )" + more + R"("sequences": [{"clips": [{"actions": [)" +
         actions + "]}]}]}";
}

std::vector<Finding> found(const Stage& stage, const char* check) { return StageEvaluator().run(stage, check).findings; }

// ---- foot_slide

// A ball of 10 cm on the ground that turns and moves forward.
Library ball_library() {
  PartDesc part;
  part.name = part.kind = "ball";
  part.colliders.push_back({"ball", "", Sphere{{0, 0.1, 0}, 0.1}});
  Library library;
  library.parts["ball"] = part;
  CharacterDesc desc;
  desc.name = "ball";
  desc.slots.push_back({"ball", "ball", Side::center, "", "", {"ball"}});
  library.characters["ball"] = desc;
  return library;
}

// A ball that turns once per second, and moves forward `rolls` times as fast as by rolling.
std::vector<Finding> found_of_ball(double rolls, double height_m = 0.0) {
  const Character ball = small::build(ball_library(), {"ball", {}, {}});
  Motion motion = small::at_rest(ball, 60);
  for (int frame = 0; frame < 60; ++frame) {
    const double angle = 2.0 * kPi * frame / 60.0;
    const Quat q = axis_angle(Vec3(1, 0, 0), angle);
    const Vec3 center(0, 0.1 + height_m, rolls * 0.1 * angle);
    motion.root[static_cast<std::size_t>(frame)] = {q, center - q * Vec3(0, 0.1, 0)};
  }
  return StageEvaluator().judge(ball, motion, "foot_slide");
}

TEST(FootSlide, WhatRollsDoesNotSlide) {
  EXPECT_TRUE(found_of_ball(1.0).empty());
  EXPECT_FALSE(found_of_ball(-1.0).empty()) << "it turns against its way";
  EXPECT_FALSE(found_of_ball(4.0).empty());
  EXPECT_TRUE(found_of_ball(4.0, 0.01).empty()) << "in the air";
}

TEST(FootSlide, IsMeasuredFromWhereItCameDown) {
  const Character character = small::build();
  Motion motion = small::at_rest(character, 30);
  for (int frame = 0; frame < 30; ++frame) {  // 2 mm a frame: each step is small, all together are 5.8 cm
    motion.root[static_cast<std::size_t>(frame)].p_m.z += 0.002 * frame;
  }
  const std::vector<Finding> findings = StageEvaluator().judge(character, motion, "foot_slide");
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].first_frame, 11);
  EXPECT_NEAR(findings[0].worst_margin, 0.02 - 0.058, 1e-9);
  Motion hopping = motion;
  for (int frame = 0; frame < 30; ++frame)
    if (frame % 8 == 7) hopping.root[static_cast<std::size_t>(frame)].p_m.y += 0.01;
  EXPECT_TRUE(StageEvaluator().judge(character, hopping, "foot_slide").empty()) << "it came down anew";
}

TEST(FootSlide, WalksOnPlanesSlopesAndStairsStandFirm) {
  for (const char* ground : {R"({"type": "plane"})", R"({"type": "slope", "slope_deg": 12})",
                             R"({"type": "steps", "depth_m": 0.45, "height_m": 0.1})"})
    for (const char* who : {"human", "mech", "quadruped"}) {
      const std::string slot = std::string(who) == "quadruped" ? "hips" : "waist";
      const Stage stage = staged(playing(
          R"({"action": "walk", "slot": ")" + slot + R"(", "duration_frames": 240})",
          R"("character": {"name": ")" + std::string(who) + R"("}, "environment": {"ground": )" + ground + "}, "));
      for (const Finding& f : found(stage, "foot_slide"))
        ADD_FAILURE() << who << " " << ground << ": " << f.subject << " " << f.worst_margin << " at " << f.worst_frame;
    }
}

// ---- bind_pose_flash

// The left arm at these angles, degrees, at 10 Hz.
std::size_t flashes(const std::vector<double>& lift_deg) {
  const Character character = small::build();
  Motion motion = small::at_rest(character, static_cast<int>(lift_deg.size()), 10.0);
  for (std::size_t frame = 0; frame < lift_deg.size(); ++frame)
    small::set(motion, static_cast<int>(frame), small::joint_of(character, "arm_left/lift"),
               lift_deg[frame] * kRadPerDeg);
  return StageEvaluator().judge(character, motion, "bind_pose_flash").size();
}

TEST(BindPoseFlash, IsOneOrTwoFramesAmongOthers) {
  EXPECT_EQ(flashes({30, 30, 0, 30, 30}), 1U);
  EXPECT_EQ(flashes({30, 30, 0, 0.5, 32, 30}), 1U);
  EXPECT_EQ(flashes({30, 30, 0, 0, 0, 30}), 0U) << "a stop at rest";
  EXPECT_EQ(flashes({0, 30, 30, 30}), 0U) << "it begins at rest";
  EXPECT_EQ(flashes({30, 30, 30, 0}), 0U) << "it ends there";
  EXPECT_EQ(flashes({30, 0, 30, 30, 30, 30, 0, 30}), 2U);
  EXPECT_EQ(flashes({8, 8, 0, 8, 8}), 0U) << "too near to tell";
  EXPECT_EQ(flashes({30, 30, 2, 30, 30}), 0U) << "not the rest pose";
}

TEST(BindPoseFlash, ASwingThroughTheRestPoseIsNone) { EXPECT_EQ(flashes({-20, -12, 0, 12, 20}), 0U); }

// ---- pop and angular_velocity: never both

TEST(JointPop, AnIntervalIsAPopOrTooFast) {
  const Character character = small::build();
  const auto checks_of = [&](const std::vector<double>& lift_deg) {
    Motion motion = small::at_rest(character, static_cast<int>(lift_deg.size()), 60.0);
    for (std::size_t frame = 0; frame < lift_deg.size(); ++frame)
      small::set(motion, static_cast<int>(frame), small::joint_of(character, "arm_left/lift"),
                 lift_deg[frame] * kRadPerDeg);
    std::string names;
    for (const char* check : {"angular_velocity", "pop"})
      for (const Finding& f : StageEvaluator().judge(character, motion, check))
        names += f.check + " " + std::to_string(f.first_frame) + "-" + std::to_string(f.last_frame) + " ";
    return names;
  };
  // 300 deg/s are 5 degrees a frame.
  EXPECT_EQ(checks_of({0, 0, 20, 20, 20}), "pop 2-2 ");
  EXPECT_EQ(checks_of({0, 3, 10, 18, 26, 30, 31}), "angular_velocity 2-4 ");
  EXPECT_EQ(checks_of({0, 0, 20, 0, 0}), "pop 2-3 ") << "there and back";
  EXPECT_EQ(checks_of({0, 4, 8, 12}), "");
}

TEST(JointPop, AnActionOfNoLengthIsOne) {
  const Stage stage = staged(playing(R"({"action": "pose", "slot": "arm_left", "start_frame": 10,
      "duration_frames": 0, "params": {"elbow_deg": 100}})"));
  const std::vector<Finding> pops = found(stage, "pop");
  ASSERT_EQ(pops.size(), 1U);
  EXPECT_EQ(pops[0].subject, "arm_left/elbow");
  EXPECT_TRUE(found(stage, "angular_velocity").empty());
}

// ---- angular_acceleration

TEST(AngularAcceleration, ABlowMayChangeSpeedsAtOnce) {
  const Character character = small::build();
  Motion motion = small::moved_by_dynamics(character, 6);
  for (int frame = 3; frame < 6; ++frame)
    small::set(motion, frame, small::joint_of(character, "arm_left/lift"), 4.9 * kRadPerDeg * (frame - 2));
  EXPECT_EQ(StageEvaluator().judge(character, motion, "angular_acceleration").size(), 1U);
  motion.response.impacts = {{2, 1, {}, {}}};
  EXPECT_TRUE(StageEvaluator().judge(character, motion, "angular_acceleration").empty());
}

// ---- residue, reach_error, stuck, queue_gap

TEST(Residue, NothingIsLeftOfAdditivesThatPlay) {
  for (const char* action : {R"({"action": "hit_reaction", "slot": "torso", "start_frame": 5})",
                             R"({"action": "recoil", "slot": "arm_right", "start_frame": 5},
                                {"action": "recoil", "slot": "arm_right", "start_frame": 9})"})
    EXPECT_TRUE(found(staged(playing(action)), "residue").empty()) << action;
}

// The motion of a generator that forgets to take its additive back.
TEST(Residue, IsFoundWhereAnAdditiveStays) {
  const Stage stage = staged(playing(R"({"action": "recoil", "slot": "arm_right", "start_frame": 5})"));
  Motion motion = generate(stage);
  ASSERT_EQ(motion.spans.size(), 1U);
  const int elbow = stage.character->find_joint("arm_right/elbow");
  const auto coord = static_cast<std::size_t>(stage.character->joints()[static_cast<std::size_t>(elbow)].coord);
  for (int frame = motion.spans[0].last_frame; frame < motion.frame_count; ++frame) motion.row(frame)[coord] += 0.01;
  const Intent intent = intent_of(stage);
  const std::vector<Finding> findings =
      StageEvaluator().judge(*stage.character, motion, "residue", stage.environment, &intent);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].subject, "arm_right");
  EXPECT_NEAR(findings[0].worst_margin, 0.1 * kRadPerDeg - 0.01, 1e-9);
}

// Foot and leg are one limb: a movement by the foot's action is no residue of the leg's additive.
TEST(Residue, IsNotJudgedWhereAnotherPartOfTheLimbActsBeforeOrAfter) {
  const auto left_by = [](const std::string& actions) {
    const Stage stage = staged(playing(actions));
    Motion motion = generate(stage);
    const int hip = stage.character->find_joint("leg_left/hip_flex");
    const auto coord = static_cast<std::size_t>(stage.character->joints()[static_cast<std::size_t>(hip)].coord);
    const int after = motion.spans.back().last_frame + 1;
    for (int frame = after; frame < motion.frame_count; ++frame) motion.row(frame)[coord] += 0.01;
    const Intent intent = intent_of(stage);
    return StageEvaluator().judge(*stage.character, motion, "residue", stage.environment, &intent).size();
  };
  const std::string leg = R"({"action": "hit_reaction", "slot": "leg_left", "start_frame": 5, "params": {"strength_deg": 5}})";
  EXPECT_EQ(left_by(leg), 1U);
  EXPECT_EQ(left_by(R"({"action": "pose", "slot": "head", "duration_frames": 60}, )" + leg), 1U) << "no part of the limb";
  EXPECT_EQ(left_by(R"({"action": "pose", "slot": "foot_left", "duration_frames": 60}, )" + leg), 0U);
  EXPECT_EQ(left_by(R"({"action": "pose", "slot": "foot_left", "start_frame": 8, "duration_frames": 4}, )" + leg), 0U)
      << "in between, and it stays there";
  EXPECT_EQ(left_by(R"({"action": "hit_reaction", "slot": "torso", "start_frame": 8, "duration_frames": 8}, )" + leg), 1U)
      << "legs do not hang on the torso";
}

// A part that is still on its way when the additive begins was not left there by it.
TEST(Residue, IsNotJudgedFromAFrameInWhichThePartMoves) {
  const Stage stage = staged(playing(R"({"action": "recoil", "slot": "arm_right", "start_frame": 5})"));
  Motion motion = generate(stage);
  const int elbow = stage.character->find_joint("arm_right/elbow");
  const auto coord = static_cast<std::size_t>(stage.character->joints()[static_cast<std::size_t>(elbow)].coord);
  for (int frame = 0; frame < 5; ++frame) motion.row(frame)[coord] += 0.01 * (5 - frame);
  const Intent intent = intent_of(stage);
  EXPECT_TRUE(StageEvaluator().judge(*stage.character, motion, "residue", stage.environment, &intent).empty());
  // The part is at rest, except for rounding as generators have it.
  for (int frame = 0; frame < 4; ++frame) motion.row(frame)[coord] = motion.row(4)[coord] + 1e-7 * (frame % 2);
  EXPECT_EQ(StageEvaluator().judge(*stage.character, motion, "residue", stage.environment, &intent).size(), 1U);
}

std::string reach_to(const std::string& target, const std::string& more = "") {
  return playing(R"({"action": "reach", "slot": "arm_left", "duration_frames": 40, "params": {"target_m": )" + target +
                 "}}" + more);
}

// A tip that is not where the generator sends it.
TEST(ReachError, SaysHowFarAPointIsMissed) {
  const Stage stage = staged(reach_to("[0.35, 1.2, 0.35]"));
  EXPECT_TRUE(found(stage, "reach_error").empty());
  const Motion motion = generate(stage);
  Intent intent = intent_of(stage);
  ASSERT_EQ(intent.goals.size(), 1U);
  intent.goals[0].target_m += Vec3(0.0, 0.05, 0.0);
  const std::vector<Finding> findings =
      StageEvaluator().judge(*stage.character, motion, "reach_error", stage.environment, &intent);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_NEAR(findings[0].worst_margin, 0.001 - 0.05, 1e-9);
  EXPECT_EQ(findings[0].worst_frame, 40);
}

TEST(ReachError, APointOutOfReachIsAnUnmetRequestAndNoFinding) {
  StageEvaluator evaluator;
  EXPECT_TRUE(evaluator.run(staged(reach_to("[0.2, 1.4, 3.0]")), "reach_error").findings.empty());
  const Intent& intent = *evaluator.execution().intent;
  EXPECT_TRUE(intent.goals.empty());
  ASSERT_EQ(intent.unmet.size(), 1U);
  const int arm = evaluator.execution().character->find_part("arm_left");
  EXPECT_EQ(intent.unmet[0], (UnmetRequest{40, 40, arm, "reach", Shortfall::out_of_reach}));
}

TEST(ReachError, IsNotJudgedWhereSomethingElseMovesTheLimb) {
  const std::string far = "[0.2, 1.4, 3.0]";
  EXPECT_TRUE(found(staged(reach_to(far, R"(, {"action": "recoil", "slot": "arm_left", "start_frame": 35,
      "duration_frames": 20})")),
                    "reach_error")
                  .empty())
      << "an additive on top";
  EXPECT_TRUE(found(staged(reach_to(far, R"(, {"action": "reach", "slot": "arm_left", "start_frame": 30,
      "duration_frames": 20, "params": {"target_m": [0.35, 1.2, 0.35]}})")),
                    "reach_error")
                  .empty())
      << "another one took over";
}

Stage two_hands_on_rifle(const std::string& target) {
  std::string spec = R"({"format": "contort.spec/1",
    "character": {"name": "human", "attachments": [{"object": "rifle", "slot": "hand_right", "socket": "grip"}]},
    "sequences": [{"clips": [{"actions": [
      {"action": "weapon_hold", "slot": "arm_left", "start_frame": 40, "duration_frames": 20, "blend_in_frames": 0},
      {"action": "reach", "slot": "arm_right", "duration_frames": 40, "params": {"target_m": TARGET}}]}]}]})";
  return staged(spec.replace(spec.find("TARGET"), 6, target));
}

TEST(ReachError, AHandThatLeavesTheForegripIsFound) {
  const Stage stage = two_hands_on_rifle("[-0.12, 1.28, 0.28]");
  Motion motion = generate(stage);
  const Intent intent = intent_of(stage);
  motion.row(50)[static_cast<std::size_t>(fixtures::joint(*stage.character, "arm_left/elbow").coord)] += 0.2;
  const std::vector<Finding> findings =
      StageEvaluator().judge(*stage.character, motion, "reach_error", stage.environment, &intent);
  EXPECT_TRUE(std::ranges::any_of(findings, [](const Finding& finding) {
    return finding.subject.starts_with("hand_left") && finding.first_frame <= 50 && finding.last_frame >= 50;
  }));
}

TEST(ReachError, AHandThatCannotFollowTheForegripIsAnUnmetRequest) {
  StageEvaluator evaluator;
  EXPECT_TRUE(evaluator.run(two_hands_on_rifle("[-0.8, 1.4, -0.2]"), "reach_error").findings.empty())
      << "the rifle goes behind the body";
  const Intent& intent = *evaluator.execution().intent;
  ASSERT_FALSE(intent.unmet.empty());
  EXPECT_EQ(intent.unmet.back().action, "weapon_hold");
  EXPECT_EQ(intent.unmet.back().last_frame, 60);
  for (const Goal& goal : intent.goals)
    if (goal.target_socket >= 0) {
      EXPECT_LT(goal.last_frame, intent.unmet.back().first_frame);
    }
}

// A second hand on the rifle, cut for a pose of its arm in frame 40, and then at it again.
Stage cut_hold(int rate_hz) {
  return staged(R"({"format": "contort.spec/1", "rate_hz": )" + std::to_string(rate_hz) + R"(,
    "character": {"name": "human", "attachments": [{"object": "rifle", "slot": "hand_right", "socket": "grip"}]},
    "sequences": [{"clips": [{"actions": [
      {"action": "reach", "slot": "arm_right", "duration_frames": 20, "params": {"target_m": [-0.15, 1.2, 0.3]}},
      {"action": "weapon_hold", "slot": "arm_left", "start_frame": 20, "duration_frames": 160, "blend_in_frames": 0}]}]}],
    "interrupts": [{"when": {"event": "frame", "frame": 40}, "sequence": {"clips": [{"actions": [
      {"action": "pose", "slot": "arm_left", "duration_frames": 20, "params": {"elbow_deg": 80}}]}]}}]})");
}

TEST(ReachError, AHoldThatWasCutHasTheTimeThatItsGeneratorTakesToComeBack) {
  for (const int rate_hz : {30, 60, 120}) {
    const Stage stage = cut_hold(rate_hz);
    EXPECT_TRUE(found(stage, "reach_error").empty()) << rate_hz << " Hz";
    const Intent intent = intent_of(stage);
    ASSERT_EQ(intent.goals.size(), 3U) << "the reach, and the hold before and after the cut";
    EXPECT_LT(intent.goals[1].last_frame, intent.goals[2].first_frame);
  }
}

TEST(ReachError, AHoldThatDoesNotComeBackAfterACutIsFound) {
  const Stage stage = cut_hold(60);
  Motion motion = generate(stage);
  const Intent intent = intent_of(stage);
  const int elbow = stage.character->find_joint("arm_left/elbow");
  const auto coord = static_cast<std::size_t>(stage.character->joints()[static_cast<std::size_t>(elbow)].coord);
  for (int frame = 60; frame < motion.frame_count; ++frame) motion.row(frame)[coord] += 0.01;
  const std::vector<Finding> findings =
      StageEvaluator().judge(*stage.character, motion, "reach_error", stage.environment, &intent);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_TRUE(findings[0].subject.ends_with("/grip")) << findings[0].subject;
  EXPECT_EQ(findings[0].first_frame, intent.goals[2].first_frame);
}

TEST(ReachError, IsNotJudgedWhereTheGeneratorDoesNotSayWhatItMeant) {
  const Stage stage = staged(reach_to("[0.2, 1.4, 3.0]"));
  EXPECT_TRUE(StageEvaluator().judge(*stage.character, generate(stage), "reach_error", stage.environment).empty());
}

TEST(Stuck, QueuesOfSpecsRunDry) {
  const Stage stage = staged(playing(R"({"action": "pose", "slot": "arm_left", "params": {"elbow_deg": 40}})"));
  EXPECT_TRUE(found(stage, "stuck").empty());
  Motion motion = generate(stage);
  ASSERT_EQ(motion.queue.size(), 1U);
  motion.queue[0].last_frame = motion.frame_count - 1;
  const Intent intent = intent_of(stage);
  EXPECT_EQ(StageEvaluator().judge(*stage.character, motion, "stuck", stage.environment, &intent).size(), 1U);
}

// A pose of 40 frames, cut by others in frames 10 and 20.
Stage cut_twice() {
  return staged(R"({"format": "contort.spec/1", "character": {"name": "human"}, "hold_frames": 5,
    "sequences": [{"clips": [{"actions": [{"action": "pose", "slot": "arm_left", "duration_frames": 40}]}]}],
    "interrupts": [
      {"when": {"event": "frame", "frame": 10}, "sequence": {"clips": [{"actions": [
        {"action": "pose", "slot": "head", "duration_frames": 6}]}]}},
      {"when": {"event": "frame", "frame": 20}, "sequence": {"clips": [{"actions": [
        {"action": "pose", "slot": "head", "duration_frames": 1}]}]}}]})");
}

TEST(QueueGap, WhatIsCutGoesOnWhereItWas) {
  const Stage stage = cut_twice();
  const Motion motion = generate(stage);
  ASSERT_EQ(motion.queue.size(), 5U);
  EXPECT_TRUE(found(stage, "queue_gap").empty());
  const auto judged = [&](const Motion& changed) {
    const Intent intent = intent_of(stage);
    return StageEvaluator().judge(*stage.character, changed, "queue_gap", stage.environment, &intent);
  };
  for (std::size_t span = 0; span < motion.queue.size(); ++span)
    for (const int skipped : {-1, 1}) {
      Motion changed = motion;
      changed.queue[span].first_content += skipped;
      const std::vector<Finding> findings = judged(changed);
      ASSERT_FALSE(findings.empty()) << span;
      EXPECT_EQ(findings[0].worst_frame, motion.queue[span].first_frame) << span;
      EXPECT_NEAR(findings[0].worst_margin, 0.001 - 1.0 / motion.rate_hz, 1e-12) << span;
    }
}

}  // namespace
}  // namespace contort
