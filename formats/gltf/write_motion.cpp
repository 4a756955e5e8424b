#include <tiny_gltf.h>

#include <cmath>
#include <limits>
#include <string>

#include "formats/gltf/write_parts.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

bool turns(JointKind kind) { return kind != JointKind::prismatic; }
bool travels(JointKind kind) { return kind == JointKind::root || kind == JointKind::prismatic; }

// The keys of one joint.
struct Track {
  // X y z w; the signs are chosen so that neighbours are less than half a turn apart as quaternions.
  std::vector<float> rotations;
  std::vector<float> translations;  // x y z
  Quat last = kNoRotation;
};

Rigid local_at(const Joint& joint, const Motion& motion, int frame) {
  if (joint.kind == JointKind::root) return motion.root[static_cast<std::size_t>(frame)];
  return joint.parent_from_joint * joint_motion(joint, motion.row(frame));
}

// Returns false for NaN.
bool fits_float(double value) { return std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max()); }

bool fits_float(const Rigid& r) {
  return fits_float(r.p_m.x) && fits_float(r.p_m.y) && fits_float(r.p_m.z) && fits_float(r.q.w) && fits_float(r.q.x) &&
         fits_float(r.q.y) && fits_float(r.q.z);
}

Issue bad_value(const char* code, const Joint& joint, const Motion& motion, int frame, const char* what) {
  const int row = frame * motion.coord_count + joint.coord;
  const std::string pointer =
      joint.kind == JointKind::root ? "/root/" + std::to_string(frame) : "/coords/" + std::to_string(row);
  return {code, pointer, "frame " + std::to_string(frame) + ", joint \"" + joint.name + "\": " + what};
}

// q and -q are the same rotation, but for a linear track from one to the other many viewers go the long way.
Quat continued(const Quat& q, const Quat& last) { return glm::dot(q, last) < 0.0 ? -q : q; }

Result<Done> add_key(Track& track, const Joint& joint, const Motion& motion, int frame) {
  const Rigid local = local_at(joint, motion, frame);
  if (!fits_float(local))
    return bad_value("gltf.not_finite", joint, motion, frame, "NaN, infinite, or too large for a 32-bit float");
  const double length = std::sqrt(glm::dot(local.q, local.q));
  if (!(length > 1e-12)) return bad_value("gltf.not_unit", joint, motion, frame, "a quaternion of length 0");
  track.last = continued(local.q / length, track.last);
  if (turns(joint.kind))
    for (const double v : {track.last.x, track.last.y, track.last.z, track.last.w})
      track.rotations.push_back(static_cast<float>(v));
  if (travels(joint.kind))
    for (int i = 0; i < 3; ++i) track.translations.push_back(static_cast<float>(local.p_m[i]));
  return Done{};
}

Result<std::vector<Track>> make_tracks(const Character& character, const Motion& motion) {
  const std::span<const Joint> joints = character.joints();
  std::vector<Track> tracks(joints.size());
  // The loop over frames is outside, so that the first bad frame is reported.
  for (int frame = motion.first_frame; frame < motion.frame_count; ++frame)
    for (std::size_t i = 0; i < joints.size(); ++i)
      if (const auto added = add_key(tracks[i], joints[i], motion, frame); !added) return added.issue();
  return tracks;
}

Result<std::vector<float>> key_times(const Motion& motion) {
  std::vector<float> out;
  for (int frame = motion.first_frame; frame < motion.frame_count; ++frame) {
    out.push_back(static_cast<float>((frame - motion.first_frame) / motion.rate_hz));
    // After hours at high rates, neighbouring frames get the same 32-bit time.
    if (frame > motion.first_frame && !(out.back() > out[out.size() - 2]))
      return Issue{"gltf.too_large", "/frame_count",
                   "32-bit times cannot tell frame " + std::to_string(frame) + " from the one before"};
  }
  return out;
}

void add_channel(tinygltf::Model& model, tinygltf::Animation& animation, int node, const char* path, int times,
                 const std::vector<float>& values, std::size_t components) {
  tinygltf::AnimationChannel channel;
  channel.sampler = static_cast<int>(animation.samplers.size());
  channel.target_node = node;
  channel.target_path = path;
  animation.channels.push_back(std::move(channel));
  tinygltf::AnimationSampler sampler;
  sampler.input = times;
  sampler.output = add_floats(model, values, components, false);
  sampler.interpolation = "LINEAR";
  animation.samplers.push_back(std::move(sampler));
}

Result<Done> check_shape(const Character& character, const Motion& motion) {
  if (!(motion.rate_hz > 0.0) || !std::isfinite(motion.rate_hz))
    return Issue{"gltf.bad_rate", "/rate_hz",
                 "found " + std::to_string(motion.rate_hz) + "; allowed are rates above 0"};
  const auto frames = static_cast<std::size_t>(motion.frame_count);
  const bool fits = motion.frame_count >= 0 && motion.coord_count == character.coord_count() &&
                    motion.root.size() == frames &&
                    motion.coords.size() == frames * static_cast<std::size_t>(motion.coord_count);
  if (fits) return Done{};
  return Issue{"gltf.wrong_character", "/coord_count",
               "the motion has " + std::to_string(motion.frame_count) + " frames of " +
                   std::to_string(motion.coord_count) + " coordinates; the character has " +
                   std::to_string(character.coord_count())};
}

}  // namespace

Result<Done> add_motion(tinygltf::Model& model, const Character& character, const Motion& motion,
                        std::optional<int> only_part) {
  if (motion.frame_count == 0) return Done{};
  if (const auto checked = check_shape(character, motion); !checked) return checked.issue();
  const Result<std::vector<Track>> tracks = make_tracks(character, motion);
  if (!tracks) return tracks.issue();
  const Result<std::vector<float>> seconds = key_times(motion);
  if (!seconds) return seconds.issue();
  const int times = add_floats(model, *seconds, 1, true);
  tinygltf::Animation animation;
  animation.name = "motion";
  for (std::size_t i = 0; i < tracks->size(); ++i) {
    const Track& track = (*tracks)[i];
    const int node = static_cast<int>(i);
    if (only_part && character.joints()[i].part != *only_part) continue;
    if (!track.rotations.empty()) add_channel(model, animation, node, "rotation", times, track.rotations, 4);
    if (!track.translations.empty()) add_channel(model, animation, node, "translation", times, track.translations, 3);
  }
  model.animations.push_back(std::move(animation));
  return Done{};
}

}  // namespace contort
