// jitter: a joint of a clip trembles, more often to and fro than muscles can. A stroke is a movement one way, from one
// turning point to the next; papers on smoothness count it as a peak of speed (Rohrer et al., "Movement smoothness
// changes during stroke recovery", J. Neurosci. 22(18), 2002). The fast part of a motion is its distance from its
// running mean, a low-pass filter, as in the residual analysis of Winter, "Biomechanics and Motor Control of Human
// Movement", 4th ed., section 3.4.4.3. People move fingers to and fro at most seven times a second, and tremble at 8 to
// 12 Hz by less than a degree. So no body makes 18 strokes of 2 degrees in one second, or 12 in half a second.
#include <algorithm>
#include <cmath>
#include <functional>

#include "checks/clip_figure.h"
#include "checks/clip_steps.h"

namespace contort {

namespace {

constexpr double kMean_s = 0.07;  // on either side: a mean over 0.14 s keeps motion slower than about 5 Hz
constexpr double kTremble_rad = 2.0 * kRadPerDeg;
constexpr double kTrembleOfFigure = 0.005;
constexpr double kSlackOfTimes_s = 1e-4;  // files store times as 32-bit numbers

struct TrembleWindow {
  double length_s;
  std::size_t strokes;
};
constexpr TrembleWindow kWindows[] = {{1.0, 18}, {0.5, 12}};

// A turning point of the fast part of a motion.
struct Stroke {
  std::size_t key;
  double size;
};

// The difference between two values of a channel: `difference(a, b)` leads from key a to key b.
using Difference = FunctionRef<Vec3(std::size_t, std::size_t)>;

// The distance of a key from the mean of the keys around it; 0 for the first and last key.
Vec3 fast_part(const AssetChannel& channel, std::size_t key, Difference difference) {
  const std::vector<double>& t = channel.times_s;
  std::size_t reach = 0;
  const auto is_near = [&](std::size_t other) { return std::fabs(t[other] - t[key]) < kMean_s; };
  while (reach < key && key + reach + 1 < t.size() && is_near(key - reach - 1) && is_near(key + reach + 1)) ++reach;
  Vec3 sum(0.0);
  for (std::size_t k = key - reach; k <= key + reach; ++k) sum += difference(key, k);
  return sum / -static_cast<double>(2 * reach + 1);
}

std::vector<Stroke> strokes_of(const AssetChannel& channel, Difference difference) {
  std::vector<Stroke> out;
  Vec3 farthest(0.0);
  for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
    const Vec3 fast = fast_part(channel, key, difference);
    const bool turns = out.empty() || glm::dot(fast, farthest) < 0.0;
    if (turns) out.push_back({key, 0.0});
    if (!turns && length(fast) <= out.back().size) continue;
    out.back() = {key, length(fast)};
    farthest = fast;
  }
  return out;
}

struct Tremble {
  double size = 0.0;  // size of the smallest stroke that counts
  std::size_t first_key = 0, last_key = 0;
};

// The window with too many strokes in which the smallest counted stroke is largest.
Tremble worst_tremble(const std::vector<double>& times_s, const std::vector<Stroke>& strokes) {
  Tremble worst;
  std::vector<double> sizes;
  for (const TrembleWindow& window : kWindows)
    for (std::size_t first = 0, end = 0; first < strokes.size(); ++first) {
      const double until_s = times_s[strokes[first].key] + window.length_s + kSlackOfTimes_s;
      while (end < strokes.size() && times_s[strokes[end].key] <= until_s) ++end;
      if (end - first < window.strokes) continue;
      sizes.clear();
      for (std::size_t i = first; i < end; ++i) sizes.push_back(strokes[i].size);
      const auto least = sizes.begin() + static_cast<std::ptrdiff_t>(window.strokes - 1);
      std::nth_element(sizes.begin(), least, sizes.end(), std::greater<>());
      if (*least > worst.size) worst = {*least, strokes[first].key, strokes[end - 1].key};
    }
  return worst;
}

// "12.0 deg to and fro, 15.0 times a second"
std::string tremble_text(const AssetChannel& channel, const Tremble& tremble, const std::vector<Stroke>& strokes,
                         double most, Difference difference) {
  int ways = 0;
  double sum = 0.0;
  const Stroke* before = nullptr;
  for (const Stroke& stroke : strokes) {
    if (stroke.key < tremble.first_key || stroke.key > tremble.last_key || stroke.size < most) continue;
    if (before != nullptr) sum += length(difference(before->key, stroke.key)), ++ways;
    before = &stroke;
  }
  if (ways == 0) return "shakes";
  const double length_s = channel.times_s[tremble.last_key] - channel.times_s[tremble.first_key];
  const bool turns = channel.path == ChannelPath::rotation;
  const double way = sum / static_cast<double>(ways) * (turns ? kDegPerRad : 1.0);
  return "shakes by " + fixed_text(way, turns ? 1 : 3) + (turns ? " deg" : " m") + " to and fro, " +
         fixed_text(static_cast<double>(ways) / (2.0 * length_s), 1) + " times a second";
}

void judge_tremble(const ClipInput& in, const AssetChannel& channel, double most, Difference difference,
                   std::vector<KeyFinding>& out) {
  const std::string& node = in.asset.nodes[static_cast<std::size_t>(channel.node)].label;
  const std::vector<Stroke> strokes = strokes_of(channel, difference);
  const Tremble worst = worst_tremble(channel.times_s, strokes);
  const double margin = most + tolerance_of(in.settings, "jitter", node) - worst.size;
  if (!(margin < 0.0)) return;
  const bool turns = channel.path == ChannelPath::rotation;
  const int first = static_cast<int>(worst.first_key), last = static_cast<int>(worst.last_key);
  KeyFinding finding;
  static_cast<Finding&>(finding) = {"jitter", node,   turns ? "rad" : "m", first,
                                    first,    last,   margin,
                                    -margin / find_check("jitter").scale};
  finding.t0_s = channel.times_s[worst.first_key], finding.t1_s = channel.times_s[worst.last_key];
  finding.what = tremble_text(channel, worst, strokes, std::min(most, worst.size), difference);
  out.push_back(std::move(finding));
}

void judge_turns(const ClipInput& in, const AssetChannel& channel, std::vector<KeyFinding>& out) {
  std::vector<Quat> keys;
  for (const double t_s : channel.times_s) keys.push_back(sample_rotation(channel, t_s));
  judge_tremble(
      in, channel, kTremble_rad,
      [&](std::size_t a, std::size_t b) { return to_rotation_vector(glm::conjugate(keys[a]) * keys[b]); }, out);
}

void judge_moves(const ClipInput& in, const ClipFigure& figure, const AssetChannel& channel,
                 std::vector<KeyFinding>& out) {
  std::vector<Vec3> keys;
  for (const double t_s : channel.times_s)
    keys.push_back(in_world(in.asset, figure, channel.node, sample_vector(channel, t_s)));
  judge_tremble(
      in, channel, kTrembleOfFigure * figure.size_m, [&](std::size_t a, std::size_t b) { return keys[b] - keys[a]; },
      out);
}

}  // namespace

ClipCheckResult jitter_in_clip(const ClipInput& in) {
  ClipCheckResult result{0, "no joint has twelve keys", {}};
  const ClipFigure figure = clip_figure(in.asset);
  for (const AssetChannel& channel : in.clip.channels) {
    const bool has_size = channel.path == ChannelPath::translation && figure.size_m > 0.0;
    if (channel.times_s.size() < 12 || channel.interpolation == Interpolation::step) continue;
    if (channel.path != ChannelPath::rotation && !has_size) continue;
    ++result.subjects;
    if (has_size)
      judge_moves(in, figure, channel, result.findings);
    else
      judge_turns(in, channel, result.findings);
  }
  return result;
}

}  // namespace contort
