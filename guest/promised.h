// Requests whose motions should be equal to another one, by the effects that the manifest declares.
#pragma once

#include "guest/request.h"
#include "model/motion/foreign.h"

namespace contort {

// A request, and where its motion should be equal to the whole one. A motion of rest is not asked for.
struct Promised {
  GuestRequest request;
  EqualMotion equal;   // without frames
  int first_row = 0;   // frames of the answer before this one are not compared
};

// For each use with the effect `rest`, or `equals` after another use, the frames up to the next use; for each with
// `none` all frames; for each that returns the frames after that. At most kMostPromised. The use of an `equals` begins
// in frame 1 of its request: frame 0 is the state before it.
std::vector<Promised> promises_of(const GuestRequest& whole);
inline constexpr std::size_t kMostPromised = 4;

EqualMotion rest_motion(const Character& character, const Rigid& root, const Promised& promised);

// Every action once, one after another, with its parameters at their defaults.
Spec spec_of_all_actions(const CharacterChoice& choice, const Character& character, const Offers& offers,
                         double rate_hz);

}  // namespace contort
