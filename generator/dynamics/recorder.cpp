#include "generator/dynamics/recorder.h"

#include <algorithm>
#include <cmath>

namespace contort {

void Recorder::begin(Motion& motion, int dof_count) {
  motion_ = &motion;
  Response& response = motion.response;
  const auto frames = static_cast<std::size_t>(motion.frame_count);
  response.dof_count = dof_count;
  response.target_coords = motion.coords;
  response.target_root = motion.root;
  response.efforts.assign(frames * static_cast<std::size_t>(dof_count), 0.0);
  response.control.assign(frames * static_cast<std::size_t>(dof_count), 0.0);
  response.stances.assign(frames, {});
  response.impacts.clear();
}

void Recorder::begin_frame(int frame, const FigureState& state, std::uint8_t planned) {
  frame_ = frame;
  motion_->root[static_cast<std::size_t>(frame)] = state.root;
  std::ranges::copy(state.coords, motion_->row(frame).begin());
  stance().planned = planned;
  balanced_ = false;
}

void Recorder::end_frame(std::span<const int> standing) {
  for (const int sole : standing) stance().standing |= static_cast<std::uint8_t>(1U << sole);
}

std::span<double> Recorder::row(std::vector<double>& values) const {
  const auto n = static_cast<std::size_t>(motion_->response.dof_count);
  return std::span(values).subspan(static_cast<std::size_t>(frame_) * n, n);
}

void Recorder::efforts(std::span<const double> efforts) {
  const std::span<double> greatest = row(motion_->response.efforts);
  for (std::size_t k = 0; k < greatest.size(); ++k)
    if (std::fabs(efforts[k]) > std::fabs(greatest[k])) greatest[k] = efforts[k];
}

void Recorder::control(std::span<const double> added, double share) {
  const std::span<double> mean = row(motion_->response.control);
  for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += share * added[k];
}

void Recorder::balance(const Balance& balance) {
  if (balanced_ && balance.margin_m >= stance().margin_m) return;
  balanced_ = true;
  stance().margin_m = balance.margin_m;
  stance().zmp_m = balance.zmp_m;
}

void Recorder::footing(Footing footing) { stance().footing = std::max(stance().footing, footing); }

}  // namespace contort
