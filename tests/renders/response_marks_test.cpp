#include "renders/response_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "generator/dynamics/dynamics.h"
#include "generator/dynamics/figure.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "renders/arrow.h"
#include "renders/shots.h"

namespace contort {
namespace {

Character stock(const char* name) {
  CharacterChoice choice;
  choice.name = name;
  return build_character(choice, stock_library()).value();
}

// A figure at rest in two frames, with an empty response.
struct Still {
  Character character;
  std::vector<Leg> legs = find_legs(character);
  DynamicFigure figure = build_figure(character, legs, {});
  Motion motion;
  std::vector<Rigid> world = std::vector<Rigid>(character.joints().size());
  DrawList list;
  std::vector<Triangles> meshes;

  explicit Still(const char* name = "human") : character(stock(name)) {
    motion.rate_hz = 10.0;
    motion.frame_count = 2;
    motion.coord_count = character.coord_count();
    for (int f = 0; f < 2; ++f)
      motion.coords.insert(motion.coords.end(), character.rest_coords().begin(), character.rest_coords().end());
    motion.root.assign(2, character.rest_root());
    Response& response = motion.response;
    response.dof_count = figure.body.dof_count();
    response.target_coords = motion.coords;
    response.target_root = motion.root;
    response.control.assign(2 * at(response.dof_count), 0.0);
    response.stances.assign(2, {.planned = 3, .standing = 3, .zmp_m = Vec3(0.0, 0.0, 0.03), .margin_m = 0.05});
    place_joints();
  }

  // Bends all joints a little, so that no two axes are parallel.
  void bend() {
    for (const Joint& joint : character.joints())
      for (int k = 0; k < coord_size(joint.kind) && coord_size(joint.kind) == 1; ++k)
        motion.coords[at(joint.coord)] = 0.3 * joint.low + 0.7 * joint.high;
    place_joints();
  }

  void place_joints() { forward_kinematics(character, motion.root[0], motion.row(0), world); }
  ResponseFrame frame(int f = 0) const { return {character, legs, motion, f, world}; }
  const Link& link(const std::string& joint) const { return figure.body.links()[at(character.find_joint(joint))]; }
  double& control(const std::string& joint, int k = 0) { return motion.response.control[at(link(joint).dof + k)]; }
  int count(const Vec3& color) const {
    return static_cast<int>(
        std::ranges::count_if(list.instances, [&](const DrawInstance& i) { return i.color == color; }));
  }
};

double length_of(const Triangles& arrow) {
  double length_m = 0.0;
  for (const Vec3& p : arrow.positions_m) length_m = std::max(length_m, p.y);
  return length_m;
}

Vec3 along(const DrawInstance& arrow) { return arrow.world_from_mesh.q * Vec3(0, 1, 0); }

TEST(Arrow, EndsAtItsLengthAndFacesOutwards) {
  for (const double length_m : {0.01, 0.1, 0.4}) {
    const Triangles arrow = arrow_triangles(length_m);
    EXPECT_DOUBLE_EQ(length_of(arrow), length_m);
    ASSERT_EQ(arrow.positions_m.size(), arrow.normals.size());
    for (std::size_t i = 0; i < arrow.positions_m.size(); i += 3) {
      const Vec3 *p = &arrow.positions_m[i], middle = (p[0] + p[1] + p[2]) / 3.0;
      const Vec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
      EXPECT_GT(glm::dot(normal, arrow.normals[i]), 0.999);
      const Vec3 from_axis(middle.x, 0.0, middle.z);
      EXPECT_TRUE(glm::dot(normal, from_axis) > 0.0 || normal.y < -0.999) << i;
    }
  }
}

TEST(ControlArrows, AreThereExactlyForJointsThatControlMoves) {
  Still still;
  add_control_arrows(still.frame(), still.list, still.meshes);
  EXPECT_TRUE(still.list.instances.empty());
  still.control("arm_left/elbow") = 12.0;
  still.control("arm_right/shoulder", 0) = -20.0;
  add_control_arrows(still.frame(), still.list, still.meshes);
  ASSERT_EQ(still.list.instances.size(), 2U);
  for (const DrawInstance& arrow : still.list.instances) EXPECT_TRUE(arrow.mark && !arrow.ghost);
  EXPECT_EQ(still.count(kControlColor), 2);
  std::vector<double> lengths_m = {length_of(still.meshes[0]), length_of(still.meshes[1])};
  std::ranges::sort(lengths_m);
  EXPECT_NEAR(lengths_m[0], 12.0 * kArrow_m_per_rad_s2, 1e-12);
  EXPECT_NEAR(lengths_m[1], 20.0 * kArrow_m_per_rad_s2, 1e-12);
  DrawList after;
  add_control_arrows(still.frame(1), after, still.meshes);
  EXPECT_TRUE(after.instances.empty());
}

// At rest the arm hangs: bending the elbow takes the hand forward.
TEST(ControlArrows, PointForwardWhereAnElbowIsBent) {
  Still still;
  still.control("arm_left/elbow") = 10.0;
  add_control_arrows(still.frame(), still.list, still.meshes);
  ASSERT_EQ(still.list.instances.size(), 1U);
  const Rigid& elbow = still.world[at(still.character.find_joint("arm_left/elbow"))];
  EXPECT_GT(std::fabs(along(still.list.instances[0]).z), 0.9);
  EXPECT_GT(along(still.list.instances[0]).z *
                still.character.joints()[at(still.character.find_joint("arm_left/elbow"))].high,
            0.0);
  EXPECT_LT(still.list.instances[0].world_from_mesh.p_m.y, elbow.p_m.y - 0.15);  // at the wrist
}

// Against the integrator of dynamics, for every joint of a bent figure.
TEST(ControlArrows, PointWhereTheJointTurnsTo) {
  for (const char* name : {"human", "mech", "quadruped"}) {
    Still still(name);
    still.bend();
    int arrows = 0;
    for (int j = 1; j < static_cast<int>(still.character.joints().size()); ++j) {
      const Link& link = still.figure.body.links()[at(j)];
      std::vector<double> rates(at(still.motion.response.dof_count), 0.0);
      for (int k = 0; k < link.dof_count; ++k) rates[at(link.dof + k)] = 5.0 - 3.0 * k;
      std::ranges::copy(rates, still.motion.response.control.begin());
      still.list = {};
      add_control_arrows(still.frame(), still.list, still.meshes);
      ASSERT_LE(still.list.instances.size(), 1U);
      if (still.list.instances.empty()) continue;  // the lever point lies on the axis
      ++arrows;
      Still moved = still;
      integrate(still.figure.body, rates, 1e-6, moved.motion.root[0], moved.motion.row(0));
      moved.place_joints();
      const Vec3 before_m = lever_point_m(still.character, still.world, j);
      const Vec3 way = glm::normalize(lever_point_m(still.character, moved.world, j) - before_m);
      EXPECT_NEAR(glm::dot(way, along(still.list.instances[0])), 1.0, 1e-6) << still.character.joints()[at(j)].name;
      EXPECT_EQ(still.list.instances[0].world_from_mesh.p_m, before_m);
    }
    EXPECT_GE(arrows, 10) << name;
  }
}

TEST(ControlArrows, ShowWhatIsDoneToTheRoot) {
  Still still;
  still.motion.response.control[2] = -0.5;
  still.motion.response.control[4] = 9.0;  // its turning is not shown
  add_control_arrows(still.frame(), still.list, still.meshes);
  ASSERT_EQ(still.list.instances.size(), 1U);
  EXPECT_NEAR(along(still.list.instances[0]).z, -1.0, 1e-12);
  EXPECT_EQ(still.list.instances[0].world_from_mesh.p_m, still.world[0].p_m);
  EXPECT_NEAR(length_of(still.meshes[0]), 0.5 * kArrow_m_per_m_s2, 1e-12);
}

TEST(ControlArrows, HaveALengthThatCanBeDrawn) {
  Still still;
  still.control("arm_left/elbow") = 1e9;
  still.control("arm_right/elbow") = 0.5 * kLeastArrow_m / kArrow_m_per_rad_s2;
  still.control("leg_left/knee") = std::numeric_limits<double>::quiet_NaN();
  add_control_arrows(still.frame(), still.list, still.meshes);
  ASSERT_EQ(still.list.instances.size(), 1U);
  EXPECT_DOUBLE_EQ(length_of(still.meshes[0]), kLongestArrow_m);
}

TEST(ImpactArrows, EndWhereTheBlowStruckForAWhile) {
  Still still;
  const Vec3 point_m(0.2, 1.4, 0.1), impulse_N_s(0.0, 0.0, -5.0);
  still.motion.response.impacts = {{.frame = 3, .joint = 0, .point_m = point_m, .impulse_N_s = impulse_N_s}};
  for (const int frame : {2, 3, 6, 7}) {  // at 10 frames a second
    still.list = {}, still.meshes.clear();
    add_impact_arrows(still.frame(frame), still.list, still.meshes);
    ASSERT_EQ(still.count(kImpactColor), frame == 3 || frame == 6 ? 1 : 0) << frame;
    if (still.meshes.empty()) continue;
    const double length_m = length_of(still.meshes[0]);
    EXPECT_NEAR(length_m, 5.0 * kArrow_m_per_N_s, 1e-12);
    EXPECT_LT(glm::distance(still.list.instances[0].world_from_mesh * Vec3(0, length_m, 0), point_m), 1e-12);
    EXPECT_NEAR(along(still.list.instances[0]).z, -1.0, 1e-12);
  }
}

// The patch of the rest posture, in the world.
std::vector<Vec3> patch_of(const Still& still) {
  std::vector<Vec3> corners;
  for (const DrawInstance& instance : still.list.instances)
    if (instance.ghost)
      for (const Vec3& p : still.meshes[at(instance.mesh)].positions_m) corners.push_back(instance.world_from_mesh * p);
  return corners;
}

TEST(BalanceMarks, AreGreenInsideAndRedOutside) {
  for (const double margin_m : {0.05, 0.0, -0.01}) {
    Still still;
    still.motion.response.stances[0].margin_m = margin_m;
    add_balance_marks(still.frame(), still.list, still.meshes);
    EXPECT_EQ(still.count(kBalancedColor), margin_m >= 0.0 ? 2 : 0);
    EXPECT_EQ(still.count(kUnbalancedColor), margin_m >= 0.0 ? 0 : 2);
    const DrawInstance& ball = still.list.instances.back();
    EXPECT_EQ(ball.world_from_mesh.p_m, still.motion.response.stances[0].zmp_m);
    EXPECT_FALSE(ball.ghost);
  }
}

TEST(BalanceMarks, LieUnderTheSolesThatStand) {
  Still both, left;
  left.motion.response.stances[0].standing = 1;
  for (Still* still : {&both, &left}) {
    add_balance_marks(still->frame(), still->list, still->meshes);
    const std::vector<Vec3> corners = patch_of(*still);
    ASSERT_GE(corners.size(), 9U);
    double low_x = 1e9, high_x = -1e9;
    for (const Vec3& p : corners) {
      low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
      EXPECT_NEAR(p.y, 0.004, 1e-3);  // level with the ground, and a little above
    }
    const int leg = still->figure.soles[0].link;
    EXPECT_GT(high_x, still->world[at(leg)].p_m.x);
    EXPECT_EQ(low_x < 0.0, still == &both);
    const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    EXPECT_GT(normal.y, 0.0);  // seen from above
  }
}

TEST(BalanceMarks, AreOnlyThereWhereItStands) {
  for (const Footing footing : {Footing::airborne, Footing::tipping, Footing::fallen}) {
    Still still;
    still.motion.response.stances[0].footing = footing;
    add_balance_marks(still.frame(), still.list, still.meshes);
    EXPECT_TRUE(still.list.instances.empty());
  }
  Still nowhere;
  nowhere.motion.root[0].p_m.x = std::numeric_limits<double>::quiet_NaN();
  nowhere.place_joints();
  add_balance_marks(nowhere.frame(), nowhere.list, nowhere.meshes);
  EXPECT_TRUE(nowhere.list.instances.empty());
}

TEST(BalanceMarks, HaveNoBallFarOutside) {
  for (const double margin_m : {-3.0, -std::numeric_limits<double>::infinity()}) {
    Still still;
    still.motion.response.stances[0].margin_m = margin_m;
    add_balance_marks(still.frame(), still.list, still.meshes);
    ASSERT_EQ(still.list.instances.size(), 1U);
    EXPECT_TRUE(still.list.instances[0].ghost);
    EXPECT_EQ(still.list.instances[0].color, kUnbalancedColor);
  }
}

TEST(Loads, AreBoxesAtTheirPlaces) {
  Still still;
  const LoadDesc load{.slot = "torso", .socket = "back", .position_m = {0.02, 0.1, -0.075}};
  add_loads(std::vector<LoadDesc>{load, {.slot = "torso", .socket = "nowhere"}}, still.character, still.world,
            still.list, still.meshes);
  ASSERT_EQ(still.list.instances.size(), 1U);
  const DrawInstance& box = still.list.instances[0];
  EXPECT_TRUE(box.ghost);
  EXPECT_EQ(box.color, kLoadColor);
  const Rigid socket = world_from_socket(still.character, still.world, still.character.find_socket("torso/back"));
  EXPECT_LT(glm::distance(box.world_from_mesh.p_m, socket * load.position_m), 1e-12);
  Vec3 high(-1e9);
  for (const Vec3& p : still.meshes[at(box.mesh)].positions_m) high = glm::max(high, p);
  EXPECT_LT(glm::distance(high, 0.5 * load.size_m), 1e-12);
}

}  // namespace
}  // namespace contort
