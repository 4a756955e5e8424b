#include "formats/mocap/bvh.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <set>
#include <span>

#include "formats/mocap/bvh_positions.h"
#include "formats/mocap/limits.h"
#include "formats/mocap/words.h"
#include "model/asset/labels.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

using Remarks = std::vector<Remark>;

constexpr MocapSyntax kBvhSyntax{.area = "bvh", .alone = "{}", .blank = ""};
constexpr std::array<std::string_view, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                           "Xrotation", "Yrotation", "Zrotation"};

// One number of each frame: its node, and the property of the node.
struct BvhChannel {
  int node = 0;
  int axis = 0;  // 0 x, 1 y, 2 z
  bool is_rotation = false;
};

// A node whose closing brace has not been read yet.
struct OpenNode {
  int node = 0;
  bool is_end_site = false;
  bool has_offset = false;
  bool has_channels = false;
};

struct Hierarchy {
  std::vector<AssetNode> nodes;
  std::vector<BvhChannel> channels;
};

void open_node(MocapWords& words, std::string name, bool is_end_site, std::vector<OpenNode>& open, Hierarchy& out) {
  if (out.nodes.size() >= kMaxMocapNodes)
    words.fail("too_large", "found more than the allowed " + std::to_string(kMaxMocapNodes) + " joints");
  if (open.size() >= kMaxMocapDepth)
    words.fail("too_deep", "joints are nested more than the allowed " + std::to_string(kMaxMocapDepth) + " deep");
  words.expect("{");
  if (!words.ok()) return;
  AssetNode node;
  node.name = std::move(name);
  node.parent = open.empty() ? -1 : open.back().node;
  node.is_joint = !is_end_site;
  open.push_back({static_cast<int>(out.nodes.size()), is_end_site, false, false});
  out.nodes.push_back(std::move(node));
}

void read_channels(MocapWords& words, OpenNode& joint, Hierarchy& out) {
  if (joint.has_channels) words.fail("bad_channel", "this joint has channels already");
  joint.has_channels = true;
  const int count = words.count("channels of a joint", static_cast<std::int64_t>(kChannelNames.size()));
  std::array<bool, kChannelNames.size()> known{};
  for (int i = 0; i < count && words.ok(); ++i) {
    const std::string_view word = words.next();
    std::size_t which = 0;
    while (which < kChannelNames.size() && !is_same_word(word, kChannelNames[which])) ++which;
    if (which == kChannelNames.size() || known[which])
      return words.fail("bad_channel", "found " + quoted_word(word) + ", allowed are Xposition … Zrotation, each once");
    known[which] = true;
    out.channels.push_back({joint.node, static_cast<int>(which % 3), which >= 3});
  }
}

void read_offset(MocapWords& words, OpenNode& node, Hierarchy& out) {
  if (node.has_offset) words.fail("bad_syntax", "this joint has an offset already");
  node.has_offset = true;
  out.nodes[static_cast<std::size_t>(node.node)].rest.translation = words.vector(kMaxMocapLength);
}

void close_node(MocapWords& words, std::vector<OpenNode>& open) {
  if (!open.back().has_offset) words.fail("bad_syntax", "this joint has no OFFSET");
  open.pop_back();
}

// Reads one statement inside a joint or an end site.
void read_statement(MocapWords& words, std::vector<OpenNode>& open, Hierarchy& out) {
  const std::string_view word = words.next();
  const bool in_joint = !open.back().is_end_site;
  if (word == "}") return close_node(words, open);
  if (is_same_word(word, "OFFSET")) return read_offset(words, open.back(), out);
  if (in_joint && is_same_word(word, "CHANNELS")) return read_channels(words, open.back(), out);
  if (in_joint && is_same_word(word, "JOINT"))
    return open_node(words, std::string(words.rest_of_line()), false, open, out);
  if (in_joint && is_same_word(word, "End")) {
    words.expect("Site");
    const std::string& joint = out.nodes[static_cast<std::size_t>(open.back().node)].name;
    return open_node(words, joint + " End Site", true, open, out);
  }
  words.fail("bad_syntax", "found " + quoted_word(word) + ", expected OFFSET, " +
                               (in_joint ? "CHANNELS, JOINT, End Site or }" : "or }"));
}

Hierarchy read_hierarchy(MocapWords& words) {
  Hierarchy out;
  words.expect("HIERARCHY");
  while (is_same_word(words.peek(), "ROOT") || (words.ok() && out.nodes.empty())) {
    words.expect("ROOT");
    std::vector<OpenNode> open;
    open_node(words, std::string(words.rest_of_line()), false, open, out);
    while (!open.empty() && words.has_more()) read_statement(words, open, out);
    if (!open.empty()) words.fail("truncated", "the text ends inside of the hierarchy");
  }
  return out;
}

// ---- motion

// The rotation and translation channels in the clip that receive a node's numbers; -1 for none.
struct NodeTargets {
  int rotation = -1;
  int translation = -1;
};

std::vector<NodeTargets> make_channels(const Hierarchy& hierarchy, std::size_t frames, AssetClip& clip) {
  std::vector<NodeTargets> targets(hierarchy.nodes.size());
  for (const BvhChannel& channel : hierarchy.channels) {
    NodeTargets& node = targets[static_cast<std::size_t>(channel.node)];
    int& target = channel.is_rotation ? node.rotation : node.translation;
    if (target >= 0) continue;
    target = static_cast<int>(clip.channels.size());
    const ChannelPath path = channel.is_rotation ? ChannelPath::rotation : ChannelPath::translation;
    clip.channels.push_back({channel.node, path, Interpolation::linear, {}, {}});
    clip.channels.back().values.reserve(frames * row_size(path));
  }
  return targets;
}

// Adds one key for every target of a node, from its numbers in a frame. Positions are kept as in the file; axes without
// a channel get OFFSET.
void add_keys(const AssetNode& node, const NodeTargets& targets, std::span<const BvhChannel> channels,
              std::span<const double> numbers, AssetClip& clip) {
  constexpr std::array<Vec3, 3> kAxes = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  Quat q = kNoRotation;
  Vec3 p = node.rest.translation;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].is_rotation)
      q = q * axis_angle(kAxes[static_cast<std::size_t>(channels[i].axis)], numbers[i] * kRadPerDeg);
    else
      p[channels[i].axis] = numbers[i];
  }
  q = glm::normalize(q);
  const auto append = [&clip](int target, std::initializer_list<double> row) {
    if (target < 0) return;
    std::vector<double>& values = clip.channels[static_cast<std::size_t>(target)].values;
    values.insert(values.end(), row);
  };
  append(targets.rotation, {q.x, q.y, q.z, q.w});
  append(targets.translation, {p.x, p.y, p.z});
}

// Reads the numbers of a line and returns how many it has. Only the last line of a text may have too few; on any other
// line a missing number would shift all that follow.
std::size_t read_frame(MocapWords& words, const std::vector<BvhChannel>& channels, std::vector<double>& numbers) {
  std::size_t count = 0;
  for (; count < channels.size() && words.ok() && (count == 0 || !words.line_ends()); ++count) {
    // The text may end inside a number.
    if (count + 1 < channels.size() && words.breaks_off()) return words.next(), count;
    numbers[count] = words.number(channels[count].is_rotation ? kMaxMocapAngle_deg : kMaxMocapLength);
  }
  if (words.ok() && count == channels.size() && !words.line_ends())
    words.fail("too_many_values",
               "found more numbers than the " + std::to_string(channels.size()) + " channels of this skeleton");
  if (words.ok() && count < channels.size() && words.has_more())
    words.fail("too_few_values", "found " + std::to_string(count) + " numbers, this skeleton has " +
                                     std::to_string(channels.size()) + " channels");
  return count;
}

// The number of rotations and translations that have channels.
std::int64_t count_targets(const Hierarchy& hierarchy) {
  std::set<std::pair<int, bool>> targets;
  for (const BvhChannel& channel : hierarchy.channels) targets.emplace(channel.node, channel.is_rotation);
  return static_cast<std::int64_t>(targets.size());
}

// The number of frames that the limits of numbers and of keys allow.
std::int64_t most_frames(const Hierarchy& hierarchy) {
  if (hierarchy.channels.empty()) return 0;
  return std::min(kMaxMocapNumbers / static_cast<std::int64_t>(hierarchy.channels.size()),
                  kMaxMocapKeys / count_targets(hierarchy));
}

void fail_if_above(std::int64_t most, std::int64_t frames, MocapWords& words) {
  if (frames > most)
    words.fail("too_large", "found " + std::to_string(frames) + " frames or more, allowed are " + std::to_string(most) +
                                " with the channels of this skeleton");
}

// Reads all lines and returns the number of frames.
int read_frames(MocapWords& words, const Hierarchy& hierarchy, int said, AssetClip& clip, Remarks& remarks) {
  // Takes no memory for frames that are only announced.
  const std::size_t lines = std::min(static_cast<std::size_t>(said), words.lines_left());
  const std::vector<NodeTargets> targets = make_channels(hierarchy, lines, clip);
  const std::vector<BvhChannel>& channels = hierarchy.channels;
  std::vector<double> numbers(channels.size());
  const std::int64_t most = most_frames(hierarchy);
  int frames = 0;
  for (; words.has_more(); ++frames) {
    fail_if_above(most, frames + 1, words);
    const std::size_t count = read_frame(words, channels, numbers);
    if (words.ok() && count < channels.size()) {
      remarks.push_back({"bvh.cut_frame", "the last line has " + std::to_string(count) + " of " +
                                              std::to_string(channels.size()) + " numbers; it is left out"});
      break;
    }
    for (std::size_t first = 0, end = 0; first < channels.size() && words.ok(); first = end) {
      while (end < channels.size() && channels[end].node == channels[first].node) ++end;
      const auto node = static_cast<std::size_t>(channels[first].node);
      add_keys(hierarchy.nodes[node], targets[node], std::span(channels).subspan(first, end - first),
               std::span(numbers).subspan(first, end - first), clip);
    }
  }
  return frames;
}

// Reads the number after "Frames:"; one above the limit is a fault.
int read_frame_count(MocapWords& words, const Hierarchy& hierarchy) {
  words.expect_label("Frames:");
  const int frames = words.count("frames", kMaxMocapNumbers);
  fail_if_above(most_frames(hierarchy), frames, words);
  return words.ok() ? frames : 0;
}

// The time of a frame in seconds: by `rate_hz` if it is given, otherwise as in the file.
double read_frame_time(MocapWords& words, double rate_hz, Remarks& remarks) {
  constexpr double kShort_s = 0.001, kLong_s = 0.2;  // cameras and suits record between 5 and 1000 Hz
  words.expect("Frame");
  words.expect_label("Time:");
  if (rate_hz > 0.0) {
    remarks.push_back({"bvh.frame_time", "Frame Time: says " + quoted_word(words.next()) + "; the frames are read at " +
                                             number_text(rate_hz) + " per second instead"});
    return 1.0 / rate_hz;
  }
  const double time_s = words.number(3600.0);
  if (!words.ok()) return 0.0;
  const std::string said = "Frame Time: says " + number_text(time_s) + " s";
  if (!(time_s >= 1e-9))
    words.fail("bad_frame_time", "found " + number_text(time_s) + " s, allowed is more than 0; --rate-hz says it");
  else if (time_s > kLong_s || time_s < kShort_s)
    remarks.push_back({"bvh.frame_time", said + ", which is " + number_text(1.0 / time_s) +
                                             " frames per second; if that is wrong, --rate-hz says what is right"});
  return time_s;
}

void time_frames(int frames, double frame_time_s, AssetClip& clip) {
  std::vector<double> times_s(static_cast<std::size_t>(frames));
  for (int frame = 0; frame < frames; ++frame) times_s[static_cast<std::size_t>(frame)] = frame * frame_time_s;
  if (clip.channels.empty()) return;
  clip.last_s = times_s.back();
  for (AssetChannel& channel : clip.channels) channel.times_s = times_s;
}

// Data that do not come from the text.
struct BvhContext {
  const std::string& clip_name;
  double rate_hz;
};

AssetClip read_motion(MocapWords& words, const Hierarchy& hierarchy, const BvhContext& context, Remarks& remarks) {
  const std::string& name = context.clip_name;
  AssetClip clip{name, name.empty() ? "#0" : name, {}, 0.0, 0.0};
  words.expect("MOTION");
  const int said = read_frame_count(words, hierarchy);
  const double frame_time_s = read_frame_time(words, context.rate_hz, remarks);
  if (!words.ok() || (said == 0 && !words.has_more())) return clip;
  const int frames = read_frames(words, hierarchy, said, clip, remarks);
  if (frames == 0) words.fail("too_few_values", "the text ends before the first frame");
  if (!words.ok()) return clip;
  if (frames != said)
    remarks.push_back({"bvh.frame_count", "Frames: says " + std::to_string(said) + ", and the file has " +
                                              std::to_string(frames) + " lines of numbers; all of them are read"});
  time_frames(frames, frame_time_s, clip);
  return clip;
}

// The axes along which each node has a position channel.
std::vector<PositionAxes> has_axis(const Hierarchy& hierarchy) {
  std::vector<PositionAxes> axes(hierarchy.nodes.size());
  for (const BvhChannel& channel : hierarchy.channels)
    if (!channel.is_rotation)
      axes[static_cast<std::size_t>(channel.node)][static_cast<std::size_t>(channel.axis)] = true;
  return axes;
}

}  // namespace

Result<Asset> parse_bvh(std::string_view text, const std::string& clip_name, double rate_hz) {
  if (text.size() > kMaxMocapBytes)
    return Issue{"bvh.too_large", "",
                 "the text has more than the allowed " + std::to_string(kMaxMocapBytes) + " bytes"};
  MocapWords words(kBvhSyntax, text);
  Hierarchy hierarchy = read_hierarchy(words);
  Asset asset;
  AssetClip clip = read_motion(words, hierarchy, {clip_name, rate_hz}, asset.remarks);
  if (!words.ok()) return words.issue();
  place_joints(hierarchy.nodes, has_axis(hierarchy), clip, asset.remarks);
  std::vector<std::string> names;
  for (const AssetNode& node : hierarchy.nodes) names.push_back(node.name);
  const std::vector<std::string> labels = unique_labels(names);
  for (std::size_t i = 0; i < labels.size(); ++i) hierarchy.nodes[i].label = labels[i];
  asset.nodes = std::move(hierarchy.nodes);
  asset.order.resize(labels.size());
  // A file nests children inside their parents, so the order is the file's.
  std::iota(asset.order.begin(), asset.order.end(), 0);
  if (!clip.channels.empty()) asset.clips.push_back(std::move(clip));
  return asset;
}

Result<Asset> read_bvh(const std::string& path, double rate_hz) {
  const Result<std::string> text = read_mocap_text(path, "bvh");
  if (!text) return text.issue();
  return parse_bvh(*text, std::filesystem::path(path).stem().string(), rate_hz);
}

}  // namespace contort
