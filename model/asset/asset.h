// A rigged and animated model that was made elsewhere, as plain values: nodes, skins, clips. Lengths are in the file's
// own units; glTF says metres, many files disagree. Everything that a reader hands out has been checked: indices are
// valid, numbers finite, rotations unit, times ascending, and the nodes form a forest.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <string>
#include <vector>

#include "model/core/math.h"

namespace contort {

using Mat4 = glm::dmat4;

// Translation, rotation, scale: parent_from_node(p) = translation + rotation * (scale * p).
struct Trs {
  Vec3 translation{0.0};
  Quat rotation = Quat(1.0, 0.0, 0.0, 0.0);  // Unit.
  Vec3 scale{1.0};                           // May be negative or 0.
  bool operator==(const Trs&) const = default;
};

struct AssetNode {
  std::string name;   // As in the file: may be empty, or the name of another node too.
  std::string label;  // Never empty, never twice: the name, or "<name>#<index>" where that is empty or not unique.
  int parent = -1;    // -1 for a root. Not always smaller than the own index, see Asset::order.
  Trs rest;
  bool is_joint = false;  // A skin lists it, or it is a joint of a BVH.
  bool operator==(const AssetNode&) const = default;
};

struct AssetSkin {
  std::string name;
  int skeleton = -1;                  // The common root that the file names, or -1.
  std::vector<int> joints;            // Nodes.
  std::vector<Mat4> joint_from_mesh;  // Inverse bind matrices, one for each joint; identity if the file has none.
  bool operator==(const AssetSkin&) const = default;
};

enum class ChannelPath : std::uint8_t { translation, rotation, scale };
enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

// One animated property of one node.
struct AssetChannel {
  int node = 0;
  ChannelPath path = ChannelPath::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times_s;  // At least one, ascending; two keys may have one time. Keys may lie before 0.
  // Per key: x y z, or for rotations x y z w (the file's order). Cubic splines have three such rows per key:
  // in-tangent, value, out-tangent. Rotation values are unit; tangents are as in the file, in units per second.
  std::vector<double> values;
  bool operator==(const AssetChannel&) const = default;
};

// Returns how many numbers a row of AssetChannel::values has.
inline std::size_t row_size(ChannelPath path) { return path == ChannelPath::rotation ? 4 : 3; }

struct AssetClip {
  std::string name;                    // The file's name.
  std::string label;                   // Unique, made like a node's.
  std::vector<AssetChannel> channels;  // At most one for each (node, path). Morph weights are left out.
  double first_s = 0.0;                // The first and last key of all channels; both 0 without channels.
  double last_s = 0.0;
  std::map<std::string, int> not_read{};  // channels that move no joint, by their kind: "morph weights"
  bool operator==(const AssetClip&) const = default;
};

// A fault of a file that the reader skipped, as its caller requested (formats/gltf/read.h).
struct AssetFault {
  std::string clip;   // its label; "" if the fault concerns all clips
  int node = -1;      // the node of the channel, or -1
  std::string code;   // the code of the Issue: "gltf.bad_times"
  std::string where;  // a JSON pointer into the file
  std::string text;
  // For a rotation that is not a unit quaternion: the index of its key, and its length. The channel was read
  // nevertheless.
  int key = -1;
  double length = 1.0;
  bool operator==(const AssetFault&) const = default;
};

// A remark for people about how a file was read. It does not stop the reader.
struct Remark {
  std::string code;  // The code of the Issue: "bvh.frame_count".
  std::string text;  // One line.
  bool operator==(const Remark&) const = default;
};

struct Asset {
  std::vector<AssetNode> nodes;  // In the file's order.
  std::vector<int> order;  // Every node once, parents before children; roots by index, children as the file lists them.
  std::vector<AssetSkin> skins;
  std::vector<AssetClip> clips;
  std::vector<AssetFault> faults{};  // filled only by readers that skip faults
  std::vector<Remark> remarks;
  bool operator==(const Asset&) const = default;
};

}  // namespace contort
