#include "renders/raster/auto_camera.h"

#include <algorithm>
#include <numeric>

namespace contort {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;

// Of a pair, a chest has many more pixels than the hand in it: the sum alone would hide the hand. So the one that shows
// least decides, and the sum between nearly equal views.
int score(const std::vector<int>& visible) {
  if (visible.size() < 2) return 0;
  const auto groups = std::span(visible).subspan(1);
  return 4 * *std::min_element(groups.begin(), groups.end()) + std::accumulate(groups.begin(), groups.end(), 0);
}

// A view from the front is understood sooner; it may cost this much of what could be seen.
constexpr double kGoodEnough = 0.9;

struct Probe {
  View view;
  int score = 0;
  int visible_pixels = 0;
};

Result<std::vector<Probe>> probe_all(Renderer& renderer, const DrawList& list, std::span<const Vec3> points) {
  std::vector<Probe> probes;
  for (const View& view : probe_views()) {
    const Camera camera = frame_points(points, view, static_cast<double>(kWidth) / kHeight);
    const Result<std::vector<int>> visible = renderer.count_visible(list, camera, kWidth, kHeight);
    if (!visible) return visible.issue();
    probes.push_back({view, score(*visible), std::accumulate(visible->begin(), visible->end(), 0)});
  }
  return probes;
}

}  // namespace

Result<ProbedView> best_view(Renderer& renderer, const DrawList& list, std::span<const Triangles> meshes) {
  const bool any = std::any_of(list.instances.begin(), list.instances.end(),
                               [](const DrawInstance& instance) { return instance.highlight > 0; });
  if (!any) return ProbedView{probe_views().front(), 0};
  const Result<std::vector<Probe>> probes = probe_all(renderer, list, outline(list, meshes));
  if (!probes) return probes.issue();
  const auto less = [](const Probe& a, const Probe& b) { return a.score < b.score; };
  const int best = std::max_element(probes->begin(), probes->end(), less)->score;
  const auto chosen = std::find_if(probes->begin(), probes->end(),
                                   [&](const Probe& probe) { return probe.score >= kGoodEnough * best; });
  return ProbedView{chosen->view, chosen->visible_pixels};
}

}  // namespace contort
