// scale_pop: a node of a clip shrinks, grows or is mirrored for a key or two, or for good, while its scale hardly
// changes around that time (lone_steps.h). Changes are fractions of the usual size, the median of the clip: a step to
// zero is 1, a step to the mirror image 2. Models hide parts by a scale of 0; that is no finding.
#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/clip_steps.h"

namespace contort {

namespace {

constexpr double kHidden = 0.01;  // hidden nodes are smaller than this part of the usual size
constexpr double kBlipOfSize = 0.1;
constexpr double kJumpOfSize = 0.4;  // a node that doubles or halves changes by at least 0.5 of its usual size

bool is_scaled(const AssetChannel& channel) {
  return channel.path == ChannelPath::scale && channel.times_s.size() > 1;
}

double greatest(const Vec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

std::string text_of(const Vec3& s) {
  const bool is_even = s.x == s.y && s.x == s.z;
  return is_even ? fixed_text(s.x, 3) : fixed_text(s.x, 3) + " " + fixed_text(s.y, 3) + " " + fixed_text(s.z, 3);
}

// The median of the sizes, or the greatest size if the median is 0.
double usual_size(const std::vector<Vec3>& scales) {
  std::vector<double> sizes;
  for (const Vec3& scale : scales) sizes.push_back(greatest(scale));
  std::ranges::sort(sizes);
  const double median = sizes[sizes.size() / 2];
  return median > 0.0 ? median : sizes.back();
}

struct ScaleSteps {
  std::vector<Vec3> scales;
  double usual = 0.0;

  double apart(std::size_t a, std::size_t b) const { return greatest(scales[b] - scales[a]) / usual; }
  bool is_hidden(std::size_t key) const { return greatest(scales[key]) < kHidden * usual; }
  bool hides_or_shows(std::size_t i) const { return is_hidden(i) != is_hidden(i + 1); }
};

// Allows steps that hide or show a part for good.
void allow_hiding(const ScaleSteps& of, std::vector<double>& allowed) {
  const std::vector<double> judged = allowed;
  const auto is_judged = [&](std::size_t i) { return i < judged.size() && std::isfinite(judged[i]); };
  for (std::size_t i = 0; i < allowed.size(); ++i)
    if (of.hides_or_shows(i) && !is_judged(i - 1) && !is_judged(i + 1))
      allowed[i] = std::numeric_limits<double>::infinity();
}

void judge_scales(const ClipInput& in, const AssetChannel& channel, std::vector<KeyFinding>& out) {
  ScaleSteps of;
  for (const double t_s : channel.times_s) of.scales.push_back(sample_vector(channel, t_s));
  of.usual = usual_size(of.scales);
  if (!(of.usual > 0.0)) return;
  const auto apart = [&](std::size_t a, std::size_t b) { return of.apart(a, b); };
  const std::vector<SpeedInterval> steps = step_intervals(channel, apart);
  std::vector<double> allowed = allowed_lone_steps(
      steps, apart, lone_limits(channel.interpolation, {kBlipOfSize, kJumpOfSize}));
  allow_hiding(of, allowed);
  add_step_findings(
      "scale_pop", in.asset.nodes[static_cast<std::size_t>(channel.node)], "of its size", steps, allowed, in.settings,
      [&](std::size_t i) {
        return "scale " + text_of(of.scales[i]) + " becomes " + text_of(of.scales[i + 1]) + " in one step";
      },
      out);
}

}  // namespace

ClipCheckResult scale_pop_in_clip(const ClipInput& in) {
  ClipCheckResult result{0, "no node is scaled", {}};
  for (const AssetChannel& channel : in.clip.channels) {
    if (!is_scaled(channel)) continue;
    ++result.subjects;
    judge_scales(in, channel, result.findings);
  }
  return result;
}

}  // namespace contort
