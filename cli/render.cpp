// contort render: starts contort-render, a separate program that loads OpenGL and OpenImageIO (261 shared libraries,
// 216 ms and 130 MB), so that other commands need not load them.
#include "cli/render.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <thread>

#include "cli/commands.h"
#include "cli/program_files.h"
#include "cli/render_options.h"
#include "corpus/corpus.h"
#include "fuzz/parallel.h"
#include "process/program.h"

namespace contort::cli {

std::vector<std::string> renderer_call(const Context& context) {
  std::vector<std::string> call = {renderer_path(), "--gl", context.gl};
  for (const std::string& argument : context.sources.arguments()) call.push_back(argument);
  if (!context.settings_file.empty()) call.insert(call.end(), {"--settings", context.settings_file});
  return call;
}

int draw_strips(const std::vector<StripFile>& strips, const std::vector<std::string>& more, const Context& context,
                const std::function<void()>& progress) {
  const int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<int> codes(static_cast<std::size_t>(jobs), 0);
  parallel_for(
      jobs, jobs,
      [&](int, int share) {
        std::vector<std::string> call = renderer_call(context);
        call.push_back("--many");
        call.insert(call.end(), more.begin(), more.end());
        const std::size_t fixed = call.size();
        for (std::size_t i = static_cast<std::size_t>(share); i < strips.size(); i += static_cast<std::size_t>(jobs))
          call.insert(call.end(), {strips[i].file, strips[i].png});
        const Result<int> code = call.size() > fixed ? run_in_foreground(call) : Result<int>(0);
        codes[static_cast<std::size_t>(share)] = code ? *code : kInternal;
      },
      progress);
  return *std::ranges::max_element(codes);
}

namespace {

// The minimal cases of a corpus, the deepest first. Cases without a motion are left out.
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

// Replaces folders by their cases. Unreadable cases are reported and counted.
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

struct RenderRequest : PictureOptions {
  std::vector<std::string> inputs;
};

// `given` has the options for contort-render.
void render(RenderRequest options, const std::vector<std::string>& given, Context& context) {
  if (context.gl == "none") return context.fail({"usage", "", "--gl none draws nothing"});
  int unreadable = 0;
  if (options.sheet)
    if (const Result<Done> found = take_cases(options.inputs, unreadable); !found) return context.fail(found.issue());
  std::vector<std::string> call = renderer_call(context);
  call.insert(call.end(), given.begin(), given.end());
  call.push_back("--");  // a file may have the name --rows
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
  auto options = std::make_shared<RenderRequest>();
  CLI::App* command = app.add_subcommand("render", "Draw a case or spec as a film strip (PNG)");
  command->add_option("FILE", options->inputs, "Case or spec file; several with --rows or --sheet")->required();
  add_picture_options(*command, *options);
  command->get_option("--output")->required();
  command->footer(
      "Example: contort render docs/examples/reach_hand.json -o strip.png\n"
      "         contort render before.json --compare after.json -o difference.png");
  command->callback([options, command, &context] { render(*options, given_options(*command), context); });
}

}  // namespace contort::cli
