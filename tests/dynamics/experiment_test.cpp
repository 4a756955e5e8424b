// The squat of the experiment in docs/experiments/squat, by numbers: (a) no load, (b) 5 kg on the back, (c) 8 kg, (d) a
// blow on the left shoulder. Compares tracking with dynamic control.
#include <gtest/gtest.h>

#include <cmath>

#include "generator/generate.h"
#include "model/core/files.h"
#include "model/geometry/distance.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

const std::string kFolder = CONTORT_SOURCE_DIR "/docs/experiments/squat/";

const Library& library() {
  static const Library made = [] {
    Library read = stock_library();
    const Result<Done> loaded = load_folder(kFolder + "actions", read);
    if (!loaded) ADD_FAILURE() << to_line(loaded.issue());
    return read;
  }();
  return made;
}

class Played {
 public:
  Played(const std::string& name, Mode mode, int ticks) {
    const Result<std::string> text = read_file(kFolder + name + ".json");
    Result<Spec> spec = parse_spec(*text);
    if (!spec) throw std::logic_error(to_line(spec.issue()));
    Spec changed = *spec;
    changed.dynamics.mode = mode, changed.dynamics.ticks_per_frame = ticks;
    const Result<Stage> stage = build_stage(changed, library());
    if (!stage) throw std::logic_error(to_line(stage.issue()));
    stage_ = *stage;
    motion = generate(stage_);
  }

  const DynamicFigure& figure() const { return stage_.dynamics->figure; }
  const Character& character() const { return *stage_.character; }

  double peak_effort(const std::string& joint) const {
    double peak = 0.0;
    for_joints(joint, [&](const Joint&, const Link& link) {
      for (int f = 0; f < motion.frame_count; ++f)
        peak = std::max(peak, std::fabs(row(motion.response.efforts, f)[static_cast<std::size_t>(link.dof)]));
    });
    return peak;
  }

  // Degrees from the target, forward positive: of balls about the side axis.
  double deviation_deg(const Joint& joint, int frame) const {
    const double* now = &motion.row(frame)[static_cast<std::size_t>(joint.coord)];
    const double* goal =
        &motion.response.target_coords[static_cast<std::size_t>(frame * motion.coord_count + joint.coord)];
    if (joint.kind != JointKind::ball) return (now[0] - goal[0]) * kDegPerRad;
    const Quat a(now[0], now[1], now[2], now[3]), b(goal[0], goal[1], goal[2], goal[3]);
    return -to_rotation_vector(a * glm::conjugate(b)).x * kDegPerRad;
  }

  std::pair<double, double> deviations_deg(const std::string& joint) const {
    std::pair<double, double> range;
    for_joints(joint, [&](const Joint& j, const Link&) {
      for (int f = 0; f < motion.frame_count; ++f) {
        range.first = std::min(range.first, deviation_deg(j, f));
        range.second = std::max(range.second, deviation_deg(j, f));
      }
    });
    return range;
  }

  // Returns the least gap between any two bodies that must not touch.
  double least_gap_m(int frame) const {
    std::vector<Rigid> world(character().joints().size());
    forward_kinematics(character(), motion.root[static_cast<std::size_t>(frame)], motion.row(frame), world);
    double least_m = 1.0;
    for (const ColliderPair& pair : character().judged_colliders()) {
      const auto solid = [&](int collider) {
        const Collider& own = character().colliders()[static_cast<std::size_t>(collider)];
        return moved(world[static_cast<std::size_t>(own.joint)], solid_of(own));
      };
      least_m = std::min(least_m, signed_distance(solid(pair.a), solid(pair.b), 0.1));
    }
    return least_m;
  }

  double largest_deviation_deg(int first_frame = 0) const {
    double largest = 0.0;
    for_joints("", [&](const Joint& j, const Link&) {
      for (int f = first_frame; f < motion.frame_count; ++f)
        largest = std::max(largest, std::fabs(deviation_deg(j, f)));
    });
    return largest;
  }

  int frames_outside() const {
    int count = 0;
    for (const Stance& stance : motion.response.stances)
      count += stance.margin_m < 0.0 || stance.footing != Footing::standing;
    return count;
  }

  std::span<const double> row(const std::vector<double>& values, int frame) const {
    const auto n = static_cast<std::size_t>(motion.response.dof_count);
    return std::span(values).subspan(static_cast<std::size_t>(frame) * n, n);
  }

  template <class Visit>
  void for_joints(const std::string& part_of_name, Visit visit) const {
    for (std::size_t j = 1; j < character().joints().size(); ++j)
      if (character().joints()[j].name.find(part_of_name) != std::string::npos)
        visit(character().joints()[j], figure().body.links()[j]);
  }

  Motion motion;

 private:
  Stage stage_;
};

constexpr int kTicks = 4;
const char* const kA = "a_nothing_added";
const char* const kB = "b_5_kg";
const char* const kC = "c_8_kg";
const char* const kD = "d_blow";

TEST(Experiment, WithNothingAddedDynamicControlDoesNothingBitByBit) {
  for (const int ticks : {1, 4}) {
    const Played tracked(kA, Mode::tracking, ticks), controlled(kA, Mode::dynamic, ticks);
    EXPECT_EQ(motion_hash(tracked.motion), motion_hash(controlled.motion));
    for (const double added : controlled.motion.response.control) ASSERT_EQ(added, 0.0);
    EXPECT_LE(controlled.largest_deviation_deg(), ticks == 1 ? 7.0 : 4.0);
    EXPECT_EQ(controlled.frames_outside(), 0);
  }
}

TEST(Experiment, WithFiveKilogramsTheArmsSwingForwardAndRelieveTheWaist) {
  const Played tracked(kB, Mode::tracking, kTicks), controlled(kB, Mode::dynamic, kTicks);
  EXPECT_LE(controlled.peak_effort("lumbar_flex"), 0.98 * tracked.peak_effort("lumbar_flex"));
  EXPECT_LE(controlled.peak_effort("hip_flex"), 0.98 * tracked.peak_effort("hip_flex"));
  const auto [back, forward] = controlled.deviations_deg("shoulder");
  EXPECT_GE(forward, 8.0);
  EXPECT_GT(forward, 2.0 * -back);
  EXPECT_EQ(controlled.frames_outside(), 0);
}

TEST(Experiment, WithEightKilogramsTheArmsSwingMoreAndTheWaistBalancesToo) {
  const Played five(kB, Mode::dynamic, kTicks), tracked(kC, Mode::tracking, kTicks),
      controlled(kC, Mode::dynamic, kTicks);
  EXPECT_LE(controlled.peak_effort("lumbar_flex"), 0.96 * tracked.peak_effort("lumbar_flex"));
  EXPECT_LE(controlled.peak_effort("hip_flex"), 0.96 * tracked.peak_effort("hip_flex"));
  EXPECT_GE(controlled.deviations_deg("shoulder").second, 1.3 * five.deviations_deg("shoulder").second);
  EXPECT_GE(controlled.deviations_deg("lumbar_flex").second, 1.3 * five.deviations_deg("lumbar_flex").second);
  EXPECT_GE(tracked.frames_outside(), 1);
  EXPECT_EQ(controlled.frames_outside(), 0);
}

TEST(Experiment, AfterABlowItKeepsItsBalanceAndReturnsWithinItsStrength) {
  const Played tracked(kD, Mode::tracking, kTicks), controlled(kD, Mode::dynamic, kTicks);
  EXPECT_GE(tracked.frames_outside(), 1);
  EXPECT_EQ(controlled.frames_outside(), 0);
  EXPECT_LE(controlled.largest_deviation_deg(20), 3.0);  // after the first extremum of the target
  const int last = controlled.motion.frame_count - 1;
  EXPECT_LE(controlled.largest_deviation_deg(last), 0.1);
  for (int f = 0; f <= last; ++f) {
    const std::span<const double> efforts = controlled.row(controlled.motion.response.efforts, f);
    for (std::size_t k = 0; k < efforts.size(); ++k) {
      EXPECT_LE(efforts[k], controlled.figure().strength_high[k] * (1 + 1e-9)) << f << " " << k;
      EXPECT_GE(efforts[k], controlled.figure().strength_low[k] * (1 + 1e-9)) << f << " " << k;
    }
  }
}

TEST(Experiment, NoBodyGoesThroughAnother) {
  for (const char* name : {kA, kB, kC, kD}) {
    const Played controlled(name, Mode::dynamic, kTicks);
    for (int f = 0; f < controlled.motion.frame_count; ++f)
      EXPECT_GE(controlled.least_gap_m(f), 0.0) << name << " frame " << f;
  }
}

TEST(Experiment, SagittalLoadsMoveBothSidesAlike) {
  const Played controlled(kC, Mode::dynamic, kTicks);
  const auto dof = [&](const char* name) {
    return static_cast<std::size_t>(
        controlled.figure().body.links()[static_cast<std::size_t>(controlled.character().find_joint(name))].dof);
  };
  for (int f = 0; f < controlled.motion.frame_count; ++f) {
    EXPECT_LT(std::fabs(controlled.motion.response.stances[static_cast<std::size_t>(f)].zmp_m.x), 1e-6);
    const std::span<const double> added = controlled.row(controlled.motion.response.control, f);
    EXPECT_NEAR(added[dof("arm_left/shoulder")], added[dof("arm_right/shoulder")], 1e-9 * 25.0);
    EXPECT_NEAR(added[dof("leg_left/knee")], added[dof("leg_right/knee")], 1e-9 * 25.0);
  }
}

}  // namespace
}  // namespace contort
