// The layers of a picture: which instances each pass of the renderer draws.
#pragma once

#include "renders/draw_list.h"

namespace contort {

// Drawn first, with depth.
inline bool is_opaque(const DrawInstance& instance) { return !instance.ghost && !instance.on_top; }

// A piece of the grey figure that a motion's target is: all of these are one layer.
inline bool is_ghost_figure(const DrawInstance& instance) {
  return instance.ghost && !instance.mark && instance.highlight == 0;
}

// Blended over what is opaque, one by one.
inline bool is_translucent(const DrawInstance& instance) { return instance.ghost && !is_ghost_figure(instance); }

// Drawn again, faintly, where something is in front.
inline bool shines_through(const DrawInstance& instance) {
  return instance.highlight > 0 || (instance.mark && !instance.ghost && !instance.on_top);
}

inline bool casts_shadow(const DrawInstance& instance) { return !instance.ghost && !instance.mark; }

}  // namespace contort
