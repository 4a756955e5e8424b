// A motion as a picture of some of its frames shows it, all but the pixels. Nothing here knows of OpenGL.
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

// The motion to show. For one that dynamics moved: its target as a ghost, the figure itself pale, and signs of
// what happened (renders/response_marks.h).
struct Story {
  const Character& character;
  const Motion& motion;                      // of this character
  const Finding* finding = nullptr;          // highlighted
  const Motion* ghost = nullptr;             // instead of the response's target
  const Environment* environment = nullptr;  // null: a level plane at height 0
  const DynamicsDesc* dynamics = nullptr;    // whose loads are drawn; null: none
  bool colliders = false;                    // as wires around the figure
  const Skin* skin = nullptr;                // of this character; null: its parts' meshes are drawn
};

struct Shots {
  std::vector<Triangles> meshes;  // of the figure, the signs and the scenery
  std::vector<int> frames;
  std::vector<DrawList> lists;              // by frame, as all below
  std::vector<std::vector<Vec3>> outlines;  // for framing
  std::vector<Vec3> anchors;                // the place on the ground below the root: what a following camera follows
};

// Codes: render.no_frames, render.wrong_motion, render.bad_frame.
Result<Done> check_story(const Story& story, std::span<const int> frames);

// Takes shots of frames that the motion has, without scenery.
Shots take_shots(const Story& story, std::span<const int> frames);

// Adds the scenery, as far as a camera that frames all of these outlines sees it.
void add_scenery(const Story& story, std::span<const std::vector<Vec3>> outlines, Shots& shots);

Environment environment_of(const Story& story);

// Keeps those views from which the story's angle is seen: where a hinge left its range, along its axis, in which the
// sector of its range is not a line. All of them for everything else.
std::vector<View> views_of_angle(const Story& story, int frame, std::vector<View> views);

}  // namespace contort
