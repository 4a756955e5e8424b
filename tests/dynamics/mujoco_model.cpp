#ifdef CONTORT_HAS_MUJOCO
#include "tests/dynamics/mujoco_model.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace contort::fixtures {

namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  char one[40];
  for (const double value : values) {
    std::snprintf(one, sizeof one, "%.17g ", value);
    text += one;
  }
  return text;
}

std::string at(const char* name, const Vec3& v) {
  return std::string(" ") + name + "=\"" + numbers({v.x, v.y, v.z}) + "\"";
}

const char* type_of(JointKind kind) {
  return kind == JointKind::ball ? "ball" : kind == JointKind::prismatic ? "slide" : "hinge";
}

// A joint without a body of its own turns the next body: its axis and place as that body has them at rest.
std::string joint_text(const Joint& joint, int index, const Rigid& body_from_joint) {
  std::string text = "<joint name=\"j" + std::to_string(index) + "\" type=\"" + type_of(joint.kind) + "\"";
  text += at("pos", body_from_joint.p_m);
  if (joint.kind != JointKind::ball) text += at("axis", body_from_joint.q * joint.axis);
  return text + "/>";
}

std::string inertial_text(const Joint& joint) {
  const Mat3& i = joint.inertia_kg_m2;
  return "<inertial" + at("pos", joint.center_of_mass_m) + " mass=\"" + numbers({joint.mass_kg}) + "\" fullinertia=\"" +
         numbers({i[0][0], i[1][1], i[2][2], i[1][0], i[2][0], i[2][1]}) + "\"/>";
}

std::string placed(const Rigid& at_rest) {
  return at("pos", at_rest.p_m) + " quat=\"" + numbers({at_rest.q.w, at_rest.q.x, at_rest.q.y, at_rest.q.z}) + "\"";
}

struct ShapeText {
  std::string operator()(const Sphere& s) const {
    return "sphere\"" + at("pos", s.center_m) + " size=\"" + numbers({s.radius_m}) + "\"";
  }
  std::string operator()(const Capsule& c) const {
    return "capsule\" fromto=\"" + numbers({c.a_m.x, c.a_m.y, c.a_m.z, c.b_m.x, c.b_m.y, c.b_m.z}) + "\" size=\"" +
           numbers({c.radius_m}) + "\"";
  }
  std::string operator()(const Box& b) const {
    return "box\"" + placed({from_rotation_vector(kRadPerDeg * b.rotation_deg), b.center_m}) + at("size", b.half_m);
  }
  std::string operator()(const ConvexHull&) const { throw std::runtime_error("hulls are not told to MuJoCo"); }
};

std::string shapes_text(const Character& character, int joint) {
  std::string text;
  for (const Collider& collider : character.colliders())
    if (collider.joint == joint) text += "<geom type=\"" + std::visit(ShapeText{}, collider.shape) + "/>";
  return text;
}

std::string body_name(int joint) { return "\"b" + std::to_string(joint) + "\""; }

// Bodies with shapes that are not a judged pair.
std::string excludes_text(const Character& character) {
  const auto bodies = character.bodies();
  const auto judged = [&](int a, int b) {
    return std::ranges::any_of(character.judged_pairs(), [&](const JudgedPair& pair) {
      const int first = bodies[static_cast<std::size_t>(pair.body_a)].joint;
      const int second = bodies[static_cast<std::size_t>(pair.body_b)].joint;
      return std::minmax(first, second) == std::minmax(a, b);
    });
  };
  std::string text;
  for (const Body& a : bodies)
    for (const Body& b : bodies)
      if (a.joint < b.joint && !judged(a.joint, b.joint))
        text += "<exclude body1=" + body_name(a.joint) + " body2=" + body_name(b.joint) + "/>";
  return "<contact>" + text + "</contact>";
}

std::string body_text(const Character& character, int index, const Rigid& parent_from_before,
                      std::vector<std::pair<int, Rigid>> pending, Shapes shapes) {
  const auto joints = character.joints();
  const Joint& joint = joints[static_cast<std::size_t>(index)];
  const Rigid own = parent_from_before * joint.parent_from_joint;
  for (auto& [other, own_from_other] : pending) own_from_other = inverse(joint.parent_from_joint) * own_from_other;
  pending.emplace_back(index, Rigid{});
  const auto children = [&](const Rigid& from, const std::vector<std::pair<int, Rigid>>& carried) {
    std::string text;
    for (std::size_t c = 1; c < joints.size(); ++c)
      if (joints[c].parent == index) text += body_text(character, static_cast<int>(c), from, carried, shapes);
    return text;
  };
  if (joint.mass_kg == 0.0 && index > 0) return children(own, pending);
  std::string text = "<body name=" + body_name(index) + placed(own) + ">";
  if (index == 0) text += "<freejoint name=\"j0\"/>";
  for (const auto& [other, own_from_other] : pending)
    if (other > 0) text += joint_text(joints[static_cast<std::size_t>(other)], other, own_from_other);
  if (shapes == Shapes::colliders) text += shapes_text(character, index);
  return text + inertial_text(joint) + children(Rigid{}, {}) + "</body>\n";
}

}  // namespace

std::string mjcf_of(const Character& character, Shapes shapes) {
  const bool touch = shapes == Shapes::colliders;
  return std::string("<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\"/>") +
         (touch ? "<size nconmax=\"2000\" njmax=\"8000\"/>" : "") + "<option gravity=\"0 -9.81 0\"><flag " +
         (touch ? "" : "contact=\"disable\" constraint=\"disable\" ") + "energy=\"enable\"/></option><worldbody>" +
         body_text(character, 0, Rigid{}, {}, shapes) + "</worldbody>" + (touch ? excludes_text(character) : "") +
         "</mujoco>";
}

MujocoModel::MujocoModel(const Character& character, Shapes shapes) {
  const std::string text = mjcf_of(character, shapes);
  auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  char error[300] = "";
  model_ = mj_loadXML("model.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (model_ == nullptr) throw std::runtime_error(error);
  data_ = mj_makeData(model_);
  for (std::size_t i = 0; i < character.joints().size(); ++i) {
    const int joint = mj_name2id(model_, mjOBJ_JOINT, ("j" + std::to_string(i)).c_str());
    coords_.push_back(joint < 0 ? -1 : model_->jnt_qposadr[joint]);
    dofs_.push_back(joint < 0 ? -1 : model_->jnt_dofadr[joint]);
  }
}

MujocoModel::~MujocoModel() {
  if (data_ != nullptr) mj_deleteData(data_);
  if (model_ != nullptr) mj_deleteModel(model_);
}

std::vector<double> MujocoModel::coords_of(const Multibody& body, const Rigid& root,
                                           std::span<const double> row) const {
  std::vector<double> out(static_cast<std::size_t>(model_->nq));
  const double placed[] = {root.p_m.x, root.p_m.y, root.p_m.z, root.q.w, root.q.x, root.q.y, root.q.z};
  std::copy_n(placed, 7, out.begin() + coords_[0]);
  for (std::size_t i = 1; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    std::copy_n(row.begin() + link.coord, coord_size(link.kind), out.begin() + coords_[i]);
  }
  return out;
}

void MujocoModel::set(const Multibody& body, const DynamicsState& state) {
  std::ranges::copy(coords_of(body, state.root, state.coords), data_->qpos);
  for (std::size_t i = 0; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    std::copy_n(state.velocity.begin() + link.dof, link.dof_count, data_->qvel + dofs_[i]);
    std::copy_n(state.acceleration.begin() + link.dof, link.dof_count, data_->qacc + dofs_[i]);
  }
}

std::vector<double> MujocoModel::ours(const Multibody& body, const mjtNum* theirs) const {
  std::vector<double> out(static_cast<std::size_t>(body.dof_count()));
  for (std::size_t i = 0; i < body.links().size(); ++i)
    std::copy_n(theirs + dofs_[i], body.links()[i].dof_count, out.begin() + body.links()[i].dof);
  return out;
}

std::vector<double> MujocoModel::mass_matrix(const Multibody& body) {
  const auto n = static_cast<std::size_t>(body.dof_count());
  std::vector<double> theirs(n * n), rows(n * n);
  mj_fullM(model_, theirs.data(), data_->qM);
  std::vector<std::size_t> order(n);  // theirs, by ours
  for (std::size_t i = 0; i < body.links().size(); ++i)
    for (int j = 0; j < body.links()[i].dof_count; ++j)
      order[static_cast<std::size_t>(body.links()[i].dof + j)] = static_cast<std::size_t>(dofs_[i] + j);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) rows[i * n + j] = theirs[order[i] * n + order[j]];
  return rows;
}

}  // namespace contort::fixtures
#endif
