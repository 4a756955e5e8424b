#include "generator/dynamics/figure.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/control.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// rad/s^2; the lower body's also m/s^2. From a study of a human squat: an arm may swing, a trunk may only give way.
constexpr double kGreatestArms = 25.0;
constexpr double kGreatestBack = 4.0;
constexpr double kGreatestLower = 0.3;

enum class Role { trunk, leg, arm, other };

class FigureBuilder {
 public:
  FigureBuilder(const Character& character, std::span<const Leg> legs) : character_(character), legs_(legs) {
    world_.resize(character.joints().size());
    forward_kinematics(character, character.rest_root(), character.rest_coords(), world_);
    find_roles();
  }

  void build(DynamicFigure& figure) const {
    for (const Leg& leg : legs_) figure.soles.push_back(sole_of(leg));
    add_strengths(figure);
    add_ankles(figure);
    add_chains(figure);
    add_groups(figure);
    add_watched(figure);
  }

 private:
  int part_of(int joint) const { return character_.joints()[at(joint)].part; }
  const Joint& joint(int index) const { return character_.joints()[at(index)]; }

  // The part that carries a part with joints of its own; -1 for the first one.
  int carrier(int part) const {
    const Part& own = character_.parts()[at(part)];
    return own.joint_count == 0 || joint(own.first_joint).parent < 0 ? -1 : part_of(joint(own.first_joint).parent);
  }

  void find_roles() {
    const auto parts = character_.parts();
    roles_.assign(parts.size(), Role::other);
    for (const Leg& leg : legs_) roles_[at(leg.part)] = roles_[at(leg.foot_part)] = Role::leg;
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (!parts[p].reach.empty() && roles_[p] == Role::other) roles_[p] = Role::arm;
    // A part that carries other limbs is the trunk.
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const int below = carrier(static_cast<int>(p));
      if (below >= 0 && roles_[at(below)] == Role::other) roles_[at(below)] = Role::trunk;
    }
  }

  Sole sole_of(const Leg& leg) const {
    const Socket& socket = character_.sockets()[at(leg.sole)];
    Sole sole;
    sole.link = socket.joint, sole.link_from_sole = socket.joint_from_socket;
    const double x[] = {leg.low_m.x, leg.high_m.x}, z[] = {leg.low_m.z, leg.high_m.z};
    const Vec3 corners[] = {{x[0], 0, z[0]}, {x[0], 0, z[1]}, {x[1], 0, z[1]}, {x[1], 0, z[0]}};
    for (std::size_t i = 0; i < 4; ++i) sole.corners_m[i] = sole.link_from_sole * corners[i];
    return sole;
  }

  void add_strengths(DynamicFigure& figure) const {
    for (const Link& link : figure.body.links()) {
      const Joint& own = joint(static_cast<int>(&link - figure.body.links().data()));
      const bool root = link.kind == JointKind::root;
      figure.strength_low.insert(figure.strength_low.end(), at(link.dof_count), root ? 0.0 : own.strength_low);
      figure.fastest.insert(figure.fastest.end(), at(link.dof_count), root ? 0.0 : own.max_speed);
      figure.strength_high.insert(figure.strength_high.end(), at(link.dof_count), root ? 0.0 : own.strength_high);
    }
  }

  void add_ankles(DynamicFigure& figure) const {
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      Sole& sole = figure.soles[i];
      sole.ankle_m = {legs_[i].sole_from_ankle.x, 0.0, legs_[i].sole_from_ankle.z};
      const Quat sole_from_world = glm::conjugate(world_from_socket(character_, world_, legs_[i].sole).q);
      for (int k = 0; k < legs_[i].ankle_count; ++k) {
        const int j = legs_[i].ankles[at(k)];
        const Joint& ankle = joint(j);
        sole.ankle_dofs.push_back(figure.body.links()[at(j)].dof);
        const bool is_ball = ankle.kind == JointKind::ball;
        const double high_N_m = ankle.strength_high, low_N_m = -ankle.strength_low;
        const double either_N_m = std::max(high_N_m, low_N_m);
        const Vec3 axis = sole_from_world * (world_[at(j)].q * ankle.axis);
        if (is_ball || std::fabs(axis.x) > 0.7) {
          sole.toes_N_m = is_ball ? either_N_m : axis.x > 0.0 ? high_N_m : low_N_m;
          sole.heel_N_m = is_ball ? either_N_m : axis.x > 0.0 ? low_N_m : high_N_m;
        }
        if (is_ball || std::fabs(axis.z) > 0.7) sole.tilt_N_m = either_N_m;
      }
    }
  }

  void add_chains(DynamicFigure& figure) const {
    for (Sole& sole : figure.soles) {
      const Link& last = figure.body.links()[at(sole.link)];
      for (int k = last.dof + last.dof_count - 1; k >= kRootDofs; k = figure.body.parent_dof()[at(k)])
        sole.chain_dofs.push_back(k);
    }
    for (std::size_t i = 0; i < legs_.size(); ++i)
      for (int j = 1; j < static_cast<int>(character_.joints().size()); ++j) {
        if (part_of(j) != legs_[i].part && part_of(j) != legs_[i].foot_part) continue;
        const Link& link = figure.body.links()[at(j)];
        for (int k = 0; k < link.dof_count; ++k) figure.soles[i].leg_dofs.push_back(link.dof + k);
      }
  }

  // A ball's axes are the character's own: about its side and about its front.
  void add_handles(const DynamicFigure& figure, int first, int last, std::size_t most, std::vector<Handle>& out) const {
    std::size_t added = 0;
    for (int j = first; j <= last && added < most; ++j) {
      const Link& link = figure.body.links()[at(j)];
      if (link.kind == JointKind::root) continue;
      if (link.kind != JointKind::ball) {
        out.push_back({j, link.dof, link.axis, false});
        ++added;
        continue;
      }
      const Quat parent_from_world = glm::conjugate(world_[at(link.parent)].q);
      for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 0, 1)})
        out.push_back({j, link.dof, parent_from_world * axis, true});
      added += 2;
    }
  }

  ControlGroup limbs(const DynamicFigure& figure, Role role, std::string name) const {
    ControlGroup group{std::move(name), {}, kGreatestArms, false};
    for (std::size_t p = 0; p < roles_.size(); ++p) {
      const Part& part = character_.parts()[p];
      if (roles_[p] != role || part.joint_count == 0) continue;
      const int below = carrier(static_cast<int>(p));
      if (below >= 0 && roles_[at(below)] != Role::trunk && below != 0) continue;  // a hand on its arm
      const int first = part.reach.empty() ? part.first_joint : part.reach.front().upper;
      add_handles(figure, first, part.first_joint + part.joint_count - 1, 2, group.handles);
    }
    return group;
  }

  ControlGroup back(const DynamicFigure& figure) const {
    ControlGroup group{"back", {}, kGreatestBack, false};
    for (std::size_t p = 0; p < roles_.size(); ++p) {
      const Part& part = character_.parts()[p];
      if (roles_[p] == Role::trunk)
        add_handles(figure, part.first_joint, part.first_joint + part.joint_count - 1, 8, group.handles);
    }
    for (const Handle& handle : group.handles) group.moves_feet = group.moves_feet || carries_feet(handle.link);
    return group;
  }

  // Handles for the place of the hips and their pitch.
  static void add_root_handles(std::vector<Handle>& out) {
    for (const int dof : {0, 1, 2, 3}) out.push_back({0, dof, Vec3(0.0), false});
  }

  // Returns true if feet would move along: some leg hangs on the joint.
  bool carries_feet(int moved) const {
    return std::ranges::any_of(legs_, [&](const Leg& leg) {
      int j = joint(character_.parts()[at(leg.part)].first_joint).parent;
      while (j > moved) j = joint(j).parent;
      return j == moved;
    });
  }

  void add_declared(const JointGroup& declared, DynamicFigure& figure) const {
    ControlGroup group{declared.name, {}, declared.greatest, false};
    for (const int j : declared.joints) {
      if (j == 0)
        add_root_handles(group.handles);
      else
        add_handles(figure, j, j, 2, group.handles);
      group.moves_feet = group.moves_feet || carries_feet(j);
    }
    figure.groups.push_back(std::move(group));
  }

  // Control has place for so many; of a figure with more limbs the first ones act.
  static void add_found(ControlGroup group, DynamicFigure& figure) {
    while (group.handles.size() > kMostHandles) group.handles.pop_back();
    if (!group.handles.empty()) figure.groups.push_back(std::move(group));
  }

  void add_groups(DynamicFigure& figure) const {
    for (const JointGroup& declared : character_.control_groups()) add_declared(declared, figure);
    if (!figure.groups.empty()) return;
    ControlGroup arms = limbs(figure, Role::arm, "arms");
    // Without arms a head and a tail swing.
    if (arms.handles.empty()) arms = limbs(figure, Role::other, "limbs");
    ControlGroup lower{"lower_body", {}, kGreatestLower, true};
    add_root_handles(lower.handles);
    add_found(std::move(arms), figure);
    add_found(back(figure), figure);
    if (!legs_.empty()) add_found(std::move(lower), figure);
  }

  void add_watched(DynamicFigure& figure) const {
    for (std::size_t j = 1; j < character_.joints().size(); ++j) {
      const Link& link = figure.body.links()[j];
      if (roles_[at(part_of(static_cast<int>(j)))] != Role::trunk) continue;
      for (int k = 0; k < link.dof_count; ++k) figure.watched.push_back(link.dof + k);
    }
    for (const Sole& sole : figure.soles)
      for (std::size_t k = 0; k < std::min<std::size_t>(2, sole.leg_dofs.size()); ++k)
        figure.watched.push_back(sole.leg_dofs[k]);
  }

  const Character& character_;
  std::span<const Leg> legs_;
  std::vector<Rigid> world_;
  std::vector<Role> roles_;  // by part
};

}  // namespace

Load box_load(int link, const Rigid& link_from_box, const Vec3& size_m, double mass_kg) {
  const Vec3 square = size_m * size_m;
  const Mat3 turn = glm::mat3_cast(link_from_box.q);
  Mat3 inertia(0.0);
  for (int i = 0; i < 3; ++i) inertia[i][i] = mass_kg / 12.0 * (square.x + square.y + square.z - square[i]);
  return {link, mass_kg, link_from_box.p_m, turn * inertia * glm::transpose(turn)};
}

DynamicFigure build_figure(const Character& character, std::span<const Leg> legs, std::span<const Load> loads) {
  DynamicFigure figure;
  figure.body = Multibody::of(character);
  for (const Load& load : loads)
    figure.body.add_mass(load.link, load.mass_kg, load.center_of_mass_m, load.inertia_kg_m2);
  figure.loads.assign(loads.begin(), loads.end());
  FigureBuilder(character, legs).build(figure);
  return figure;
}

}  // namespace contort
