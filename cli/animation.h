// Animations made elsewhere that a user names on the command line: glTF (.glb, .gltf, .vrm, .vrma), BVH, and AMC with
// its ASF; and tables of joint values (CSV). A file's contents decide its format, not its name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/mocap/amc.h"
#include "formats/mocap/take.h"
#include "formats/table/joint_table.h"
#include "model/asset/asset.h"
#include "model/core/result.h"

namespace contort::cli {

// An animation as it was read. An .amc has limits of its own, in its skeleton.
struct Animation {
  Asset asset;
  std::optional<Take> take{};
  std::optional<JointTable> table{};  // a table, whose clip in the asset has no channels
};

struct AnimationOptions {
  std::string skeleton;    // The .asf of an .amc; "": find_skeleton.
  double rate_hz = kTakeRate_hz;  // The frame rate of an .amc, which does not state it.
  double table_rate_hz = 0.0;  // Rows per second of a table without times; 0: it has times.
  double bvh_rate_hz = 0.0;  // The frame rate of a .bvh, instead of its own; 0: its own.
  std::string unit;          // The unit of lengths of a .bvh ("cm") or of angles of a table ("deg"); "": not given.
  std::string up;            // Axis that points up: "y" or "z"; "": +Y in a .bvh, +Z for the root of a table.
};

inline constexpr char kAnimationFiles[] = "an animation (.glb, .gltf, .vrm, .vrma, .bvh, .amc, .csv)";

// Metres in a unit of length; 0 if the name is not a unit of length.
double metres_in(const std::string& unit);

bool is_animation(const std::string& path);  // by its contents, otherwise by its ending
bool is_table(const std::string& path);      // true for a table of joint values, which are a motion of a character; by
                                             // its contents, too

// Returns an issue that names the kind of a plain file that is not an animation; nothing for other files.
std::optional<Issue> other_than_animation(const std::string& path, const std::string& expected);

Result<Animation> read_animation(const std::string& path, const AnimationOptions& options);

struct Unreadable {
  std::string file;
  Issue issue;
};

struct Expanded {
  std::vector<std::string> files;
  std::vector<Unreadable> unreadable;  // folders that cannot be listed
  std::vector<Unreadable> skipped;  // files in folders that are no animations, but of a kind that people take for one
};

// Returns files as they are named, and for folders all animations in them and below, sorted by path. With a character
// it also returns tables that have a column of times.
Expanded expand_animations(const std::vector<std::string>& paths, bool has_character);

}  // namespace contort::cli
