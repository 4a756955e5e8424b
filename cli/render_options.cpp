#include "cli/render_options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "cli/input.h"

namespace contort::cli {

namespace {

// A range that is not repeated in the help after the unit's name.
CLI::Validator range(double least, double most) { return CLI::Range(least, most).description(""); }

// Refuses an empty text, which the parser would read as the number 0.
std::string refuse_empty(const std::string& text) {
  return text.empty() ? "found \"\", expected a number" : "";
}

}  // namespace

std::optional<double> PictureOptions::azimuth_rad() const {
  if (azimuth_deg.empty()) return std::nullopt;
  return std::strtod(azimuth_deg.c_str(), nullptr) * kRadPerDeg;
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
  command.add_option("-o,--output", options.output, "Picture file");
  command.add_option("--tiles", options.tiles, "Number of frames on the strip")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command.add_option("--frames", options.frames, "Frames to show, such as 0,4,8 (default: chosen automatically)")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(refuse_empty)
      ->allow_extra_args(false);
  add_level_option(command, options.level);
  command
      .add_option("--azimuth", options.azimuth_deg, "Direction of view: 0 from the front, 90 from the figure's left")
      ->type_name("DEGREES")
      ->check(range(-360.0, 360.0))
      ->check(refuse_nan);
  command.add_option("--clip", options.clip, "Also write the failing half second as an animation (WebP)")
      ->type_name("FILE");
  command
      .add_option("--compare", options.compared,
                  "Draw this case or spec in a second row, and say in which frame the two motions first differ")
      ->type_name("FILE");
  command.add_option("--tolerance", options.tolerance_mm, "Positions that are no farther apart than this, in mm, count as equal [1]")
      ->type_name("MM")
      ->check(range(0.0, 1e6))
      ->check(refuse_nan);
  command.add_flag("--json", options.json, "Print the result of --compare as JSON");
  command.add_flag("--colliders", options.colliders, "Draw the shapes that checks judge, as wires around the figure");
  command.add_flag("--rows", options.rows, "Draw one row for each FILE, with the same frames and camera");
  command.add_flag("--sheet", options.sheet, "Draw a contact sheet: a tile for each FILE, or for each bucket of a corpus");
  command.add_flag("--allow-unreadable", options.allow_unreadable,
                   "With --sheet, files that cannot be shown are not an error");
  command.add_option("--label", options.labels, "Title of the strip, or of the rows in turn: one for each FILE")
      ->allow_extra_args(false);
}

std::vector<std::string> given_options(const CLI::App& command) {
  std::vector<std::string> call;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_lnames().empty() || option->count() == 0) continue;  // FILE, or an option that was not given
    const std::string name = "--" + option->get_lnames().front();
    const bool is_flag = option->get_items_expected_max() == 0;
    if (is_flag) call.push_back(name);
    for (const std::string& value : is_flag ? CLI::results_t{} : option->results())
      call.insert(call.end(), {name, value});
  }
  return call;
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
