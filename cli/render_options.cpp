#include "cli/render_options.h"

#include <cstdlib>

namespace contort::cli {

std::optional<double> RenderOptions::azimuth_rad() const {
  if (azimuth_deg.empty()) return std::nullopt;
  return std::strtod(azimuth_deg.c_str(), nullptr) * kRadPerDeg;
}

std::string misfit(const RenderOptions& options) {
  const std::size_t files = options.files.size(), shown = files + (options.compared.empty() ? 0 : 1);
  if (options.many + options.rows + options.sheet > 1) return "--many, --rows and --sheet exclude each other";
  if (options.compared.empty() && options.json) return "--json is what --compare found";
  if (!options.compared.empty() && (options.many || options.rows || options.sheet || files > 1))
    return "--compare sets one FILE beside another";
  if (options.sheet && !options.labels.empty()) return "--sheet takes no --label";
  if (!options.clip.empty() && options.clip == options.output) return "--clip and -o are the same file";
  if (options.sheet && !options.frames.empty()) return "--sheet shows the worst frame of each FILE";
  if (options.many && files % 2 != 0) return "expected --many FILE PNG FILE PNG …";
  if (options.allow_unreadable && !options.sheet) return "--allow-unreadable is for --sheet";
  if ((options.clips || options.views) && !options.many) return "--clips and --views need --many";
  if (!options.clip.empty() && (options.many || options.rows || options.sheet || !options.compared.empty()))
    return "--clip is of one FILE";
  if (!options.many && options.output.empty()) return "expected -o PNG";
  if (!options.many && !options.rows && !options.sheet && files > 1)
    return "found " + std::to_string(files) +
           " files: with --rows they become the rows of one picture, with --sheet its tiles";
  if (!options.labels.empty() && (options.many || options.labels.size() != shown))
    return "found " + std::to_string(options.labels.size()) + " labels for " + std::to_string(shown) +
           " files, expected one for each";
  return "";
}

}  // namespace contort::cli
