// Reads the channels of a reply.
#pragma once

#include <span>

#include "guest/channels.h"
#include "guest/manifest.h"
#include "model/core/json_value_fields.h"
#include "model/core/result.h"

namespace contort {

// Expects all declared channels, with a value of their type for each frame. Code guest.bad_channel.
Result<ChannelFacts> read_channels(const json_fields::Json& reply, std::span<const GuestChannel> declared, int frames);

}  // namespace contort
