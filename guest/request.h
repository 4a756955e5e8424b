// Converts a spec to a request to a generator that is a program of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "guest/manifest.h"
#include "model/core/result.h"
#include "model/generator.h"
#include "model/spec/spec.h"

namespace contort {

// A use of an action on the one time line that the generator sees.
struct PlacedUse {
  const ActionUse* use = nullptr;
  const GuestAction* action = nullptr;
  const OfferedAction* offer = nullptr;  // the offer of this action on this use's part
  int sequence = 0;  // indices into the spec
  int clip = 0;
  int index = 0;
  int start_frame = 0;
  int end_frame() const { return start_frame + use->duration_frames; }
};

// Returns all uses of a spec that admit_request() accepts, in the order of their starts.
std::vector<PlacedUse> placed_uses(const GuestManifest& manifest, const Spec& spec, const Character& character,
                                   const Offers& offers);

// Returns the number of frames of the whole motion: the frame at time 0, the frames to the end of the last use, and the
// hold.
int frames_of(const Spec& spec);

// Returns true if a parameter may have the value.
bool allows(const ParamDef& def, const ParamValue& value);

// Refuses specs that the generator does not offer. Codes guest.unsupported, .unknown_action, .unknown_param,
// .bad_param, .bad_duration, .too_long, with pointers into the spec.
Result<Done> admit_request(const Spec& spec, const Character& character, const Offers& offers);

struct GuestRequest {
  std::int64_t id = 0;
  double rate_hz = 60.0;
  int frames = 0;
  std::vector<PlacedUse> uses;
};

// Prints the request as one line of JSON. Uses keep their times in seconds if the rate differs from the spec's rate.
std::string print_request(const GuestRequest& request, const GuestManifest& manifest, const Spec& spec);

}  // namespace contort
