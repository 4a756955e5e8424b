#include "formats/mocap/amc.h"

#include <algorithm>
#include <charconv>
#include <map>

#include "formats/mocap/limits.h"
#include "formats/mocap/words.h"
#include "model/asset/labels.h"

namespace contort {

namespace {

constexpr MocapSyntax kAmcSyntax{.area = "amc", .alone = "", .blank = "", .comment = '#'};

// The place of a bone's numbers in a row.
struct BonePlace {
  const AsfBone* bone = nullptr;
  std::size_t first_dof = 0;
};
struct BonePlaces {
  std::map<std::string_view, BonePlace> of_bone;
  std::int64_t turned_and_moved = 0;  // number of bones that turn and of bones that move: each has keys
};

bool turns(const AsfBone& bone) {
  return std::ranges::any_of(bone.dofs, [](const AsfDof& dof) { return is_rotation(dof.kind); });
}
bool moves(const AsfBone& bone) {
  return std::ranges::any_of(bone.dofs,
                             [](const AsfDof& dof) { return dof.kind >= DofKind::tx && dof.kind <= DofKind::tz; });
}

BonePlaces places_of(const AsfSkeleton& skeleton) {
  BonePlaces out;
  std::size_t dof = 0;
  for (const AsfBone& bone : skeleton.bones) {
    out.of_bone[bone.name] = {&bone, dof};
    out.turned_and_moved += (turns(bone) ? 1 : 0) + (moves(bone) ? 1 : 0);
    dof += bone.dofs.size();
  }
  return out;
}

// Returns true if the word is a whole number; such a line is the number of a frame.
bool is_frame_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

void read_frame_number(MocapWords& words, AmcMotion& motion) {
  const int number = words.count("a frame", 1'000'000'000);
  if (motion.frame_count == 0) motion.first_frame = number;
  const int expected = motion.first_frame + motion.frame_count;
  if (number != expected)
    words.fail("bad_frame", "found frame " + std::to_string(number) + ", expected " + std::to_string(expected));
}

void read_bone(MocapWords& words, const BonePlaces& places, double rad, std::vector<bool>& known,
               std::span<double> row) {
  const std::string_view name = words.next();
  const auto found = places.of_bone.find(name);
  if (found == places.of_bone.end()) return words.fail("unknown_bone", "the skeleton has no bone " + quoted_word(name));
  const auto& [bone, first_dof] = found->second;
  if (bone->dofs.empty() || known[first_dof])
    return words.fail("bad_bone", quoted_word(name) + (bone->dofs.empty() ? " does not move in this skeleton"
                                                                          : " stands twice in this frame"));
  for (std::size_t i = 0; i < bone->dofs.size() && words.ok(); ++i) {
    if (words.line_ends())
      return words.fail("too_few_values", "found " + std::to_string(i) + " numbers, " + quoted_word(name) + " has " +
                                              std::to_string(bone->dofs.size()) + " degrees of freedom");
    const bool is_angle = is_rotation(bone->dofs[i].kind);
    row[first_dof + i] = words.number(is_angle ? kMaxMocapAngle_deg : kMaxMocapLength) * (is_angle ? rad : 1.0);
    known[first_dof + i] = true;
  }
  if (words.ok() && !words.line_ends())
    words.fail("too_many_values", "found more numbers than the " + std::to_string(bone->dofs.size()) +
                                      " degrees of freedom of " + quoted_word(name));
}

// Checks the size before memory is taken for one more frame.
void check_size(MocapWords& words, const AmcMotion& motion, std::int64_t turned_and_moved) {
  const std::int64_t frames = std::int64_t{motion.frame_count} + 1;
  if (frames * motion.dof_count > kMaxMocapNumbers)
    words.fail("too_large", "found more than the allowed " + std::to_string(kMaxMocapNumbers) + " numbers");
  if (frames * turned_and_moved > kMaxMocapKeys)
    words.fail("too_large", "found more than the allowed " + std::to_string(kMaxMocapKeys) + " keys");
}

void read_frame(MocapWords& words, const BonePlaces& places, double rad, AmcMotion& motion) {
  read_frame_number(words, motion);
  const auto dofs = static_cast<std::size_t>(motion.dof_count);
  check_size(words, motion, places.turned_and_moved);
  if (!words.ok()) return;
  motion.values.resize(motion.values.size() + dofs);
  const std::span<double> row = std::span(motion.values).last(dofs);
  std::vector<bool> known(dofs, false);
  while (words.has_more() && !is_frame_number(words.peek())) read_bone(words, places, rad, known, row);
  if (words.ok() && std::find(known.begin(), known.end(), false) != known.end())
    words.fail("too_few_values", "frame " + std::to_string(motion.first_frame + motion.frame_count) +
                                     " does not name every bone that moves");
  ++motion.frame_count;
}

// Reads ":DEGREES" and other words before the first frame. Returns the factor for angles.
double read_header(MocapWords& words, const AsfSkeleton& skeleton) {
  bool in_degrees = skeleton.is_in_degrees;
  while (words.peek().starts_with(':')) {
    const std::string_view word = words.next();
    if (is_same_word(word, ":DEGREES")) in_degrees = true;
    if (is_same_word(word, ":RADIANS")) in_degrees = false;
    words.skip_line();
  }
  return in_degrees ? kRadPerDeg : 1.0;
}

// ---- as an asset

// R of a bone, from its numbers in a frame.
Quat turn_of(const AsfBone& bone, std::span<const double> values) {
  Quat q = kNoRotation;
  for (const int axis : bone.turn_order) {
    Vec3 unit(0.0);
    unit[axis] = 1.0;
    for (std::size_t i = 0; i < bone.dofs.size(); ++i)
      if (bone.dofs[i].kind == static_cast<DofKind>(axis)) q = axis_angle(unit, values[i]) * q;
  }
  return glm::normalize(bone.axis * q * glm::conjugate(bone.axis));
}

Vec3 shift_of(const AsfBone& bone, std::span<const double> values) {
  Vec3 p(0.0);
  for (std::size_t i = 0; i < bone.dofs.size(); ++i)
    if (const int axis = static_cast<int>(bone.dofs[i].kind) - static_cast<int>(DofKind::tx); axis >= 0 && axis < 3)
      p[axis] += values[i];
  return bone.axis * p;
}

std::vector<AssetNode> to_nodes(const AsfSkeleton& skeleton) {
  std::vector<std::string> names;
  for (const AsfBone& bone : skeleton.bones) names.push_back(bone.name);
  std::vector<std::string> labels = unique_labels(names);
  std::vector<AssetNode> nodes(names.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].name = std::move(names[i]);
    nodes[i].label = std::move(labels[i]);
    nodes[i].parent = skeleton.bones[i].parent;
    nodes[i].rest.translation = skeleton.root_position;
    if (nodes[i].parent < 0) continue;
    const AsfBone& parent = skeleton.bones[static_cast<std::size_t>(nodes[i].parent)];
    nodes[i].rest.translation = parent.length * parent.direction;
  }
  return nodes;
}

void add_bone_channels(const AsfBone& bone, int node, const Vec3& rest, std::size_t first_dof, const AmcMotion& motion,
                       const std::vector<double>& times_s, AssetClip& clip) {
  if (bone.dofs.empty()) return;  // saves time for thousands of fixed bones in millions of frames
  AssetChannel rotations{node, ChannelPath::rotation, Interpolation::linear, times_s, {}};
  AssetChannel shifts{node, ChannelPath::translation, Interpolation::linear, times_s, {}};
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    const std::span<const double> values = motion.row(frame).subspan(first_dof, bone.dofs.size());
    const Quat q = turn_of(bone, values);
    const Vec3 p = rest + shift_of(bone, values);
    rotations.values.insert(rotations.values.end(), {q.x, q.y, q.z, q.w});
    shifts.values.insert(shifts.values.end(), {p.x, p.y, p.z});
  }
  if (turns(bone)) clip.channels.push_back(std::move(rotations));
  if (moves(bone)) clip.channels.push_back(std::move(shifts));
}

}  // namespace

Result<AmcMotion> parse_amc(std::string_view text, const AsfSkeleton& skeleton) {
  MocapWords words(kAmcSyntax, text);
  const BonePlaces places = places_of(skeleton);
  AmcMotion motion;
  for (const AsfBone& bone : skeleton.bones) motion.dof_count += static_cast<int>(bone.dofs.size());
  const double rad = read_header(words, skeleton);
  while (words.has_more()) read_frame(words, places, rad, motion);
  if (words.ok() && motion.frame_count == 0) words.fail("truncated", "there is no frame");
  if (!words.ok()) return words.issue();
  return motion;
}

Result<AmcMotion> read_amc(const std::string& path, const AsfSkeleton& skeleton) {
  const Result<std::string> text = read_mocap_text(path, "amc");
  if (!text) return text.issue();
  return parse_amc(*text, skeleton);
}

Asset to_asset(const AsfSkeleton& skeleton, const AmcMotion& motion, double rate_hz, const std::string& clip_name) {
  Asset asset;
  asset.nodes = to_nodes(skeleton);
  asset.order = skeleton.order;
  AssetClip clip{clip_name, clip_name.empty() ? "#0" : clip_name, {}, 0.0, 0.0};
  std::vector<double> times_s;
  for (int frame = 0; frame < motion.frame_count; ++frame) times_s.push_back(frame / rate_hz);
  std::size_t dof = 0;
  for (std::size_t i = 0; i < skeleton.bones.size(); ++i) {
    add_bone_channels(skeleton.bones[i], static_cast<int>(i), asset.nodes[i].rest.translation, dof, motion, times_s,
                      clip);
    dof += skeleton.bones[i].dofs.size();
  }
  if (!clip.channels.empty()) clip.last_s = times_s.back();
  asset.clips.push_back(std::move(clip));
  return asset;
}

}  // namespace contort
