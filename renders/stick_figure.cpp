#include "renders/stick_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "model/core/index.h"
#include "renders/html.h"

namespace contort {

namespace {

constexpr double kSide = 160.0, kFrameMargin = 10.0;  // size of the drawing, in pixels
constexpr double kMostDistance_m = 1e6;  // points farther away are left out, because the others would be too small

struct Dot {
  double x = 0.0;
  double y = 0.0;
};

bool can_be_shown(const Vec3& p) {
  return std::fabs(p.x) < kMostDistance_m && std::fabs(p.y) < kMostDistance_m && std::fabs(p.z) < kMostDistance_m;
}

// Parallel projection, seen from 35 degrees to the figure's left and 15 degrees above; y points down.
Dot seen(const Vec3& p) {
  constexpr double kCosYaw = 0.81915, kSinYaw = 0.57358, kCosPitch = 0.96593, kSinPitch = 0.25882;
  const double depth = kSinYaw * p.x + kCosYaw * p.z;
  return {kCosYaw * p.x - kSinYaw * p.z, -(kCosPitch * p.y - kSinPitch * depth)};
}

class Drawing {
 public:
  Drawing(const StickFigure& figure, std::string_view alt) : figure_(figure), alt_(alt) {
    for (const Vec3& point : figure.points) {
      shown_.push_back(can_be_shown(point) ? 1 : 0);
      dots_.push_back(shown_.back() != 0 ? seen(point) : Dot{});
    }
  }

  std::string svg() {
    if (std::ranges::count(shown_, 1) < 2) return "";
    fit();
    const std::string side = std::to_string(static_cast<int>(kSide));
    std::string out = "<svg class='figure' viewBox='0 0 " + side + " " + side + "' width='" + side + "' height='" + side +
                      "' role='img' aria-label='" + html_text(alt_) + "'>";
    for (const bool marked : {false, true})
      for (std::size_t i = 0; i < dots_.size(); ++i) add_bone(i, marked, out);
    for (std::size_t i = 0; i < dots_.size(); ++i)
      if (is_marked(i) && shown_[i] != 0)
        out += "<circle class='marked' cx='" + number(dots_[i].x) + "' cy='" + number(dots_[i].y) + "' r='4'/>";
    return out + "</svg>";
  }

 private:
  bool is_marked(std::size_t i) const { return i < figure_.marked.size() && figure_.marked[i] != 0; }

  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
  }

  void fit() {
    double left = std::numeric_limits<double>::infinity(), top = left, right = -left, bottom = -left;
    for (std::size_t i = 0; i < dots_.size(); ++i) {
      if (shown_[i] == 0) continue;
      left = std::min(left, dots_[i].x), right = std::max(right, dots_[i].x);
      top = std::min(top, dots_[i].y), bottom = std::max(bottom, dots_[i].y);
    }
    const double scale = (kSide - 2.0 * kFrameMargin) / std::max({right - left, bottom - top, 1e-9});
    for (Dot& dot : dots_)
      dot = {0.5 * kSide + scale * (dot.x - 0.5 * (left + right)), 0.5 * kSide + scale * (dot.y - 0.5 * (top + bottom))};
  }

  // A bone belongs to the joint at its beginning.
  void add_bone(std::size_t i, bool marked, std::string& out) const {
    const int parent = i < figure_.parents.size() ? figure_.parents[i] : -1;
    if (parent < 0 || shown_[i] == 0 || shown_[at(parent)] == 0 || is_marked(at(parent)) != marked) return;
    const Dot &from = dots_[at(parent)], &to = dots_[i];
    out += std::string("<line") + (marked ? " class='marked'" : "") + " x1='" + number(from.x) + "' y1='" +
           number(from.y) + "' x2='" + number(to.x) + "' y2='" + number(to.y) + "'/>";
  }

  const StickFigure& figure_;
  std::string_view alt_;
  std::vector<Dot> dots_;
  std::vector<char> shown_;
};

}  // namespace

std::string stick_figure_svg(const StickFigure& figure, std::string_view alt) { return Drawing(figure, alt).svg(); }

}  // namespace contort
