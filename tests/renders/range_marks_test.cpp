// The range drawn around a joint, against where forward kinematics puts the limb at its limits.
#include "renders/range_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/motion/kinematics.h"
#include "renders/response_marks.h"
#include "renders/shots.h"

namespace contort {
namespace {

class Ranged {
 public:
  explicit Ranged(const char* joint) : joint_(character.find_joint(joint)) { place(); }
  const Joint& joint() const { return character.joints()[static_cast<std::size_t>(joint_)]; }
  double* coords() { return &row[static_cast<std::size_t>(joint().coord)]; }
  void place() { forward_kinematics(character, character.rest_root(), row, world); }
  void mark() { add_range_mark(character, joint_, world, row, list, meshes); }
  Vec3 origin() const { return world[static_cast<std::size_t>(joint_)].p_m; }
  Vec3 limb() const { return unit_or(lever_point_m(character, world, joint_) - origin(), Vec3(0)); }
  // The cosine of the least angle between a direction and the corners of a mesh, as seen from the joint.
  double nearest_corner(std::size_t mesh, const Vec3& direction) const {
    double best = -1.0;
    for (const Vec3& corner : meshes[mesh].positions_m)
      if (glm::distance(corner, origin()) > 0.01)
        best = std::max(best, glm::dot(unit_or(corner - origin(), Vec3(0)), direction));
    return best;
  }

  Character character = build_character({}, stock_library()).value();
  std::vector<double> row{character.rest_coords().begin(), character.rest_coords().end()};
  std::vector<Rigid> world = std::vector<Rigid>(character.joints().size());
  DrawList list;
  std::vector<Triangles> meshes;

 private:
  int joint_;
};

TEST(RangeMark, ASectorReachesToBothLimitsAndRedBeyondOne) {
  Ranged knee("leg_left/knee");
  Vec3 at_limit[2];
  for (int i = 0; i < 2; ++i) {
    knee.coords()[0] = i == 0 ? knee.joint().low : knee.joint().high;
    knee.place();
    at_limit[i] = knee.limb();
  }
  knee.coords()[0] = knee.joint().high + 0.3;
  knee.place();
  knee.mark();
  ASSERT_EQ(knee.meshes.size(), 2u);
  EXPECT_TRUE(knee.list.instances[0].ghost && knee.list.instances[0].mark);
  EXPECT_FALSE(knee.list.instances[1].ghost);
  // The limb hardly leans along its axis, so that directions may differ by a degree or two.
  for (const Vec3& limit : at_limit) EXPECT_GT(knee.nearest_corner(0, limit), std::cos(2 * kRadPerDeg));
  EXPECT_LT(knee.nearest_corner(0, knee.limb()), std::cos(10 * kRadPerDeg)) << "not beyond";
  EXPECT_GT(knee.nearest_corner(1, knee.limb()), std::cos(2 * kRadPerDeg)) << "red to where the limb is";
  EXPECT_LT(knee.nearest_corner(1, at_limit[0]), std::cos(10 * kRadPerDeg));
}

TEST(RangeMark, InsideThereIsNothingRed) {
  Ranged knee("leg_left/knee");
  knee.coords()[0] = 0.5 * (knee.joint().low + knee.joint().high);
  knee.place();
  knee.mark();
  EXPECT_EQ(knee.meshes.size(), 1u);
}

// A swing about one of the ellipse's axes, up to its limit, puts the limb on the cone.
TEST(RangeMark, TheConeOfABallIsWhereItsSwingEnds) {
  Ranged shoulder("arm_left/shoulder");
  shoulder.mark();
  ASSERT_EQ(shoulder.meshes.size(), 1u);
  const Joint joint = shoulder.joint();
  const Vec3 other = glm::cross(joint.axis, joint.swing_axis);
  for (const Vec3& swing : {joint.swing_a_rad * joint.swing_axis, -joint.swing_b_rad * other}) {
    const Quat q = joint.swing_center * from_rotation_vector(swing);
    double* c = shoulder.coords();
    c[0] = q.w, c[1] = q.x, c[2] = q.y, c[3] = q.z;
    shoulder.place();
    EXPECT_GT(shoulder.nearest_corner(0, shoulder.limb()), std::cos(4 * kRadPerDeg));
  }
  const Quat middle = joint.swing_center;
  double* c = shoulder.coords();
  c[0] = middle.w, c[1] = middle.x, c[2] = middle.y, c[3] = middle.z;
  shoulder.place();
  EXPECT_LT(shoulder.nearest_corner(0, shoulder.limb()), std::cos(30 * kRadPerDeg)) << "hollow";
}

// Seen along its axis the sector is a sector; from the front a knee's is a line.
TEST(RangeMark, HingesAreLookedAtAlongTheirAxis) {
  Ranged knee("leg_left/knee");
  Motion motion;
  motion.frame_count = 1, motion.coord_count = knee.character.coord_count();
  motion.coords = knee.row, motion.root = {knee.character.rest_root()};
  Finding finding{"joint_range", "leg_left/knee max", "rad", 0, 0, 0, -0.1, 1.0};
  const Story story{knee.character, motion, &finding};
  const std::vector<View> views = views_of_angle(story, 0, probe_views());
  ASSERT_FALSE(views.empty());
  EXPECT_LT(views.size(), probe_views().size());
  for (const View& view : views) EXPECT_GT(std::fabs(towards_eye(view).x), 0.6) << view.azimuth_rad;
  finding.check = "angular_velocity";
  EXPECT_EQ(views_of_angle(story, 0, probe_views()).size(), probe_views().size());
}

TEST(RangeMark, NothingForWhatIsNoNumber) {
  Ranged knee("leg_left/knee");
  knee.coords()[0] = std::numeric_limits<double>::quiet_NaN();
  knee.place();
  knee.mark();
  EXPECT_TRUE(knee.meshes.empty() && knee.list.instances.empty());
}

}  // namespace
}  // namespace contort
