// Prepares the pictures of some frames of a motion, up to the drawing itself. Nothing here depends on OpenGL.
#pragma once

#include <span>
#include <vector>

#include "checks/fold.h"
#include "model/motion/motion.h"
#include "model/spec/dynamics_desc.h"
#include "model/world/environment.h"
#include "renders/camera.h"
#include "renders/draw_list.h"
#include "renders/skin.h"

namespace contort {

// The motion to show. If dynamics changed it, its target is shown as a ghost, the figure itself is pale, and marks show
// the effects of dynamics (renders/response_marks.h).
struct Story {
  const Character& character;
  const Motion& motion;                      // a motion of this character
  const Finding* finding = nullptr;          // highlighted
  const Motion* ghost = nullptr;             // replaces the response's target as the ghost
  const Environment* environment = nullptr;  // null: a level plane at height 0
  const DynamicsDesc* dynamics = nullptr;    // source of the loads that are drawn; null: no loads
  bool colliders = false;                    // true: draws colliders as wires around the figure
  const Skin* skin = nullptr;                // skin of this character; null: its parts' meshes are drawn
};

struct Shots {
  std::vector<Triangles> meshes;  // meshes of the figure, the signs and the scenery
  std::vector<int> frames;
  std::vector<DrawList> lists;              // by frame, as all below
  std::vector<std::vector<Vec3>> outlines;  // for framing
  std::vector<Vec3> anchors;                // points on the ground below the root, which a moving camera follows
};

// Checks the input. Codes: render.no_frames, render.wrong_motion, render.bad_frame.
Result<Done> check_story(const Story& story, std::span<const int> frames);

// Makes shots of existing frames of the motion, without scenery.
Shots take_shots(const Story& story, std::span<const int> frames);

// Adds the scenery that is visible to a camera that frames all of these outlines.
void add_scenery(const Story& story, std::span<const std::vector<Vec3>> outlines, Shots& shots);

Environment environment_of(const Story& story);

// Keeps the views from which the finding's angle is visible: if a hinge left its range, views along its axis, from
// which the sector of its range is not a line. For other findings it keeps all views.
std::vector<View> views_of_angle(const Story& story, int frame, std::vector<View> views);

}  // namespace contort
