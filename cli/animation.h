// Animations made elsewhere that a user names on the command line: .glb, .gltf, .bvh, and .amc with its .asf.
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
};

bool is_animation(const std::string& path);  // by its ending

Result<Animation> read_animation(const std::string& path, const AnimationOptions& options);

// The only .asf in the folder of an .amc; of several, the one whose name begins most like the .amc's. Code
// check.no_skeleton where there is none or no single one.
Result<std::string> find_skeleton(const std::string& amc_path);

struct Unreadable {
  std::string file;
  Issue issue;
};

// Files as they are named, and folders as all animations in them and below, sorted by path, whatever kind of file these
// are. Folders that cannot be looked into are added to `unreadable`.
std::vector<std::string> expand_animations(const std::vector<std::string>& paths, std::vector<Unreadable>& unreadable);

}  // namespace contort::cli
