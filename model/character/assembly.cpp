#include "model/character/assembly.h"

#include <map>

namespace contort {

namespace {

// Converts a part's data to its slot's side: unchanged on the left and in the middle, a reflection in x = 0 on the
// right. Axes of rotation are axial vectors; the axis of a travel is a direction.
struct Handed {
  bool mirror;
  Vec3 point(const Vec3& p) const { return mirror ? mirror_point(p) : p; }
  Vec3 axial(const Vec3& a) const { return mirror ? mirror_axis(a) : a; }
  Quat rotation(const Quat& q) const { return mirror ? mirror_rotation(q) : q; }
  Rigid frame(const Vec3& position_m, const Vec3& rotation_deg) const {
    return {rotation(from_rotation_vector(rotation_deg * kRadPerDeg)), point(position_m)};
  }
  template <class Shape>
  Shape shape(const Shape& s) const {
    return mirror ? mirrored(s) : s;
  }
};

struct MoveShape {
  const Rigid& to_from_own;
  Sphere operator()(Sphere s) const {
    s.center_m = to_from_own * s.center_m;
    return s;
  }
  Capsule operator()(const Capsule& c) const { return {to_from_own * c.a_m, to_from_own * c.b_m, c.radius_m}; }
  Box operator()(const Box& b) const {
    const Quat q = to_from_own.q * from_rotation_vector(b.rotation_deg * kRadPerDeg);
    return {to_from_own * b.center_m, b.half_m, to_rotation_vector(q) * kDegPerRad};
  }
  ConvexHull operator()(ConvexHull hull) const {
    for (Vec3& p : hull.points_m) p = to_from_own * p;
    return hull;
  }
  TriangleMesh operator()(TriangleMesh mesh) const {
    for (Vec3& p : mesh.positions_m) p = to_from_own * p;
    return mesh;
  }
};

template <class Shape>
Shape moved_shape(const Rigid& to_from_own, const Shape& shape) {
  if (to_from_own == Rigid{}) return shape;
  return std::visit([&](const auto& s) -> Shape { return MoveShape{to_from_own}(s); }, shape);
}

// The polyhedron of the points as authored, which check_part has checked, moved to the slot.
std::shared_ptr<const Polyhedron> polyhedron_of(const ColliderShape& shape, bool mirror, const Rigid& to_from_own) {
  const auto* hull = std::get_if<ConvexHull>(&shape);
  if (hull == nullptr) return nullptr;
  Polyhedron solid = convex_polyhedron(hull->points_m);
  return std::make_shared<Polyhedron>(moved(to_from_own, mirror ? mirrored(std::move(solid)) : std::move(solid)));
}

JointKind kind_of(JointType type) {
  switch (type) {
    case JointType::hinge: return JointKind::hinge;
    case JointType::ball: return JointKind::ball;
    case JointType::prismatic: return JointKind::prismatic;
  }
  return JointKind::hinge;
}

void set_body(Joint& joint, const BodyInertia& body) {
  joint.mass_kg = body.mass_kg;
  joint.center_of_mass_m = body.center_m;
  joint.inertia_kg_m2 = body.inertia_kg_m2;
}

// Adds a body that is fixed to a joint's body.
void fix_body(Joint& joint, const Rigid& joint_from_body, const BodyInertia& body) {
  if (body.mass_kg <= 0.0) return;
  set_body(joint, merged({joint.mass_kg, joint.center_of_mass_m, joint.inertia_kg_m2}, moved(joint_from_body, body)));
}

void set_limits(Joint& joint, const JointDesc& desc, const Handed& handed) {
  const bool travels = desc.type == JointType::prismatic;
  joint.axis = travels ? handed.point(desc.axis) : handed.axial(desc.axis);
  joint.low = travels ? desc.low_m : desc.low_deg * kRadPerDeg;
  joint.high = travels ? desc.high_m : desc.high_deg * kRadPerDeg;
  joint.max_speed = travels ? desc.max_speed_m_s : desc.max_speed_deg_s * kRadPerDeg;
  joint.swing_axis = handed.axial(desc.swing_axis);
  joint.swing_a_rad = desc.swing_deg[0] * kRadPerDeg;
  joint.swing_b_rad = desc.swing_deg[1] * kRadPerDeg;
  joint.swing_center = handed.rotation(from_rotation_vector(desc.swing_center_deg * kRadPerDeg));
  joint.strength_low = desc.strength_low;
  joint.strength_high = desc.strength_high;
}

// Adds one part to an assembly, and resolves the part's own joint names.
class PartAdder {
 public:
  PartAdder(Assembly& assembly, const SlotDesc& slot, const PartDesc& desc, const Dock& dock)
      : assembly_(assembly), slot_(slot), desc_(desc), dock_(dock), handed_{slot.side == Side::right} {}

  void add() {
    part_.slot = slot_.name;
    part_.name = desc_.name;
    part_.kind = desc_.kind;
    part_.side = slot_.side;
    part_.first_joint = static_cast<int>(assembly_.joints.size());
    part_.first_coord = assembly_.coord_count;
    for (const JointDesc& joint : desc_.joints) add_joint(joint);
    part_.joint_count = static_cast<int>(assembly_.joints.size()) - part_.first_joint;
    part_.coord_count = assembly_.coord_count - part_.first_coord;
    fix_body(assembly_.joints[static_cast<std::size_t>(dock_.joint)], dock_.joint_from_dock, fixed_body());
    for (const ColliderDesc& collider : desc_.colliders) add_collider(collider);
    add_mesh();
    for (const SocketDesc& socket : desc_.sockets) add_socket(socket);
    add_chains();
    assembly_.parts.push_back(std::move(part_));
  }

 private:
  Dock on(const std::string& joint) const {
    if (joint.empty()) return dock_;
    return {joint_index_.at(joint), Rigid{}};
  }

  void add_joint(const JointDesc& desc) {
    const Dock parent = on(desc.parent);
    Joint joint;
    joint.name = slot_.name + "/" + desc.name;
    joint.local_name = desc.name;
    joint.body_name = desc.body.empty() ? desc.name : desc.body;
    joint.part = static_cast<int>(assembly_.parts.size());
    joint.parent = parent.joint;
    joint.kind = kind_of(desc.type);
    joint.coord = assembly_.coord_count;
    joint.parent_from_joint = parent.joint_from_dock * handed_.frame(desc.position_m, desc.rotation_deg);
    set_limits(joint, desc, handed_);
    set_body(joint, principal_inertia(desc.mass_kg, handed_.point(desc.center_of_mass_m), desc.inertia_kg_m2));
    assembly_.coord_count += coord_size(joint.kind);
    joint_index_[desc.name] = static_cast<int>(assembly_.joints.size());
    assembly_.joints.push_back(std::move(joint));
  }

  BodyInertia fixed_body() const {
    return principal_inertia(desc_.fixed_mass_kg, handed_.point(desc_.fixed_center_of_mass_m),
                             desc_.fixed_inertia_kg_m2);
  }

  void add_collider(const ColliderDesc& desc) {
    const Dock dock = on(desc.joint);
    assembly_.colliders.push_back({slot_.name + "/" + desc.name, dock.joint,
                                   moved_shape(dock.joint_from_dock, handed_.shape(desc.shape)),
                                   polyhedron_of(desc.shape, handed_.mirror, dock.joint_from_dock)});
  }

  void add_mesh_piece(const std::string& joint, const MeshShape& shape, const Vec3& color) {
    const Dock dock = on(joint);
    assembly_.mesh.push_back({dock.joint, moved_shape(dock.joint_from_dock, handed_.shape(shape)), color});
  }

  void add_mesh() {
    for (const MeshDesc& piece : desc_.mesh) add_mesh_piece(piece.joint, piece.shape, piece.color);
    if (!desc_.mesh.empty()) return;
    for (const ColliderDesc& collider : desc_.colliders)
      add_mesh_piece(collider.joint, as_mesh(collider.shape), desc_.color);
  }

  void add_socket(const SocketDesc& desc) {
    const Dock dock = on(desc.joint);
    assembly_.sockets.push_back({slot_.name + "/" + desc.name, dock.joint,
                                 dock.joint_from_dock * handed_.frame(desc.position_m, desc.rotation_deg)});
  }

  void add_chains() {
    for (const ReachDesc& reach : desc_.reach) {
      const int upper = joint_index_.at(reach.upper);
      const bool ball = assembly_.joints[static_cast<std::size_t>(upper)].kind == JointKind::ball;
      part_.reach.push_back({upper, ball ? upper : upper + 2, joint_index_.at(reach.middle), socket_index(reach.tip)});
    }
    for (const FacingDesc& facing : desc_.facing) {
      FacingChain chain;
      for (const std::string& joint : facing.joints) chain.joints.push_back(joint_index_.at(joint));
      chain.socket = socket_index(facing.socket);
      part_.facing.push_back(std::move(chain));
    }
  }

  int socket_index(const std::string& local) const { return find_socket(assembly_, slot_.name + "/" + local); }

  Assembly& assembly_;
  const SlotDesc& slot_;
  const PartDesc& desc_;
  const Dock& dock_;
  Handed handed_;
  Part part_;
  std::map<std::string, int> joint_index_;
};

}  // namespace

void add_part(Assembly& assembly, const SlotDesc& slot, const PartDesc& part, const Dock& dock) {
  PartAdder(assembly, slot, part, dock).add();
}

void add_object(Assembly& assembly, const ObjectDesc& object, const Dock& dock) {
  const std::string prefix = "object:" + object.name + "/";
  fix_body(assembly.joints[static_cast<std::size_t>(dock.joint)], dock.joint_from_dock,
           principal_inertia(object.mass_kg, object.center_of_mass_m, object.inertia_kg_m2));
  for (const ColliderDesc& c : object.colliders) {
    assembly.colliders.push_back({prefix + c.name, dock.joint, moved_shape(dock.joint_from_dock, c.shape),
                                  polyhedron_of(c.shape, false, dock.joint_from_dock)});
    if (object.mesh.empty())
      assembly.mesh.push_back({dock.joint, moved_shape(dock.joint_from_dock, as_mesh(c.shape)), object.color});
  }
  for (const MeshDesc& m : object.mesh)
    assembly.mesh.push_back({dock.joint, moved_shape(dock.joint_from_dock, m.shape), m.color});
  const Handed as_is{false};
  for (const SocketDesc& s : object.points)
    assembly.sockets.push_back(
        {prefix + s.name, dock.joint, dock.joint_from_dock * as_is.frame(s.position_m, s.rotation_deg)});
}

int find_socket(const Assembly& assembly, const std::string& name) {
  for (std::size_t i = 0; i < assembly.sockets.size(); ++i)
    if (assembly.sockets[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace contort
