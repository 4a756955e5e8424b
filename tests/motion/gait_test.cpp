// Walking and running, measured from outside: where soles and their corners are by forward kinematics, and where the
// ground is.
#include "generator/motion/gait.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/stage_evaluator.h"
#include "generator/execute.h"
#include "model/motion/kinematics.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

struct Walked {
  double slide_m = 0.0;   // the farthest that a standing sole's corner gets from where it was put down
  double depth_m = 0.0;   // the deepest corner below the ground
  double gap_m = 0.0;     // the highest that the lowest corner of a standing sole is above the ground
  double travel_m = 0.0;  // distance of the root
  int steps = 0;          // swings of all feet
  int range_findings = 0;
  bool is_unmet = false;  // the generator reports that legs cannot go so fast
};

EnvironmentDesc noise_field() {
  EnvironmentDesc desc;
  HeightGround ground;
  ground.columns = ground.rows = 41, ground.spacing_m = 0.5;
  ground.heights_m.clear();
  std::uint32_t state = 12345;
  for (int i = 0; i < 41 * 41; ++i) {
    state = state * 1664525U + 1013904223U;
    ground.heights_m.push_back(0.08 * (state >> 8) / double(1 << 24) - 0.04);
  }
  desc.ground = ground;
  return desc;
}

EnvironmentDesc ground_named(const std::string& name) {
  EnvironmentDesc desc;
  if (name == "slope") desc.ground = SlopeGround{20.0, 0.0};
  if (name == "slope_down") desc.ground = SlopeGround{20.0, 180.0};
  if (name == "slope_across") desc.ground = SlopeGround{12.0, 90.0};
  if (name == "stairs") desc.ground = StepsGround{0.0, 0.8, 0.4, 0.14, 8};
  if (name == "noise") return noise_field();
  return desc;
}

CharacterChoice character_named(const std::string& name) {
  if (name == "reverse") return {"mech", {{"leg_left", "mech_leg_reverse"}, {"leg_right", "mech_leg_reverse"}}, {}};
  return {name, {}, {}};
}

std::vector<Vec3> corners_m(const Character& character, const Leg& leg, std::span<const Rigid> world) {
  const Rigid sole = world_from_socket(character, world, leg.sole);
  std::vector<Vec3> corners;
  for (const double x : {leg.low_m.x, leg.high_m.x})
    for (const double z : {leg.low_m.z, leg.high_m.z}) corners.push_back(sole * Vec3(x, 0.0, z));
  return corners;
}

class Walks : public ::testing::Test {
 protected:
  Walked walk(const std::string& character, const std::string& ground, const std::string& action, double speed_m_s) {
    Spec spec;
    spec.character = character_named(character);
    spec.environment = ground_named(ground);
    ActionUse use;
    use.action = action, use.slot = spec.character.name == "quadruped" ? "hips" : "waist";
    use.duration_frames = 360;
    use.params = {{"speed_m_s", speed_m_s}};
    ClipDesc clip;
    clip.actions = {use};
    SequenceDesc sequence;
    sequence.clips = {clip};
    spec.sequences = {sequence};
    const Result<Stage> stage = build_stage(spec, stock_library());
    if (!stage) throw std::logic_error(to_line(stage.issue()));
    return measure(*stage);
  }

 private:
  // A sole stands while its corners' mean keeps its height to a tenth of a millimetre and is less than a centimetre
  // above the ground: at the top of a low swing it keeps its height, too.
  Walked measure(const Stage& stage) {
    const Motion motion = generate(stage);
    Walked out;
    std::vector<Rigid> world(stage.character->joints().size());
    std::vector<std::vector<Vec3>> before(stage.legs.size()), landed(stage.legs.size());
    for (int f = 0; f < motion.frame_count; ++f) {
      const auto at = static_cast<std::size_t>(f);
      forward_kinematics(*stage.character, motion.root[at], motion.row(f), world);
      for (std::size_t l = 0; l < stage.legs.size(); ++l) {
        const std::vector<Vec3> now = corners_m(*stage.character, stage.legs[l], world);
        double lowest = 1e9;
        for (const Vec3& corner : now)
          lowest = std::min(lowest, corner.y - stage.environment.height_at(corner.x, corner.z));
        out.depth_m = std::max(out.depth_m, -lowest);
        const bool stands = lowest < 0.01 && !before[l].empty() && std::fabs(mean_y(now) - mean_y(before[l])) < 1e-4 &&
                            length(mean(now) - mean(before[l])) < 0.01;
        if (!stands) {
          out.steps += !landed[l].empty();
          landed[l].clear();
        } else if (landed[l].empty()) {
          landed[l] = now;
        } else {
          for (std::size_t c = 0; c < now.size(); ++c)
            out.slide_m = std::max(out.slide_m, across_m(now[c] - landed[l][c]));
          out.gap_m = std::max(out.gap_m, lowest);
        }
        before[l] = now;
      }
    }
    out.travel_m = length(motion.root.back().p_m - motion.root.front().p_m);
    out.is_unmet = !intent_of(stage).unmet.empty();
    StageEvaluator evaluator;
    for (const Finding& finding : evaluator.judge(*stage.character, motion, "joint_range")) {
      ++out.range_findings;
      if (out.range_findings < 4) std::printf("    %s %.3f\n", finding.subject.c_str(), finding.worst_margin);
    }
    return out;
  }
  // A corner that rises because its heel does is not sliding.
  static double across_m(const Vec3& v) { return std::sqrt(v.x * v.x + v.z * v.z); }
  static double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }
  static Vec3 mean(const std::vector<Vec3>& points) {
    Vec3 sum(0.0);
    for (const Vec3& point : points) sum += point / static_cast<double>(points.size());
    return sum;
  }
  static double mean_y(const std::vector<Vec3>& points) { return mean(points).y; }
};

std::vector<std::string> walkers() {
  return {"human", "mech", "reverse", "quadruped"};
}

// Prints slide and penetration in all terrains, because changes of the gait are judged by these numbers.
TEST_F(Walks, FeetStandStillAndStayAboveTheGround) {
  double all_travels_m = 0.0;  // a walk may be slower than it was asked for, but walks that stand are no walks
  for (const std::string& character : walkers())
    for (const std::string ground : {"level", "slope", "slope_down", "slope_across", "stairs", "noise"}) {
      const Walked walked = walk(character, ground, "walk", 0.9);
      std::printf("%-10s %-13s slide %6.2f mm, depth %6.2f mm, gap %6.2f mm, %.2f m in %d steps, %d out of range\n",
                  character.c_str(), ground.c_str(), 1e3 * walked.slide_m, 1e3 * walked.depth_m, 1e3 * walked.gap_m,
                  walked.travel_m, walked.steps, walked.range_findings);
      EXPECT_LT(walked.slide_m, 5e-3) << character << " on " << ground;
      EXPECT_LT(walked.depth_m, 5e-3) << character << " on " << ground;
      all_travels_m += walked.travel_m;
      EXPECT_EQ(walked.range_findings, 0) << character << " on " << ground;
      EXPECT_TRUE(walked.is_unmet || walked.steps > 4) << character << " on " << ground;
      EXPECT_TRUE(walked.is_unmet || walked.travel_m > 2.5) << character << " on " << ground;
      EXPECT_FALSE(walked.is_unmet && ground == "level") << character;
    }
  EXPECT_GT(all_travels_m, 40.0);
}

// A course that no joint could make would be a figure that stands, which is clean.
TEST_F(Walks, RunsGetSomewhereOnAllLegs) {
  for (const auto& [character, least_m] : {std::pair{"human", 8.0}, {"mech", 8.0}, {"reverse", 4.0}, {"quadruped", 3.0}}) {
    const Walked run = walk(character, "level", "run", 2.0);
    EXPECT_GT(run.travel_m, least_m) << character;
    EXPECT_LT(run.slide_m, 5e-3) << character;
    EXPECT_EQ(run.range_findings, 0) << character;
  }
}

}  // namespace
}  // namespace contort
