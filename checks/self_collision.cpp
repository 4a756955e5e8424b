// self_collision: signed distance of every judged pair of bodies, in frames and between them. Most pairs are not
// measured in most frames, because they cannot have come near enough since their last measurement.
// docs/reference/checks.md has the bounds.
#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/between_frames.h"
#include "checks/check.h"
#include "checks/clearances.h"

namespace contort {

namespace {

// A pair is measured exactly up to a somewhat greater distance than it matters, so that at the present speed it need
// not be measured again for this many frames.
constexpr double kFramesAhead = 8.0;

// Watches all judged pairs, frame by frame.
class Watch {
 public:
  Watch(const CheckInput& in, MarginFold& fold)
      : in_(in),
        fold_(fold),
        clearances_(in.character),
        between_(in.character),
        paths_m_(in.character.judged_pairs().size(), 0.0),
        no_nearer_m_(paths_m_.size(), std::numeric_limits<double>::quiet_NaN()) {
    for (std::size_t p = 0; p < paths_m_.size(); ++p) matters_m_.push_back(matters_below(p));
    if (in.intent != nullptr)
      for (const Grasp& grasp : in.intent->grasps) add_grasp(grasp);
  }

  // Expects the frames in ascending order.
  void look_at(int frame) {
    if (frame > 0)
      between_.set({in_.motion.row(frame - 1), in_.world_at(frame - 1)}, {in_.motion.row(frame), in_.world_at(frame)});
    between_.paths_m(paths_m_);
    clearances_.place(in_.world_at(frame));
    due_.clear();
    for (std::size_t p = 0; p < paths_m_.size(); ++p)
      if (const double now_m = no_nearer_m_[p] - paths_m_[p]; now_m >= matters_m_[p])
        no_nearer_m_[p] = now_m;
      else if (!is_parted(p))
        due_.push_back({p, matters_m_[p], matters_m_[p] + std::max(0.0, kFramesAhead * paths_m_[p])});
    clearances_.measure(due_);
    for (const DuePair& due : due_) judge(due, frame);
  }

 private:
  double matters_below(std::size_t p) const {
    return std::min(in_.settings.collision_band_m, fold_.matters_below(static_cast<int>(p)));
  }

  // First compares with the summed path lengths, which is cheap. Only if that fails, it computes the gap of the pair.
  // NaN counts as touching.
  bool is_parted(std::size_t p) {
    const double now_m = clearances_.gap_m(p);
    if (!(now_m >= matters_m_[p]) || between_.may_overlap(p, no_nearer_m_[p], now_m)) return false;
    no_nearer_m_[p] = now_m;
    return true;
  }

  // The hand of a grasp may overlap its object.
  void add_grasp(const Grasp& grasp) {
    for (std::size_t p = 0; p < paths_m_.size(); ++p) {
      const JudgedPair& pair = in_.character.judged_pairs()[p];
      if ((pair.body_a == grasp.body && is_beyond(grasp.joint, pair.body_b)) ||
          (pair.body_b == grasp.body && is_beyond(grasp.joint, pair.body_a)))
        grasped_.push_back({p, grasp.first_frame, grasp.last_frame});
    }
  }

  bool is_beyond(int joint, int body) const {
    int own = in_.character.bodies()[static_cast<std::size_t>(body)].joint;
    while (own > joint) own = in_.character.joint(own).parent;
    return own == joint;
  }

  bool is_grasped(std::size_t judged, int frame) const {
    return std::ranges::any_of(grasped_, [&](const GraspedPair& grasped) {
      return grasped.judged == judged && grasped.first_frame <= frame && frame <= grasped.last_frame;
    });
  }

  // A grasp that ended in the frame before still counts between the frames.
  void judge(const DuePair& due, int frame) {
    if (is_grasped(due.judged, frame) || is_grasped(due.judged, frame - 1)) {
      no_nearer_m_[due.judged] = clearances_.distance_m(due);
      matters_m_[due.judged] = matters_below(due.judged);
      return;
    }
    const double before_m = no_nearer_m_[due.judged], now_m = clearances_.distance_m(due);
    double margin_m = now_m >= in_.settings.collision_band_m ? std::numeric_limits<double>::infinity() : now_m;
    if (between_.may_overlap(due.judged, before_m, now_m)) {
      const double least_m = between_.least_distance(due.judged, before_m, now_m);
      if (least_m < std::min(before_m, now_m)) margin_m = least_m;
    }
    fold_.report(static_cast<int>(due.judged), frame, margin_m);
    no_nearer_m_[due.judged] = now_m;
    matters_m_[due.judged] = matters_below(due.judged);
  }

  struct GraspedPair {
    std::size_t judged = 0;
    int first_frame = 0;
    int last_frame = -1;
  };

  const CheckInput& in_;
  MarginFold& fold_;
  Clearances clearances_;
  BetweenFrames between_;
  std::vector<double> paths_m_;      // path length of each judged pair since the frame before
  std::vector<double> no_nearer_m_;  // lower bound of each pair's distance; NaN if unknown
  std::vector<double> matters_m_;    // greater distances of a pair change no result
  std::vector<DuePair> due_;
  std::vector<GraspedPair> grasped_;
};

}  // namespace

int self_collision_subject_count(const Character& character) {
  return static_cast<int>(character.judged_pairs().size());
}

Subject self_collision_subject(const Character& character, int subject) {
  const JudgedPair& pair = character.judged_pairs()[static_cast<std::size_t>(subject)];
  const std::string& a = character.bodies()[static_cast<std::size_t>(pair.body_a)].name;
  const std::string& b = character.bodies()[static_cast<std::size_t>(pair.body_b)].name;
  return {a < b ? a + " ~ " + b : b + " ~ " + a, "m"};
}

void self_collision_measure(const CheckInput& in, MarginFold& fold) {
  Watch watch(in, fold);
  for (int frame = 0; frame < in.motion.frame_count; ++frame) watch.look_at(frame);
  if (in.motion.frame_count > 0) fold.judged_all();
}

}  // namespace contort
