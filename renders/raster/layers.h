// The layers of a picture: which instances each pass of the renderer draws.
#pragma once

#include "renders/draw_list.h"

namespace contort {

// True for instances that are drawn first, with depth.
inline bool is_opaque(const DrawInstance& instance) { return !instance.ghost && !instance.on_top; }

// True for pieces of the grey figure that shows the target motion. Together they are one layer.
inline bool is_ghost_figure(const DrawInstance& instance) {
  return instance.ghost && !instance.mark && instance.highlight == 0;
}

// True for instances that are blended over the opaque ones, one by one.
inline bool is_translucent(const DrawInstance& instance) { return instance.ghost && !is_ghost_figure(instance); }

// True for instances that are drawn again, faintly, through objects in front of them.
inline bool shines_through(const DrawInstance& instance) {
  return instance.highlight > 0 || (instance.mark && !instance.ghost && !instance.on_top);
}

inline bool casts_shadow(const DrawInstance& instance) { return !instance.ghost && !instance.mark; }

}  // namespace contort
