// contort-render: draws film strips. One call draws one (FILE -o PNG), a row for each of several files (--rows FILE… -o
// PNG), two files where they differ (FILE --compare FILE -o PNG), or many strips (--many FILE PNG FILE PNG …) with one
// OpenGL context. `contort render` and `contort report` start it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/render_options.h"
#include "cli/start.h"
#include "cli/tested.h"
#include "cli/usage_text.h"
#include "corpus/evaluator.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"
#include "process/ended.h"
#include "renders/divergence.h"
#include "renders/frames.h"
#include "renders/measured_text.h"
#include "renders/raster/strip.h"
#include "renders/skin.h"
#include "renders/strip_views.h"

namespace contort::cli {

namespace {

std::string clip_of(const RenderOptions& options, const std::string& png) {
  return options.clips ? std::filesystem::path(png).replace_extension(".webp").string() : options.clip;
}

// The data that all pictures of a call share.
struct Studio {
  StripRenderer renderer;
  Generator& generator;
  RenderOptions options;
  Wardrobe wardrobe;
  std::vector<Issue> notes{};     // reasons for which figures have no skin, each once
  std::set<std::string> noted{};  // characters with such a reason

  // nullptr: the figure is drawn by its parts' meshes.
  std::shared_ptr<const Skin> skin_of(const Character& character) {
    const Result<std::shared_ptr<const Skin>> skin = wardrobe.skin_of(character);
    if (skin) return *skin;
    Issue issue = skin.issue();
    issue.text += "; " + character.name() + " is drawn without its skin";
    if (noted.insert(character.name()).second) notes.push_back(std::move(issue));
    return nullptr;
  }
};

// The contents of a file, with all data that must live as long as its pictures are drawn.
struct Shown {
  SpecInput input;
  Evaluator evaluator;
  Evaluation evaluation;
  std::shared_ptr<const Skin> skin{};
};

Result<std::unique_ptr<Shown>> evaluate(Studio& studio, const std::string& file) {
  Result<SpecInput> input = read_spec_input(file, studio.options.level);
  if (!input) return input.issue();
  auto shown = std::make_unique<Shown>(
      Shown{std::move(input).value(), Evaluator(studio.generator, studio.options.settings), {}});
  Result<Evaluation> evaluation = unless_it_ends([&] { return shown->evaluator.run(shown->input.spec); });
  if (!evaluation) return about_file(file, evaluation.issue());
  shown->evaluation = std::move(evaluation).value();
  shown->skin = studio.skin_of(*shown->evaluator.execution().character);
  return shown;
}

std::string sentence_of(const Finding& finding, const Character& character, const RenderOptions& options) {
  const bool has_own_limit = !options.sources.generator.empty() && finding.check == "reach_error";
  return failed_text({finding.check, finding.subject, finding.unit, finding.worst_margin, has_own_limit}, &character,
                     options.settings);
}

StripInput strip_of(const Shown& shown, const RenderOptions& options, const std::string& file) {
  const Execution& execution = shown.evaluator.execution();
  StripInput strip{*execution.character, execution.motion};
  strip.finding = subject_of(shown.input, shown.evaluation.findings);
  if (strip.finding != nullptr) strip.measured = sentence_of(*strip.finding, *execution.character, options);
  if (plays_another_motion(shown.input, shown.evaluation)) strip.note = "NOT THE STORED MOTION";
  strip.replay_command =
      shown.input.stored ? replay_command(file, options.sources) : "contort check " + shell_quoted(file);
  strip.tiles = options.tiles;
  strip.environment = &execution.environment;
  strip.dynamics = &shown.input.spec.dynamics;
  strip.frames = options.frames;
  strip.azimuth_rad = options.azimuth_rad();
  strip.colliders = options.colliders;
  strip.skin = shown.skin.get();
  if (!options.labels.empty()) strip.title = options.labels.front();
  return strip;
}

Result<StripDone> draw(Studio& studio, const std::string& file, const std::string& png) {
  const Result<std::unique_ptr<Shown>> shown = evaluate(studio, file);
  if (!shown) return shown.issue();
  Result<StripDone> done =
      studio.renderer.render(strip_of(**shown, studio.options, file), png, clip_of(studio.options, png));
  if (!done || !studio.options.views) return done;
  const Result<Done> written = write_strip_views(png, done->tiles);
  return written ? done : written.issue();
}

// One of several files, and its motion.
struct Performed {
  std::string file;
  Spec spec;
  Execution made;
  std::shared_ptr<const Skin> skin;
};

Result<std::vector<Performed>> perform_all(Studio& studio, const std::vector<std::string>& files) {
  std::vector<Performed> all;
  for (const std::string& file : files) {
    Result<SpecInput> input = read_spec_input(file, studio.options.level);
    if (!input) return input.issue();
    Result<Execution> made = unless_it_ends([&] { return execute(studio.generator, input->spec); });
    if (!made) return about_file(file, made.issue());
    std::shared_ptr<const Skin> skin = studio.skin_of(*made->character);
    all.push_back({file, std::move(input->spec), std::move(made).value(), std::move(skin)});
  }
  return all;
}

// The frames of the command line, or frames evenly spread over the shortest motion.
std::vector<int> frames_of(const RenderOptions& options, const std::vector<Performed>& all) {
  if (!options.frames.empty()) return options.frames;
  int first = all.front().made.motion.first_frame, shortest = all.front().made.motion.frame_count;
  for (const Performed& one : all) {
    first = std::max(first, one.made.motion.first_frame);
    shortest = std::min(shortest, one.made.motion.frame_count);
  }
  return spread_frames(shortest, options.tiles, first);
}

std::string command_of(const RenderOptions& options, const std::vector<int>& frames) {
  std::string command = "contort render";
  for (const std::string& file : options.files) command += " " + shell_quoted(file);
  command += options.compared.empty() ? " --rows" : " --compare " + shell_quoted(options.compared);
  if (!options.compared.empty()) command += " --tolerance " + json_fields::shortest(options.tolerance_mm);
  command += " --frames ";
  for (const int frame : frames) command += (&frame == frames.data() ? "" : ",") + std::to_string(frame);
  if (!options.azimuth_deg.empty()) command += " --azimuth " + shell_quoted(options.azimuth_deg);
  if (options.colliders) command += " --colliders";
  if (!options.level.empty()) command += " --level " + shell_quoted(options.level);
  for (const std::string& label : options.labels) command += " --label " + shell_quoted(label);
  for (const std::string& argument : options.sources.arguments()) command += " " + shell_quoted(argument);
  return command;
}

Result<StripDone> draw_all(Studio& studio) {
  const RenderOptions& options = studio.options;
  const Result<std::vector<Performed>> all = perform_all(studio, options.files);
  if (!all) return all.issue();
  RowsInput input;
  for (std::size_t i = 0; i < all->size(); ++i) {
    const Performed& one = (*all)[i];
    const std::string name = std::filesystem::path(one.file).stem().string();
    input.rows.push_back({{.character = *one.made.character,
                           .motion = one.made.motion,
                           .environment = &one.made.environment,
                           .dynamics = &one.spec.dynamics,
                           .colliders = options.colliders,
                           .skin = one.skin.get()},
                          options.labels.empty() ? name : options.labels[i]});
  }
  input.frames = frames_of(options, *all);
  input.azimuth_rad = options.azimuth_rad();
  input.replay_command = command_of(options, input.frames);
  return studio.renderer.render_rows(input, options.output);
}

// Frames around the first difference, up to the last one, in the range that both motions have.
std::vector<int> frames_of(const RenderOptions& options, const Divergence& divergence) {
  if (!options.frames.empty()) return options.frames;
  if (divergence.first.frame < 0) return spread_frames(divergence.frames, options.tiles);
  return choose_frames(divergence.first.frame, divergence.worst.frame, divergence.last_frame, divergence.frames,
                       options.tiles);
}

// Makes two rows: the first motion, and the second one with the first as its ghost if the figures are the same.
RowsInput rows_of(const RenderOptions& options, const std::vector<Performed>& all, const Divergence& divergence,
                  const Finding& where, const std::string& verdict) {
  RowsInput input;
  const bool same_figure = all[0].made.character->hash() == all[1].made.character->hash();
  for (std::size_t i = 0; i < 2; ++i) {
    const Performed& one = all[i];
    const std::string name = std::filesystem::path(one.file).stem().string();
    const std::string label = options.labels.empty() ? name : options.labels[i];
    input.rows.push_back({{.character = *one.made.character,
                           .motion = one.made.motion,
                           .finding = where.subject.empty() ? nullptr : &where,
                           .ghost = i == 1 && same_figure && !divergence.none() ? &all[0].made.motion : nullptr,
                           .environment = &one.made.environment,
                           .dynamics = &one.spec.dynamics,
                           .colliders = options.colliders,
                           .skin = one.skin.get()},
                          i == 0 ? label : label + "   " + verdict});
  }
  input.frames = frames_of(options, divergence);
  input.azimuth_rad = options.azimuth_rad();
  if (divergence.first.frame >= 0) input.marked_frame = divergence.first.frame, input.mark = "first difference";
  input.replay_command = command_of(options, input.frames);
  return input;
}

Result<StripDone> draw_comparison(Studio& studio) {
  const RenderOptions& options = studio.options;
  const Result<std::vector<Performed>> all = perform_all(studio, {options.files.front(), options.compared});
  if (!all) return all.issue();
  const Performed &a = (*all)[0], &b = (*all)[1];
  const double tolerance_m = options.tolerance_mm / 1000.0, rate_hz = a.made.motion.rate_hz;
  const Result<Divergence> divergence =
      find_divergence({*a.made.character, a.made.motion}, {*b.made.character, b.made.motion}, tolerance_m);
  if (!divergence) return divergence.issue();
  const std::string verdict = divergence_text(*divergence, tolerance_m, rate_hz);
  std::printf("%s\n", options.json ? divergence_json(*divergence, tolerance_m, rate_hz).c_str() : verdict.c_str());
  const Finding where{"difference", divergence->first.joint, "m"};
  return studio.renderer.render_rows(rows_of(options, *all, *divergence, where, verdict), options.output);
}

constexpr int kSheetColumns = 5;
constexpr std::size_t kMostSheetTiles = 1000;

Result<Image> draw_tile(Studio& studio, const Shown& shown, const std::string& file) {
  return studio.renderer.render_tile(strip_of(shown, studio.options, file));
}

// Draws a tile for each file. Files that cannot be shown are left out and counted, and listed in `warnings`.
Result<StripDone> draw_sheet(Studio& studio, int& left_out) {
  const RenderOptions& options = studio.options;
  StripDone done;
  std::vector<Image> tiles;
  for (const std::string& file : options.files) {
    if (tiles.size() == kMostSheetTiles) {
      const std::string all = std::to_string(options.files.size());
      done.warnings.push_back({"render.too_many", "",
                               "the sheet has the first " + std::to_string(tiles.size()) + " of " + all + " pictures"});
      break;
    }
    const Result<std::unique_ptr<Shown>> shown = evaluate(studio, file);
    Result<Image> tile = shown ? draw_tile(studio, **shown, file) : Result<Image>(shown.issue());
    if (tile)
      tiles.push_back(std::move(tile).value());
    else
      done.warnings.push_back(about_file(file, tile.issue())), ++left_out;
  }
  if (tiles.empty() && !done.warnings.empty()) return done.warnings.front();
  const Result<Done> written = write_sheet(tiles, kSheetColumns, options.output);
  return written ? Result<StripDone>(done) : written.issue();
}

int fail(const Issue& issue, int code) {
  std::fprintf(stderr, "contort: %s\n", to_line(issue).c_str());
  return code;
}

// Input faults are the user's; all others (no OpenGL, an unwritable picture) are the machine's.
int code_of(const Issue& issue) {
  if (issue.code == "generator.ended") return kFindings;
  const bool asked = issue.code == "render.bad_frame" || issue.code == "render.bad_size";
  const bool ours = (issue.code.rfind("render.", 0) == 0 && !asked) || issue.code == "file.unwritable";
  return ours ? kInternal : kBadInput;
}

int report(const Result<StripDone>& done) {
  if (!done) return fail(done.issue(), code_of(done.issue()));
  for (const Issue& warning : done->warnings) std::fprintf(stderr, "contort: %s\n", to_line(warning).c_str());
  return kClean;
}

int sheet(Studio& studio) {
  int left_out = 0;
  const int code = report(draw_sheet(studio, left_out));
  if (left_out == 0 || code != kClean || studio.options.allow_unreadable) return code;
  return fail({"render.left_out", "",
               "files that are not on the sheet: " + std::to_string(left_out) + " of " +
                   std::to_string(studio.options.files.size()) + "; --allow-unreadable makes that no error"},
              kBadInput);
}

int draw_what_is_asked(Studio& studio) {
  const RenderOptions& options = studio.options;
  if (!options.compared.empty()) return report(draw_comparison(studio));
  if (options.rows) return report(draw_all(studio));
  if (options.sheet) return sheet(studio);
  if (!options.many) return report(draw(studio, options.files.front(), options.output));
  int code = kClean;
  for (std::size_t i = 0; i < options.files.size(); i += 2)
    if (const int one = report(draw(studio, options.files[i], options.files[i + 1])); one != kClean) code = one;
  return code;
}

int run(RenderOptions options) {
  const Result<Tested> tested = load_tested(options.sources);
  if (!tested) return fail(tested.issue(), kBadInput);
  Result<CheckSettings> settings = load_settings_file(options.settings_file);
  if (!settings) return fail(settings.issue(), kBadInput);
  options.settings = std::move(settings).value();
  options.settings.waivers.clear();  // waived findings are shown too
  Result<StripRenderer> renderer = StripRenderer::create(*gl_source(options.gl));
  if (!renderer) return fail(renderer.issue(), kInternal);
  Wardrobe wardrobe(options.sources.libraries);
  Studio studio{std::move(renderer).value(), *tested->generator, std::move(options), std::move(wardrobe)};
  const int code = draw_what_is_asked(studio);
  for (const Issue& note : studio.notes) std::fprintf(stderr, "contort: %s\n", to_line(note).c_str());
  return code;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Draws film strips of cases and specs; see contort render.", "contort-render");
  RenderOptions options;
  app.add_option("FILE", options.files, "Case or spec; with --many: FILE PNG pairs")->required();
  add_picture_options(app, options);
  app.add_option("--library", options.sources.libraries,
                 "Folder with parts, objects, characters and actions; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--generator", options.sources.generator, "Program that makes the motions");
  app.add_flag("--clips", options.clips, "With --many, a moving picture beside each strip");
  app.add_flag("--views", options.views, "With --many, beside each strip a script that says from where it is seen");
  app.add_option("--settings", options.settings_file, "Limits that are not the default ones");
  app.add_option("--gl", options.gl, "Where OpenGL comes from")->check(CLI::IsMember({"auto", "osmesa", "egl"}));
  app.add_flag("--many", options.many, "Draw many with one OpenGL context");
  app.set_version_flag("--version", std::string("contort-render ") + CONTORT_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {
    return app.exit(answer);
  } catch (const CLI::ParseError& error) {
    return fail({"usage", "", usage_text(app, argc, argv, error)}, kBadInput);
  }
  if (const std::string why = misfit(options); !why.empty()) return fail({"usage", "", why}, kBadInput);
  return run(options);
}

}  // namespace

}  // namespace contort::cli

int main(int argc, char** argv) { return contort::cli::run_to_the_end(argc, argv, contort::cli::parse_and_run); }
