#include "import/contacts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "generator/motion/joint_clamp.h"
#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/geometry/distance.h"
#include "model/motion/kinematics.h"
#include "model/motion/recording.h"

namespace contort {

namespace {

constexpr std::size_t kMostPairs = 1000;  // as many as a character's file may list
constexpr double kPosesPerClip = 24.0;
constexpr int kMostContactPoses = 600;

// An overlap is allowed if it occurs in this fraction of the poses.
struct Habit {
  double share;
  const char* reason;
  const char* poses;
};
constexpr Habit kOwnClips = {0.1, "own_clips", "sampled poses"};
constexpr Habit kSampledPoses = {0.95, "sampled_poses", "poses within all ranges"};

struct PairCount {
  double rest_m = 0.0;  // signed distance
  double least_m = 0.0;
  int overlaps = 0;
};

class ContactFinder {
 public:
  ContactFinder(const Character& character, const Habit& habit)
      : character_(character),
        habit_(habit),
        world_(character.joints().size()),
        counts_(character.judged_colliders().size()) {
    for (const Collider& collider : character.colliders()) solids_.push_back(solid_of(collider.shape));
  }

  void rest() {
    forward_kinematics(character_, character_.rest_root(), character_.rest_coords(), world_);
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i].rest_m = counts_[i].least_m = distance(i);
  }

  void pose(const Rigid& root, std::span<const double> coords) {
    forward_kinematics(character_, root, coords, world_);
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      const double now = distance(i);
      counts_[i].least_m = std::min(counts_[i].least_m, now);
      counts_[i].overlaps += now < 0.0;
    }
    ++poses_;
  }

  OwnContacts result() const {
    OwnContacts out;
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (counts_[i].rest_m < 0.0 || is_often(i)) found.push_back(i);
    std::stable_sort(found.begin(), found.end(),
                     [this](std::size_t a, std::size_t b) { return counts_[a].least_m < counts_[b].least_m; });
    for (const std::size_t i : found) {
      if (out.pairs.size() == kMostPairs) {
        ++out.left_out;
        continue;
      }
      const ColliderPair& pair = character_.judged_colliders()[i];
      ++(counts_[i].rest_m < 0.0 ? out.at_rest : out.in_poses);
      out.pairs.push_back(
          {character_.colliders()[at(pair.a)].name, character_.colliders()[at(pair.b)].name, reason(i)});
    }
    return out;
  }

 private:
  double distance(std::size_t i) const {
    const ColliderPair& pair = character_.judged_colliders()[i];
    const auto placed = [&](int c) { return moved(world_[at(character_.colliders()[at(c)].joint)], solids_[at(c)]); };
    return signed_distance(placed(pair.a), placed(pair.b), 0.0);
  }

  bool is_often(std::size_t i) const { return poses_ > 0 && counts_[i].overlaps >= habit_.share * poses_; }

  std::string reason(std::size_t i) const {
    char text[120];
    if (counts_[i].rest_m < 0.0)
      std::snprintf(text, sizeof text, "rest_pose: they overlap by %.4f m", -counts_[i].rest_m);
    else
      std::snprintf(text, sizeof text, "%s: they overlap in %d of %d %s", habit_.reason, counts_[i].overlaps, poses_,
                    habit_.poses);
    return text;
  }

  const Character& character_;
  const Habit& habit_;
  std::vector<Solid> solids_;
  std::vector<Rigid> world_;
  std::vector<PairCount> counts_;  // by index into judged_colliders()
  int poses_ = 0;
};

// Draws poses within all ranges. Only the bits of the standard's engine are used, because its distributions differ
// between libraries.
class EvenPoses {
 public:
  explicit EvenPoses(const Character& character)
      : character_(character), coords_(character.rest_coords().begin(), character.rest_coords().end()) {}

  std::span<const double> next() {
    for (const Joint& joint : character_.joints().subspan(1)) draw(joint, &coords_[at(joint.coord)]);
    return coords_;
  }

 private:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

  void draw(const Joint& joint, double* coords) {
    if (joint.kind != JointKind::ball) {
      coords[0] = between(joint.low, joint.high);
      return;
    }
    const double share = std::sqrt(between(0.0, 1.0)), angle_rad = between(-kPi, kPi);  // uniform in the ellipse
    set_swing_twist(joint,
                    {joint.swing_a_rad * share * det::cos(angle_rad), joint.swing_b_rad * share * det::sin(angle_rad),
                     between(std::max(joint.low, -kPi), std::min(joint.high, kPi))},
                    coords);
  }

  const Character& character_;
  std::vector<double> coords_;
  std::mt19937_64 engine_;
};

}  // namespace

OwnContacts propose_contacts(const Character& character, int poses) {
  ContactFinder finder(character, kSampledPoses);
  finder.rest();
  EvenPoses drawn(character);
  for (int i = 0; i < poses; ++i) finder.pose(character.rest_root(), drawn.next());
  return finder.result();
}

OwnContacts find_contacts(const Character& character, const Asset& asset,
                          const std::map<std::string, std::string>& joints) {
  ContactFinder finder(character, kOwnClips);
  finder.rest();
  int poses = 0;
  for (const AssetClip& clip : asset.clips) {
    const double length_s = clip.last_s - clip.first_s;
    if (poses >= kMostContactPoses || !(length_s > 0.0)) continue;
    const double rate_hz = std::min(30.0, kPosesPerClip / length_s);
    const Result<Motion> motion = follow_recording(character, {asset, clip, joints, 0.0, rate_hz, 0, Rigid{}});
    if (!motion) continue;  // if names do not match, only the rest pose counts
    for (int frame = 0; frame < motion->frame_count; ++frame, ++poses)
      finder.pose(motion->root[at(frame)], motion->row(frame));
  }
  return finder.result();
}

}  // namespace contort
