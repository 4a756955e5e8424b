// translation_pop: a node of a clip jumps to another place for a key or two, or for good, while it hardly moves around
// that time (lone_steps.h). Lengths are those of the model at rest in the world. They are judged relative to the
// figure's size, because not all files use metres.
#include <algorithm>

#include "checks/clip_figure.h"
#include "checks/clip_steps.h"
#include "checks/pop.h"

namespace contort {

namespace {

constexpr double kBlipOfFigure = 0.01;  // 2 cm of a figure of 2 m, which people see. No shipped clip has such a blip
constexpr double kJumpOfFigure = 0.05;
constexpr double kLeapOfFigure = 0.5;  // a step of half the figure's size is a pop even in fast motion

bool moves_place(const AssetChannel& channel) {
  return channel.path == ChannelPath::translation && channel.times_s.size() > 1;
}

std::vector<Vec3> places(const ClipInput& in, const ClipFigure& figure, const AssetChannel& channel) {
  std::vector<Vec3> out;
  for (const double t_s : channel.times_s)
    out.push_back(in_world(in.asset, figure, channel.node, sample_vector(channel, t_s)));
  return out;
}

// The size of the node's path. A lone node has no size of its own, so this is used instead.
double way_m(const std::vector<Vec3>& path) {
  Vec3 low = path.front(), high = path.front();
  for (const Vec3& place : path) low = glm::min(low, place), high = glm::max(high, place);
  return length(high - low);
}

void judge_places(const ClipInput& in, const ClipFigure& figure, const AssetChannel& channel,
                  std::vector<KeyFinding>& out) {
  const std::vector<Vec3> path = places(in, figure, channel);
  const auto apart = [&](std::size_t a, std::size_t b) { return length(path[b] - path[a]); };
  const double size_m = figure.size_m > 0.0 ? figure.size_m : way_m(path);
  const std::vector<SpeedInterval> steps = step_intervals(channel, apart);
  const bool jumps = channel.interpolation == Interpolation::step;
  std::vector<double> allowed = allowed_lone_steps(
      steps, apart, lone_limits(channel.interpolation, {kBlipOfFigure * size_m, kJumpOfFigure * size_m}));
  for (std::size_t i = 0; i < steps.size() && !jumps; ++i) {
    const double explained_m = explained_rad_s(steps, i) * (steps[i].t1_s - steps[i].t0_s);
    allowed[i] = std::min(allowed[i], std::max(explained_m, kLeapOfFigure * size_m));
  }
  add_step_findings(
      "translation_pop", in.asset.nodes[static_cast<std::size_t>(channel.node)], "m", steps, allowed, in.settings,
      [&](std::size_t i) {
        return "moves by " + fixed_text(apart(i, i + 1), 3) + " m between two keys (" +
               fixed_text(steps[i].speed_rad_s, 1) + " m/s); by the keys around it up to " +
               fixed_text(allowed[i], 3) + " m would be expected";
      },
      out);
}

}  // namespace

ClipCheckResult translation_pop_in_clip(const ClipInput& in) {
  ClipCheckResult result{0, "no node is moved from its place", {}};
  const ClipFigure figure = clip_figure(in.asset);
  for (const AssetChannel& channel : in.clip.channels) {
    if (!moves_place(channel)) continue;
    ++result.subjects;
    judge_places(in, figure, channel, result.findings);
  }
  return result;
}

}  // namespace contort
