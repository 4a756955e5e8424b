// The options of `contort render` and of contort-render, the program that it starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checks/settings.h"
#include "cli/sources.h"
#include "renders/divergence.h"

namespace CLI {
class App;
}

namespace contort::cli {

// Options of both programs. A new one is declared once, in add_picture_options.
struct PictureOptions {
  std::string output;
  int tiles = 8;
  std::vector<int> frames;
  std::string level;        // scope of each file; "": the whole spec
  std::string azimuth_deg;  // as written on the command line; "": not given
  std::string clip;         // file for the animation; "": none
  std::string compared;     // the file to compare with; "": no comparison
  double tolerance_mm = 1000.0 * kSamePlace_m;
  bool json = false;
  bool colliders = false;
  bool rows = false;
  bool sheet = false;
  bool allow_unreadable = false;  // with `sheet`
  std::vector<std::string> labels;

  std::optional<double> azimuth_rad() const;
  bool operator==(const PictureOptions&) const = default;
};

void add_picture_options(CLI::App& command, PictureOptions& options);

// The options of the parsed command line, without files, for a program that declares the same ones.
std::vector<std::string> given_options(const CLI::App& command);

// The options of contort-render.
struct RenderOptions : PictureOptions {
  std::vector<std::string> files;
  Sources sources;
  std::string gl = "auto";
  std::string settings_file;
  CheckSettings settings{};
  bool clips = false;  // with `many`: also writes an animation beside each strip
  bool views = false;  // with `many`: also writes the cameras of each strip
  bool many = false;
};

// Returns the reason why the arguments contradict each other; "" if they do not.
std::string misfit(const RenderOptions& options);

}  // namespace contort::cli
