// The contents of a picture, as plain values. Nothing here depends on OpenGL.
//
//   Figure figure = make_figure(character, highlighted(character, finding));   // once: triangles, colours
//   DrawList list;
// add_figure(list, figure, world); // per frame: the place of everything
#pragma once

#include <span>
#include <vector>

#include "model/character/character.h"
#include "model/core/math.h"
#include "renders/highlight.h"

namespace contort {

struct DrawInstance {
  int mesh = 0;           // Index into the triangles of the figure and the scenery.
  Rigid world_from_mesh;  // Finite, within kWorldReach_m.
  Vec3 color{0.7};        // Linear RGB, each in [0, 1].
  int highlight =
      0;  // 0: none. n > 0: a subject of the finding (see highlight_groups), which is visible through everything in
          // front of it.
  bool ghost = false;   // Translucent.
  bool mark = false;    // A sign: it has no shadow, and unless it is translucent it is visible through everything in
                        // front of it.
  bool on_top = false;  // With `mark`: drawn in front of everything; of several the later one is in front.
};

// Positions beyond this are treated as not finite: nothing would be visible, and floats would lose centimetres.
inline constexpr double kWorldReach_m = 1e4;

// The objects around the figure. They do not count for framing, and they never hide the figure.
struct Scenery {
  std::vector<DrawInstance> ground;  // Empty: a level plane.
  double level_m = 0.0;              // The height of that plane.
  std::vector<DrawInstance> obstacles;
};

struct DrawList {
  std::vector<DrawInstance> instances;
  Scenery scenery;
  bool complete = true;  // false: something was left out because its place is not finite.
};

// A character's triangles and colours, in the frames of its joints.
struct FigurePiece {
  int mesh = 0;
  int joint = 0;
  Vec3 color{0.7};
  int highlight = 0;
  bool ghost = false;
  bool mark = false;
};

struct Figure {
  std::vector<Triangles> meshes;
  std::vector<FigurePiece> pieces;
};

// Returns mesh pieces with their colours. Highlighted pieces are red and all others pale, because a character may be
// red itself. Also adds the highlighted colliders if the mesh has another shape than the judged one, and a small
// sphere at each highlighted joint. If the figure wears a skin, which is not here, only the meshes of attached
// objects are included.
Figure make_figure(const Character& character, const Highlight& highlight, bool wears_skin = false);

// The colour of a skin's piece in this highlight group.
Vec3 skin_color(int group, bool any_highlight);

// Adds the shape of every collider, which is what checks judge, as wires around the figure.
inline constexpr Vec3 kMarkerColor{1.0, 0.82, 0.05};  // of a highlighted joint
inline constexpr Vec3 kGhostColor{0.04, 0.042, 0.046};
inline constexpr Vec3 kWireColor{0.0, 0.16, 0.75};
void add_wires(const Character& character, Figure& figure);

// Returns the diagonal of the box around the figure's colliders at rest; 1 if there are none.
double figure_size_m(const Character& character);

enum class Look {
  solid,  // in its own colours
  pale,   // nearly white except for highlights: the figure to which a ghost belongs
  ghost,  // grey and translucent, without highlight
};

// Appends one instance. An instance without a finite transform is left out, and the list is then not complete.
void add_instance(DrawList& list, const DrawInstance& instance);

// Returns the colour in which a piece of this colour and group is drawn.
Vec3 color_in(Look look, const Vec3& color, int highlight);

// Appends the figure in the pose `world` (world_from_joint, one per joint).
void add_figure(DrawList& list, const Figure& figure, std::span<const Rigid> world, Look look = Look::solid);

// Returns the corners of the boxes around all instances, for framing, without the scenery; markers of highlighted
// joints and translucent pieces are included.
std::vector<Vec3> outline(const DrawList& list, std::span<const Triangles> meshes);

}  // namespace contort
