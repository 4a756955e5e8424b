// The effects of dynamics in a frame, as signs in its picture: arrows where control accelerates joints and where blows
// struck, boxes for loads, the zero moment point (ZMP) on the area that supports the figure.
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
inline constexpr double kLeastArrow_m = 0.01;  // Shorter ones would be specks, and are left out.
inline constexpr double kLongestArrow_m = 0.4;

inline constexpr double kImpactShown_s = 0.3;  // From the frame in which it struck.

inline constexpr Vec3 kControlColor{1.0, 0.38, 0.01};
inline constexpr Vec3 kImpactColor{0.75, 0.01, 0.30};
inline constexpr Vec3 kLoadColor{0.34, 0.15, 0.04};
inline constexpr Vec3 kBalancedColor{0.04, 0.50, 0.09};
inline constexpr Vec3 kUnbalancedColor{0.80, 0.03, 0.03};

// A frame of a motion with a response, and its pose.
struct ResponseFrame {
  const Character& character;
  std::span<const Leg> legs;  // of that character
  const Motion& motion;
  int frame = 0;
  std::span<const Rigid> world;  // world_from_joint
};

// The place at which a joint's turning is shown: the next joint's origin, or, where none or several follow, the body's
// centre of mass. In the world. Bodies without mass between the axes of an anatomical joint hand on to the next one.
Vec3 lever_point_m(const Character& character, std::span<const Rigid> world, int joint);

// An arrow for each joint that control accelerates, from the lever point: where a hinge or ball turns it to, as long as
// the angular acceleration is large, or along the travel of a prismatic joint. One from the root's origin for what it
// does to the root, without its turning. None where the lever point lies on the axis.
void add_control_arrows(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes);

// An arrow that ends where a blow struck.
void add_impact_arrows(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes);

// While the figure stands: the area between its soles, and a ball at the ZMP; green while that is inside, else red.
// A ZMP that is far outside has no ball.
void add_balance_marks(const ResponseFrame& of, DrawList& list, std::vector<Triangles>& meshes);

// Boxes at their places; those with unknown names are left out.
void add_loads(std::span<const LoadDesc> loads, const Character& character, std::span<const Rigid> world,
               DrawList& list, std::vector<Triangles>& meshes);

}  // namespace contort
