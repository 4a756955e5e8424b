// contort render: hands over to contort-render, the program beside this one that loads OpenGL and OpenImageIO (261
// shared libraries, 216 ms and 130 MB), so that nothing else pays for them.
#include "cli/render.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "cli/commands.h"
#include "corpus/corpus.h"
#include "process/program.h"

namespace contort::cli {

std::string renderer_path() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return (self.parent_path() / "contort-render").string();
}

std::vector<std::string> renderer_call(const Context& context) {
  std::vector<std::string> call = {renderer_path(), "--gl", context.gl};
  for (const std::string& folder : context.library_folders) call.insert(call.end(), {"--library", folder});
  if (!context.settings_file.empty()) call.insert(call.end(), {"--settings", context.settings_file});
  return call;
}

namespace {

// Of a folder that is a corpus, the minimal cases, deepest first; those without a motion are left out.
Result<std::vector<std::string>> cases_of(const std::string& folder, int& unreadable) {
  const Result<Corpus> corpus = Corpus::open(folder);
  if (!corpus) return corpus.issue();
  std::vector<Issue> damaged;
  std::vector<std::pair<double, std::string>> cases;
  for (const Bucket& bucket : corpus->buckets(damaged)) {
    const std::string path = corpus->folder_of(bucket) + "/" + bucket.min;
    const Result<Case> stored = read_case_of(corpus->folder_of(bucket), bucket.min);
    if (!stored) damaged.push_back(stored.issue());
    if (stored && !is_abnormal_exit(stored->expect)) cases.emplace_back(-stored->expect.depth, path);
  }
  for (const Issue& issue : damaged) std::fprintf(stderr, "contort: %s\n", to_line(issue).c_str());
  unreadable += static_cast<int>(damaged.size());
  if (cases.empty()) return Issue{"corpus.no_case", "", folder + " has no case to draw"};
  std::stable_sort(cases.begin(), cases.end(), [](const auto& l, const auto& r) { return l.first < r.first; });
  std::vector<std::string> paths;
  for (auto& [depth, path] : cases) paths.push_back(std::move(path));
  return paths;
}

// Folders become the cases that they hold; those that cannot be read are told, and counted.
Result<Done> take_cases(std::vector<std::string>& inputs, int& unreadable) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    std::error_code error;
    if (!std::filesystem::is_directory(input, error)) {
      files.push_back(input);
      continue;
    }
    const Result<std::vector<std::string>> cases = cases_of(input, unreadable);
    if (!cases) return cases.issue();
    files.insert(files.end(), cases->begin(), cases->end());
  }
  inputs = std::move(files);
  return Done{};
}

struct PictureRequest {
  std::vector<std::string> inputs;
  std::string output;
  std::vector<std::string> labels;
  std::string frames;
  std::string azimuth_deg;
  std::string clip;
  std::string compared;
  std::string tolerance_mm;
  bool json = false;
  int tiles = 8;
  bool colliders = false;
  bool rows = false;
  bool sheet = false;
  bool allow_unreadable = false;
};

// The arguments for contort-render, without its files.
std::vector<std::string> arguments_of(const PictureRequest& options) {
  std::vector<std::string> call = {"-o", options.output, "--tiles", std::to_string(options.tiles)};
  for (const auto& [name, value] : {std::pair("--compare", &options.compared), {"--tolerance", &options.tolerance_mm},
                                    {"--frames", &options.frames}, {"--azimuth", &options.azimuth_deg},
                                    {"--clip", &options.clip}})
    if (!value->empty()) call.insert(call.end(), {name, *value});
  for (const auto& [name, is_set] : {std::pair("--json", options.json), {"--colliders", options.colliders},
                                     {"--rows", options.rows}, {"--sheet", options.sheet},
                                     {"--allow-unreadable", options.allow_unreadable}})
    if (is_set) call.emplace_back(name);
  for (const std::string& label : options.labels) call.insert(call.end(), {"--label", label});
  return call;
}

void render(PictureRequest options, Context& context) {
  if (context.gl == "none") return context.fail({"usage", "", "--gl none draws nothing"});
  int unreadable = 0;
  if (options.sheet)
    if (const Result<Done> found = take_cases(options.inputs, unreadable); !found) return context.fail(found.issue());
  std::vector<std::string> call = renderer_call(context);
  const std::vector<std::string> arguments = arguments_of(options);
  call.insert(call.end(), arguments.begin(), arguments.end());
  call.push_back("--");  // A file may be called --rows.
  call.insert(call.end(), options.inputs.begin(), options.inputs.end());
  const Result<int> code = run_in_foreground(call);
  if (!code) return context.fail(code.issue(), kInternal);
  context.exit_code = *code;
  if (*code == kClean && unreadable > 0 && !options.allow_unreadable)
    context.fail({"render.left_out", "",
                  "buckets that cannot be read and are not on the sheet: " + std::to_string(unreadable) +
                      "; --allow-unreadable makes that no error"});
}

}  // namespace

void add_render(CLI::App& app, Context& context) {
  auto options = std::make_shared<PictureRequest>();
  CLI::App* command = app.add_subcommand("render", "Draw a case or spec as a film strip (PNG)");
  command->add_option("FILE", options->inputs, "Case or spec file; several with --rows or --sheet")->required();
  command->add_option("-o,--output", options->output, "The picture")->required();
  command->add_option("--tiles", options->tiles, "Frames on the strip")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--frames", options->frames, "Which frames, instead of a choice: 0,4,8")->type_name("LIST");
  command->add_option("--azimuth", options->azimuth_deg, "Look from here: 0 from the front, 90 from the figure's left")
      ->type_name("DEGREES");
  command->add_option("--clip", options->clip, "The failing half second as a moving picture, too (WebP)")
      ->type_name("FILE");
  command->add_option("--compare", options->compared, "Another case or spec, in a row below: says where the two part")
      ->type_name("FILE");
  command->add_option("--tolerance", options->tolerance_mm, "What is no farther apart is the same [1]")
      ->type_name("MM");
  command->add_flag("--json", options->json, "Print what --compare found as JSON");
  command->add_flag("--colliders", options->colliders, "The shapes that checks judge, as wires around the figure");
  command->add_flag("--rows", options->rows, "A row for each FILE, the same frames and camera in all of them");
  command->add_flag("--sheet", options->sheet, "A contact sheet: a tile for each FILE, or for each bucket of a corpus");
  command->add_flag("--allow-unreadable", options->allow_unreadable,
                    "With --sheet, files that cannot be shown are no error");
  command->add_option("--label", options->labels, "Title of the strip, or of the rows in turn: one for each FILE")
      ->allow_extra_args(false);
  command->footer(
      "Example: contort render docs/examples/reach_hand.json -o strip.png\n"
      "         contort render before.json --compare after.json -o difference.png");
  command->callback([options, &context] { render(*options, context); });
}

}  // namespace contort::cli
