#include "checks/clip_feet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "checks/clip_figure.h"
#include "model/asset/sample.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kFrame_s = 1.0 / 60.0;
constexpr double kMostFrames = 36'000.0;  // longer clips are sampled in longer steps

// All lengths are in leg lengths.
constexpr double kStillSpeed = 0.2;    // per second: ankle and toe of a standing foot move slower up and down
constexpr double kStill_s = 0.1;      // time for which a foot must stand still
constexpr double kStood_s = 0.2;       // total time for which a foot must stand before the ground is known
constexpr double kSameHeight = 0.03;   // greatest difference in height between places where feet stood
constexpr double kOnGround = 0.02;     // greatest distance of a standing foot from its height on the ground
constexpr double kUpright = 0.6;       // smallest height of the hip over the foot of an upright figure
constexpr double kStays = 0.5;  // greatest distance between the first and last place of the hips of a figure that stays
constexpr double kSameWay = 0.8;       // smallest cosine of the angle between two equal directions
constexpr double kSamePlace = 0.2;     // greatest distance of a sinking foot from the place where it stood last
// Differences up to this are rounding: the first frame of a fault that lasts is the worst.
constexpr double kSameAmount = 1e-9;
constexpr double kSlide_s = 0.25;      // shortest time of a slide: quicker ones are steps without lifting the foot
constexpr double kSlideOnTheSpot_s = 0.5;  // the same in a figure that stays, because figures of games step often

constexpr double kTogether = 0.02;     // greatest difference between the movements of feet that sink together
constexpr double kDrift_s = 0.3;       // shortest time of standing before a figure has sunk: jumps are quicker
constexpr double kSameExtension = 0.1;  // greatest change of a leg's extension in a figure that sinks as a whole

constexpr std::string_view kNoGround = "no two feet come to rest on the same ground";

// The path of a foot over the frames, in leg lengths.
struct FootPath {
  std::vector<Vec3> hip, ankle, toe;
  double leg = 0.0;  // length in the file's unit
};

Vec3 place_of(const std::vector<Mat4>& world, int node) { return Vec3(world[at(node)][3]); }

double length_of_leg(const Asset& asset, const std::vector<Mat4>& rest, const ClipFoot& foot) {
  double leg = 0.0;
  for (int node = foot.ankle; node != foot.hip && node >= 0; node = asset.nodes[at(node)].parent)
    if (const int parent = asset.nodes[at(node)].parent; parent >= 0)
      leg += length(place_of(rest, node) - place_of(rest, parent));
  return leg;
}

// The lower end of the height range of size kSameHeight that holds most of the heights; the lowest if there are
// several.
double most_common(std::vector<double>& heights) {
  std::ranges::sort(heights);
  double low = 0.0;
  std::size_t most = 0;
  for (std::size_t first = 0, end = 0; first < heights.size(); ++first) {
    while (end < heights.size() && heights[end] <= heights[first] + kSameHeight) ++end;
    if (end - first > most) most = end - first, low = heights[first];
  }
  return low;
}

double middle_value(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double level_length(const Vec3& v) { return std::sqrt(v.x * v.x + v.z * v.z); }

class FeetJudge {
 public:
  FeetJudge(const Asset& asset, const AssetClip& clip, const std::vector<ClipFoot>& feet) : feet_(feet) {
    const double length_s = clip.last_s - clip.first_s;
    step_s_ = std::max(kFrame_s, length_s / kMostFrames);
    first_s_ = clip.first_s;
    count_ = 1 + static_cast<int>(std::floor(length_s / step_s_ + 1e-9));
    const std::vector<Mat4> rest = clip_figure(asset).world_from_node;
    paths_.resize(feet.size());
    for (std::size_t f = 0; f < feet.size(); ++f) paths_[f].leg = length_of_leg(asset, rest, feet[f]);
    for (int frame = 0; frame < count_; ++frame) {
      const std::vector<Mat4> world = world_from_nodes(asset, pose(asset, clip, time_s(frame)));
      for (std::size_t f = 0; f < feet.size(); ++f) add_places(world, feet[f], paths_[f]);
    }
  }

  ClipFeetFaults judge() {
    ClipFeetFaults out;
    out.why_not = find_ground();
    if (const std::optional<FootFault> drift = drift_of_figure()) out.drifts.push_back(*drift), out.judged = foot_count();
    if (!out.why_not.empty()) return out;
    stays_ = stays();
    out.judged = foot_count();
    for (int f = 0; f < foot_count(); ++f) {
      if (const std::optional<FootFault> slide = slide_of(f)) out.slides.push_back(*slide);
      if (const std::optional<FootFault> sink = sink_of(f)) out.sinks.push_back(*sink);
    }
    if (is_on_the_spot(out.slides)) {
      out.slides.clear();
      out.no_slide = "the figure walks on the spot";
    }
    return out;
  }

 private:
  int foot_count() const { return static_cast<int>(feet_.size()); }
  double time_s(int frame) const { return first_s_ + frame * step_s_; }
  const FootPath& path(int foot) const { return paths_[at(foot)]; }

  static void add_places(const std::vector<Mat4>& world, const ClipFoot& foot, FootPath& out) {
    const double scale = out.leg > 0.0 ? 1.0 / out.leg : 0.0;
    out.hip.push_back(scale * place_of(world, foot.hip));
    out.ankle.push_back(scale * place_of(world, foot.ankle));
    out.toe.push_back(scale * place_of(world, foot.toe));
  }

  bool is_upright(const FootPath& p, int frame) const {
    return p.hip[at(frame)].y - std::min(p.ankle[at(frame)].y, p.toe[at(frame)].y) > kUpright;
  }

  bool is_still(const FootPath& p, int frame) const {
    const double most = kStillSpeed * step_s_;
    return is_upright(p, frame) && std::fabs(p.ankle[at(frame)].y - p.ankle[at(frame - 1)].y) < most &&
           std::fabs(p.toe[at(frame)].y - p.toe[at(frame - 1)].y) < most;
  }

  // The frames in which a foot stands still for at least kStill_s.
  std::vector<int> still_frames(const FootPath& p) const {
    std::vector<int> out;
    int first = -1;
    for (int frame = 1; frame <= count_; ++frame) {
      const bool still = frame < count_ && is_still(p, frame);
      if (still && first < 0) first = frame;
      if (still || first < 0) continue;
      if ((frame - first) * step_s_ >= kStill_s)
        for (int f = first; f < frame; ++f) out.push_back(f);
      first = -1;
    }
    return out;
  }

  // Finds the height of each foot's ankle and toe on the ground. Returns the reason if the clip does not show the
  // ground.
  std::string_view find_ground() {
    std::vector<std::vector<int>> still;
    std::vector<double> heights;
    for (const FootPath& p : paths_) {
      if (!(p.leg > 0.0) || !std::isfinite(p.leg)) return "a leg has no length";
      still.push_back(still_frames(p));
      for (const int frame : still.back()) heights.push_back(p.toe[at(frame)].y);
    }
    const double low = most_common(heights);
    for (std::size_t f = 0; f < paths_.size(); ++f) {
      std::vector<double> ankle, toe;
      for (const int frame : still[f])
        if (const double height = paths_[f].toe[at(frame)].y; height >= low && height <= low + kSameHeight)
          ankle.push_back(paths_[f].ankle[at(frame)].y), toe.push_back(height);
      if (static_cast<double>(toe.size()) * step_s_ < kStood_s) return kNoGround;
      ankle_height_.push_back(middle_value(ankle)), toe_height_.push_back(middle_value(toe));
    }
    return "";
  }

  bool stands(int foot, int frame) const {
    const FootPath& p = path(foot);
    return is_upright(p, frame) && std::fabs(p.ankle[at(frame)].y - ankle_height_[at(foot)]) < kOnGround &&
           std::fabs(p.toe[at(frame)].y - toe_height_[at(foot)]) < kOnGround;
  }

  // The horizontal movement between two frames: the smallest of ankle, toe and the middle between them.
  double way(int foot, int from, int to) const {
    const FootPath& p = path(foot);
    const Vec3 ankle = p.ankle[at(to)] - p.ankle[at(from)], toe = p.toe[at(to)] - p.toe[at(from)];
    return std::min({level_length(ankle), level_length(toe), level_length(0.5 * (ankle + toe))});
  }

  // Returns true if most of the movement happens at once: the foot stepped without being lifted, as stylised figures
  // do.
  bool is_step(int foot, int from, int to, double slid) const {
    int first = from, last = to;
    while (first < to && way(foot, from, first + 1) < 0.1 * slid) ++first;
    while (last > first && way(foot, from, last - 1) > 0.9 * slid) --last;
    return (last - first) * step_s_ < (stays_ ? kSlideOnTheSpot_s : kSlide_s);
  }

  std::optional<FootFault> slide_of(int foot) const {
    const int back = static_cast<int>(std::lround(kClipSlideTime_s / step_s_));
    FootFault worst{.foot = foot, .leg = path(foot).leg};
    int stood_from = -1;
    for (int frame = 0; frame < count_; ++frame) {
      if (!stands(foot, frame)) {
        stood_from = -1;
        continue;
      }
      if (stood_from < 0) stood_from = frame;
      const int from = std::max(stood_from, frame - back);
      const double slid = way(foot, from, frame);
      if (slid > worst.amount + kSameAmount && !is_step(foot, from, frame, slid))
        worst = {foot, slid, path(foot).leg, time_s(from), time_s(frame), time_s(frame)};
    }
    return worst.amount > kClipSlide ? std::optional(worst) : std::nullopt;
  }

  bool another_stands(int foot, int frame) const {
    for (int other = 0; other < foot_count(); ++other)
      if (other != foot && stands(other, frame)) return true;
    return false;
  }

  // The depth of a foot that is below the ground as a whole; otherwise 0, as for a toe that points down.
  double depth(int foot, int frame) const {
    const double toe = toe_height_[at(foot)] - path(foot).toe[at(frame)].y;
    const double ankle = ankle_height_[at(foot)] - path(foot).ankle[at(frame)].y;
    return toe > 0.0 && ankle > 0.5 * toe ? toe : 0.0;
  }

  // Judges only feet that are where they stood last: elsewhere the ground may be lower, as on stairs.
  std::optional<FootFault> sink_of(int foot) const {
    const FootPath& p = path(foot);
    FootFault worst{.foot = foot, .leg = p.leg};
    int stood = -1;
    for (int frame = 0; frame < count_; ++frame) {
      if (stands(foot, frame) && (frame == 0 || is_still(p, frame))) stood = frame;
      const double below = depth(foot, frame);
      if (stood < 0 || below <= worst.amount + kSameAmount || !another_stands(foot, frame)) continue;
      if (level_length(p.toe[at(frame)] - p.toe[at(stood)]) > kSamePlace) continue;
      worst.amount = below;
      worst.first_s = time_s(stood), worst.worst_s = worst.last_s = time_s(frame);
    }
    return worst.amount > kClipSink ? std::optional(worst) : std::nullopt;
  }

  double extension(const FootPath& p, int frame) const { return p.hip[at(frame)].y - p.ankle[at(frame)].y; }

  // Returns true if all soles rise or sink alike and keep their places since the frame `from`, and no leg bends.
  bool moves_as_one(int from, int frame) const {
    const FootPath& first = path(0);
    const double rise = first.toe[at(frame)].y - first.toe[at(from)].y;
    return std::ranges::all_of(paths_, [&](const FootPath& p) {
      const Vec3 toe = p.toe[at(frame)] - p.toe[at(from)], ankle = p.ankle[at(frame)] - p.ankle[at(from)];
      return is_upright(p, frame) && std::fabs(toe.y - rise) < kTogether && std::fabs(ankle.y - rise) < kTogether &&
             level_length(toe) < kTogether + kTogether && level_length(ankle) < kTogether + kTogether &&
             std::fabs(extension(p, frame) - extension(p, from)) < kSameExtension;
    });
  }

  // Returns true if in the last frame no foot is at its former height: a figure that bounces or jumps comes back.
  bool stays_away(int from) const {
    return std::ranges::all_of(paths_, [&](const FootPath& p) {
      return std::fabs(p.toe.back().y - p.toe[at(from)].y) > kClipSink;
    });
  }

  // The greatest distance that the figure rises or sinks while it stands, without coming back.
  std::optional<FootFault> drift_of_figure() const {
    FootFault worst{.foot = 0, .leg = path(0).leg};
    double low = 0.0, high = 0.0;  // a figure that both rises and sinks bounces
    for (int from = 0, frame = 1; frame < count_; ++frame) {
      if (!moves_as_one(from, frame)) {
        from = frame, low = high = 0.0;
        continue;
      }
      const double rise = path(0).toe[at(frame)].y - path(0).toe[at(from)].y;
      low = std::min(low, rise), high = std::max(high, rise);
      if (low < -kClipSink && high > kClipSink) return std::nullopt;
      if ((frame - from) * step_s_ < kDrift_s || !stays_away(from)) continue;
      if (std::fabs(rise) > worst.amount + kSameAmount)
        worst = {0, std::fabs(rise), path(0).leg, time_s(from), time_s(frame), time_s(frame)};
    }
    return worst.amount > kClipSink ? std::optional(worst) : std::nullopt;
  }

  // Returns true if the figure ends where it began. Such a motion is on the spot; an engine moves the figure.
  bool stays() const {
    return std::ranges::all_of(
        paths_, [](const FootPath& p) { return level_length(p.hip.back() - p.hip.front()) < kStays; });
  }

  // The total movement of a foot while it stands.
  Vec3 pulled(int foot) const {
    Vec3 sum(0.0);
    for (int frame = 1; frame < count_; ++frame)
      if (stands(foot, frame) && stands(foot, frame - 1)) sum += path(foot).toe[at(frame)] - path(foot).toe[at(frame - 1)];
    return {sum.x, 0.0, sum.z};
  }

  bool is_on_the_spot(const std::vector<FootFault>& slides) const {
    if (slides.size() < 2 || !stays_) return false;
    const Vec3 first = pulled(slides.front().foot);
    return std::ranges::all_of(slides, [&](const FootFault& slide) {
      const Vec3 own = pulled(slide.foot);
      return glm::dot(first, own) > kSameWay * length(first) * length(own);
    });
  }

  const std::vector<ClipFoot>& feet_;
  double first_s_ = 0.0, step_s_ = kFrame_s;
  int count_ = 0;
  std::vector<FootPath> paths_;
  bool stays_ = false;                             // the figure ends where it began
  std::vector<double> ankle_height_, toe_height_;  // heights by foot, while it rests on the ground
};

}  // namespace

ClipFeetFaults faults_of_feet(const Asset& asset, const AssetClip& clip, const std::vector<ClipFoot>& feet) {
  ClipFeetFaults none;
  if (feet.size() < 2) none.why_not = "the names of its nodes tell no two feet";
  if (clip.last_s - clip.first_s < kStood_s) none.why_not = "it is too short for feet to stand";
  return none.why_not.empty() ? FeetJudge(asset, clip, feet).judge() : none;
}

}  // namespace contort
