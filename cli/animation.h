// Animations made elsewhere that a user names on the command line: glTF (.glb, .gltf, .vrm, .vrma), BVH, and AMC with
// its ASF. What a file holds tells its format, whatever its name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/mocap/amc.h"
#include "model/asset/asset.h"
#include "model/core/result.h"

namespace contort::cli {

// An .amc has limits of its own, in its skeleton.
struct Take {
  AsfSkeleton skeleton;
  AmcMotion motion;
};

struct Animation {
  Asset asset;
  std::optional<Take> take;
};

struct AnimationOptions {
  std::string skeleton;    // The .asf of an .amc; "": find_skeleton.
  double rate_hz = 120.0;  // The frame rate of an .amc, which does not say it.
  double bvh_rate_hz = 0.0;  // The frame rate of a .bvh, instead of its own; 0: its own.
  double bvh_unit_m = 0.0;   // The unit of a .bvh in metres; 0: nobody says it, and lengths stay in that unit.
  bool bvh_z_up = false;     // Else +Y is up in a .bvh.
};

inline constexpr char kAnimationFiles[] = "an animation (.glb, .gltf, .vrm, .vrma, .bvh, .amc)";

bool is_animation(const std::string& path);  // by what it holds, else by its ending

// Says what a plain file is that is no animation; nothing for what is no plain file.
std::optional<Issue> other_than_animation(const std::string& path, const std::string& expected);

Result<Animation> read_animation(const std::string& path, const AnimationOptions& options);

// The only .asf in the folder of an .amc; of several, the one whose name begins most like the .amc's. Code
// check.no_skeleton where there is none or no single one.
Result<std::string> find_skeleton(const std::string& amc_path);

struct Unreadable {
  std::string file;
  Issue issue;
};

struct Expanded {
  std::vector<std::string> files;
  std::vector<Unreadable> unreadable;  // folders that cannot be looked into
  std::vector<Unreadable> skipped;     // files in folders that are no animation, but of a kind that people take for one
};

// Files as they are named, and folders as all animations in them and below, sorted by path, whatever kind of file these
// are.
Expanded expand_animations(const std::vector<std::string>& paths);

}  // namespace contort::cli
