#include "model/character/character.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/character/assembly.h"
#include "model/character/part_rules.h"
#include "model/core/nearest.h"

namespace contort {

int freedom_count(JointKind kind) {
  if (kind == JointKind::root) return 6;
  return kind == JointKind::ball ? 3 : 1;
}

int coord_size(JointKind kind) {
  switch (kind) {
    case JointKind::root: return 0;
    case JointKind::ball: return 4;
    case JointKind::hinge:
    case JointKind::prismatic: return 1;
  }
  return 0;
}

namespace {

// Lowest y of a shape that is placed by world_from_joint.
struct LowestPoint {
  const Rigid& world;
  double operator()(const Sphere& s) const { return (world * s.center_m).y - s.radius_m; }
  double operator()(const Capsule& c) const { return std::min((world * c.a_m).y, (world * c.b_m).y) - c.radius_m; }
  double operator()(const Box& b) const {
    const Mat3 r = glm::mat3_cast(world.q * from_rotation_vector(b.rotation_deg * kRadPerDeg));
    double low = (world * b.center_m).y;
    for (int i = 0; i < 3; ++i) low -= std::fabs(r[i].y) * b.half_m[i];
    return low;
  }
  double operator()(const ConvexHull& hull) const {
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3& p : hull.points_m) low = std::min(low, (world * p).y);
    return low;
  }
};

std::string names_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

template <class T>
std::string names_of(const std::map<std::string, T>& items) {
  std::vector<std::string> names;
  for (const auto& [name, item] : items) names.push_back(name);
  return names_of(names);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Issue unknown(const std::string& code, const std::string& pointer, const std::string& found,
              const std::string& allowed) {
  return {
      "character." + code, pointer,
      "found \"" + found + "\", allowed are " + (allowed.empty() ? "none" : allowed) + did_you_mean(found, allowed)};
}

Issue in_file(const std::string& name, Issue issue) {
  issue.text = name + ".json: " + issue.text;
  return issue;
}

}  // namespace

class CharacterBuilder {
 public:
  CharacterBuilder(const CharacterChoice& choice, const Library& library) : choice_(choice), library_(library) {}

  Result<Character> build() {
    const auto found = library_.characters.find(choice_.name);
    if (found == library_.characters.end())
      return unknown("unknown_character", "/name", choice_.name, names_of(library_.characters));
    desc_ = &found->second;
    for (const auto step : {&CharacterBuilder::check_choice, &CharacterBuilder::add_slots,
                            &CharacterBuilder::add_attachments, &CharacterBuilder::add_pairs})
      if (const Result<Done> done = (this->*step)(); !done) return done.issue();
    take_over();
    if (const Result<Done> done = add_control_groups(); !done) return done.issue();
    if (const Result<Done> done = add_regions(); !done) return done.issue();
    out_.withstands_N_s_ = desc_->withstands_N_s;
    set_rest();
    out_.hash_ = hash_of(out_);
    return std::move(out_);
  }

 private:
  Result<Done> check_choice() {
    std::vector<std::string> slots;
    for (const SlotDesc& slot : desc_->slots) slots.push_back(slot.name);
    for (const auto& [slot, part] : choice_.parts)
      if (!contains(slots, slot)) return unknown("unknown_slot", "/parts/" + slot, slot, names_of(slots));
    return Done{};
  }

  Result<Done> add_slots() {
    Joint root;
    root.name = root.local_name = "root";
    assembly_.joints.push_back(root);
    if (desc_->slots.empty()) return Issue{"character.no_slot", "/name", desc_->name + " has no slot"};
    for (std::size_t i = 0; i < desc_->slots.size(); ++i)
      if (const Result<Done> added = add_slot(desc_->slots[i], i == 0); !added) return added;
    return Done{};
  }

  Result<Done> add_slot(const SlotDesc& slot, bool is_root) {
    if (slot.parts.empty())
      return in_file(desc_->name, {"character.no_part", "/name", "slot " + slot.name + " has no parts"});
    const auto chosen = choice_.parts.find(slot.name);
    const std::string pointer = "/parts/" + slot.name;
    const std::string& name = chosen == choice_.parts.end() ? slot.parts.front() : chosen->second;
    if (!contains(slot.parts, name)) return unknown("unknown_part", pointer, name, names_of(slot.parts));
    const auto part = library_.parts.find(name);
    if (part == library_.parts.end())
      return in_file(desc_->name, unknown("unknown_part", pointer, name, names_of(library_.parts)));
    if (part->second.kind != slot.kind)
      return in_file(name, {"character.wrong_kind", pointer,
                            "found kind \"" + part->second.kind + "\", the slot takes \"" + slot.kind + "\""});
    if (const Result<Done> rules = check_part(part->second); !rules) return in_file(name, rules.issue());
    for (const Part& earlier : assembly_.parts)
      if (earlier.slot == slot.name)
        return in_file(desc_->name, {"character.duplicate_name", "/name", "slot " + slot.name + " stands twice"});
    Dock dock;
    if (is_root != slot.on_slot.empty())
      return in_file(desc_->name,
                     {"character.bad_root", "/name", "the first slot, and no other, has an empty on_slot"});
    if (!is_root) {
      const int socket = find_socket(assembly_, slot.on_slot + "/" + slot.on_socket);
      if (socket < 0)
        return in_file(desc_->name, {"character.unknown_socket", pointer,
                                     "slot " + slot.name + " docks at \"" + slot.on_slot + "/" + slot.on_socket +
                                         "\", which is not there"});
      dock = dock_at(socket);
    }
    add_part(assembly_, slot, part->second, dock);
    return check_size(pointer);
  }

  Result<Done> check_size(const std::string& pointer) const {
    if (assembly_.joints.size() <= kMaxCharacterJoints && assembly_.colliders.size() <= kMaxCharacterColliders)
      return Done{};
    return Issue{"character.too_large", pointer,
                 "more than " + std::to_string(kMaxCharacterJoints) + " joints or " +
                     std::to_string(kMaxCharacterColliders) + " colliders in all"};
  }

  Dock dock_at(int socket) const {
    const Socket& s = assembly_.sockets[static_cast<std::size_t>(socket)];
    return {s.joint, s.joint_from_socket};
  }

  Result<Done> add_attachments() {
    std::vector<std::string> seen;
    for (std::size_t i = 0; i < choice_.attachments.size(); ++i) {
      const AttachmentDesc& attachment = choice_.attachments[i];
      const std::string pointer = "/attachments/" + std::to_string(i);
      const auto object = library_.objects.find(attachment.object);
      if (!contains(desc_->objects, attachment.object) || object == library_.objects.end())
        return unknown("unknown_object", pointer + "/object", attachment.object, names_of(desc_->objects));
      if (contains(seen, attachment.object))
        return Issue{"character.duplicate_object", pointer + "/object",
                     "\"" + attachment.object + "\" is attached already"};
      if (const Result<Done> rules = check_object(object->second); !rules)
        return in_file(attachment.object, rules.issue());
      const int socket = find_socket(assembly_, attachment.slot + "/" + attachment.socket);
      if (socket < 0)
        return unknown("unknown_socket", pointer + "/socket", attachment.slot + "/" + attachment.socket,
                       socket_names());
      add_object(assembly_, object->second, dock_at(socket));
      if (const Result<Done> size = check_size(pointer); !size) return size;
      seen.push_back(attachment.object);
    }
    return Done{};
  }

  std::string socket_names() const {
    std::vector<std::string> names;
    for (const Socket& socket : assembly_.sockets) names.push_back(socket.name);
    return names_of(names);
  }

  // Ignores pairs of parts that are not in use: they apply when the parts are swapped in.
  Result<Done> add_pairs() {
    std::vector<Body> bodies = group_colliders(assembly_);
    std::vector<AllowedPair> by_user;
    for (const AllowedPairDesc& pair : desc_->allowed_pairs) {
      const int a = find_collider_index(pair.a);
      const int b = find_collider_index(pair.b);
      if (a >= 0 && b >= 0 && a != b) by_user.push_back({std::min(a, b), std::max(a, b), "user: " + pair.reason});
    }
    CollisionPlan plan = plan_collisions(assembly_, std::move(bodies), by_user);
    out_.bodies_ = std::move(plan.bodies);
    out_.allowed_pairs_ = std::move(plan.allowed);
    out_.judged_colliders_ = std::move(plan.colliders);
    out_.judged_pairs_ = std::move(plan.judged);
    return Done{};
  }

  int find_collider_index(const std::string& name) const {
    for (std::size_t i = 0; i < assembly_.colliders.size(); ++i)
      if (assembly_.colliders[i].name == name) return static_cast<int>(i);
    return -1;
  }

  void take_over() {
    out_.name_ = desc_->name;
    out_.joints_ = std::move(assembly_.joints);
    out_.parts_ = std::move(assembly_.parts);
    out_.colliders_ = std::move(assembly_.colliders);
    out_.mesh_ = std::move(assembly_.mesh);
    out_.sockets_ = std::move(assembly_.sockets);
    out_.coord_count_ = assembly_.coord_count;
    for (const ActionDesc& action : library_.actions)
      if (std::any_of(out_.parts_.begin(), out_.parts_.end(), [&](const Part& part) { return is_for(action, part); }))
        out_.actions_.push_back(action);
  }

  void set_rest() {
    out_.rest_coords_.assign(static_cast<std::size_t>(out_.coord_count_), 0.0);
    std::vector<Rigid> world(out_.joints_.size());
    for (std::size_t i = 1; i < out_.joints_.size(); ++i) {
      const Joint& joint = out_.joints_[i];
      world[i] = world[static_cast<std::size_t>(joint.parent)] * joint.parent_from_joint;
      if (joint.kind == JointKind::ball) out_.rest_coords_[static_cast<std::size_t>(joint.coord)] = 1.0;
    }
    double lowest = out_.colliders_.empty() ? 0.0 : std::numeric_limits<double>::infinity();
    for (const Collider& c : out_.colliders_)
      lowest = std::min(lowest, std::visit(LowestPoint{world[static_cast<std::size_t>(c.joint)]}, c.shape));
    out_.rest_root_ = {kNoRotation, Vec3(0.0, -lowest, 0.0)};
  }

  // Control solves for eight handles at once, so a group has at most eight.
  Result<Done> add_control_groups() {
    for (std::size_t i = 0; i < desc_->control_groups.size(); ++i) {
      const ControlGroupDesc& desc = desc_->control_groups[i];
      JointGroup group{desc.name, {}, desc.greatest};
      int handles = 0;
      for (const std::string& name : desc.joints) {
        const int found = out_.find_joint(name);
        if (found < 0) continue;
        const JointKind kind = out_.joints_[static_cast<std::size_t>(found)].kind;
        handles += kind == JointKind::root ? 4 : kind == JointKind::ball ? 2 : 1;
        group.joints.push_back(found);
      }
      if (handles > 8)
        return in_file(desc_->name,
                       {"character.too_many_handles", "/control_groups/" + std::to_string(i) + "/joints",
                        "\"" + desc.name + "\" has " + std::to_string(handles) + " freedoms, allowed are 8"});
      if (!group.joints.empty()) out_.control_groups_.push_back(std::move(group));
    }
    return Done{};
  }

  // Ignores a region whose point belongs to a part that is not in use. A point that no part of the slot has is an
  // error.
  Result<Done> add_regions() {
    for (std::size_t i = 0; i < desc_->regions.size(); ++i) {
      const RegionDesc& desc = desc_->regions[i];
      const std::string pointer = "/regions/" + std::to_string(i);
      for (std::size_t k = 0; k < i; ++k)
        if (desc_->regions[k].name == desc.name)
          return in_file(desc_->name,
                         {"character.duplicate_name", pointer + "/name", "\"" + desc.name + "\" stands twice"});
      Region region{desc.name, out_.find_joint(desc.point), Vec3(0.0), desc.shape, desc.keep_out};
      if (const int socket = out_.find_socket(desc.point); socket >= 0) {
        region.joint = out_.sockets_[static_cast<std::size_t>(socket)].joint;
        region.point_m = out_.sockets_[static_cast<std::size_t>(socket)].joint_from_socket.p_m;
      }
      if (region.joint >= 0)
        out_.regions_.push_back(std::move(region));
      else if (!some_part_has(desc.point))
        return in_file(desc_->name, {"character.unknown_point", pointer + "/point",
                                     "no part of a slot has \"" + desc.point + "\" as a socket or joint"});
    }
    return Done{};
  }

  bool some_part_has(const std::string& point) const {
    const auto is_named = [&](const SlotDesc& slot, const auto& owned) {
      return std::any_of(owned.begin(), owned.end(), [&](const auto& o) { return slot.name + "/" + o.name == point; });
    };
    for (const SlotDesc& slot : desc_->slots)
      for (const std::string& name : slot.parts)
        if (const auto part = library_.parts.find(name); part != library_.parts.end())
          if (is_named(slot, part->second.sockets) || is_named(slot, part->second.joints)) return true;
    return false;
  }

  const CharacterChoice& choice_;
  const Library& library_;
  const CharacterDesc* desc_ = nullptr;
  Assembly assembly_;
  Character out_;
};

Result<Character> build_character(const CharacterChoice& choice, const Library& library) {
  return CharacterBuilder(choice, library).build();
}

namespace {

template <class T>
int find_named(std::span<const T> items, std::string_view name) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace

bool is_for(const ActionDesc& action, const Part& part) {
  const auto among = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return among(action.parts, part.name) || among(action.kinds, part.kind);
}

int Character::find_part(std::string_view slot) const {
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (parts_[i].slot == slot) return static_cast<int>(i);
  return -1;
}

int Character::find_joint(int part, std::string_view local_name) const {
  const Part& p = parts_[static_cast<std::size_t>(part)];
  for (int i = p.first_joint; i < p.first_joint + p.joint_count; ++i)
    if (joints_[static_cast<std::size_t>(i)].local_name == local_name) return i;
  return -1;
}

int Character::find_joint(std::string_view name) const { return find_named(joints(), name); }
int Character::find_socket(std::string_view name) const { return find_named(sockets(), name); }
int Character::find_collider(std::string_view name) const { return find_named(colliders(), name); }

int carrier_of(const Character& character, int part) {
  const Part& own = character.parts()[static_cast<std::size_t>(part)];
  if (own.joint_count == 0 || part == 0) return 0;
  const int joint = character.joints()[static_cast<std::size_t>(own.first_joint)].parent;
  return character.joints()[static_cast<std::size_t>(joint)].part;
}

}  // namespace contort
