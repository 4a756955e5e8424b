#include "import/parts.h"

#include <algorithm>
#include <limits>
#include <set>

#include "import/names.h"
#include "import/roles.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kMaxSpeed_deg_s = 3000.0;     // as in `contort check` for unknown joints
constexpr std::size_t kMostColliders = 64;     // greatest number of a part
constexpr std::size_t kMostTriangles = 33000;  // greatest number of a piece of mesh: 100000 vertices

Vec3 rounded(const Vec3& v, double steps) {
  return {on_lattice(v.x, steps), on_lattice(v.y, steps), on_lattice(v.z, steps)};
}
double rounded_up(double value, double steps) { return std::ceil(value * steps) / steps; }

// Names joints by their roles, so that actions of files fit all arms; "" for other roles.
std::string role_name(BoneRole role) {
  switch (role) {
    case BoneRole::upper_arm: return "shoulder";
    case BoneRole::forearm: return "elbow";
    case BoneRole::hand: return "wrist";
    case BoneRole::thigh: return "hip";
    case BoneRole::shank: return "knee";
    case BoneRole::foot: return "ankle";
    default: return "";
  }
}

// The strength as a fraction of the figure's weight times its height, from the stock human, where 1 is 1247 N m.
double strength_share(BoneRole role) {
  switch (role) {
    case BoneRole::thigh: return 0.2;
    case BoneRole::shank:
    case BoneRole::hock: return 0.18;
    case BoneRole::spine: return 0.25;
    case BoneRole::foot:
    case BoneRole::upper_arm:
    case BoneRole::clavicle: return 0.1;
    case BoneRole::forearm: return 0.06;
    case BoneRole::neck:
    case BoneRole::head: return 0.04;
    case BoneRole::hand: return 0.015;
    case BoneRole::toe: return 0.02;
    case BoneRole::finger: return 0.005;
    default: return 0.05;
  }
}

ColliderShape tidy(ColliderShape shape) {
  constexpr double kSteps = 1e4;  // 0.1 mm
  if (auto* c = std::get_if<Capsule>(&shape)) {
    c->a_m = rounded(c->a_m, kSteps), c->b_m = rounded(c->b_m, kSteps);
    c->radius_m = std::max(on_lattice(c->radius_m, kSteps), 1e-3);
  }
  if (auto* b = std::get_if<Box>(&shape)) {
    b->center_m = rounded(b->center_m, kSteps);
    b->half_m = glm::max(rounded(b->half_m, kSteps), Vec3(1e-3));
  }
  return shape;
}

// The figure in which parts are described: the figure itself, or its mirror image for parts on the right.
struct Seen {
  RiggedFigure figure;
  ClipPoses poses;
  std::vector<BoneBody> bodies;
};

class PartWriter {
 public:
  PartWriter(const Seen& seen, const std::vector<PartPlan>& plans, std::size_t plan, double torque_Nm,
             BoneReport* reports)
      : seen_(seen),
        figure_(seen.figure),
        plans_(plans),
        plan_(plans[plan]),
        torque_Nm_(torque_Nm),
        reports_(reports),
        first_in_joints_(plan == 0 ? 1 : 0),
        index_(static_cast<int>(plan)) {}

  PartDesc write(const std::string& name, const std::vector<TriangleMesh>& meshes) {
    out_.name = name;
    out_.kind = plan_.kind;
    out_.color = color();
    joint_of_.assign(figure_.bones.size(), "");
    if (index_ == 0) set_fixed_body();
    for (std::size_t i = first_in_joints_; i < plan_.bones.size(); ++i) add_bone(plan_.bones[i]);
    for (const int bone : plan_.bones) add_colliders(bone);
    if (!meshes.empty())
      for (const int bone : plan_.bones) add_mesh(bone, meshes[at(bone)]);
    for (std::size_t p = 0; p < plans_.size(); ++p)
      if (plans_[p].carrier == index_) add_dock(plans_[p]);
    add_reach();
    add_facing();
    add_sole();
    add_grip();
    return std::move(out_);
  }

 private:
  const Bone& bone(int index) const { return bone_at(figure_, index); }
  const BoneBody& body(int index) const { return seen_.bodies[at(index)]; }

  Vec3 color() const {
    if (plan_.kind == "head" || plan_.kind == "hand") return {0.58, 0.34, 0.23};
    if (plan_.kind == "leg" || plan_.kind == "waist" || plan_.kind == "body") return {0.05, 0.07, 0.16};
    if (plan_.kind == "foot" || plan_.kind == "tail") return {0.12, 0.1, 0.1};
    return {0.07, 0.27, 0.36};
  }

  void set_fixed_body() {
    const BodyInertia& inertia = body(0).inertia;
    out_.fixed_mass_kg = inertia.mass_kg;
    out_.fixed_center_of_mass_m = rounded(inertia.center_m, 1e5);
    for (int i = 0; i < 3; ++i) out_.fixed_inertia_kg_m2[i] = std::min(inertia.inertia_kg_m2[i][i], 1e6);
  }

  std::string claim(std::string wanted) { return claim_name(std::move(wanted), taken_); }

  JointDesc plain_joint(const BoneJoint& limits, int index) {
    JointDesc joint;
    joint.type = limits.type;
    joint.axis = limits.axis;
    joint.low_deg = limits.low_deg, joint.high_deg = limits.high_deg;
    if (limits.type == JointType::ball) {
      joint.swing_axis = limits.swing_axis;
      joint.swing_deg = limits.swing_deg;
      joint.swing_center_deg = limits.swing_center_deg;
    }
    joint.max_speed_deg_s = kMaxSpeed_deg_s;
    const double strength = std::clamp(rounded_up(torque_Nm_ * strength_share(bone(index).role), 100.0), 0.01, 1e7);
    joint.strength_low = -strength, joint.strength_high = strength;
    return joint;
  }

  void add_bone(int index) {
    const Bone& own = bone(index);
    const BoneJoint limits = joint_of(figure_, index, seen_.poses.turns[at(index)]);
    const std::string plain = role_name(own.role).empty() ? own.name : role_name(own.role);
    JointDesc joint = plain_joint(limits, index);
    const bool docks = index == plan_.bones.front();
    joint.name = claim(limits.is_pair ? plain + "_flex" : plain);
    joint.parent = docks ? "" : joint_of_[at(own.parent)];
    joint.position_m = docks ? Vec3(0.0) : rounded(own.position_m - bone(own.parent).position_m, 1e5);
    reports_[index] = {plan_.slot + "/" + joint.name, "", limits};
    if (limits.is_pair) {
      out_.joints.push_back(joint);
      joint.parent = joint.name;
      joint.name = claim(plain + "_inv");
      joint.position_m = Vec3(0.0);
      joint.axis = limits.second_axis;
      joint.low_deg = limits.second_low_deg, joint.high_deg = limits.second_high_deg;
    }
    if (joint.name != own.name) joint.body = own.name;
    const BodyInertia& inertia = body(index).inertia;
    joint.mass_kg = inertia.mass_kg;
    joint.center_of_mass_m = rounded(inertia.center_m, 1e5);
    for (int i = 0; i < 3; ++i) joint.inertia_kg_m2[i] = std::min(inertia.inertia_kg_m2[i][i], 1e6);
    joint_of_[at(index)] = joint.name;
    reports_[index].carries = plan_.slot + "/" + joint.name;
    out_.joints.push_back(std::move(joint));
  }

  void add_colliders(int index) {
    const std::size_t most = std::max<std::size_t>(kMostColliders / plan_.bones.size(), 1);
    const std::vector<ColliderShape>& shapes = body(index).shapes;
    for (std::size_t i = 0; i < std::min(shapes.size(), most); ++i)
      out_.colliders.push_back({shapes.size() == 1 ? bone(index).name : bone(index).name + "_" + std::to_string(i + 1),
                                joint_of_[at(index)], tidy(shapes[i])});
  }

  void add_mesh(int index, const TriangleMesh& mesh) {
    for (std::size_t first = 0; first < mesh.indices.size(); first += 3 * kMostTriangles) {
      MeshDesc piece{joint_of_[at(index)], TriangleMesh{}, out_.color};
      auto& triangles = std::get<TriangleMesh>(piece.shape);
      for (std::size_t i = first; i < std::min(first + 3 * kMostTriangles, mesh.indices.size()); ++i) {
        // A mirrored triangle would face inward, so two of its corners are swapped.
        const std::size_t corner = plan_.side != Side::right ? i : i - i % 3 + (3 - i % 3) % 3;
        const Vec3 p = rounded(mesh.positions_m[at(mesh.indices[corner])], 1e4);
        triangles.indices.push_back(static_cast<int>(triangles.positions_m.size()));
        triangles.positions_m.push_back(plan_.side == Side::right ? mirror_point(p) : p);
      }
      out_.mesh.push_back(std::move(piece));
    }
  }

  // Adds the socket for a part that begins with another bone.
  void add_dock(const PartPlan& plan) {
    const int first = plan.bones.front(), parent = bone(first).parent;
    out_.sockets.push_back(
        {plan.slot, joint_of_[at(parent)], rounded(bone(first).position_m - bone(parent).position_m, 1e5), Vec3(0.0)});
  }

  int find_role(BoneRole role) const {
    for (const int b : plan_.bones)
      if (bone(b).role == role) return b;
    return -1;
  }

  void add_reach() {
    const bool is_arm = plan_.kind == "arm";
    const int upper = find_role(is_arm ? BoneRole::upper_arm : BoneRole::thigh);
    const int middle = find_role(is_arm ? BoneRole::forearm : BoneRole::shank);
    if (upper < 0 || middle < 0 || bone(middle).parent != upper) return;
    const Vec3 tip = rounded(end_of(figure_, middle) - bone(middle).position_m, 1e5);
    if (length(tip) < 1e-3 * figure_.height_m ||
        length(bone(middle).position_m - bone(upper).position_m) < 1e-3 * figure_.height_m)
      return;
    out_.sockets.push_back({"tip", joint_of_[at(middle)], tip, Vec3(0.0)});
    out_.reach.push_back({joint_of_[at(upper)], joint_of_[at(middle)], "tip"});
  }

  void add_facing() {
    if (plan_.kind != "head") return;
    int head = -1;
    for (const int b : plan_.bones)
      if (bone(b).family == BoneFamily::head && !bone(b).points_m.empty()) head = head < 0 ? b : head;
    if (head < 0) return;
    FacingDesc facing{{}, "face"};
    for (int b = head; b >= 0 && std::find(plan_.bones.begin(), plan_.bones.end(), b) != plan_.bones.end();
         b = bone(b).parent)
      facing.joints.insert(facing.joints.begin(), joint_of_[at(b)]);
    if (facing.joints.size() > 8) facing.joints.erase(facing.joints.begin(), facing.joints.end() - 8);
    Vec3 middle(0.0);
    double front = -std::numeric_limits<double>::infinity();
    for (const Vec3& p : bone(head).points_m)
      middle += p / static_cast<double>(bone(head).points_m.size()), front = std::max(front, p.z);
    out_.sockets.push_back({"face", joint_of_[at(head)], rounded(Vec3(middle.x, middle.y, front), 1e5), Vec3(0.0)});
    out_.facing.push_back(std::move(facing));
  }

  // The position of the lowest vertices of the leg's end, relative to the bone with the sole.
  Vec3 standing_point(int sole) const {
    const double band = lowest_below_m(figure_, sole) + 0.03 * figure_.height_m;
    Vec3 sum(0.0);
    int count = 0;
    for (const int b : plan_.bones)
      for (const Vec3& p : bone(b).points_m)
        if (bone(b).position_m.y + p.y < band) sum += bone(b).position_m + p, ++count;
    return count == 0 ? bone(sole).position_m : sum / static_cast<double>(count);
  }

  void add_sole() {
    int sole = find_role(BoneRole::foot);
    if (plan_.kind == "leg" && find_role(BoneRole::shank) >= 0 && ends_in(find_role(BoneRole::shank)))
      sole = find_role(BoneRole::shank);
    if (sole < 0 || (plan_.kind == "foot" && !is_sole_bone(figure_, sole))) return;
    if (lowest_below_m(figure_, sole) > figure_.ground_m + 0.06 * figure_.height_m) return;
    double low = std::numeric_limits<double>::infinity();
    for (const int b : plan_.bones) low = std::min(low, bone(b).position_m.y + lowest_of(body(b).shapes));
    const Vec3 stands = figure_.is_humanoid && plan_.kind == "foot" ? bone(sole).position_m : standing_point(sole);
    const Vec3 place = Vec3(stands.x, low, stands.z) - bone(sole).position_m;
    out_.sockets.push_back({"sole", joint_of_[at(sole)], rounded(place, 1e5), Vec3(0.0)});
  }

  bool ends_in(int index) const {
    const std::vector<int> below = children_of(figure_, index);
    return std::none_of(below.begin(), below.end(), [&](int c) { return bone(c).role == BoneRole::foot; });
  }

  void add_grip() {
    const int hand = find_role(BoneRole::hand);
    if (plan_.kind != "hand" || hand < 0) return;
    out_.sockets.push_back({"grip", joint_of_[at(hand)], rounded(body(hand).inertia.center_m, 1e5), Vec3(0.0)});
  }

  const Seen& seen_;
  const RiggedFigure& figure_;
  const std::vector<PartPlan>& plans_;
  const PartPlan& plan_;
  double torque_Nm_;
  BoneReport* reports_;
  std::size_t first_in_joints_;
  int index_;
  PartDesc out_;
  std::set<std::string> taken_;
  std::vector<std::string> joint_of_;  // joint of each bone; "" is the fixed body
};

Seen see(RiggedFigure figure, ClipPoses poses) {
  Seen out{std::move(figure), std::move(poses), {}};
  out.bodies = fit_bodies(out.figure);
  weigh(out.figure, out.bodies);
  return out;
}

}  // namespace

CutFigure describe(const RiggedFigure& figure, const ClipPoses& poses, const std::vector<PartPlan>& plans,
                   const std::string& name, const std::vector<TriangleMesh>& meshes) {
  const Seen plain = see(figure, poses), mirror = see(mirrored(figure), mirrored(poses));
  double mass_kg = 0.0;
  for (const BoneBody& body : plain.bodies) mass_kg += body.inertia.mass_kg;
  CutFigure out;
  out.bones.resize(figure.bones.size());
  out.bones[0].joint = out.bones[0].carries = "root";
  out.character.name = name;
  out.character.help = "Imported from a rigged model; " + name + ".import.md says what was guessed.";
  for (std::size_t p = 0; p < plans.size(); ++p) {
    const PartPlan& plan = plans[p];
    const Seen& seen = plan.side == Side::right ? mirror : plain;
    PartWriter writer(seen, plans, p, mass_kg * 9.81 * figure.height_m, out.bones.data());
    out.parts.push_back(writer.write(name + "_" + plan.slot, meshes));
    out.character.slots.push_back({plan.slot,
                                   plan.kind,
                                   plan.side,
                                   plan.carrier < 0 ? "" : plans[at(plan.carrier)].slot,
                                   plan.carrier < 0 ? "" : plan.slot,
                                   {out.parts.back().name}});
  }
  for (std::size_t b = 0; b < figure.bones.size(); ++b) {
    const std::string& label = figure.bones[b].label;
    if (label.empty() || label.size() > 200) continue;
    if (b > 0) out.joint_of_node[label] = out.bones[b].joint;
    out.carrier_of_node[label] = out.bones[b].carries;
  }
  return out;
}

}  // namespace contort
