#include "model/motion/recording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/asset/sample.h"
#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/motion/hinge_angles.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// The scale that each node applies to its children.
std::vector<Vec3> scales_of(const Asset& asset, const std::vector<Trs>& local) {
  std::vector<Vec3> scale(asset.nodes.size(), Vec3(1.0));
  for (const int node : asset.order) {
    scale[at(node)] = local[at(node)].scale;
    if (const int parent = asset.nodes[at(node)].parent; parent >= 0) scale[at(node)] *= scale[at(parent)];
  }
  return scale;
}

// The place of every node, without scales: a scaled bone does not rotate.
std::vector<Rigid> world_of(const Asset& asset, const std::vector<Trs>& local) {
  std::vector<Rigid> world(asset.nodes.size());
  const std::vector<Vec3> scale = scales_of(asset, local);
  for (const int node : asset.order) {
    const Trs& own = local[at(node)];
    const int parent = asset.nodes[at(node)].parent;
    world[at(node)] = {own.rotation, own.translation};
    if (parent < 0) continue;
    world[at(node)].p_m *= scale[at(parent)];
    world[at(node)] = world[at(parent)] * world[at(node)];
  }
  return world;
}

std::vector<Trs> rest_of(const Asset& asset) {
  std::vector<Trs> local;
  for (const AssetNode& node : asset.nodes) local.push_back(node.rest);
  return local;
}

int find_node(const Asset& asset, const std::string& name) {
  const auto found =
      std::ranges::find_if(asset.nodes, [&](const AssetNode& n) { return n.label == name || n.name == name; });
  return found == asset.nodes.end() ? -1 : static_cast<int>(found - asset.nodes.begin());
}

// The node of each joint: the given one, or the one with its name; -1 for none.
Result<std::vector<int>> nodes_of_joints(const Character& character, const RecordingUse& use) {
  std::vector<int> nodes;
  for (const Joint& own : character.joints()) nodes.push_back(find_node(use.asset, own.name));
  std::vector<char> given(nodes.size(), 0);
  for (const auto& [node, joint] : use.joints) {
    const int index = character.find_joint(joint), found = find_node(use.asset, node);
    if (found < 0) return Issue{"recording.unknown_node", "/joints/" + node, "is no node of the animation"};
    if (index < 0)
      return Issue{"recording.unknown_joint", "/joints/" + node,
                   "found \"" + joint + "\", which is no joint of " + character.name()};
    if (given[at(index)] != 0)
      return Issue{"recording.duplicate_joint", "/joints/" + node, "\"" + joint + "\" is given to two nodes"};
    given[at(index)] = 1, nodes[at(index)] = found;
  }
  return nodes;
}

bool is_above(const Asset& asset, int above, int node) {
  while (node >= 0 && node != above) node = asset.nodes[at(node)].parent;
  return node == above;
}

// Returns the lowest node that is above all of these nodes, or -1 if no node is.
int carrier_of(const Asset& asset, std::span<const int> nodes) {
  const auto first = std::ranges::find_if(nodes, [](int node) { return node >= 0; });
  if (first == nodes.end()) return -1;
  int carrier = asset.nodes[at(*first)].parent;
  const auto carries_all = [&] {
    return std::ranges::all_of(nodes, [&](int n) { return n < 0 || (n != carrier && is_above(asset, carrier, n)); });
  };
  while (carrier >= 0 && !carries_all()) carrier = asset.nodes[at(carrier)].parent;
  return carrier;
}

// The rotation about a unit axis that is nearest to a given rotation.
double twist_about(const Vec3& axis, const Quat& q) {
  return wrap_angle(2.0 * det::atan2(glm::dot(axis, Vec3(q.x, q.y, q.z)), q.w));
}

// The equivalent angle of a hinge that is nearest to the previous frame's: past half a turn it continues, and does not
// jump to -pi.
double counted_on(double angle, double before) {
  return angle + 2.0 * kPi * std::floor((before - angle + kPi) / (2.0 * kPi));
}

// A joint of the character and the node that it follows.
struct Followed {
  int joint = 0;
  int node = 0;
  int hinges = 1;    // number of hinges that share the node's rotation: this one and the next ones
  Quat world_aside;  // rotates the character's bone at rest to the direction of the model's
};

// The heights of the character's and the model's lowest mapped joints, and the ratio of their sizes.
struct Fit {
  double scale = 1.0;
  double floor_m = 0.0;
  double node_floor = 0.0;
};

// Finds the rotation between two figures that stand along the axes. A quarter turn about +Y moves a place (x, z) to (z,
// -x). The turn is chosen that brings the places nearest to the character's own, if they are spread out enough to
// decide.
Quat facing_of(const std::vector<Vec3>& model, const std::vector<Vec3>& own) {
  constexpr double kPlain = 0.3, kHalf = 0.70710678118654752;  // kHalf: sine and cosine of 45 degrees
  double along = 0.0, across = 0.0, at_most = 0.0;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const Vec3 &m = model[i], &c = own[i];
    along += m.x * c.x + m.z * c.z, across += m.z * c.x - m.x * c.z;
    at_most += std::sqrt((m.x * m.x + m.z * m.z) * (c.x * c.x + c.z * c.z));
  }
  if (std::max(-along, std::fabs(across)) <= std::max(along, kPlain * at_most)) return kNoRotation;
  if (-along > std::fabs(across)) return {0.0, 0.0, 1.0, 0.0};
  return {kHalf, 0.0, across > 0.0 ? kHalf : -kHalf, 0.0};
}

// Chooses the solution of Euler angles that is nearer to the previous frame, so that no angle jumps to the other
// solution.
Vec3 nearer_solution(const Vec3& one, const Vec3& before, int hinges) {
  const Vec3 other(wrap_angle(one.x + kPi), wrap_angle(kPi - one.y), wrap_angle(one.z + kPi));
  double apart[2] = {0.0, 0.0};
  for (int k = 0; k < hinges; ++k)
    apart[0] += std::fabs(wrap_angle(one[k] - before[k])), apart[1] += std::fabs(wrap_angle(other[k] - before[k]));
  return apart[1] < apart[0] ? other : one;
}

class Follower {
 public:
  Follower(const Character& character, const RecordingUse& use)
      : character_(character),
        use_(use),
        node_scale_(scales_of(use.asset, rest_of(use.asset))),
        node_rest_(world_of(use.asset, rest_of(use.asset))),
        rest_(character.joints().size()) {
    forward_kinematics(character, character.rest_root(), character.rest_coords(), rest_);
  }

  Result<Done> map() {
    Result<std::vector<int>> found = nodes_of_joints(character_, use_);
    if (!found) return found.issue();
    std::vector<int> nodes = std::move(found).value();
    if (nodes.front() < 0 && !use_.may_lack_root) nodes.front() = carrier_of(use_.asset, nodes);
    followed_of_.assign(nodes.size(), -1);
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (nodes[j] < 0) continue;
      followed_of_[j] = static_cast<int>(followed_.size());
      followed_.push_back({static_cast<int>(j), nodes[j], 1, kNoRotation});
    }
    has_root_ = !followed_.empty() && followed_[0].joint == 0;
    if (followed_.empty() || !(has_root_ || use_.may_lack_root))
      return Issue{"recording.no_root", "/joints", "no node is called \"root\", given for it, or carries those of all joints"};
    if (use_.may_face_elsewhere) face_forward();
    for (Followed& f : followed_) f.hinges = hinges_from(f.joint);
    for (Followed& f : followed_) f.world_aside = aside(f);
    find_fit();
    return Done{};
  }

  // Returns an entry for each joint that has a node, with nothing missed yet.
  std::vector<FollowedNode> followed() const {
    std::vector<FollowedNode> out;
    for (const Followed& f : followed_) out.push_back({f.joint, f.node, f.hinges});
    return out;
  }

  void play(Motion& motion, std::vector<FollowedNode>& followed) const {
    std::vector<Rigid> world(rest_.size());
    for (int frame = 0; frame < motion.frame_count; ++frame) {
      const double t_s = std::min(begin_s() + frame / use_.rate_hz, use_.clip.last_s);
      const std::vector<Trs> local = pose(use_.asset, use_.clip, t_s);
      const std::vector<Rigid> nodes = nodes_at(local);
      const std::span<double> row = motion.row(frame);
      const std::span<const double> before = frame > 0 ? motion.row(frame - 1) : row;
      std::copy(character_.rest_coords().begin(), character_.rest_coords().end(), row.begin());
      place_root(nodes, motion.root[at(frame)]);
      forward_kinematics(character_, motion.root[at(frame)], row, world);
      for (std::size_t i = has_root_ ? 1 : 0; i < followed_.size(); ++i) {
        const int next = i + 1 < followed_.size() ? followed_[i + 1].joint : static_cast<int>(world.size());
        turn(followed_[i], nodes, local, before, world, row);
        forward_kinematics(character_, row, followed_[i].joint, next, world);
        note(followed_[i], frame, nodes, local, world, followed[i]);
      }
    }
  }

 private:
  const Joint& joint(int index) const { return character_.joints()[at(index)]; }

  // Counts this hinge and the hinges at the same point that share its node, because they have none of their own.
  int hinges_from(int first) const {
    int count = 1;
    while (count < 3 && joint(first).kind == JointKind::hinge && first + count < static_cast<int>(rest_.size())) {
      const Joint& next = joint(first + count);
      const bool same_frame = next.parent == first + count - 1 && next.parent_from_joint == Rigid{};
      const bool upright = std::fabs(glm::dot(next.axis, joint(first + count - 1).axis)) < 1e-9;
      if (!same_frame || !upright || next.kind != JointKind::hinge || followed_of_[at(first + count)] >= 0) break;
      ++count;
    }
    return count;
  }

  // The nearest joint towards the root that follows a node; null for the root.
  const Followed* above(int index) const {
    for (int j = joint(index).parent; j >= 0; j = joint(j).parent)
      if (followed_of_[at(j)] >= 0) return &followed_[at(followed_of_[at(j)])];
    return nullptr;
  }

  Quat aside(const Followed& own) const {
    const Followed* up = above(own.joint);
    const Quat inherited = up != nullptr ? up->world_aside : kNoRotation;
    const Followed* next = nullptr;
    for (const Followed& other : followed_) {
      if (above(other.joint) != &own) continue;
      if (next != nullptr) return inherited;
      next = &other;
    }
    if (next == nullptr) return inherited;
    const Vec3 bone = rest_[at(next->joint)].p_m - rest_[at(own.joint)].p_m;
    const Vec3 model = node_rest_[at(next->node)].p_m - node_rest_[at(own.node)].p_m;
    if (glm::dot(bone, bone) < 1e-12 || glm::dot(model, model) < 1e-12) return inherited;
    return shortest_arc(glm::normalize(inherited * bone), glm::normalize(model)) * inherited;
  }

  std::vector<Rigid> nodes_at(const std::vector<Trs>& local) const {
    std::vector<Rigid> nodes = world_of(use_.asset, local);
    if (facing_ != kNoRotation)
      for (Rigid& node : nodes) node = Rigid{facing_, Vec3(0.0)} * node;
    return nodes;
  }

  void face_forward() {
    std::vector<Vec3> model, own;
    for (const Followed& f : followed_) {
      model.push_back(node_rest_[at(f.node)].p_m - node_rest_[at(followed_[0].node)].p_m);
      own.push_back(rest_[at(f.joint)].p_m - rest_[at(followed_[0].joint)].p_m);
    }
    facing_ = facing_of(model, own);
    node_rest_ = nodes_at(rest_of(use_.asset));
  }

  Quat turned(int node, const std::vector<Rigid>& nodes) const {
    return nodes[at(node)].q * glm::conjugate(node_rest_[at(node)].q);
  }

  double lowest(const std::vector<Rigid>& nodes) const {
    double low = nodes[at(followed_[0].node)].p_m.y;
    for (const Followed& f : followed_) low = std::min(low, nodes[at(f.node)].p_m.y);
    return low;
  }

  double begin_s() const { return use_.clip.first_s + use_.from_s; }

  double lowest_ever() const {
    double low = std::numeric_limits<double>::infinity();
    for (int frame = 0; frame == 0 || begin_s() + frame / use_.rate_hz <= use_.clip.last_s; ++frame)
      low = std::min(low, lowest(nodes_at(pose(use_.asset, use_.clip, begin_s() + frame / use_.rate_hz))));
    return low;
  }

  void find_fit() {
    const double root_m = rest_[0].p_m.y, node_root = node_rest_[at(followed_[0].node)].p_m.y;
    double low_m = root_m;
    for (const Followed& f : followed_) low_m = std::min(low_m, rest_[at(f.joint)].p_m.y);
    const double low_node = lowest(node_rest_);
    if (root_m - low_m > 1e-6 && node_root - low_node > 1e-6)
      fit_ = {(root_m - low_m) / (node_root - low_node), low_m, node_root == 0.0 ? lowest_ever() : low_node};
    else if (root_m > 0.0 && node_root > 1e-9)
      fit_.scale = root_m / node_root;  // no legs are mapped
  }

  void place_root(const std::vector<Rigid>& nodes, Rigid& root) const {
    if (!has_root_) {
      root = use_.start * character_.rest_root();
      return;
    }
    const Followed& own = followed_[0];
    const Quat q = turned(own.node, nodes) * own.world_aside * rest_[0].q;
    const Vec3 above_floor = nodes[at(own.node)].p_m - Vec3(0, fit_.node_floor, 0);
    root = use_.start * Rigid{glm::normalize(q), fit_.scale * above_floor + Vec3(0, fit_.floor_m, 0)};
  }

  // The rotation that the joint should reach, in the world.
  Quat wanted_turn(const Followed& f, const std::vector<Rigid>& nodes) const {
    return use_.start.q * turned(f.node, nodes) * f.world_aside * rest_[at(f.joint)].q;
  }

  // Keeps the greatest movement that the joint could not follow.
  void note(const Followed& f, int frame, const std::vector<Rigid>& nodes, const std::vector<Trs>& local,
            std::span<const Rigid> world, FollowedNode& out) const {
    if (joint(f.joint).kind == JointKind::prismatic) return;
    const Quat& taken = world[at(f.joint + f.hinges - 1)].q;
    const double missed = rotation_angle(glm::conjugate(taken) * wanted_turn(f, nodes));
    if (missed > out.missed_rad) out.missed_rad = missed, out.missed_frame = frame;
    const AssetNode& node = use_.asset.nodes[at(f.node)];
    const Vec3 off = local[at(f.node)].translation - node.rest.translation;
    const double moved_m = fit_.scale * length(node.parent < 0 ? off : node_scale_[at(node.parent)] * off);
    if (moved_m > out.moved_m) out.moved_m = moved_m, out.moved_frame = frame;
  }

  void turn(const Followed& f, const std::vector<Rigid>& nodes, const std::vector<Trs>& local,
            std::span<const double> before, std::span<const Rigid> world, std::span<double> row) const {
    const Joint& own = joint(f.joint);
    double* q = &row[at(own.coord)];
    if (own.kind == JointKind::prismatic) {
      const Trs& rest = use_.asset.nodes[at(f.node)].rest;
      q[0] = glm::dot(glm::conjugate(rest.rotation) * (local[at(f.node)].translation - rest.translation), own.axis);
      return;
    }
    const Quat wanted = wanted_turn(f, nodes);
    const Quat in_joint = glm::conjugate(world[at(own.parent)].q * own.parent_from_joint.q) * wanted;
    if (own.kind == JointKind::ball) {
      q[0] = in_joint.w, q[1] = in_joint.x, q[2] = in_joint.y, q[3] = in_joint.z;
    } else {
      share(f, in_joint, before, row);
    }
  }

  void share(const Followed& f, const Quat& wanted, std::span<const double> before, std::span<double> row) const {
    const Joint& own = joint(f.joint);
    if (f.hinges == 1) {
      row[at(own.coord)] = counted_on(twist_about(own.axis, wanted), before[at(own.coord)]);
      return;
    }
    const Vec3 second = joint(f.joint + 1).axis;
    const Vec3 third = f.hinges == 3 ? joint(f.joint + 2).axis : glm::cross(own.axis, second);
    Vec3 last(0.0);
    for (int k = 0; k < f.hinges; ++k) last[k] = before[at(joint(f.joint + k).coord)];
    const Vec3 angles = nearer_solution(hinge_angles(own.axis, second, third, wanted), last, f.hinges);
    for (int k = 0; k < f.hinges; ++k) row[at(joint(f.joint + k).coord)] = counted_on(angles[k], last[k]);
  }

  const Character& character_;
  const RecordingUse& use_;
  bool has_root_ = false;
  Quat facing_ = kNoRotation;
  std::vector<Vec3> node_scale_;  // at rest
  std::vector<Rigid> node_rest_;
  std::vector<Rigid> rest_;
  std::vector<int> followed_of_;  // by joint: index into followed_, or -1
  std::vector<Followed> followed_;
  Fit fit_;
};

}  // namespace

double frames_of(const RecordingUse& use) {
  // Rounds, so that a clip of exactly n periods has n + 1 frames although its end is a 32-bit time.
  const double length_s = std::max(0.0, use.clip.last_s - use.clip.first_s - use.from_s);
  return std::floor(length_s * use.rate_hz + 1e-3) + 1.0 + use.hold_frames;
}

Result<Motion> follow_recording(const Character& character, const RecordingUse& use,
                                std::vector<FollowedNode>* followed) {
  Follower follower(character, use);
  if (const Result<Done> mapped = follower.map(); !mapped) return mapped.issue();
  Motion motion;
  motion.rate_hz = use.rate_hz;
  motion.coord_count = character.coord_count();
  motion.frame_count = static_cast<int>(frames_of(use));
  motion.coords.resize(at(motion.frame_count) * at(motion.coord_count));
  motion.root.resize(at(motion.frame_count));
  std::vector<FollowedNode> left_out = follower.followed();
  follower.play(motion, left_out);
  if (followed != nullptr) *followed = std::move(left_out);
  return motion;
}

}  // namespace contort
