// Compares a checked frame (joints placed, then joint_range, angular_velocity and self_collision) with MuJoCo's
// mj_inverse, which computes about as much for a frame: kinematics, collisions, forces. Both get the same frames of
// motions that the fuzzer draws, and MuJoCo has the same shapes in the same pairs.
#include <cstdio>

#include "bench/side_by_side.h"
#include "checks/check.h"
#include "fuzz/draw.h"
#include "generator/generate.h"
#include "generator/execute.h"
#include "model/motion/place_frames.h"
#include "tests/dynamics/mujoco_model.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

constexpr int kMotions = 64;
constexpr int kRounds = 21;

struct Case {
  Stage stage;
  Motion motion;
  Intent intent;
};

std::vector<Case> draw_cases(const char* character, const char* profile) {
  std::vector<Case> cases;
  DrawConfig config{{character}, *load_profile(profile)};
  config.profile.swaps = config.profile.objects = 0.0;
  for (int i = 0; i < kMotions; ++i) {
    const Result<Stage> stage = build_stage(draw_spec(config, stock_generator(), 7, i), stock_library());
    if (!stage) continue;
    const Motion motion = generate(*stage);
    cases.push_back({*stage, motion, intent_of(*stage)});
  }
  return cases;
}

// MuJoCo's state in a frame.
struct State {
  std::vector<double> coords, velocity, acceleration;
};

void differentiate(mjModel* model, double rate_hz, std::vector<State>& states) {
  const auto dofs = static_cast<std::size_t>(model->nv);
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    states[i].velocity.resize(dofs);
    mj_differentiatePos(model, states[i].velocity.data(), 1.0 / rate_hz, states[i].coords.data(),
                        states[i + 1].coords.data());
  }
  if (states.size() > 1) states.back().velocity = states[states.size() - 2].velocity;
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].velocity.resize(dofs);
    states[i].acceleration.assign(dofs, 0.0);
    for (std::size_t d = 0; i > 0 && d < dofs; ++d)
      states[i].acceleration[d] = rate_hz * (states[i].velocity[d] - states[i - 1].velocity[d]);
  }
}

// The frames of all cases; all cases have the stock character.
class MujocoFrames {
 public:
  explicit MujocoFrames(const std::vector<Case>& cases)
      : body_(Multibody::of(*cases.front().stage.character)),
        theirs_(*cases.front().stage.character, fixtures::Shapes::colliders) {
    for (const Case& each : cases) {
      std::vector<State> states;
      for (int f = 0; f < each.motion.frame_count; ++f)
        states.push_back(
            {theirs_.coords_of(body_, each.motion.root[static_cast<std::size_t>(f)], each.motion.row(f)), {}, {}});
      differentiate(theirs_.model(), each.motion.rate_hz, states);
      states_.push_back(std::move(states));
    }
  }

  double seconds(std::size_t i) {
    mjData* data = theirs_.data();
    const double begin = thread_time_s();
    for (const State& state : states_[i]) {
      std::ranges::copy(state.coords, data->qpos);
      std::ranges::copy(state.velocity, data->qvel);
      std::ranges::copy(state.acceleration, data->qacc);
      mj_inverse(theirs_.model(), data);
      contacts_ += data->ncon;
    }
    return thread_time_s() - begin;
  }

  long contacts() const { return contacts_; }

 private:
  Multibody body_;
  fixtures::MujocoModel theirs_;
  std::vector<std::vector<State>> states_;  // by case, then frame
  long contacts_ = 0;
};

class CheckedFrames {
 public:
  double seconds(const Case& each, std::span<const std::string_view> checks) {
    const Character& character = *each.stage.character;
    const double begin = thread_time_s();
    place_frames(character, each.motion, world_);
    const CheckInput input{character, each.motion, world_, settings_, each.stage.environment, &each.intent};
    for (const std::string_view name : checks) {
      const CheckDef& check = find_check(name);
      MarginFold fold(check.subject_count(character), settings_.merge_gap_frames, check.resolution);
      check.measure(input, fold);
      findings_ += fold.episodes().size();
    }
    return thread_time_s() - begin;
  }
  std::size_t findings() const { return findings_; }

 private:
  CheckSettings settings_;
  std::vector<Rigid> world_;
  std::size_t findings_ = 0;
};

// Prints microseconds for a frame, over whole rounds of all cases.
void compare(const char* character, const char* profile) {
  const std::vector<Case> cases = draw_cases(character, profile);
  constexpr std::string_view kChecks[] = {"joint_range", "angular_velocity", "self_collision"};
  int frames = 0;
  for (const Case& each : cases) frames += each.motion.frame_count;
  MujocoFrames theirs(cases);
  std::vector<double> peer_us;
  std::vector<std::vector<double>> own_us(5), ratios(5);  // joints alone, with each of the checks, with all checks
  const double to_us = 1e6 / frames;
  CheckedFrames ours;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> own(5, 0.0);
    double peer = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      peer += to_us * theirs.seconds(i);
      own[0] += to_us * ours.seconds(cases[i], {});
      for (std::size_t c = 0; c < 3; ++c)
        own[1 + c] += to_us * ours.seconds(cases[i], std::span(kChecks).subspan(c, 1));
      own[4] += to_us * ours.seconds(cases[i], kChecks);
    }
    peer_us.push_back(peer);
    for (std::size_t k = 0; k < 5; ++k) own_us[k].push_back(own[k]), ratios[k].push_back(own[k] / peer);
  }
  std::printf("%s, profile %s: %d frames, %.1f contacts in each, mj_inverse %.2f us\n", character, profile, frames,
              static_cast<double>(theirs.contacts()) / kRounds / frames, median(peer_us));
  constexpr const char* kNames[] = {"joints placed", "  and joint_range", "  and angular_velocity",
                                    "  and self_collision", "checked frame"};
  for (std::size_t k = 0; k < 5; ++k)
    std::printf("%-24s %6.2f us   ratio %.3f\n", kNames[k], median(own_us[k]), median(ratios[k]));
  std::printf("%zu episodes in a round\n", ours.findings() / kRounds / 2);
}

}  // namespace
}  // namespace contort

int main() {
  contort::compare("human", "tame");
  for (const char* character : {"human", "mech", "quadruped"}) contort::compare(character, "nightly");
}
