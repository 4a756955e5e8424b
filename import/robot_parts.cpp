#include "import/robot_parts.h"

#include <algorithm>
#include <set>

#include "import/names.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr std::size_t kMostOfPart = 64;  // greatest number of joints, of colliders and of sockets
constexpr std::size_t kMostRobotParts = 64;
constexpr std::size_t kMostSharedBytes = 20;
constexpr double kGreatestInertia = 1e6;  // kg m^2
constexpr double kGreatestStrength = 1e7;

struct Limb {
  std::string slot;
  int carrier = -1;  // index of an earlier limb
  std::vector<int> links;
};

// The common beginning of the names of a limb's joints: "panda" for "panda_joint1" and "panda_finger". A single joint
// gives its whole name.
std::string shared_beginning(const Linkage& linkage, const std::vector<int>& links) {
  std::vector<std::string> names;
  for (const int link : links)
    for (const int report : linkage.links[at(link)].reports)
      names.push_back(legal_name(linkage.reports[at(report)].file_name, "joint"));
  if (names.size() == 1) return names[0].substr(0, kMostSharedBytes);
  std::string shared = names[0] + "_";
  for (const std::string& name : names) {
    std::size_t same = 0;
    while (same < std::min(shared.size(), name.size()) && shared[same] == name[same]) ++same;
    shared.resize(std::min(same, shared.size()));
  }
  shared.resize(shared.find_last_of('_') == std::string::npos ? 0 : shared.find_last_of('_'));
  return legal_name(shared.substr(0, kMostSharedBytes), "");
}

// The name of a limb, by the words in its joints' names: "arm_left".
std::string limb_name(const Linkage& linkage, const std::vector<int>& links) {
  int arm = 0, leg = 0, head = 0, trunk = 0, finger = 0, count = 0;
  Side side = Side::center;
  for (const int link : links)
    for (const int report : linkage.links[at(link)].reports) {
      const NameSense sense = sense_of(linkage.reports[at(report)].file_name);
      ++count;
      if (count == 1) side = sense.side;
      switch (sense.family) {
        case BoneFamily::clavicle:
        case BoneFamily::upper_arm:
        case BoneFamily::forearm:
        case BoneFamily::arm:
        case BoneFamily::hand: ++arm; break;
        case BoneFamily::thigh:
        case BoneFamily::shank:
        case BoneFamily::leg:
        case BoneFamily::foot:
        case BoneFamily::toe: ++leg; break;
        case BoneFamily::neck:
        case BoneFamily::head: ++head; break;
        case BoneFamily::hips:
        case BoneFamily::spine: ++trunk; break;
        case BoneFamily::finger: ++finger; break;
        default: break;
      }
    }
  const auto is_most = [&](int n) { return 2 * n > count; };
  const char* kind = is_most(arm)      ? "arm"
                     : is_most(leg)    ? "leg"
                     : is_most(head)   ? "head"
                     : is_most(trunk)  ? "torso"
                     : is_most(finger) ? "finger"
                                       : "";
  if (*kind != '\0' && side != Side::center) return std::string(kind) + (side == Side::left ? "_left" : "_right");
  const std::string shared = shared_beginning(linkage, links);
  const bool is_middle = is_most(head) || is_most(trunk);
  if (*kind != '\0' && (is_middle || shared.empty())) return kind;
  return *kind == '\0' ? (shared.empty() ? std::string("limb") : shared) : std::string(kind) + "_" + shared;
}

// Cuts a linkage into limbs. A branch of two or more joints is a limb of its own; so are joints that no longer fit into
// one part.
class Cutter {
 public:
  Cutter(Linkage& linkage, std::string name, double strength_Nm)
      : linkage_(linkage), name_(std::move(name)), strength_Nm_(strength_Nm), limb_of_(linkage.links.size(), 0) {}

  Result<RobotParts> cut() {
    assign();
    if (limbs_.size() > kMostRobotParts)
      return Issue{"import.too_many_parts", "",
                   "the robot would have " + std::to_string(limbs_.size()) + " parts, allowed are " +
                       std::to_string(kMostRobotParts)};
    name_limbs();
    out_.joint_of_link.assign(linkage_.links.size(), "root");
    local_.assign(linkage_.links.size(), "");
    for (std::size_t i = 0; i < limbs_.size(); ++i) write(static_cast<int>(i));
    return std::move(out_);
  }

 private:
  const RobotLink& link(int index) const { return linkage_.links[at(index)]; }

  void assign() {
    std::vector<int> children(linkage_.links.size(), 0), below(linkage_.links.size(), 0);
    for (std::size_t i = linkage_.links.size(); i-- > 1;) {
      below[i] += static_cast<int>(linkage_.links[i].joints.size());
      below[at(linkage_.links[i].parent)] += below[i];
      ++children[at(linkage_.links[i].parent)];
    }
    limbs_.push_back({"body", -1, {0}});
    for (int i = 1; i < static_cast<int>(linkage_.links.size()); ++i) {
      const int parent = link(i).parent, limb = limb_of_[at(parent)];
      const bool branches = below[at(i)] >= 2 && (parent == 0 || children[at(parent)] > 1);
      limb_of_[at(i)] = branches || !has_room(limbs_[at(limb)], i) ? static_cast<int>(limbs_.size()) : limb;
      if (limb_of_[at(i)] == static_cast<int>(limbs_.size()))
        limbs_.push_back({"", limb, {i}});
      else
        limbs_[at(limb)].links.push_back(i);
    }
  }

  bool has_room(const Limb& limb, int added) const {
    std::size_t joints = link(added).joints.size(), colliders = link(added).shapes.size();
    for (const int i : limb.links) joints += link(i).joints.size(), colliders += link(i).shapes.size();
    return joints <= kMostOfPart && colliders <= kMostOfPart;
  }

  void name_limbs() {
    std::set<std::string> taken = {"body", "object"};
    for (std::size_t i = 1; i < limbs_.size(); ++i)
      limbs_[i].slot = claim_name(limb_name(linkage_, limbs_[i].links), taken);
  }

  void write(int index) {
    const Limb& limb = limbs_[at(index)];
    PartDesc part;
    part.name = name_ + "_" + limb.slot;
    part.kind = limb.slot;
    part.color = Vec3(0.42, 0.45, 0.5);
    std::set<std::string> names, collider_names;
    for (const int i : limb.links) add_link(i, i == limb.links.front(), limb, names, part);
    for (const int i : limb.links) add_colliders(i, limb, collider_names, part);
    for (const Limb& other : limbs_)
      if (other.carrier == index) part.sockets.push_back({other.slot, local_[at(link(other.links[0]).parent)], {}, {}});
    out_.slots.push_back({limb.slot,
                          part.kind,
                          Side::center,
                          index == 0 ? "" : limbs_[at(limb.carrier)].slot,
                          index == 0 ? "" : limb.slot,
                          {part.name}});
    out_.parts.push_back(std::move(part));
  }

  void add_link(int index, bool is_first, const Limb& limb, std::set<std::string>& names, PartDesc& part) {
    const RobotLink& own = link(index);
    if (own.joints.empty()) {
      part.fixed_mass_kg = own.inertia.mass_kg;
      part.fixed_center_of_mass_m = own.inertia.center_m;
      part.fixed_inertia_kg_m2 = moments(own.inertia);
      return;
    }
    std::string parent = is_first ? "" : local_[at(own.parent)];
    for (std::size_t j = 0; j < own.joints.size(); ++j) {
      JointDesc joint = own.joints[j];
      RobotJointReport& report = linkage_.reports[at(own.reports[j])];
      joint.name = claim_name(legal_name(report.file_name, "joint"), names);
      joint.parent = parent;
      const double effort = report.in_file.greatest_effort;
      joint.strength_high = std::min(effort > 0.0 ? effort : strength_Nm_, kGreatestStrength);
      joint.strength_low = -joint.strength_high;
      if (!(effort > 0.0))
        report.remark += std::string(report.remark.empty() ? "" : "; ") + "no greatest effort is declared";
      parent = joint.name;
      report.joint = limb.slot + "/" + joint.name;
      if (j + 1 == own.joints.size()) set_body(own, joint);
      part.joints.push_back(std::move(joint));
    }
    local_[at(index)] = parent;
    out_.joint_of_link[at(index)] = limb.slot + "/" + parent;
  }

  static Vec3 moments(const BodyInertia& body) {
    Vec3 out;
    for (int i = 0; i < 3; ++i) out[i] = std::clamp(body.inertia_kg_m2[i][i], 0.0, kGreatestInertia);
    return out;
  }

  static void set_body(const RobotLink& own, JointDesc& joint) {
    const std::string body = legal_name(own.body, "body");
    if (body != joint.name) joint.body = body;
    joint.mass_kg = own.inertia.mass_kg;
    joint.center_of_mass_m = own.inertia.center_m;
    joint.inertia_kg_m2 = moments(own.inertia);
  }

  void add_colliders(int index, const Limb& limb, std::set<std::string>& names, PartDesc& part) {
    const std::vector<LinkageShape>& shapes = link(index).shapes;
    for (std::size_t s = 0; s < shapes.size() && part.colliders.size() < kMostOfPart; ++s) {
      const std::string name = claim_name(legal_name(shapes[s].body, "collider"), names);
      part.colliders.push_back({name, local_[at(index)], shapes[s].shape});
      out_.colliders.push_back({limb.slot + "/" + name, index, static_cast<int>(s)});
    }
    if (shapes.size() > kMostOfPart)
      linkage_.notes.push_back("Body " + link(index).body + " has more than 64 shapes; the others are left out.");
  }

  Linkage& linkage_;
  std::string name_;
  double strength_Nm_;
  std::vector<int> limb_of_;
  std::vector<Limb> limbs_;
  std::vector<std::string> local_;  // by link: the name of its last joint in its part
  RobotParts out_;
};

}  // namespace

Result<RobotParts> cut_robot(Linkage& linkage, const std::string& name, double strength_Nm) {
  return Cutter(linkage, name, strength_Nm).cut();
}

}  // namespace contort
