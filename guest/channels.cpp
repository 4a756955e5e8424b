#include "guest/channel_fields.h"
#include "model/core/index.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;

constexpr std::size_t kLongestValue = 200;  // greatest number of bytes of a text

Issue bad_channel(const GuestChannel& channel, const std::string& text) {
  return {"guest.bad_channel", "/channels/" + channel.name, text};
}

bool is_value(ChannelType type, const Json& value) {
  if (type == ChannelType::number) return value.is_number();
  if (type == ChannelType::flag) return value.is_boolean();
  return value.is_string() && value.get_ref<const std::string&>().size() <= kLongestValue;
}

// Adds a value of one frame: it continues the last run, or begins another one.
void add_value(const std::string& channel, const std::string& value, int frame, std::vector<ChannelRun>& runs) {
  const bool goes_on = !runs.empty() && runs.back().channel == channel && runs.back().value == value &&
                       runs.back().last_frame == frame - 1;
  if (goes_on)
    runs.back().last_frame = frame;
  else
    runs.push_back({channel, value, frame, frame});
}

void add_channel(const GuestChannel& channel, const Json& values, ChannelFacts& facts) {
  if (channel.type == ChannelType::number) facts.numbers.push_back({channel.name, {}});
  for (int frame = 0; frame < static_cast<int>(values.size()); ++frame) {
    const Json& value = values[at(frame)];
    if (channel.type == ChannelType::number) facts.numbers.back().values.push_back(value.get<double>());
    if (channel.type == ChannelType::flag && value.get<bool>()) add_value(channel.name, "", frame, facts.runs);
    if (channel.type == ChannelType::text && value != "")
      add_value(channel.name, value.get<std::string>(), frame, facts.runs);
  }
}

}  // namespace

Result<ChannelFacts> read_channels(const Json& reply, std::span<const GuestChannel> declared, int frames) {
  ChannelFacts facts;
  const auto all = reply.find("channels");
  for (const GuestChannel& channel : declared) {
    const bool is_there = all != reply.end() && all->is_object() && all->contains(channel.name);
    if (!is_there) return bad_channel(channel, "the manifest declares the channel, and the reply does not have it");
    const Json& values = all->at(channel.name);
    if (!values.is_array() || values.size() != at(frames))
      return bad_channel(channel, "expected a list of " + std::to_string(frames) + " values, one for each frame");
    for (const Json& value : values)
      if (!is_value(channel.type, value)) return bad_channel(channel, "found a value of another type than declared");
    add_channel(channel, values, facts);
  }
  return facts;
}

}  // namespace contort
