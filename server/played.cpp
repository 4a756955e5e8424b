#include "server/played.h"

#include <algorithm>
#include <cstring>

#include "model/core/json_fields.h"

namespace contort::server {

namespace {

using json_fields::Json;

float float_at(const std::string& bytes, std::size_t index) {
  float value = 0.0F;
  std::memcpy(&value, bytes.data() + index * sizeof value, sizeof value);
  return value;
}

}  // namespace

int PlayClock::frame(double rate_hz, Time at) const {
  if (!playing_) return frame_;
  const double frames = std::chrono::duration<double>(at - since_).count() * rate_hz;
  return frame_ + static_cast<int>(std::clamp(frames, 0.0, 1e6));
}

std::string Played::frames_from(int from, int count) const {
  if (from < 0 || from >= frame_count || count <= 0) return "";
  const auto each = static_cast<std::size_t>(frame_bytes());
  return frames.substr(static_cast<std::size_t>(from) * each, static_cast<std::size_t>(count) * each);
}

int Played::first_difference(const Played& other) const {
  const std::size_t each = static_cast<std::size_t>(std::max(1, frame_bytes()));
  const std::size_t common = std::min(frames.size(), other.frames.size());
  const auto differs =
      std::mismatch(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(common), other.frames.begin());
  return static_cast<int>(static_cast<std::size_t>(differs.first - frames.begin()) / each);
}

Rigid Played::root(int frame) const {
  const std::size_t first = static_cast<std::size_t>(frame) * static_cast<std::size_t>(joint_count) * 7;
  const auto value = [&](std::size_t k) { return static_cast<double>(float_at(frames, first + k)); };
  return {Quat(value(6), value(3), value(4), value(5)), Vec3(value(0), value(1), value(2))};
}

Result<std::shared_ptr<const Played>> played_of(const Reply& reply) {
  const Result<Json> head = json_fields::parse_document(reply.head);
  if (!head) return head.issue();
  auto played = std::make_shared<Played>();
  played->frame_count = head->value("frame_count", 0);
  played->joint_count = head->value("joint_count", 0);
  played->rate_hz = head->value("rate_hz", 60.0);
  played->motion_hash = head->value("motion_hash", "");
  played->frames = reply.bytes;
  for (const Json& span : head->at("queue"))
    played->queue.push_back({span.value("first_frame", 0), span.value("last_frame", 0), span.value("sequence", 0),
                             span.value("first_content", 0)});
  played->spans = "\"spans\":" + head->at("spans").dump(-1, ' ', false, Json::error_handler_t::replace) +
                  ",\"marks\":" + head->at("marks").dump(-1, ' ', false, Json::error_handler_t::replace);
  return std::shared_ptr<const Played>(played);
}

}  // namespace contort::server
