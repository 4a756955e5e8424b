// A small good part and a small good object, then one broken copy for each rule.
#include "model/character/part_rules.h"

#include <gtest/gtest.h>

#include <functional>

namespace contort {
namespace {

JointDesc joint_of(const std::string& name, const std::string& parent, JointType type, const Vec3& axis) {
  JointDesc joint;
  joint.name = name;
  joint.parent = parent;
  joint.type = type;
  joint.axis = axis;
  if (type == JointType::prismatic) joint.high_m = 0.1;
  return joint;
}

// Three hinges in a point, an elbow, a slide and a ball; both chains.
PartDesc good_part() {
  PartDesc part;
  part.name = "p", part.kind = "arm";
  part.joints = {joint_of("yaw", "", JointType::hinge, {0, 1, 0}),
                 joint_of("pitch", "yaw", JointType::hinge, {1, 0, 0}),
                 joint_of("roll", "pitch", JointType::hinge, {0, 0, 1}),
                 joint_of("elbow", "roll", JointType::hinge, {1, 0, 0}),
                 joint_of("slide", "elbow", JointType::prismatic, {0, 1, 0}),
                 joint_of("wrist", "slide", JointType::ball, {0, 1, 0})};
  part.colliders = {{"a", "elbow", Sphere{}}, {"b", "", Box{}}};
  part.mesh = {{"wrist", TriangleMesh{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {0, 1, 2}}, Vec3(0.5)}};
  part.sockets = {{"tip", "wrist", Vec3(0), Vec3(0)}, {"base", "", Vec3(0), Vec3(0)}};
  part.reach = {{"yaw", "elbow", "tip"}};
  part.facing = {{{"yaw", "pitch"}, "tip"}};
  return part;
}

ObjectDesc good_object() {
  ObjectDesc object;
  object.name = "o";
  object.colliders = {{"a", "", Sphere{}}, {"b", "", Box{}}};
  object.mesh = {{"", TriangleMesh{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {0, 1, 2}}, Vec3(0.5)}};
  object.points = {{"muzzle", "", Vec3(0), Vec3(0)}, {"grip", "", Vec3(0), Vec3(0)}};
  return object;
}

template <class T>
struct Broken {
  const char* name;
  std::function<void(T&)> change;
  const char* code;
  const char* pointer;
};

TriangleMesh& triangles(MeshDesc& piece) { return std::get<TriangleMesh>(piece.shape); }

const Broken<PartDesc> kBrokenParts[] = {
    {"two joints of one name",
     [](PartDesc& p) { p.joints[5].name = "slide", p.sockets[0].joint = "slide", p.mesh.clear(); },
     "part.duplicate_name", "/joints/5/name"},
    {"two colliders of one name", [](PartDesc& p) { p.colliders[1].name = "a"; }, "part.duplicate_name",
     "/colliders/1/name"},
    {"two sockets of one name", [](PartDesc& p) { p.sockets[1].name = "tip"; }, "part.duplicate_name",
     "/sockets/1/name"},
    {"a parent that is not there", [](PartDesc& p) { p.joints[3].parent = "none"; }, "part.unknown_joint",
     "/joints/3/parent"},
    {"a parent that comes later", [](PartDesc& p) { p.joints[3].parent = "wrist"; }, "part.unknown_joint",
     "/joints/3/parent"},
    {"a joint that is its own parent", [](PartDesc& p) { p.joints[0].parent = "yaw"; }, "part.unknown_joint",
     "/joints/0/parent"},
    {"a collider on no joint", [](PartDesc& p) { p.colliders[0].joint = "none"; }, "part.unknown_joint",
     "/colliders/0/joint"},
    {"a mesh on no joint", [](PartDesc& p) { p.mesh[0].joint = "none"; }, "part.unknown_joint", "/mesh/0/joint"},
    {"a socket on no joint", [](PartDesc& p) { p.sockets[1].joint = "none"; }, "part.unknown_joint",
     "/sockets/1/joint"},
    {"a long axis", [](PartDesc& p) { p.joints[1].axis = Vec3(1.001, 0, 0); }, "part.bad_axis", "/joints/1/axis"},
    {"no axis", [](PartDesc& p) { p.joints[4].axis = Vec3(0); }, "part.bad_axis", "/joints/4/axis"},
    {"a long swing axis", [](PartDesc& p) { p.joints[5].swing_axis = Vec3(0.9, 0, 0); }, "part.bad_axis",
     "/joints/5/swing_axis"},
    {"a swing axis along the twist axis", [](PartDesc& p) { p.joints[5].swing_axis = Vec3(0, 1, 0); }, "part.bad_axis",
     "/joints/5/swing_axis"},
    {"a range above rest", [](PartDesc& p) { p.joints[0].low_deg = 1; }, "part.bad_range", "/joints/0/low_deg"},
    {"a range below rest", [](PartDesc& p) { p.joints[0].high_deg = -1; }, "part.bad_range", "/joints/0/low_deg"},
    {"an empty range", [](PartDesc& p) { p.joints[0].low_deg = p.joints[0].high_deg = 0; }, "part.bad_range",
     "/joints/0/low_deg"},
    {"an empty travel", [](PartDesc& p) { p.joints[4].high_m = 0; }, "part.bad_range", "/joints/4/low_m"},
    {"a hinge that travels", [](PartDesc& p) { p.joints[3].high_m = 1; }, "part.other_type", "/joints/3/low_m"},
    {"a slide that turns", [](PartDesc& p) { p.joints[4].max_speed_deg_s = 1; }, "part.other_type",
     "/joints/4/low_deg"},
    {"a hinge that swings",
     [](PartDesc& p) {
       p.joints[3].swing_deg = {1, 1};
     },
     "part.other_type", "/joints/3/swing_deg"},
    {"an index beyond the vertices", [](PartDesc& p) { triangles(p.mesh[0]).indices[2] = 3; }, "part.bad_shape",
     "/mesh/0/shape/indices"},
    {"a negative index", [](PartDesc& p) { triangles(p.mesh[0]).indices[2] = -1; }, "part.bad_shape",
     "/mesh/0/shape/indices"},
    {"a hull of three points",
     [](PartDesc& p) {
       p.colliders[1].shape = ConvexHull{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}};
     },
     "part.bad_shape", "/colliders/1/shape/points_m"},
    {"a flat hull",
     [](PartDesc& p) {
       p.mesh[0].shape = ConvexHull{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}};
     },
     "part.bad_shape", "/mesh/0/shape/points_m"},
    {"half a triangle", [](PartDesc& p) { triangles(p.mesh[0]).indices.pop_back(); }, "part.bad_shape",
     "/mesh/0/shape/indices"},
    {"a chain from no joint", [](PartDesc& p) { p.reach[0].upper = "none"; }, "part.unknown_joint", "/reach/0/upper"},
    {"a chain over no joint", [](PartDesc& p) { p.reach[0].middle = "none"; }, "part.unknown_joint", "/reach/0/middle"},
    {"a chain to no socket", [](PartDesc& p) { p.reach[0].tip = "none"; }, "part.unknown_socket", "/reach/0/tip"},
    {"a chain from one hinge", [](PartDesc& p) { p.reach[0].upper = "elbow"; }, "part.bad_reach", "/reach/0/upper"},
    {"a chain from the last joint", [](PartDesc& p) { p.reach[0].upper = "slide"; }, "part.bad_reach",
     "/reach/0/upper"},
    {"hinges that are not at right angles", [](PartDesc& p) { p.joints[2].axis = Vec3(0.6, 0, 0.8); }, "part.bad_reach",
     "/reach/0/upper"},
    {"hinges that are not in one point", [](PartDesc& p) { p.joints[1].position_m = Vec3(0, 0.1, 0); },
     "part.bad_reach", "/reach/0/upper"},
    {"a middle joint that is no hinge", [](PartDesc& p) { p.reach[0].middle = "slide"; }, "part.bad_reach",
     "/reach/0/middle"},
    {"a middle joint elsewhere", [](PartDesc& p) { p.reach[0].middle = "pitch"; }, "part.bad_reach", "/reach/0/middle"},
    {"a tip that the middle joint does not move", [](PartDesc& p) { p.reach[0].tip = "base"; }, "part.bad_reach",
     "/reach/0/tip"},
    {"facing with no joint of the part", [](PartDesc& p) { p.facing[0].joints = {"none"}; }, "part.unknown_joint",
     "/facing/0/joints"},
    {"facing without joints", [](PartDesc& p) { p.facing[0].joints = {}; }, "part.bad_facing", "/facing/0/joints"},
    {"facing with a slide", [](PartDesc& p) { p.facing[0].joints = {"slide"}; }, "part.bad_facing", "/facing/0/joints"},
    {"facing from the tip inward",
     [](PartDesc& p) {
       p.facing[0].joints = {"pitch", "yaw"};
     },
     "part.bad_facing", "/facing/0/joints"},
    {"facing with one joint twice",
     [](PartDesc& p) {
       p.facing[0].joints = {"yaw", "yaw"};
     },
     "part.bad_facing", "/facing/0/joints"},
    {"facing with no socket", [](PartDesc& p) { p.facing[0].socket = "none"; }, "part.unknown_socket",
     "/facing/0/socket"},
    {"facing with a socket that stays", [](PartDesc& p) { p.facing[0].socket = "base"; }, "part.bad_facing",
     "/facing/0/socket"},
};

const Broken<ObjectDesc> kBrokenObjects[] = {
    {"two colliders of one name", [](ObjectDesc& o) { o.colliders[1].name = "a"; }, "object.duplicate_name",
     "/colliders/1/name"},
    {"two points of one name", [](ObjectDesc& o) { o.points[1].name = "muzzle"; }, "object.duplicate_name",
     "/points/1/name"},
    {"a collider on a joint", [](ObjectDesc& o) { o.colliders[0].joint = "j"; }, "object.unknown_joint",
     "/colliders/0/joint"},
    {"a mesh on a joint", [](ObjectDesc& o) { o.mesh[0].joint = "j"; }, "object.unknown_joint", "/mesh/0/joint"},
    {"a point on a joint", [](ObjectDesc& o) { o.points[0].joint = "j"; }, "object.unknown_joint", "/points/0/joint"},
    {"a hull of too many points",
     [](ObjectDesc& o) { o.colliders[0].shape = ConvexHull{std::vector<Vec3>(kMaxHullPoints + 1, Vec3(1))}; },
     "object.bad_shape", "/colliders/0/shape/points_m"},
    {"an index beyond the vertices", [](ObjectDesc& o) { triangles(o.mesh[0]).indices[1] = 99999; }, "object.bad_shape",
     "/mesh/0/shape/indices"},
};

TEST(PartRules, TheGoodOnesAreGood) {
  EXPECT_TRUE(check_part(good_part()).ok());
  EXPECT_TRUE(check_object(good_object()).ok());
}

TEST(PartRules, EachBrokenPartIsRefusedForItsRule) {
  for (const Broken<PartDesc>& broken : kBrokenParts) {
    PartDesc part = good_part();
    broken.change(part);
    const Result<Done> checked = check_part(part);
    ASSERT_FALSE(checked.ok()) << broken.name;
    EXPECT_EQ(checked.issue().code, broken.code) << broken.name;
    EXPECT_EQ(checked.issue().pointer, broken.pointer) << broken.name;
  }
}

TEST(PartRules, EachBrokenObjectIsRefusedForItsRule) {
  for (const Broken<ObjectDesc>& broken : kBrokenObjects) {
    ObjectDesc object = good_object();
    broken.change(object);
    const Result<Done> checked = check_object(object);
    ASSERT_FALSE(checked.ok()) << broken.name;
    EXPECT_EQ(checked.issue().code, broken.code) << broken.name;
    EXPECT_EQ(checked.issue().pointer, broken.pointer) << broken.name;
  }
}

TEST(PartRules, LimitsOfARangeMayTouchRest) {
  PartDesc part = good_part();
  part.joints[3].low_deg = 0;
  part.joints[4].low_m = -0.1, part.joints[4].high_m = 0;
  EXPECT_TRUE(check_part(part).ok());
}

}  // namespace
}  // namespace contort
