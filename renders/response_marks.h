// Draws the effects of dynamics in a frame: arrows where control accelerates joints and at impacts, boxes for loads,
// and the zero moment point (ZMP) on the area that supports the figure.
#pragma once

#include <span>
#include <vector>

#include "model/motion/legs.h"
#include "model/motion/motion.h"
#include "model/spec/dynamics_desc.h"
#include "renders/draw_list.h"

namespace contort {

// Lengths of arrows.
inline constexpr double kArrow_m_per_rad_s2 = 0.01;
inline constexpr double kArrow_m_per_m_s2 = 0.2;
inline constexpr double kArrow_m_per_N_s = 0.06;
inline constexpr double kLeastArrow_m = 0.01;  // Shorter arrows are left out, because they would be specks.
inline constexpr double kLongestArrow_m = 0.4;

inline constexpr double kImpactShown_s = 0.3;  // Time for which an impact is shown, from its frame on.

inline constexpr Vec3 kControlColor{1.0, 0.38, 0.01};
inline constexpr Vec3 kImpactColor{0.75, 0.01, 0.30};
inline constexpr Vec3 kLoadColor{0.34, 0.15, 0.04};
inline constexpr Vec3 kBalancedColor{0.04, 0.50, 0.09};
inline constexpr Vec3 kUnbalancedColor{0.80, 0.03, 0.03};

// A frame of a motion with a response, and its pose.
struct ResponseFrame {
  const Character& character;
  std::span<const Leg> legs;  // the character's legs
  const Motion& motion;
  int frame = 0;
  std::span<const Rigid> world;  // world_from_joint
};

// Returns the point, in the world, at which a joint's rotation is shown: the next joint's origin or, if none or
// several follow, the body's centre of mass. Bodies without mass between the axes of an anatomical joint are skipped.
Vec3 lever_point_m(const Character& character, std::span<const Rigid> world, int joint);

// Adds an arrow for each joint that control accelerates. It begins at the lever point and points in the direction in
// which a hinge or ball moves that point, with a length in proportion to the angular acceleration; for a prismatic
// joint it points along the travel. One arrow from the root's origin shows the root's linear acceleration. There is no
// arrow if the lever point lies on the axis.
void add_control_arrows(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes);

// Adds an arrow that ends at the point of an impact.
void add_impact_arrows(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes);

// Adds, while the figure stands, the area between its soles, and a ball at the ZMP: green inside the area, otherwise
// red. A ZMP that is far outside has no ball.
void add_balance_marks(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes);

// Adds boxes for loads; loads with unknown names are left out.
void add_loads(std::span<const LoadDesc> loads, const Character& character, std::span<const Rigid> world,
               DrawList& list, std::vector<Triangles>& meshes);

}  // namespace contort
