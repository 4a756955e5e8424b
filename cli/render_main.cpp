// contort-render: draws film strips. One call draws one (FILE -o PNG) or many (--many FILE PNG FILE PNG …) with one
// OpenGL context. `contort render` and `contort report` start it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "checks/evaluate.h"
#include "cli/commands.h"
#include "cli/input.h"
#include "renders/raster/strip.h"

namespace contort::cli {

namespace {

struct Options {
  std::vector<std::string> files;
  std::string output;
  std::vector<std::string> libraries;
  bool many = false;
  int tiles = 8;
};

// The finding that the strip is about: the one that a case expects; of a spec, the deepest.
const Finding* subject_of(const SpecInput& input, const std::vector<Finding>& findings) {
  if (input.stored) return deepest(findings, input.stored->expect.check, input.stored->expect.subject);
  const Finding* worst = nullptr;
  for (const Finding& finding : findings)
    if (worst == nullptr || finding.depth > worst->depth) worst = &finding;
  return worst;
}

Result<StripDone> draw(StripRenderer& renderer, const Library& library, const Options& options, const std::string& file,
                       const std::string& png) {
  const Result<SpecInput> input = read_spec_input(file);
  if (!input) return input.issue();
  const Result<Stage> stage = build_stage(input->spec, library);
  if (!stage) return stage.issue();
  Evaluator evaluator;
  const Evaluation evaluation = evaluator.run(*stage);
  StripInput strip{*stage->character, evaluator.motion()};
  strip.finding = subject_of(*input, evaluation.findings);
  strip.replay_command =
      input->stored ? replay_command(file, options.libraries) : "contort check " + shell_quoted(file);
  strip.tiles = options.tiles;
  strip.environment = &stage->environment;
  return renderer.render(strip, png);
}

int fail(const Issue& issue, int code) {
  std::fprintf(stderr, "contort: %s\n", to_line(issue).c_str());
  return code;
}

// Input faults are the user's, the rest (no OpenGL, an unwritable picture) the machine's.
int code_of(const Issue& issue) {
  const bool ours = issue.code.rfind("render.", 0) == 0 || issue.code == "file.unwritable";
  return ours ? kInternal : kBadInput;
}

int run(const Options& options) {
  const Result<Library> library = load_libraries(options.libraries);
  if (!library) return fail(library.issue(), kBadInput);
  Result<StripRenderer> renderer = StripRenderer::create();
  if (!renderer) return fail(renderer.issue(), kInternal);
  StripRenderer drawing = std::move(renderer).value();
  int code = kClean;
  for (std::size_t i = 0; i < options.files.size(); i += options.many ? 2 : 1) {
    const Result<StripDone> done =
        draw(drawing, *library, options, options.files[i], options.many ? options.files[i + 1] : options.output);
    if (!done)
      code = fail(done.issue(), code_of(done.issue()));
    else
      for (const Issue& warning : done->warnings) std::fprintf(stderr, "contort: %s\n", to_line(warning).c_str());
  }
  return code;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Draws film strips of cases and specs; see contort render.", "contort-render");
  Options options;
  app.add_option("FILE", options.files, "Case or spec; with --many: FILE PNG pairs")->required();
  app.add_option("-o,--output", options.output, "The picture");
  app.add_option("--library", options.libraries, "Folder with parts, objects, characters and actions; may be repeated")
      ->expected(1);
  app.add_option("--tiles", options.tiles, "Frames on the strip")->check(CLI::Range(1, 64));
  app.add_flag("--many", options.many, "Draw many with one OpenGL context");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail({"usage", "", error.what()}, kBadInput);
  }
  const bool right =
      options.many ? options.files.size() % 2 == 0 : options.files.size() == 1 && !options.output.empty();
  if (!right) return fail({"usage", "", "expected FILE -o PNG, or --many FILE PNG FILE PNG …"}, kBadInput);
  return run(options);
}

}  // namespace

}  // namespace contort::cli

int main(int argc, char** argv) {
  try {
    return contort::cli::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contort: internal error: %s\n", error.what());
    return contort::cli::kInternal;
  }
}
