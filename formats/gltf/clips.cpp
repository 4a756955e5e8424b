#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "formats/gltf/from_model.h"
#include "model/asset/labels.h"
#include "model/core/number_text.h"

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

Result<AssetSkin> read_joints(const tinygltf::Skin& skin, const std::string& pointer) {
  std::set<int> seen;
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    if (!seen.insert(skin.joints[i]).second)
      return Issue{"gltf.bad_skin", pointer + "/joints/" + std::to_string(i),
                   "node " + std::to_string(skin.joints[i]) + " stands in the list twice"};
  return AssetSkin{skin.name, skin.skeleton, skin.joints, std::vector<Mat4>(skin.joints.size(), Mat4(1.0))};
}

AssetFault fault_of(const Issue& issue, const std::string& clip, int node) {
  return {clip, node, issue.code, issue.pointer, issue.text, -1, 1.0};
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
    if (i > 0 && times[i] < times[i - 1])
      return Issue{"gltf.bad_times", pointer,
                   "key " + std::to_string(i) + " is before the key before it; allowed are ascending times"};
  return Done{};
}

// The rotation whose length differs most from 1.
struct WorstLength {
  std::size_t key = 0;
  double length = 1.0;

  bool is_unit() const { return std::fabs(length - 1.0) <= kUnitTolerance; }
};

constexpr double kNoLength = 1e-6;  // a shorter quaternion has no direction

// Normalises the rotations, but not the tangents. A rotation without a direction is replaced by the key before it.
WorstLength normalize_rotations(AssetChannel& channel) {
  const bool is_spline = channel.interpolation == Interpolation::cubic_spline;
  WorstLength worst;
  std::array<double, 4> before = {0.0, 0.0, 0.0, 1.0};
  for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
    double* q = channel.values.data() + 4 * (is_spline ? 3 * key + 1 : key);
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (std::fabs(length - 1.0) > std::fabs(worst.length - 1.0)) worst = {key, length};
    for (std::size_t i = 0; i < 4; ++i) q[i] = length > kNoLength ? q[i] / length : before[i];
    std::copy_n(q, 4, before.begin());
  }
  return worst;
}

class ClipReader {
 public:
  ClipReader(const tinygltf::Animation& animation, AccessorReader& accessors, std::string pointer, Faults faults,
             Asset& asset)
      : animation_(animation), accessors_(accessors), pointer_(std::move(pointer)), faults_(faults), asset_(asset) {}

  Result<Done> read(AssetClip& out) {
    for (std::size_t i = 0; i < animation_.channels.size(); ++i) {
      const tinygltf::AnimationChannel& channel = animation_.channels[i];
      if (const std::string other = moves_no_joint(channel); !other.empty()) {
        ++out.not_read[other];
        continue;
      }
      const std::size_t known = asset_.faults.size();
      Result<AssetChannel> read = read_channel(channel, pointer_ + "/channels/" + std::to_string(i));
      if (!read && faults_ == Faults::refuse) return read.issue();
      if (!read) asset_.faults.push_back(fault_of(read.issue(), out.label, channel.target_node));
      for (std::size_t f = known; f < asset_.faults.size(); ++f) asset_.faults[f].clip = out.label;
      // A channel without keys has no effect.
      if (read && !read->times_s.empty()) out.channels.push_back(std::move(read).value());
    }
    return Done{};
  }

 private:
  static std::string moves_no_joint(const tinygltf::AnimationChannel& channel) {
    if (channel.target_path == "weights") return "morph weights";
    if (channel.target_node >= 0) return "";
    return channel.target_path == "pointer" ? "animation pointers" : "channels without a node";
  }

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
    if (!accessors_.has_data(accessor)) return Done{};  // an extension's data, which are not read
    Result<std::vector<double>> times = accessors_.read(accessor, ElementKind::scalar, keys);
    if (!times) return times.issue();
    out.times_s = std::move(times).value();
    return check_times(out.times_s, accessor_pointer(accessor));
  }

  Result<Done> read_values(int accessor, std::size_t count, AssetChannel& out) {
    const bool is_rotation = out.path == ChannelPath::rotation;
    Result<std::vector<double>> values =
        accessors_.read(accessor, is_rotation ? ElementKind::vec4 : ElementKind::vec3, count,
                        is_rotation ? Integers::normalized : Integers::none);
    if (!values) return values.issue();
    out.values = std::move(values).value();
    if (!is_rotation) return Done{};
    const WorstLength worst = normalize_rotations(out);
    if (worst.is_unit()) return Done{};
    const Issue issue = {"gltf.not_unit", accessor_pointer(accessor),
                         "the rotation at key " + std::to_string(worst.key) +
                             " is a quaternion of another length than 1, "
                             "give or take 1 %"};
    if (faults_ == Faults::refuse) return issue;
    asset_.faults.push_back(fault_of(issue, "", out.node));
    asset_.faults.back().key = static_cast<int>(worst.key), asset_.faults.back().length = worst.length;
    return Done{};
  }

  const tinygltf::Animation& animation_;
  AccessorReader& accessors_;
  std::string pointer_;
  Faults faults_;
  Asset& asset_;  // receives the faults
  std::set<std::pair<int, ChannelPath>> targets_;
};

void find_range(AssetClip& clip) {
  for (std::size_t i = 0; i < clip.channels.size(); ++i) {
    const std::vector<double>& times = clip.channels[i].times_s;
    clip.first_s = i == 0 ? times.front() : std::min(clip.first_s, times.front());
    clip.last_s = i == 0 ? times.back() : std::max(clip.last_s, times.back());
  }
}

// Adds remarks about key times that the standard forbids and that are read nevertheless.
void remark_times(const AssetClip& clip, std::vector<Remark>& remarks) {
  const auto has_twins = [](const AssetChannel& c) { return std::ranges::adjacent_find(c.times_s) != c.times_s.end(); };
  if (clip.first_s < 0.0)
    remarks.push_back({"gltf.negative_times", "clip " + clip.label + " has keys before 0 s, from " +
                                                  number_text(clip.first_s) + " s on; they are judged, too"});
  if (const auto channels = std::ranges::count_if(clip.channels, has_twins); channels > 0)
    remarks.push_back({"gltf.equal_times", "clip " + clip.label + " has keys at equal times in " +
                                               std::to_string(channels) + " channels; they are read as jumps"});
}

}  // namespace

Result<Done> read_skins(const tinygltf::Model& model, AccessorReader& accessors, Faults faults, Asset& asset) {
  for (const tinygltf::Skin& skin : model.skins) {
    const std::string pointer = "/skins/" + std::to_string(asset.skins.size());
    Result<AssetSkin> joints = read_joints(skin, pointer);
    if (!joints) return joints.issue();
    AssetSkin read = std::move(joints).value();
    Result<std::vector<Mat4>> matrices = read_bind_matrices(skin, accessors, pointer);
    const bool has_clip = !model.animations.empty();  // without a clip, nothing could report the fault
    if (!matrices && (faults == Faults::refuse || !has_clip)) return matrices.issue();
    if (!matrices) asset.faults.push_back(fault_of(matrices.issue(), "", -1));
    if (matrices) read.joint_from_mesh = std::move(matrices).value();
    for (const int joint : skin.joints) asset.nodes[static_cast<std::size_t>(joint)].is_joint = true;
    asset.skins.push_back(std::move(read));
  }
  return Done{};
}

Result<Done> read_clips(const tinygltf::Model& model, AccessorReader& accessors, Faults faults, Asset& asset) {
  std::vector<std::string> names;
  for (const tinygltf::Animation& animation : model.animations) names.push_back(animation.name);
  std::vector<std::string> labels = unique_labels(names);
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    AssetClip clip{std::move(names[i]), std::move(labels[i]), {}, 0.0, 0.0};
    ClipReader reader(model.animations[i], accessors, "/animations/" + std::to_string(i), faults, asset);
    if (const Result<Done> read = reader.read(clip); !read) return read.issue();
    find_range(clip);
    remark_times(clip, asset.remarks);
    asset.clips.push_back(std::move(clip));
  }
  return Done{};
}

}  // namespace contort
