#include "renders/raster/auto_camera.h"

#include <algorithm>
#include <numeric>

#include "renders/scenery.h"

namespace contort {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
constexpr double kAroundFigure_m = 1.0;  // Covers a few steps of a stair.

// The score of a view. In a pair, a chest has many more pixels than the hand in it, so the sum would ignore the hand.
// Therefore the smaller number decides, and the sum only between nearly equal views.
int score(const std::vector<int>& visible) {
  if (visible.size() < 2) return 0;
  const auto groups = std::span(visible).subspan(1);
  return 4 * *std::min_element(groups.begin(), groups.end()) + std::accumulate(groups.begin(), groups.end(), 0);
}

// A view from the front is easier to understand, so it may show this much less.
constexpr double kGoodEnough = 0.9;
// The same for a view that shows the shape of the ground, which matters more.
constexpr double kGoodEnoughOnShapedGround = 0.6;

// Pixels behind scenery, which is translucent, count less than free ones.
constexpr int kPastScenery = 2;

struct Probe {
  View view;
  int score = 0;
  int visible_pixels = 0;
};

bool is_open(const DrawList& list) { return list.scenery.ground.empty() && list.scenery.obstacles.empty(); }

Result<std::vector<Probe>> probe_all(Renderer& renderer, const DrawList& list, std::span<const Vec3> points,
                                     std::span<const View> views) {
  const bool open = is_open(list);
  DrawList bare = list;
  bare.scenery = {};
  std::vector<Probe> probes;
  for (const View& view : views) {
    const Camera camera = frame_points(points, view, static_cast<double>(kWidth) / kHeight);
    const Result<std::vector<int>> visible = renderer.count_visible(bare, camera, kWidth, kHeight);
    if (!visible) return visible.issue();
    const Result<std::vector<int>> unobstructed =
        open ? visible : renderer.count_visible(list, camera, kWidth, kHeight);
    if (!unobstructed) return unobstructed.issue();
    probes.push_back({view, score(*visible) + kPastScenery * score(*unobstructed),
                      std::accumulate(visible->begin(), visible->end(), 0)});
  }
  return probes;
}

DrawList whole_figure_highlighted(DrawList list) {
  for (DrawInstance& instance : list.instances) instance.highlight = instance.ghost ? 0 : 1;
  return list;
}

}  // namespace

Result<ProbedView> best_view(Renderer& renderer, const DrawList& list, std::span<const Triangles> meshes,
                             std::span<const View> views) {
  const bool any = std::any_of(list.instances.begin(), list.instances.end(),
                               [](const DrawInstance& instance) { return instance.highlight > 0; });
  if (!any && is_open(list)) return ProbedView{views.front(), 0};
  const Result<std::vector<Probe>> probes =
      probe_all(renderer, any ? list : whole_figure_highlighted(list), outline(list, meshes), views);
  if (!probes) return probes.issue();
  const auto less = [](const Probe& a, const Probe& b) { return a.score < b.score; };
  const int best = std::max_element(probes->begin(), probes->end(), less)->score;
  const double enough = list.scenery.ground.empty() ? kGoodEnough : kGoodEnoughOnShapedGround;
  const auto chosen =
      std::find_if(probes->begin(), probes->end(), [&](const Probe& probe) { return probe.score >= enough * best; });
  return ProbedView{chosen->view, any ? chosen->visible_pixels : 0};
}

Result<ProbedView> choose_view(Renderer& renderer, const Story& story, const Shots& shots, std::size_t tile,
                               std::optional<double> azimuth_rad) {
  std::vector<View> views = views_of_angle(story, shots.frames[tile],
                                           views_of(environment_of(story), shots.anchors[tile], kAroundFigure_m));
  if (azimuth_rad) views = {view_from(*azimuth_rad)};
  return best_view(renderer, shots.lists[tile], shots.meshes, views);
}

}  // namespace contort
