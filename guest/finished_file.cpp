#include "guest/finished_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "guest/on_the_spot.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kLeastRate_hz = 30.0;
constexpr double kGreatestRate_hz = 240.0;
constexpr double kSameTime_s = 1e-4;  // keys nearer than this count as one, because files store times as 32-bit numbers
constexpr double kMostFrames = 100000.0;
constexpr std::size_t kMostNames = 8;  // greatest number of names in a message

double shortest_step_s(const AssetClip& clip) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const AssetChannel& channel : clip.channels)
    for (std::size_t key = 1; key < channel.times_s.size(); ++key)
      if (const double step = channel.times_s[key] - channel.times_s[key - 1]; step > kSameTime_s)
        shortest = std::min(shortest, step);
  return shortest;
}

double densest_rate_hz(const AssetClip& clip) {
  double densest = 0.0;
  for (const AssetChannel& channel : clip.channels)
    if (const double length_s = channel.times_s.back() - channel.times_s.front(); length_s > kSameTime_s)
      densest = std::max(densest, static_cast<double>(channel.times_s.size() - 1) / length_s);
  return densest;
}

// Returns the step that divides the clip evenly, if it is close to the given one: rounded times would drift over many
// frames.
double even_step_s(const AssetClip& clip, double step_s) {
  const double length_s = clip.last_s - clip.first_s, steps = std::round(length_s / step_s);
  const bool is_even = steps >= 1.0 && std::fabs(length_s / step_s - steps) < 0.1;
  return is_even ? length_s / steps : step_s;
}

bool has_node(const Asset& asset, const std::string& name) {
  return std::ranges::any_of(asset.nodes, [&](const AssetNode& n) { return n.label == name || n.name == name; });
}

std::map<std::string, std::string> joints_in(const Asset& asset, const std::map<std::string, std::string>& joints) {
  std::map<std::string, std::string> out;
  for (const auto& [node, joint] : joints)
    if (has_node(asset, node)) out.emplace(node, joint);
  return out;
}

std::string list_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > kMostNames) text += " and " + std::to_string(names.size() - kMostNames) + " more";
  return text;
}

Issue nothing_matches(const FinishedFile& file) {
  std::vector<std::string> nodes, joints;
  for (const AssetNode& node : file.asset.nodes) nodes.push_back(node.label);
  for (const Joint& joint : file.character->joints().subspan(1)) joints.push_back(joint.name);
  return {"check.nothing_matches", "",
          "no node of the file is a joint of " + file.character->name() + ", by its name or by the map: nodes are " +
              list_names(nodes) + "; joints are " + list_names(joints) +
              "; --map FILE says which node is which joint"};
}

bool is_moved(const AssetChannel& channel) {
  const std::size_t row = row_size(channel.path);
  const bool is_spline = channel.interpolation == Interpolation::cubic_spline;  // tangents move the node too
  for (std::size_t i = row; i < channel.values.size(); ++i)
    if (is_spline || channel.values[i] != channel.values[i % row]) return true;
  return false;
}

void add_left_out(const FinishedFile& file, Conversion& out) {
  std::vector<char> is_followed(file.asset.nodes.size(), 0), moves(file.character->joints().size(), 0);
  for (const FollowedNode& f : out.followed) {
    is_followed[at(f.node)] = 1;
    std::fill_n(moves.begin() + f.joint, f.hinges, 1);
  }
  std::vector<char> is_stray(file.asset.nodes.size(), 0);
  for (const AssetChannel& channel : file.clip.channels)
    if (is_followed[at(channel.node)] == 0 && is_moved(channel)) is_stray[at(channel.node)] = 1;
  for (int node = 0; node < static_cast<int>(is_stray.size()); ++node)
    if (is_stray[at(node)] != 0) out.stray_nodes.push_back(node);
  for (int joint = 0; joint < static_cast<int>(moves.size()); ++joint)
    if (moves[at(joint)] == 0) out.joints_at_rest.push_back(joint);
}

}  // namespace

double own_rate_hz(const AssetClip& clip) {
  const double step_s = shortest_step_s(clip);
  if (!std::isfinite(step_s)) return kLeastRate_hz;
  double rate_hz = 1.0 / even_step_s(clip, step_s);
  if (rate_hz > kGreatestRate_hz) rate_hz = std::min(densest_rate_hz(clip), kGreatestRate_hz);
  return rate_hz * std::max(1.0, std::ceil(kLeastRate_hz / rate_hz - 1e-3));
}

Result<Conversion> convert(const FinishedFile& file) {
  const std::map<std::string, std::string> joints = joints_in(file.asset, file.joints);
  const double rate_hz = file.rate_hz > 0.0 ? file.rate_hz : own_rate_hz(file.clip);
  RecordingUse use{file.asset, file.clip, joints, 0.0, rate_hz, 0, {}};
  use.may_face_elsewhere = use.may_lack_root = true;
  if (!(frames_of(use) <= kMostFrames))
    return Issue{"check.too_long", "", "the clip is longer than 100,000 frames at this rate; --rate-hz lowers it"};
  Conversion out;
  Result<Motion> motion = follow_recording(*file.character, use, &out.followed);
  if (!motion && motion.issue().code == "recording.no_root") return nothing_matches(file);
  if (!motion) return motion.issue();
  if (out.followed.back().joint == 0 && file.character->joints().size() > 1) return nothing_matches(file);
  out.execution.character = file.character;
  out.execution.motion = std::move(motion).value();
  out.execution.path = out.followed.front().joint == 0 ? path_of(out.execution) : RootPath::unknown;
  add_left_out(file, out);
  return out;
}

}  // namespace contort
