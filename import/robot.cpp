#include "import/robot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "checks/joint_map.h"
#include "import/contacts.h"
#include "import/robot_linkage.h"
#include "import/robot_parts.h"
#include "model/character/library.h"
#include "model/core/index.h"
#include "model/core/number_text.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr std::size_t kMostSampledPoses = 100;
constexpr std::size_t kMostSampledPairs = 1'000'000;  // greatest number of pairs in all poses together
constexpr std::size_t kMostAllowedPairs = 10000;      // as many as a character's file may list
constexpr double kStrengthShare = 0.25;               // as a fraction of weight times height, as for a spine

double mass_of(const Linkage& linkage) {
  double mass_kg = 0.0;
  for (const RobotLink& link : linkage.links) mass_kg += link.inertia.mass_kg;
  return mass_kg;
}

// The length of the longest chain, as the robot's size before it is built.
double reach_of(const Linkage& linkage) {
  std::vector<double> reach_m(linkage.links.size(), 0.0);
  for (std::size_t i = 1; i < linkage.links.size(); ++i) {
    reach_m[i] = reach_m[at(linkage.links[i].parent)];
    for (const JointDesc& joint : linkage.links[i].joints) reach_m[i] += length(joint.position_m);
  }
  return *std::max_element(reach_m.begin(), reach_m.end());
}

// Parses the files that were made. These count, not the data from which they were made.
Result<Character> build_robot(const ImportedRobot& robot) {
  Library library;
  for (const PartDesc& part : robot.parts) {
    const Result<PartDesc> read = parse_part(print_part(part));
    if (!read) return Issue{read.issue().code, read.issue().pointer, part.name + ": " + read.issue().text};
    library.parts[part.name] = *read;
  }
  const Result<CharacterDesc> character = parse_character(print_character(robot.character));
  if (!character) return character.issue();
  library.characters[character->name] = *character;
  return build_character({robot.character.name, {}, {}}, library);
}

// Knows the pairs of shapes that the file allows to touch, by the names of their bodies or by MJCF's groups.
class FilePairs {
 public:
  FilePairs(const RobotModel& robot, const Linkage& linkage, const RobotParts& parts) : linkage_(linkage) {
    for (const RobotPair& pair : robot.may_touch)
      reasons_.emplace(std::pair(std::min(pair.a, pair.b), std::max(pair.a, pair.b)), pair.reason);
    for (const RobotCollider& collider : parts.colliders) colliders_[collider.name] = &collider;
  }

  // Returns the reason for which two shapes may touch; "" if their contact is a fault.
  std::string reason(const std::string& a, const std::string& b) const {
    const LinkageShape &first = shape(a), &second = shape(b);
    const auto named = reasons_.find({std::min(first.body, second.body), std::max(first.body, second.body)});
    if (named != reasons_.end()) return named->second;
    const bool meets = (first.groups & second.partners) != 0 || (second.groups & first.partners) != 0;
    return meets ? "" : "MJCF: contype and conaffinity";
  }

 private:
  const LinkageShape& shape(const std::string& name) const {
    const RobotCollider& collider = *colliders_.at(name);
    return linkage_.links[at(collider.link)].shapes[at(collider.shape)];
  }

  const Linkage& linkage_;
  std::map<std::pair<std::string, std::string>, std::string> reasons_;
  std::map<std::string, const RobotCollider*> colliders_;
};

void allow_by_file(const Character& character, const FilePairs& pairs, ImportedRobot& out) {
  for (const ColliderPair& pair : character.judged_colliders()) {
    const std::string& a = character.colliders()[at(pair.a)].name;
    const std::string& b = character.colliders()[at(pair.b)].name;
    if (const std::string reason = pairs.reason(a, b); !reason.empty())
      out.character.allowed_pairs.push_back({a, b, reason.substr(0, 100)});
  }
  out.pairs_of_file = static_cast<int>(out.character.allowed_pairs.size());
}

// Hulls and guessed capsules are larger than the real shapes, so some of them always overlap.
void allow_unavoidable(const Character& character, ImportedRobot& out) {
  const std::size_t pairs = std::max<std::size_t>(character.judged_colliders().size(), 1);
  const std::size_t poses = std::clamp<std::size_t>(kMostSampledPairs / pairs, 1, kMostSampledPoses);
  const OwnContacts contacts = propose_contacts(character, static_cast<int>(poses));
  for (const AllowedPairDesc& pair : contacts.pairs) out.character.allowed_pairs.push_back(pair);
  out.pairs_at_rest = static_cast<int>(contacts.pairs.size());
}

double height_of(const Character& character) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  for (const Collider& collider : character.colliders())
    for (const Vec3& p : tessellate(as_mesh(collider.shape)).positions_m) {
      const double y = (world[at(collider.joint)] * p).y;
      low = std::min(low, y), high = std::max(high, y);
    }
  return character.colliders().empty() ? 0.0 : high - low;
}

void take_over(const Linkage& linkage, const RobotModel& robot, const RobotParts& parts, const std::string& name,
               ImportedRobot& out) {
  out.parts = parts.parts;
  out.character.name = name;
  const char* source = robot.is_skeleton ? "a skeleton of motion capture" : "a robot's description";
  out.is_skeleton = robot.is_skeleton;
  out.character.help = std::string("Imported from ") + source + "; " + name + ".import.md says what was guessed.";
  out.character.slots = parts.slots;
  for (std::size_t i = 0; i < robot.bodies.size(); ++i)
    if (const std::string& body = robot.bodies[i].name; body.size() <= 200)
      out.joint_of_body[body] = parts.joint_of_link[at(linkage.link_of_body[i])];
  out.joints = linkage.reports;
  out.notes = linkage.notes;
  if (!robot.has_free_root)
    out.notes.push_back("The file does not say that body " + robot.bodies.front().name +
                        " moves freely, so it may be bolted to the ground; the root of a character moves freely.");
}

// Several hinges at one point share their body's rotation, so the first of them is named. Otherwise it is the last
// joint.
std::string joint_of_body(const Linkage& linkage, std::size_t link, const std::string& last) {
  const RobotLink& own = linkage.links[link];
  for (std::size_t i = 0; i < own.joints.size(); ++i)
    if (own.joints[i].type != JointType::hinge || (i > 0 && own.joints[i].position_m != Vec3(0.0))) return last;
  return own.joints.empty() ? last : linkage.reports[at(own.reports.front())].joint;
}

// Bodies that are fixed to their parents have no joint of their own, so only one body of a joint is in the map.
std::map<std::string, std::string> map_of_bodies(const ImportedRobot& robot, const Linkage& linkage,
                                                 const RobotParts& parts) {
  std::map<std::string, std::string> out;
  for (std::size_t i = 0; i < linkage.links.size(); ++i)
    if (robot.joint_of_body.contains(linkage.links[i].body)) 
      out[linkage.links[i].body] = joint_of_body(linkage, i, parts.joint_of_link[i]);
  return out;
}

// Joints with several degrees of freedom, or without a name of their own, have no single value and are left out.
FileJoints values_of(const std::vector<RobotJointReport>& joints) {
  constexpr double kMostValue = 1e6;
  FileJoints out;
  std::set<std::string> taken;
  for (const RobotJointReport& report : joints) {
    const RobotJoint& joint = report.in_file;
    const std::string& name = report.file_name;
    if (name.empty() || name.size() > 200 || !taken.insert(name).second) {
      out.erase(name);
      continue;
    }
    const double greatest = std::max({std::fabs(report.rest), std::fabs(joint.multiplier), std::fabs(joint.offset)});
    if (joint.kind != RobotJointKind::ball && greatest <= kMostValue)
      out[name] = {report.joint, report.rest, joint.follows, joint.multiplier, joint.offset};
  }
  return out;
}

void write_robot_files(const std::map<std::string, std::string>& map, const Quat& root, ImportedRobot& out) {
  const std::array<double, 4> root_rotation{root.x, root.y, root.z, root.w};
  const std::string& name = out.character.name;
  for (const PartDesc& part : out.parts) out.files.push_back({part.name + ".json", print_part(part)});
  out.files.push_back({name + ".json", print_character(out.character)});
  out.files.push_back({"maps/" + name + ".json", print_joint_map({map, values_of(out.joints), root_rotation})});
  out.files.push_back({name + ".import.md", write_robot_report(out)});
}

void note_guesses(const Linkage& linkage, ImportedRobot& out) {
  int guessed = 0;
  for (const RobotLink& link : linkage.links)
    for (const LinkageShape& shape : link.shapes) guessed += shape.is_guessed;
  if (guessed > 0)
    out.notes.push_back(std::to_string(guessed) +
                        " colliders are capsules that were guessed from a body's mass and inertia, as its mesh was "
                        "not read: contacts of these are only estimates.");
}

}  // namespace

Result<ImportedRobot> import_robot(const RobotModel& robot, const std::string& name) {
  if (const Result<Done> named = check_import_name(name); !named) return named.issue();
  Linkage linkage = linkage_of(robot);
  const double strength_Nm = std::max(kStrengthShare * 9.81 * mass_of(linkage) * reach_of(linkage), 1.0);
  const Result<RobotParts> parts = cut_robot(linkage, name, strength_Nm);
  if (!parts) return parts.issue();
  ImportedRobot out;
  take_over(linkage, robot, *parts, name, out);
  note_guesses(linkage, out);
  if (!(mass_of(linkage) > 0.0))
    out.notes.push_back("The file declares no masses: motions with masses and strengths say nothing about this robot.");
  const Result<Character> plain = build_robot(out);
  if (!plain) return plain.issue();
  allow_by_file(*plain, FilePairs(robot, linkage, *parts), out);
  if (out.character.allowed_pairs.size() > kMostAllowedPairs)
    return Issue{"import.too_many_pairs", "", "the file lets more than 10000 pairs of shapes touch"};
  const Result<Character> sorted = build_robot(out);
  if (!sorted) return sorted.issue();
  allow_unavoidable(*sorted, out);
  const Result<Character> character = build_robot(out);
  if (!character) return character.issue();
  for (const Joint& joint : character->joints()) out.mass_kg += joint.mass_kg;
  out.height_m = height_of(*character);
  write_robot_files(map_of_bodies(out, linkage, *parts), robot.bodies.front().parent_from_body.q, out);
  return out;
}

}  // namespace contort
