#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "formats/gltf/from_model.h"
#include "model/asset/labels.h"

namespace contort {

namespace {

// ---- skins

Result<std::vector<Mat4>> read_bind_matrices(const tinygltf::Skin& skin, AccessorReader& accessors,
                                             const std::string& pointer) {
  const std::size_t count = skin.joints.size();
  std::vector<Mat4> out(count, Mat4(1.0));
  if (skin.inverseBindMatrices < 0) return out;
  if (accessors.count(skin.inverseBindMatrices) < count)
    return Issue{"gltf.bad_skin", pointer + "/inverseBindMatrices",
                 "found " + std::to_string(accessors.count(skin.inverseBindMatrices)) + " matrices for " +
                     std::to_string(count) + " joints"};
  const auto numbers = accessors.read(skin.inverseBindMatrices, ElementKind::mat4, count);
  if (!numbers) return numbers.issue();
  for (std::size_t i = 0; i < 16 * count; ++i)
    out[i / 16][static_cast<int>(i / 4 % 4)][static_cast<int>(i % 4)] = (*numbers)[i];
  return out;
}

Result<AssetSkin> read_skin(const tinygltf::Skin& skin, AccessorReader& accessors, const std::string& pointer) {
  std::set<int> seen;
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    if (!seen.insert(skin.joints[i]).second)
      return Issue{"gltf.bad_skin", pointer + "/joints/" + std::to_string(i),
                   "node " + std::to_string(skin.joints[i]) + " stands in the list twice"};
  Result<std::vector<Mat4>> matrices = read_bind_matrices(skin, accessors, pointer);
  if (!matrices) return matrices.issue();
  return AssetSkin{skin.name, skin.skeleton, skin.joints, std::move(matrices).value()};
}

// ---- clips

bool read_path(const std::string& text, ChannelPath& out) {
  if (text == "translation") out = ChannelPath::translation;
  if (text == "rotation") out = ChannelPath::rotation;
  if (text == "scale") out = ChannelPath::scale;
  return text == "translation" || text == "rotation" || text == "scale";
}

bool read_interpolation(const std::string& text, Interpolation& out) {
  if (text == "STEP") out = Interpolation::step;
  if (text == "LINEAR") out = Interpolation::linear;
  if (text == "CUBICSPLINE") out = Interpolation::cubic_spline;
  return text == "STEP" || text == "LINEAR" || text == "CUBICSPLINE";
}

Result<Done> check_times(const std::vector<double>& times, const std::string& pointer) {
  for (std::size_t i = 0; i < times.size(); ++i)
    if (times[i] < 0.0 || (i > 0 && times[i] <= times[i - 1]))
      return Issue{"gltf.bad_times", pointer,
                   "key " + std::to_string(i) +
                       " is before 0 s, or not later than the key "
                       "before it; allowed are ascending times"};
  return Done{};
}

// Makes the rotations exactly unit; tangents stay. False, with the key's number, where one is no rotation at all.
bool normalize_rotations(AssetChannel& channel, std::size_t& bad_key) {
  const bool is_spline = channel.interpolation == Interpolation::cubic_spline;
  for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
    double* q = channel.values.data() + 4 * (is_spline ? 3 * key + 1 : key);
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    bad_key = key;
    if (!(std::fabs(length - 1.0) <= kUnitTolerance)) return false;
    for (int i = 0; i < 4; ++i) q[i] /= length;
  }
  return true;
}

class ClipReader {
 public:
  ClipReader(const tinygltf::Animation& animation, AccessorReader& accessors, std::string pointer)
      : animation_(animation), accessors_(accessors), pointer_(std::move(pointer)) {}

  Result<std::vector<AssetChannel>> read() {
    std::vector<AssetChannel> out;
    for (std::size_t i = 0; i < animation_.channels.size(); ++i) {
      const tinygltf::AnimationChannel& channel = animation_.channels[i];
      // No node: for extensions. Morph weights move no joint.
      if (channel.target_node < 0 || channel.target_path == "weights") continue;
      Result<AssetChannel> read = read_channel(channel, pointer_ + "/channels/" + std::to_string(i));
      if (!read) return read.issue();
      if (!read->times_s.empty()) out.push_back(std::move(read).value());  // else nothing is said about the node
    }
    return out;
  }

 private:
  Result<AssetChannel> read_channel(const tinygltf::AnimationChannel& channel, const std::string& pointer) {
    AssetChannel out;
    out.node = channel.target_node;
    if (!read_path(channel.target_path, out.path))
      return Issue{"gltf.unsupported", pointer + "/target/path",
                   "allowed are translation, rotation, scale and weights"};
    if (!targets_.insert({out.node, out.path}).second)
      return Issue{"gltf.duplicate_channel", pointer + "/target", "an earlier channel moves the same property"};
    if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation_.samplers.size())
      return Issue{"gltf.bad_index", pointer + "/sampler",
                   "found " + std::to_string(channel.sampler) + "; allowed is the index of one of the " +
                       std::to_string(animation_.samplers.size()) + " samplers of the animation"};
    if (const auto sampled = read_sampler(channel.sampler, out); !sampled) return sampled.issue();
    return out;
  }

  Result<Done> read_sampler(int index, AssetChannel& out) {
    const tinygltf::AnimationSampler& sampler = animation_.samplers[static_cast<std::size_t>(index)];
    const std::string pointer = pointer_ + "/samplers/" + std::to_string(index);
    if (!read_interpolation(sampler.interpolation, out.interpolation))
      return Issue{"gltf.unsupported", pointer + "/interpolation", "allowed are STEP, LINEAR and CUBICSPLINE"};
    const std::size_t keys = accessors_.count(sampler.input);
    const std::size_t rows = out.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const std::size_t outputs = accessors_.count(sampler.output);
    if (outputs % rows != 0 || outputs / rows != keys)
      return Issue{"gltf.bad_accessor", accessor_pointer(sampler.output) + "/count",
                   "found " + std::to_string(outputs) + " values for " + std::to_string(keys) + " keys; allowed are " +
                       std::to_string(rows) + " for each"};
    if (const auto read = read_times(sampler.input, keys, out); !read) return read.issue();
    return read_values(sampler.output, outputs, out);
  }

  Result<Done> read_times(int accessor, std::size_t keys, AssetChannel& out) {
    if (!accessors_.has_data(accessor)) return Done{};  // a place that some extension fills in
    Result<std::vector<double>> times = accessors_.read(accessor, ElementKind::scalar, keys);
    if (!times) return times.issue();
    out.times_s = std::move(times).value();
    return check_times(out.times_s, accessor_pointer(accessor));
  }

  Result<Done> read_values(int accessor, std::size_t count, AssetChannel& out) {
    const bool is_rotation = out.path == ChannelPath::rotation;
    Result<std::vector<double>> values =
        accessors_.read(accessor, is_rotation ? ElementKind::vec4 : ElementKind::vec3, count, is_rotation);
    if (!values) return values.issue();
    out.values = std::move(values).value();
    std::size_t bad_key = 0;
    if (is_rotation && !normalize_rotations(out, bad_key))
      return Issue{"gltf.not_unit", accessor_pointer(accessor),
                   "the rotation at key " + std::to_string(bad_key) +
                       " is a quaternion of another length than 1, "
                       "give or take 1 %"};
    return Done{};
  }

  const tinygltf::Animation& animation_;
  AccessorReader& accessors_;
  std::string pointer_;
  std::set<std::pair<int, ChannelPath>> targets_;
};

void find_range(AssetClip& clip) {
  for (std::size_t i = 0; i < clip.channels.size(); ++i) {
    const std::vector<double>& times = clip.channels[i].times_s;
    clip.first_s = i == 0 ? times.front() : std::min(clip.first_s, times.front());
    clip.last_s = i == 0 ? times.back() : std::max(clip.last_s, times.back());
  }
}

}  // namespace

Result<Done> read_skins(const tinygltf::Model& model, AccessorReader& accessors, Asset& asset) {
  for (const tinygltf::Skin& skin : model.skins) {
    Result<AssetSkin> read = read_skin(skin, accessors, "/skins/" + std::to_string(asset.skins.size()));
    if (!read) return read.issue();
    for (const int joint : skin.joints) asset.nodes[static_cast<std::size_t>(joint)].is_joint = true;
    asset.skins.push_back(std::move(read).value());
  }
  return Done{};
}

Result<Done> read_clips(const tinygltf::Model& model, AccessorReader& accessors, Asset& asset) {
  std::vector<std::string> names;
  for (const tinygltf::Animation& animation : model.animations) names.push_back(animation.name);
  std::vector<std::string> labels = unique_labels(names);
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    auto channels = ClipReader(model.animations[i], accessors, "/animations/" + std::to_string(i)).read();
    if (!channels) return channels.issue();
    asset.clips.push_back({std::move(names[i]), std::move(labels[i]), std::move(channels).value(), 0.0, 0.0});
    find_range(asset.clips.back());
  }
  return Done{};
}

}  // namespace contort
