#include "guest/promised.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"

namespace contort {

namespace {

// The first frame in which a later use begins, or the end of the motion.
int next_start(const GuestRequest& whole, std::size_t use) {
  const bool is_shared = std::ranges::any_of(whole.uses, [&](const PlacedUse& other) {
    return &other != &whole.uses[use] && other.start_frame == whole.uses[use].start_frame;
  });
  if (is_shared) return whole.uses[use].start_frame;  // the order of uses with the same start is not defined
  for (std::size_t u = use + 1; u < whole.uses.size(); ++u)
    if (whole.uses[u].start_frame > whole.uses[use].start_frame) return whole.uses[u].start_frame;
  return whole.frames;
}

Promised until_next(const GuestRequest& whole, std::size_t use, Equality why) {
  const int first = whole.uses[use].start_frame;
  Promised promised;
  promised.request = {0, whole.rate_hz, std::max(0, next_start(whole, use) - first), {whole.uses[use]}};
  promised.request.uses.front().start_frame = 0;
  promised.equal.why = why;
  promised.equal.first_frame = first;
  return promised;
}

Promised without(const GuestRequest& whole, std::size_t use, Equality why, int first_frame) {
  Promised promised{whole, {}, first_frame};
  promised.request.uses.erase(promised.request.uses.begin() + static_cast<std::ptrdiff_t>(use));
  promised.equal.why = why;
  promised.equal.first_frame = first_frame;
  return promised;
}

// The first frame in which the use must have no effect any more.
int returned_frame(const PlacedUse& placed, double rate_hz) {
  const double returns_s = *placed.action->returns_s;
  return placed.end_frame() + placed.use->blend_out_frames + static_cast<int>(std::ceil(returns_s * rate_hz - 1e-9));
}

}  // namespace

std::vector<Promised> promises_of(const GuestRequest& whole) {
  std::vector<Promised> promises;
  for (std::size_t u = 0; u < whole.uses.size() && promises.size() < kMostPromised; ++u) {
    const Effect effect = whole.uses[u].action->effect;
    if (effect == Effect::rest) promises.push_back(until_next(whole, u, Equality::rest));
    if (effect == Effect::equals && whole.uses[u].start_frame > whole.uses.front().start_frame) {
      promises.push_back(until_next(whole, u, Equality::fresh));
      if (promises.back().request.frames > 0) ++promises.back().request.frames;
      promises.back().request.uses.front().start_frame = 1;
      promises.back().first_row = 1;
    }
    if (effect == Effect::none) promises.push_back(without(whole, u, Equality::none, 0));
    if (!whole.uses[u].action->returns_s) continue;
    const int first = returned_frame(whole.uses[u], whole.rate_hz);
    if (first < whole.frames) promises.push_back(without(whole, u, Equality::undo, first));
  }
  std::erase_if(promises, [](const Promised& promised) { return promised.request.frames == 0; });
  return promises;
}

EqualMotion rest_motion(const Character& character, const Rigid& root, const Promised& promised) {
  EqualMotion rest = promised.equal;
  for (int frame = 0; frame < promised.request.frames; ++frame) {
    rest.coords.insert(rest.coords.end(), character.rest_coords().begin(), character.rest_coords().end());
    rest.root.push_back(root);
  }
  return rest;
}

Spec spec_of_all_actions(const CharacterChoice& choice, const Character& character, const Offers& offers,
                         double rate_hz) {
  Spec spec;
  spec.character = choice;
  spec.rate_hz = rate_hz;
  ClipDesc clip;
  int start = 0;
  for (std::size_t p = 0; p < offers.size(); ++p)
    for (const OfferedAction& action : offers[p]) {
      ActionUse use;
      use.action = action.name, use.slot = character.parts()[p].slot;
      use.start_frame = start, use.duration_frames = action.duration->least;
      use.blend_in_frames = action.blend_in->least, use.blend_out_frames = action.blend_out->least;
      start += use.duration_frames;
      clip.actions.push_back(use);
    }
  spec.sequences.push_back({"", 0, {clip}});
  return spec;
}

}  // namespace contort
