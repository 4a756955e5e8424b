// The options of contort-render.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checks/settings.h"
#include "renders/divergence.h"

namespace contort::cli {

struct RenderOptions {
  std::vector<std::string> files;
  std::string output;
  std::vector<std::string> libraries;
  std::vector<std::string> labels;
  std::vector<int> frames;
  std::string azimuth_deg;  // as it was written; "": none is given
  std::string clip;         // where the moving picture of one file goes; "": there is none
  std::string gl = "auto";
  std::string settings_file;
  std::string compared;  // with the one file; "": with nothing
  double tolerance_mm = 1000.0 * kSamePlace_m;
  bool json = false;
  CheckSettings settings{};
  bool colliders = false;
  bool clips = false;  // with `many`: beside each strip
  bool views = false;  // the same
  bool many = false;
  bool rows = false;
  bool sheet = false;
  bool allow_unreadable = false;  // with `sheet`
  int tiles = 8;
  std::optional<double> azimuth_rad() const;
};

// Why the arguments do not fit together, "" where they do.
std::string misfit(const RenderOptions& options);

}  // namespace contort::cli
