// Takes without a generator, at 10 Hz in kinematic mode: a figure of one joint, and a letter for each frame.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/played.h"

namespace contort::server {

inline std::shared_ptr<const Played> played_bytes(std::string frames) {
  Played played;
  played.joint_count = 1, played.rate_hz = 10.0, played.spans = "\"spans\":[],\"marks\":[]";
  played.frame_count = static_cast<int>(frames.size()) / kJointBytes;
  played.frames = std::move(frames);
  return std::make_shared<const Played>(std::move(played));
}

// The spec holds for as many frames as the take's number, so that takes differ.
inline PlayedTake take_of(int number, const std::string& letters) {
  PlayedTake take;
  take.number = number, take.spec.hold_frames = number;
  std::string frames;
  for (const char letter : letters) frames += std::string(kJointBytes, letter);
  take.played[Mode::kinematic] = played_bytes(std::move(frames));
  return take;
}

// A frame for each x, m, where the root stands unturned.
inline std::shared_ptr<const Played> played_with_root_at(const std::vector<float>& xs_m) {
  std::string frames;
  for (const float x : xs_m) {
    const float joint[] = {x, 0, 0, 0, 0, 0, 1};
    static_assert(sizeof joint == kJointBytes);
    frames.append(reinterpret_cast<const char*>(joint), sizeof joint);
  }
  return played_bytes(std::move(frames));
}

}  // namespace contort::server
