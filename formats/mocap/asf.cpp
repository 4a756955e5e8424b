#include "formats/mocap/asf.h"

#include <limits>
#include <map>
#include <optional>

#include "formats/mocap/limits.h"
#include "formats/mocap/words.h"

namespace contort {

namespace {

constexpr MocapSyntax kAsfSyntax{.area = "asf", .alone = "", .blank = "()", .comment = '#'};
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// The factor for limits and axes. All known files declare the unit before the bones, but nothing requires this, so the
// factor is applied at the end.
double to_rad(const AsfSkeleton& skeleton) { return skeleton.is_in_degrees ? kRadPerDeg : 1.0; }

// A bone as written in the file, with angles in the file's unit.
struct RawBone {
  AsfBone bone;
  Vec3 axis_angles{0.0};
};

struct AsfText {
  AsfSkeleton skeleton;
  std::vector<RawBone> bones = {RawBone{}};  // the root, and the bones that bonedata adds
  std::map<std::string, int, std::less<>> index = {{"root", 0}};
};

std::optional<DofKind> dof_kind(std::string_view word) {
  for (std::size_t i = 0; i < kDofNames.size(); ++i)
    if (is_same_word(word, kDofNames[i])) return static_cast<DofKind>(i);
  return {};
}

void read_units(MocapWords& words, AsfSkeleton& out) {
  while (words.has_more() && !words.peek().starts_with(':')) {
    const std::string_view what = words.next();
    if (is_same_word(what, "length")) {
      out.length_unit = words.number(kMaxMocapLength);
      if (words.ok() && !(out.length_unit > 0.0)) words.fail("out_of_range", "the unit of length must be more than 0");
    } else if (is_same_word(what, "angle")) {
      const std::string_view unit = words.next();
      out.is_in_degrees = is_same_word(unit, "deg");
      if (!out.is_in_degrees && !is_same_word(unit, "rad"))
        words.fail("bad_syntax", "found " + quoted_word(unit) + " as the unit of angles, allowed are deg and rad");
    }
    words.skip_line();
  }
}

void read_dofs(MocapWords& words, AsfBone& bone) {
  while (!words.line_ends()) {
    const std::string_view word = words.next();
    const std::optional<DofKind> kind = dof_kind(word);
    bool is_known = false;
    for (const AsfDof& dof : bone.dofs) is_known = is_known || dof.kind == kind;
    if (!kind || is_known)
      return words.fail("bad_dof", "found " + quoted_word(word) + ", allowed are rx ry rz tx ty tz l, each once");
    bone.dofs.push_back({*kind, -kUnlimited, kUnlimited});
  }
}

// Reads the order in which rotations are applied: "XYZ".
void read_turn_order(MocapWords& words, AsfBone& bone) {
  const std::string_view word = words.next();
  std::array<bool, 3> known{};
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = word.size() == 3 ? word[i] : '?';
    const int axis = letter == 'X' || letter == 'x' ? 0 : letter == 'Y' || letter == 'y' ? 1 : 2;
    if ((axis == 2 && letter != 'Z' && letter != 'z') || known[static_cast<std::size_t>(axis)])
      return words.fail("bad_syntax", "found " + quoted_word(word) + ", allowed are the letters X, Y and Z, each once");
    known[static_cast<std::size_t>(axis)] = true;
    bone.turn_order[i] = axis;
  }
}

// A limit may be "inf" or "-inf".
double read_limit(MocapWords& words) {
  const std::string_view word = words.peek();
  for (const double infinite : {kUnlimited, -kUnlimited})
    if (is_same_word(word, infinite > 0 ? "inf" : "-inf")) return words.next(), infinite;
  return words.number(kMaxMocapAngle_deg);
}

// Reads one pair for each degree of freedom, often over several lines.
void read_limits(MocapWords& words, AsfBone& bone) {
  if (bone.dofs.empty()) words.fail("wrong_count", "found limits before any degree of freedom");
  for (AsfDof& dof : bone.dofs) {
    dof.low = read_limit(words);
    dof.high = read_limit(words);
    if (words.ok() && !(dof.low <= dof.high))
      return words.fail("bad_limit",
                        "the lower limit of " + std::string(dof_name(dof.kind)) + " is above the upper one");
  }
  if (words.ok() && !words.line_ends()) words.fail("wrong_count", "found more limits than degrees of freedom");
}

void read_root(MocapWords& words, AsfText& out) {
  RawBone& root = out.bones.front();
  while (words.has_more() && !words.peek().starts_with(':')) {
    const std::string_view what = words.next();
    if (is_same_word(what, "order"))
      read_dofs(words, root.bone);
    else if (is_same_word(what, "axis"))
      read_turn_order(words, root.bone);
    else if (is_same_word(what, "position"))
      out.skeleton.root_position = words.vector(kMaxMocapLength);
    else if (is_same_word(what, "orientation"))
      root.axis_angles = words.vector(kMaxMocapAngle_deg);
    else
      words.skip_line();
  }
}

void read_bone_line(MocapWords& words, RawBone& out) {
  const std::string_view what = words.next();
  AsfBone& bone = out.bone;
  if (is_same_word(what, "name")) {
    bone.name = words.rest_of_line();
  } else if (is_same_word(what, "direction")) {
    bone.direction = words.vector(kMaxMocapDirection);
  } else if (is_same_word(what, "length")) {
    bone.length = words.number(kMaxMocapLength);
  } else if (is_same_word(what, "axis")) {
    out.axis_angles = words.vector(kMaxMocapAngle_deg);
    read_turn_order(words, bone);
  } else if (is_same_word(what, "dof")) {
    read_dofs(words, bone);
  } else if (is_same_word(what, "limits")) {
    read_limits(words, bone);
  } else {
    words.skip_line();  // id, mass and additions of other programs
  }
}

void read_bones(MocapWords& words, AsfText& out) {
  while (is_same_word(words.peek(), "begin")) {
    words.next();
    RawBone raw;
    while (words.has_more() && !is_same_word(words.peek(), "end") && !words.peek().starts_with(':'))
      read_bone_line(words, raw);
    words.expect("end");
    if (out.bones.size() >= kMaxMocapNodes)
      words.fail("too_large", "found more than the allowed " + std::to_string(kMaxMocapNodes) + " bones");
    if (words.ok() && (raw.bone.name.empty() || out.index.contains(raw.bone.name)))
      words.fail("bad_bone", "a bone needs a name of its own, found " + quoted_word(raw.bone.name));
    out.index.emplace(raw.bone.name, static_cast<int>(out.bones.size()));
    out.bones.push_back(std::move(raw));
  }
}

int find_bone(MocapWords& words, const AsfText& text, std::string_view name) {
  const auto found = text.index.find(name);
  if (found != text.index.end()) return found->second;
  words.fail("unknown_bone", "there is no bone " + quoted_word(name));
  return 0;
}

// Reads lines of a bone and its children. The first bone of a line is the parent of all others, and no bone has two
// parents.
void read_tree(MocapWords& words, AsfText& out) {
  words.expect("begin");
  while (words.has_more() && !is_same_word(words.peek(), "end")) {
    const int parent = find_bone(words, out, words.next());
    while (words.ok() && !words.line_ends()) {
      const std::string_view name = words.next();
      const int child = find_bone(words, out, name);
      if (!words.ok()) return;
      int& known = out.bones[static_cast<std::size_t>(child)].bone.parent;
      if (child == 0 || known >= 0)
        return words.fail("bad_hierarchy", quoted_word(name) + (child == 0 ? " has a parent" : " has two parents"));
      known = parent;
    }
  }
  words.expect("end");
}

void read_section(MocapWords& words, AsfText& out) {
  const std::string_view section = words.next();
  if (is_same_word(section, ":name")) {
    out.skeleton.name = words.rest_of_line();
  } else if (is_same_word(section, ":units")) {
    read_units(words, out.skeleton);
  } else if (is_same_word(section, ":root")) {
    read_root(words, out);
  } else if (is_same_word(section, ":bonedata")) {
    read_bones(words, out);
  } else if (is_same_word(section, ":hierarchy")) {
    read_tree(words, out);
  } else if (section.starts_with(':')) {  // version, documentation, skin …
    do words.skip_line();
    while (words.has_more() && !words.peek().starts_with(':'));
  } else {
    words.fail("bad_syntax", "found " + quoted_word(section) + ", expected a section like :bonedata");
  }
}

// Orders the bones: parents before children, without recursion. Bones that the root does not reach form a ring, or are
// in no tree.
Result<Done> order_bones(AsfSkeleton& skeleton) {
  std::vector<std::vector<int>> children(skeleton.bones.size());
  for (std::size_t i = 1; i < skeleton.bones.size(); ++i)
    if (const int parent = skeleton.bones[i].parent; parent >= 0)
      children[static_cast<std::size_t>(parent)].push_back(static_cast<int>(i));
  std::vector<int> open = {0};
  while (!open.empty()) {
    const int bone = open.back();
    open.pop_back();
    skeleton.order.push_back(bone);
    const std::vector<int>& next = children[static_cast<std::size_t>(bone)];
    open.insert(open.end(), next.rbegin(), next.rend());
  }
  if (skeleton.order.size() == skeleton.bones.size()) return Done{};
  return Issue{"asf.bad_hierarchy", "",
               std::to_string(skeleton.bones.size() - skeleton.order.size()) + " bones are not below the root"};
}

Quat turn(const std::array<int, 3>& order, const Vec3& angles_rad) {
  Quat q = kNoRotation;
  for (const int axis : order) {
    Vec3 unit(0.0);
    unit[axis] = 1.0;
    q = axis_angle(unit, angles_rad[axis]) * q;
  }
  return glm::normalize(q);
}

void finish_bone(RawBone& raw, double rad, std::vector<AsfBone>& out) {
  raw.bone.axis = turn(raw.bone.turn_order, raw.axis_angles * rad);
  for (AsfDof& dof : raw.bone.dofs)
    if (is_rotation(dof.kind)) dof.low *= rad, dof.high *= rad;
  out.push_back(std::move(raw.bone));
}

}  // namespace

Result<AsfSkeleton> parse_asf(std::string_view text) {
  MocapWords words(kAsfSyntax, text);
  AsfText raw;
  raw.bones.front().bone.name = "root";
  while (words.has_more()) read_section(words, raw);
  if (words.ok() && raw.bones.front().bone.dofs.empty())
    words.fail("truncated", "there is no :root with an order of degrees of freedom");
  if (!words.ok()) return words.issue();
  AsfSkeleton& skeleton = raw.skeleton;
  for (RawBone& bone : raw.bones) finish_bone(bone, to_rad(skeleton), skeleton.bones);
  if (const Result<Done> ordered = order_bones(skeleton); !ordered) return ordered.issue();
  return std::move(skeleton);
}

Result<AsfSkeleton> read_asf(const std::string& path) {
  const Result<std::string> text = read_mocap_text(path, "asf");
  if (!text) return text.issue();
  return parse_asf(*text);
}

}  // namespace contort
