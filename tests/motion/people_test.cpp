// Compares walks and runs with those of people (docs/experiments/gait): curves of thigh, knee and ankle over a cycle,
// measured from outside by forward kinematics.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "generator/generate.h"
#include "model/motion/kinematics.h"
#include "tests/stage_evaluator.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

constexpr int kPhases = 10;  // tenths of a cycle from a foot's strike on
constexpr double kFilmed_hz = 120.0;

enum Angle { kThigh, kBentKnee, kBentAnkle, kAngles };
using Angles = std::array<double, kAngles>;  // degrees

struct Recorded {
  std::string name, action;
  double speed_m_s = 0.0, steps_per_min = 0.0;
  double strike_phase = 0.0;  // phase of the recording's strike, as a fraction of the cycle
  Angles peak_deg_s{};
  std::array<Angles, kPhases> curves_deg{};
};

constexpr std::array<const char*, kAngles> kAngleNames = {"thigh", "knee", "ankle"};

std::vector<Recorded> people() {
  std::ifstream file(CONTORT_SOURCE_DIR "/docs/experiments/gait/people.json");
  const nlohmann::json recorded = nlohmann::json::parse(file);
  std::vector<Recorded> out;
  for (const auto& gait : recorded.at("gaits")) {
    Recorded& made = out.emplace_back();
    made.name = gait.at("name"), made.action = gait.at("action");
    made.speed_m_s = gait.at("speed_m_s"), made.steps_per_min = gait.at("steps_per_min");
    made.strike_phase = gait.at("strike_phase");
    for (int a = 0; a < kAngles; ++a) {
      const std::string angle = kAngleNames[at(a)];
      made.peak_deg_s[at(a)] = gait.at("peak_deg_s").at(angle);
      for (int n = 0; n < kPhases; ++n) made.curves_deg[at(n)][at(a)] = gait.at(angle + "_deg").at(at(n));
    }
  }
  return out;
}

struct Strides {
  std::vector<Angles> angles_deg;  // angles of the left leg, for each frame
  std::vector<int> strikes;        // frames in which the left foot comes down
};

Angles angles_deg(const Character& character, const Leg& leg, std::span<const Rigid> world,
                  std::span<const double> row) {
  const ReachChain& chain = character.parts()[at(leg.part)].reach.front();
  const Vec3 thigh = world[at(chain.middle)].p_m - world[at(chain.upper)].p_m;
  return {std::atan2(thigh.z, -thigh.y) / kRadPerDeg, row[at(character.joint(chain.middle).coord)] / kRadPerDeg,
          row[at(character.joint(leg.ankles[0]).coord)] / kRadPerDeg};
}

double lowest_m(const Leg& leg, const Rigid& sole) {
  return std::min((sole * Vec3(0.0, 0.0, leg.low_m.z)).y, (sole * Vec3(0.0, 0.0, leg.high_m.z)).y);
}

Strides strides_of(const Stage& stage) {
  const Motion motion = generate(stage);
  const Character& character = *stage.character;
  const Leg& leg = stage.legs.front();
  std::vector<Rigid> world(character.joints().size());
  Strides strides;
  double was_m = 0.0;
  for (int f = 0; f < motion.frame_count; ++f) {
    forward_kinematics(character, motion.root[at(f)], motion.row(f), world);
    strides.angles_deg.push_back(angles_deg(character, leg, world, motion.row(f)));
    const double now_m = lowest_m(leg, world_from_socket(character, world, leg.sole));
    if (was_m > 1e-3 && now_m <= 1e-3) strides.strikes.push_back(f);
    was_m = now_m;
  }
  return strides;
}

Stage stage_of(const std::string& action, double speed_m_s, const Library& library) {
  ActionUse use;
  use.action = action, use.slot = "waist";
  use.duration_frames = 1440;
  use.params = {{"speed_m_s", speed_m_s}};
  Spec spec;
  spec.rate_hz = kFilmed_hz;
  spec.sequences.resize(1);
  spec.sequences[0].clips.resize(1);
  spec.sequences[0].clips[0].actions = {use};
  Result<Stage> stage = build_stage(spec, library);
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return std::move(stage).value();
}

// The stock human runs up to 3.3 m/s: beyond, landing takes more than the acceleration of its knees.
const Library& library_for(const Recorded& recorded) {
  return recorded.speed_m_s > 3.3 ? fixtures::tireless_library() : stock_library();
}

// A cycle in the middle of the course, where the speed is even.
struct Cycle {
  int first = 0, last = 0;  // frames of two strikes
};

Cycle middle_cycle(const Strides& strides) {
  const std::size_t middle = strides.strikes.size() / 2;
  return {strides.strikes.at(middle), strides.strikes.at(middle + 1)};
}

Angles at_phase(const Strides& strides, const Cycle& cycle, double phase) {
  const double frame = cycle.first + phase * (cycle.last - cycle.first);
  const int before = static_cast<int>(std::floor(frame));
  Angles out{};
  for (int a = 0; a < kAngles; ++a)
    out[at(a)] = std::lerp(strides.angles_deg[at(before)][at(a)], strides.angles_deg[at(before + 1)][at(a)],
                           frame - before);
  return out;
}

Angles rms_deg(const Recorded& people, const Strides& strides, const Cycle& cycle) {
  Angles sum{};
  for (int n = 0; n < kPhases; ++n) {
    const Angles ours = at_phase(strides, cycle, static_cast<double>(n) / kPhases - people.strike_phase);
    for (int a = 0; a < kAngles; ++a) sum[at(a)] += std::pow(ours[at(a)] - people.curves_deg[at(n)][at(a)], 2) / kPhases;
  }
  for (double& value : sum) value = std::sqrt(value);
  return sum;
}

Angles peak_deg_s(const Strides& strides, const Cycle& cycle) {
  Angles peak{};
  for (int f = cycle.first + 1; f <= cycle.last; ++f)
    for (int a = 0; a < kAngles; ++a)
      peak[at(a)] = std::max(peak[at(a)], kFilmed_hz * std::fabs(strides.angles_deg[at(f)][at(a)] -
                                                               strides.angles_deg[at(f - 1)][at(a)]));
  return peak;
}

// Printed, because changes of the gait are judged by these numbers.
TEST(Gaits, BendLegsLikePeople) {
  const std::vector<Recorded> all = people();
  ASSERT_EQ(all.size(), 4U);
  for (const Recorded& recorded : all) {
    const Strides strides = strides_of(stage_of(recorded.action, recorded.speed_m_s, library_for(recorded)));
    ASSERT_GT(strides.strikes.size(), 6U) << recorded.name;
    const Cycle cycle = middle_cycle(strides);
    const Angles rms = rms_deg(recorded, strides, cycle), peak = peak_deg_s(strides, cycle);
    const double steps_per_min = 120.0 * kFilmed_hz / (cycle.last - cycle.first);
    std::printf("%-14s thigh, knee, ankle: RMS %.1f %.1f %.1f deg, peaks %.0f %.0f %.0f deg/s, %.0f steps/min\n",
                recorded.name.c_str(), rms[0], rms[1], rms[2], peak[0], peak[1], peak[2], steps_per_min);
    EXPECT_NEAR(steps_per_min, recorded.steps_per_min, 0.1 * recorded.steps_per_min) << recorded.name;
    for (int a = 0; a < kAngles; ++a) {
      EXPECT_LT(rms[at(a)], 10.0) << recorded.name << " angle " << a;
      EXPECT_NEAR(peak[at(a)], recorded.peak_deg_s[at(a)], 0.25 * recorded.peak_deg_s[at(a)]) << recorded.name << " angle " << a;
    }
  }
}

// A fully stretched leg stops the hips above it. Stopping at once took 55 m/s^2.
TEST(Gaits, CarryHipsWithoutAJolt) {
  constexpr double kMost_m_s2 = 1.5 * 9.81;
  for (const double speed_m_s : {0.6, 0.98, 1.2, 1.6, 2.0}) {
    const Motion motion = generate(stage_of("walk", speed_m_s, stock_library()));
    double most_m_s2 = 0.0;
    for (int f = 500; f < 900; ++f) {
      const auto height_m = [&](int frame) { return motion.root[at(frame)].p_m.y; };
      const double bend = height_m(f + 1) - 2.0 * height_m(f) + height_m(f - 1);
      most_m_s2 = std::max(most_m_s2, std::fabs(bend) * kFilmed_hz * kFilmed_hz);
    }
    EXPECT_LT(most_m_s2, kMost_m_s2) << speed_m_s;
  }
}

// A speed that rises along 3u^2 - 2u^3 is 1.5 times as steep in the middle as on average.
TEST(Gaits, StartAndStopAsQuicklyAsBalanceAllows) {
  constexpr double kAverage_m_s2 = 2.2;
  const Motion motion = generate(stage_of("run", 3.0, stock_library()));
  double most_m_s2 = 0.0;
  for (int f = 1; f + 1 < motion.frame_count; ++f) {
    const auto way_m = [&](int frame) { return motion.root[at(frame)].p_m.z; };
    const double bend_m = way_m(f + 1) - 2.0 * way_m(f) + way_m(f - 1);
    most_m_s2 = std::max(most_m_s2, std::fabs(bend_m) * kFilmed_hz * kFilmed_hz);
  }
  EXPECT_LT(most_m_s2, 1.5 * kAverage_m_s2 * 1.01);
  EXPECT_GT(most_m_s2, 1.0) << "it did not run";
}

}  // namespace
}  // namespace contort
