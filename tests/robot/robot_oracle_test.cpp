// Robots that are drawn at random, read by us and by the libraries of their formats: urdfdom and MuJoCo.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "formats/robot/mjcf.h"
#include "formats/robot/urdf.h"
#include "import/robot.h"
#include "model/motion/kinematics.h"
#include "tests/corpus/temp_folder.h"
#include "tests/robot/robot_text.h"

#ifdef CONTORT_HAS_URDFDOM
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
#endif
#ifdef CONTORT_HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace contort {
namespace {

using fixtures::Draw;
using fixtures::number;

#ifdef CONTORT_HAS_URDFDOM

std::string drawn_link(Draw& draw, int index) {
  return "<link name=\"l" + std::to_string(index) + "\"><inertial><origin xyz=\"" + draw.vector(-1, 1) + "\" rpy=\"" +
         draw.vector(-2, 2) + "\"/><mass value=\"" + number(draw.between(0.1, 9)) +
         "\"/><inertia ixx=\"2\" iyy=\"3\" izz=\"4\" ixy=\"0.1\" ixz=\"0.2\" iyz=\"0.3\"/></inertial></link>";
}

std::string drawn_urdf_joint(Draw& draw, int child, int parent) {
  const char* kTypes[] = {"revolute", "prismatic", "continuous", "fixed"};
  const std::string name = std::to_string(child);
  std::string text = "<joint name=\"j" + name + "\" type=\"" + kTypes[draw.whole(0, 3)] + "\"><parent link=\"l" +
                     std::to_string(parent) + "\"/><child link=\"l" + name + "\"/><origin xyz=\"" + draw.vector(-1, 1) +
                     "\" rpy=\"" + draw.vector(-3, 3) + "\"/><axis xyz=\"";
  text += draw.whole(0, 1) == 0 ? "0 -1 0" : "0.6 0 0.8";
  text += "\"/><limit lower=\"" + number(draw.between(-3, 0)) + "\" upper=\"" + number(draw.between(0, 3)) +
          "\" velocity=\"" + number(draw.between(0, 9)) + "\" effort=\"" + number(draw.between(0, 99)) + "\"/>";
  if (child > 2 && draw.whole(0, 3) == 0) text += R"(<mimic joint="j1" multiplier="-0.5" offset="0.25"/>)";
  return text + "</joint>";
}

std::string drawn_urdf() {
  Draw draw;
  std::string text = "<robot name=\"r\">" + drawn_link(draw, 0);
  const int links = draw.whole(1, 8);
  for (int i = 1; i < links; ++i) text += drawn_link(draw, i) + drawn_urdf_joint(draw, i, draw.whole(0, i - 1));
  return text + "</robot>";
}

void expect_same_joint(const urdf::Joint& theirs, const RobotBody& body) {
  const urdf::Vector3& p = theirs.parent_to_joint_origin_transform.position;
  RC_ASSERT(body.parent_from_body.p_m == Vec3(p.x, p.y, p.z));
  double q[4];
  theirs.parent_to_joint_origin_transform.rotation.getQuaternion(q[0], q[1], q[2], q[3]);
  RC_ASSERT(std::fabs(glm::dot(body.parent_from_body.q, Quat(q[3], q[0], q[1], q[2]))) > 1.0 - 1e-12);
  RC_ASSERT(body.joints.empty() == (theirs.type == urdf::Joint::FIXED));
  if (body.joints.empty()) return;
  const RobotJoint& ours = body.joints[0];
  RC_ASSERT((ours.kind == RobotJointKind::travel) == (theirs.type == urdf::Joint::PRISMATIC));
  RC_ASSERT(ours.greatest_speed == theirs.limits->velocity);
  RC_ASSERT(ours.greatest_effort == theirs.limits->effort);
  RC_ASSERT(glm::distance(ours.axis, Vec3(theirs.axis.x, theirs.axis.y, theirs.axis.z)) < 1e-12);
  if (theirs.type != urdf::Joint::CONTINUOUS) {
    RC_ASSERT(ours.low == theirs.limits->lower);
    RC_ASSERT(ours.high == theirs.limits->upper);
  }
  RC_ASSERT(ours.follows == (theirs.mimic ? theirs.mimic->joint_name : ""));
  if (theirs.mimic) RC_ASSERT(ours.multiplier == theirs.mimic->multiplier && ours.offset == theirs.mimic->offset);
}

RC_GTEST_PROP(RobotOracle, UrdfdomReadsTheSameTreeLimitsAndMasses, ()) {
  const std::string text = drawn_urdf();
  const Result<RobotModel> ours = parse_urdf(text);
  RC_ASSERT(ours.ok());
  const urdf::ModelInterfaceSharedPtr theirs = urdf::parseURDF(text);
  RC_ASSERT(theirs != nullptr);
  RC_ASSERT(ours->bodies.size() == theirs->links_.size());
  RC_ASSERT(ours->bodies[0].name == theirs->getRoot()->name);
  for (const RobotBody& body : ours->bodies) {
    const urdf::LinkConstSharedPtr link = theirs->getLink(body.name);
    RC_ASSERT(body.inertia.mass_kg == link->inertial->mass);
    RC_ASSERT((body.parent < 0) == (link->parent_joint == nullptr));
    if (body.parent < 0) continue;
    RC_ASSERT(ours->bodies[static_cast<std::size_t>(body.parent)].name == link->parent_joint->parent_link_name);
    expect_same_joint(*link->parent_joint, body);
  }
}

#else
TEST(RobotOracle, UrdfdomReadsTheSameTreeLimitsAndMasses) { GTEST_SKIP() << "liburdfdom-dev is not installed"; }
#endif

#ifdef CONTORT_HAS_MUJOCO

struct DrawnMjcf {
  std::string text;
  int bodies = 0;
};

std::string drawn_turn(Draw& draw) {
  switch (draw.whole(0, 5)) {
    case 0: return " euler=\"" + draw.vector(-90, 90) + "\"";
    case 1: return " quat=\"1 " + draw.vector(-1, 1) + "\"";
    case 2: return " axisangle=\"1 2 2 " + number(draw.between(-90, 90)) + "\"";
    case 3: return " xyaxes=\"1 " + number(draw.between(-1, 1)) + " 0 0 1 " + number(draw.between(-1, 1)) + "\"";
    case 4: return " zaxis=\"" + number(draw.between(-1, 1)) + " 0 1\"";
    default: return "";
  }
}

std::string drawn_geom(Draw& draw) {
  const std::string places = " pos=\"" + draw.vector(-0.3, 0.3) + "\"" + drawn_turn(draw);
  const std::string groups = draw.whole(0, 2) > 0 ? ""
                                                  : " contype=\"" + number(draw.whole(0, 3)) + "\" conaffinity=\"" +
                                                        number(draw.whole(0, 3)) + "\"";
  std::string text = "<geom" + groups + (draw.whole(0, 1) == 0 ? " density=\"0.5\"" : "");
  switch (draw.whole(0, 4)) {
    case 0: return text + " size=\"5\"" + places + "/>";
    case 1: return text + " type=\"capsule\" size=\"4 1\"" + places + "/>";
    case 2: return text + " type=\"capsule\" size=\"4\" fromto=\"0 0 0 " + draw.vector(0.1, 1) + "\"/>";
    case 3: return text + " type=\"box\" size=\"4 5 6\"" + places + "/>";
    default: return text + " type=\"ellipsoid\" size=\"4 5 6\"" + places + "/>";
  }
}

std::string drawn_joint(Draw& draw, const std::string& name, bool is_last) {
  const int type = draw.whole(is_last ? 0 : 1, 4);  // MuJoCo has no hinge after a ball
  std::string text = "<joint name=\"" + name + "\" pos=\"" + draw.vector(-0.3, 0.3) + "\"";
  if (type == 0) return text + " type=\"ball\" limited=\"true\" range=\"0 2\"/>";
  text += " axis=\"" + draw.vector(0.1, 1) + "\"";
  if (type == 1) text += " type=\"slide\"";
  if (type == 2) return text + " class=\"knee\"/>";
  const double low = draw.between(-1, 0.5);  // MuJoCo 2.2 requires `limited` with a range
  return text + " limited=\"true\" range=\"" + number(low) + " " + number(low + 0.5) + "\"/>";
}

// Bodies within bodies, so large that all shapes overlap.
void add_drawn_body(Draw& draw, int depth, DrawnMjcf& out) {
  const std::string name = std::to_string(out.bodies++);
  out.text += "<body name=\"b" + name + "\" pos=\"" + draw.vector(-0.5, 0.5) + "\"" + drawn_turn(draw);
  out.text += draw.whole(0, 2) == 0 ? " childclass=\"limb\">" : ">";
  if (depth == 0) out.text += "<freejoint/>";
  const int joints = depth == 0 ? 0 : draw.whole(0, 2);
  for (int j = 0; j < joints; ++j) out.text += drawn_joint(draw, "j" + name + "_" + std::to_string(j), j + 1 == joints);
  for (int g = draw.whole(1, 2); g > 0; --g) out.text += drawn_geom(draw);
  if (draw.whole(0, 2) == 0)
    out.text += "<inertial pos=\"" + draw.vector(-1, 1) + "\"" + drawn_turn(draw) + " mass=\"" +
                number(draw.between(1, 9)) + "\" diaginertia=\"2 3 4\"/>";
  for (int c = draw.whole(0, 2); c > 0 && out.bodies < 7; --c) add_drawn_body(draw, depth + 1, out);
  out.text += "</body>";
}

DrawnMjcf drawn_mjcf() {
  Draw draw;
  DrawnMjcf out;
  out.text = std::string("<mujoco><compiler angle=\"") + (draw.whole(0, 1) == 0 ? "radian" : "degree") +
             "\" eulerseq=\"" + (draw.whole(0, 1) == 0 ? "zYx" : "XYZ") + "\"/><size nconmax=\"500\" njmax=\"10\"/>" +
             "<default><geom density=\"1\"/><joint axis=\"0 1 0\"/><default class=\"knee\"><joint limited=\"true\" "
             "range=\"0 2\"/></default>"
             "<default class=\"limb\"><geom density=\"0.7\"/><joint limited=\"true\" range=\"-0.5 0.25\"/></default>"
             "</default><worldbody>";
  add_drawn_body(draw, 0, out);
  out.text += "</worldbody><contact>";
  for (int i = 0; i < 2 && out.bodies > 2; ++i) {
    const int a = draw.whole(0, out.bodies - 2);
    out.text += "<exclude body1=\"b" + std::to_string(a) + "\" body2=\"b" +
                std::to_string(draw.whole(a + 1, out.bodies - 1)) + "\"/>";
  }
  out.text += "</contact></mujoco>";
  return out;
}

struct MujocoRobot {
  mjModel* model = nullptr;
  mjData* data = nullptr;
  explicit MujocoRobot(const std::string& text) {
    const TempFolder folder;
    const std::string path = folder.path() + "/robot.xml";
    std::ofstream(path) << text;
    char error[1000] = "";
    model = mj_loadXML(path.c_str(), nullptr, error, sizeof error);
    if (model == nullptr) throw std::runtime_error(error);
    data = mj_makeData(model);
  }
  MujocoRobot(const MujocoRobot&) = delete;
  ~MujocoRobot() { mj_deleteData(data), mj_deleteModel(model); }
  std::string body_of_geom(int geom) const { return mj_id2name(model, mjOBJ_BODY, model->geom_bodyid[geom]); }
};

// A robot's axes in a character's.
Vec3 as_character(const mjtNum* v) { return {v[1], v[2], v[0]}; }

// Draws values for all joints, for MuJoCo and for the character.
std::vector<double> drawn_pose(Draw& draw, const ImportedRobot& robot, const Character& character,
                               MujocoRobot& theirs) {
  std::vector<double> coords(character.rest_coords().begin(), character.rest_coords().end());
  mj_resetData(theirs.model, theirs.data);
  for (int i = 3; i < 7; ++i) theirs.data->qpos[i] = i == 3 ? 1.0 : 0.0;
  for (const RobotJointReport& report : robot.joints) {
    const Joint& joint = character.joint(character.find_joint(report.joint));
    mjtNum* value =
        theirs.data->qpos + theirs.model->jnt_qposadr[mj_name2id(theirs.model, mjOBJ_JOINT, report.file_name.c_str())];
    double* own = &coords[static_cast<std::size_t>(joint.coord)];
    if (joint.kind != JointKind::ball) {
      *own = draw.between(-1, 1);
      *value = report.rest + *own;
      continue;
    }
    const Quat q = from_rotation_vector(Vec3(draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)));
    own[0] = value[0] = q.w;
    own[1] = q.x, own[2] = q.y, own[3] = q.z;
    value[1] = q.z, value[2] = q.x, value[3] = q.y;
  }
  return coords;
}

RC_GTEST_PROP(RobotOracle, MujocoPutsEachJointInTheSamePlace, ()) {
  const DrawnMjcf drawn = drawn_mjcf();
  MujocoRobot theirs(drawn.text);
  const Result<RobotModel> read = parse_mjcf(drawn.text, [](const std::string&) { return Issue{}; });
  if (!read) RC_FAIL(to_line(read.issue()));
  const Result<ImportedRobot> robot = import_robot(*read, "r");
  if (!robot) RC_FAIL(to_line(robot.issue()));
  const Character character = *fixtures::character_of(*robot);
  Draw draw;
  const std::vector<double> coords = drawn_pose(draw, *robot, character, theirs);
  mju_copy4(theirs.data->qpos + 3, theirs.model->body_quat + 4);  // of the free root, which has the file's pose
  mju_zero3(theirs.data->qpos);
  mj_kinematics(theirs.model, theirs.data);
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, Rigid{}, coords, world);
  for (const RobotJointReport& report : robot->joints) {
    const int joint = character.find_joint(report.joint);
    const int other = mj_name2id(theirs.model, mjOBJ_JOINT, report.file_name.c_str());
    const Rigid& placed = world[static_cast<std::size_t>(joint)];
    if (character.joint(joint).kind != JointKind::prismatic)
      RC_ASSERT(glm::distance(placed.p_m, as_character(theirs.data->xanchor + 3 * other)) < 1e-9);
    if (character.joint(joint).kind != JointKind::ball)
      RC_ASSERT(glm::distance(placed.q * character.joint(joint).axis, as_character(theirs.data->xaxis + 3 * other)) <
                1e-9);
  }
}

RC_GTEST_PROP(RobotOracle, MujocoReadsTheSameLimitsAndMasses, ()) {
  const DrawnMjcf drawn = drawn_mjcf();
  const MujocoRobot theirs(drawn.text);
  const Result<RobotModel> robot = parse_mjcf(drawn.text, [](const std::string&) { return Issue{}; });
  if (!robot) RC_FAIL(to_line(robot.issue()));
  for (const RobotBody& body : robot->bodies) {
    const int id = mj_name2id(theirs.model, mjOBJ_BODY, body.name.c_str());
    RC_ASSERT(std::fabs(body.inertia.mass_kg - theirs.model->body_mass[id]) < 1e-9 * body.inertia.mass_kg);
    const mjtNum* own = theirs.model->body_inertia + 3 * id;
    const Mat3& tensor = body.inertia.inertia_kg_m2;
    const double trace = tensor[0][0] + tensor[1][1] + tensor[2][2];
    RC_ASSERT(std::fabs(trace - own[0] - own[1] - own[2]) < 1e-9 * trace);
    for (const RobotJoint& joint : body.joints) {
      const int j = mj_name2id(theirs.model, mjOBJ_JOINT, joint.name.c_str());
      RC_ASSERT((joint.high != kNoLimit) == (theirs.model->jnt_limited[j] != 0));
      if (joint.high == kNoLimit) continue;
      if (joint.kind != RobotJointKind::ball) RC_ASSERT(std::fabs(joint.low - theirs.model->jnt_range[2 * j]) < 1e-12);
      RC_ASSERT(std::fabs(joint.high - theirs.model->jnt_range[2 * j + 1]) < 1e-12);
    }
  }
}

using BodyPairs = std::set<std::pair<std::string, std::string>>;

std::pair<std::string, std::string> sorted_pair(const std::string& a, const std::string& b) {
  return {std::min(a, b), std::max(a, b)};
}

// The bodies of pairs that the character judges, or lets touch only because they always do.
BodyPairs pairs_of(const ImportedRobot& robot) {
  const Character character = *fixtures::character_of(robot);
  const auto body_of = [](const std::string& collider) {
    const std::string name = collider.substr(collider.find('/') + 1);
    return name.substr(0, name.find('_'));  // "b3_2" is the second shape of body b3
  };
  BodyPairs out;
  for (const ColliderPair& pair : character.judged_colliders())
    out.insert(sorted_pair(body_of(character.colliders()[static_cast<std::size_t>(pair.a)].name),
                           body_of(character.colliders()[static_cast<std::size_t>(pair.b)].name)));
  for (const AllowedPairDesc& pair : robot.character.allowed_pairs)
    if (!pair.reason.starts_with("MJCF: ")) out.insert(sorted_pair(body_of(pair.a), body_of(pair.b)));
  return out;
}

RC_GTEST_PROP(RobotOracle, MujocoLetsTheSamePairsTouch, ()) {
  const DrawnMjcf drawn = drawn_mjcf();
  MujocoRobot theirs(drawn.text);
  const Result<RobotModel> read = parse_mjcf(drawn.text, [](const std::string&) { return Issue{}; });
  if (!read) RC_FAIL(to_line(read.issue()));
  const Result<ImportedRobot> robot = import_robot(*read, "r");
  if (!robot) RC_FAIL(to_line(robot.issue()));
  mj_kinematics(theirs.model, theirs.data);
  mj_comPos(theirs.model, theirs.data);
  mj_collision(theirs.model, theirs.data);
  BodyPairs touching;
  for (int i = 0; i < theirs.data->ncon; ++i)
    touching.insert(sorted_pair(theirs.body_of_geom(theirs.data->contact[i].geom1),
                                theirs.body_of_geom(theirs.data->contact[i].geom2)));
  RC_ASSERT(pairs_of(*robot) == touching);
}

#else
TEST(RobotOracle, MujocoAgrees) { GTEST_SKIP() << "libmujoco-dev is not installed"; }
#endif

}  // namespace
}  // namespace contort
