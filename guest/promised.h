// Requests whose motions should be equal to another one, by the effects that the manifest declares.
#pragma once

#include "guest/request.h"
#include "model/motion/foreign.h"

namespace contort {

// A request, and the frames in which its motion should equal the original one. The rest pose needs no request.
struct Promised {
  GuestRequest request;
  EqualMotion equal;   // its frames are not filled in
  int first_row = 0;   // frames of the answer before this one are not compared
};

// Returns the requests for a spec, at most kMostPromised. A use with the effect `rest`, or with `equals` after another
// use, promises the frames up to the next use; a use with `none` promises all frames; a use with `returns_s` promises
// the frames after that time. The use of an `equals` begins in frame 1 of its request: frame 0 is the state before it.
std::vector<Promised> promises_of(const GuestRequest& whole);
inline constexpr std::size_t kMostPromised = 4;

EqualMotion rest_motion(const Character& character, const Rigid& root, const Promised& promised);

// Returns a request that plays every action once, one after another, with default parameters.
Spec spec_of_all_actions(const CharacterChoice& choice, const Character& character, const Offers& offers,
                         double rate_hz);

}  // namespace contort
