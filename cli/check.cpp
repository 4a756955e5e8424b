// contort check: checks a spec, or an animation made elsewhere.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "cli/animation.h"
#include "cli/check_clips.h"
#include "cli/commands.h"
#include "cli/input.h"
#include "cli/judged_text.h"
#include "cli/known.h"
#include "cli/print.h"
#include "cli/unmet_text.h"
#include "corpus/ending_case.h"
#include "corpus/evaluator.h"
#include "formats/detect/file_format.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/json_fields.h"
#include "process/ended.h"
#include "renders/measured_text.h"

namespace contort::cli {

namespace {

using json_fields::Json;

struct SpecOptions {
  std::string level;
  std::string known;  // a corpus whose rules are applied; "": the motion is made and checked
};

Json spec_json(const std::string& file, const Execution& made, const CheckSettings& settings, const Evaluation& evaluation,
               const std::vector<Circumstances>& at_worst) {
  return {{"file", file},
          {"character", made.character->name()},
          {"frames", evaluation.frame_count},
          {"motion_hash", to_hex(evaluation.motion_hash)},
          {"judged", Json::parse(judged_json(evaluation.judged))},
          {"not_judged", Json::parse(not_judged_json(evaluation.not_judged))},
          {"waivers", Json::parse(waivers_json(settings, evaluation.waivers))},
          {"unmet", Json::parse(unmet_json(made))},
          {"findings", Json::parse(findings_json(evaluation.findings, made.motion.rate_hz, at_worst))}};
}

void print_judged(const Evaluation& evaluation, const Character& character) {
  JudgedSummary summary;
  summary.add(evaluation.judged, evaluation.not_judged);
  summary.frames = evaluation.frame_count;
  summary.joints = summary.joint_count = static_cast<int>(character.joints().size());
  for (const std::string& line : judged_lines(summary)) std::printf("%s\n", line.c_str());
}

// Reports the end of a program under test during the motion. It is the only finding.
void tell_ending(const std::string& file, const Spec& spec, const Ending& ending, bool as_json, Context& context) {
  const Expectation shown = ending_case(spec, ending).expect;
  context.exit_code = kFindings;
  if (as_json) {
    const Json finding = {{"check", shown.check}, {"subject", shown.subject}, {"depth", shown.depth},
                          {"printed", ending.printed}};
    const Json out = {{"file", file}, {"character", spec.character.name}, {"findings", Json::array({finding})}};
    return void(std::printf("%s\n", out.dump(2, ' ', false, Json::error_handler_t::replace).c_str()));
  }
  std::printf("%s  %s\nFAILED: the generator made no motion.\nRESULT findings=1\n", shown.check.c_str(),
              printable(describe(ending)).c_str());
}

void check_spec(const std::string& file, const std::string& level, bool as_json, Context& context) {
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<CheckSettings> settings = context.load_settings();
  if (!settings) return context.fail(settings.issue());
  const Result<SpecInput> input = read_spec_input(file, level);
  if (!input) return context.fail(input.issue());
  Evaluator evaluator(*generator, *settings);
  Result<Evaluation> run = Issue{};
  try {
    run = evaluator.run(input->spec);
  } catch (const ProgramEnded& ended) {
    return tell_ending(file, input->spec, ended.ending(), as_json, context);
  }
  if (!run) return context.fail(about_file(file, run.issue()));
  const Evaluation& evaluation = *run;
  context.exit_code = evaluation.findings.empty() ? kClean : kFindings;
  const Execution& made = evaluator.execution();
  std::vector<Circumstances> at_worst;
  for (const Finding& finding : evaluation.findings)
    at_worst.push_back(made.intent ? circumstances_of(*made.intent, *made.character, made.motion, finding.worst_frame)
                                   : Circumstances{});
  if (as_json) {
    const Json out = spec_json(file, made, *settings, evaluation, at_worst);
    std::printf("%s\n", out.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return;
  }
  for (std::size_t i = 0; i < at_worst.size(); ++i) {
    const Finding& f = evaluation.findings[i];
    const bool has_own_limit = !context.sources.generator.empty() && f.check == "reach_error";
    const std::string value =
        failed_text({f.check, f.subject, f.unit, f.worst_margin, has_own_limit}, made.character.get(), *settings);
    std::printf("%s\n", finding_line(f, value, made.motion.rate_hz, at_worst[i]).c_str());
  }
  for (const std::string& line : waiver_lines(*settings, evaluation.waivers)) std::printf("%s\n", line.c_str());
  for (const std::string& line : unmet_lines(made)) std::printf("%s\n", line.c_str());
  for (const std::string& line : overpowered_lines(made)) std::printf("%s\n", line.c_str());
  print_judged(evaluation, *made.character);
  const std::size_t count = evaluation.findings.size();
  std::printf("%s\nRESULT findings=%zu", count == 0 ? "OK: nothing found." : "FAILED: limits are violated.", count);
  if (!settings->waivers.empty()) std::printf(" waived=%zu", evaluation.waived.size());
  std::printf("\n");
}

// Returns an option on the command line that has no meaning for a spec, which has its own character, rate and limits.
std::string option_for_animations(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && !option->get_positional() && option->get_name() != "--json" &&
        option->get_name() != "--level" && option->get_name() != "--known")
      return option->get_name();
  return "";
}

bool is_a_folder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

// Returns an issue with the kind of a plain file that is neither a spec nor an animation. A .json is always left to the
// reader of specs.
std::optional<Issue> neither(const std::string& file) {
  const std::string beginning = beginning_of(file, kKindBytes);
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  if (file.ends_with(".json") || first == beginning.npos || beginning[first] == '{') return std::nullopt;
  return other_than_animation(file, "a spec or a case (JSON), or " + std::string(kAnimationFiles));
}

// Refuses options that would have no effect.
Result<Done> options_fit(const ClipCheckOptions& options, const CLI::App& command) {
  if (options.all_clips) return Done{};
  const std::string& file = options.files.front();
  const std::string& unit = options.animation.unit;
  const FileFormat format = format_of_file(file);
  const bool is_length = metres_in(unit) > 0.0;
  if (!unit.empty() && !is_length && format != FileFormat::joint_table)
    return Issue{"usage.for_tables", "", "--unit " + unit + " is for tables of joint values, which " + file + " is not"};
  if (format == FileFormat::joint_table && is_length)
    return Issue{"usage.for_bvh", "",
                 "--unit " + unit + " is for .bvh files; of a table of joint values it is rad or deg"};
  for (const char* option : {"--unit", "--up"})
    if (command.count(option) > 0 && format != FileFormat::bvh && format != FileFormat::joint_table)
      return Issue{"usage.for_bvh", "", std::string(option) + " is for .bvh files and tables; " + file + " is another kind of file"};
  for (const char* option : {"--loops", "--max-gap-m", "--skeleton", "--max-speed-deg-s"})
    if (command.count(option) > 0 && format == FileFormat::joint_table)
      return Issue{"usage.for_clips", "", std::string(option) + " has no effect on a table of joint values, as " + file};
  return Done{};
}

// --known CORPUS: applies the rules of the corpus instead of making the motion.
void ask_rules(const std::string& file, const std::string& level, const std::string& corpus, bool as_json,
               Context& context) {
  const Result<SpecInput> input = read_spec_input(file, level);
  if (!input) return context.fail(input.issue());
  check_known(*input, corpus, as_json, context);
}

void run(const ClipCheckOptions& options, const SpecOptions& of_spec, const CLI::App& command, Context& context) {
  const auto& [level, known] = of_spec;
  if (options.allow_unreadable && !options.all_clips)
    return context.fail({"usage.for_folders", "", "--allow-unreadable is for folders and --all-clips"});
  const std::string& first = options.files.front();
  const bool of_clips = options.all_clips || is_animation(first) || is_table(first);
  if (!known.empty() && of_clips) return context.fail({"usage.for_specs", "", "--known is for specs and cases"});
  if (!level.empty() && of_clips) return context.fail({"usage.for_specs", "", "--level is for specs and cases"});
  if (!options.all_clips && options.files.size() > 1)
    return context.fail({"usage.too_many_files", "", "found several files; --all-clips checks more than one"});
  if (const Result<Done> fit = options_fit(options, command); !fit) return context.fail(fit.issue());
  if (of_clips) return check_clips(options, context);
  if (const std::optional<Issue> other = neither(options.files.front())) return context.fail(*other);
  if (const std::string option = option_for_animations(command); !option.empty())
    return context.fail(
        {"usage.for_animations", "",
         option + " is for animations, and " + options.files.front() + " is none: expected " + kAnimationFiles});
  known.empty() ? check_spec(options.files.front(), level, options.json, context)
                : ask_rules(options.files.front(), level, known, options.json, context);
}

}  // namespace

void add_check(CLI::App& app, Context& context) {
  auto options = std::make_shared<ClipCheckOptions>();
  auto of_spec = std::make_shared<SpecOptions>();
  CLI::App* command =
      app.add_subcommand("check", "Check a spec, or an animation made elsewhere (.glb, .vrm, .vrma, .bvh, .amc, .csv)");
  command
      ->add_option("FILE", options->files,
                   "Spec or case (.json), or animation (.glb, .gltf, .vrm, .vrma, .bvh, .amc, .csv), recognised by "
                   "its contents, or a folder of them; with --all-clips, any number of animations and folders")
      ->required();
  CLI::Option* character = command->add_option(
      "--character", options->character, "Judge the clips as motions of this character, by every check that applies");
  command
      ->add_option("--map", options->map, "File that says which node of the animation is which joint of the character")
      ->needs(character);
  command->add_option("--skeleton", options->animation.skeleton,
                      "Skeleton (.asf) of an .amc (default: the only one in its folder, or the one with the most similar name)");
  CLI::Option* rate = command->add_option(
      "--rate-hz", options->animation.rate_hz,
      "Frames per second: of an .amc, which does not state them; of a .bvh, instead of its own; with --character, of "
      "the character's motion");
  rate->check(CLI::Range(1.0, 1e5))
      ->check(refuse_nan)
      ->capture_default_str();
  command
      ->add_option("--unit", options->animation.unit,
                   "Unit of length of a .bvh, whose lengths are then judged in metres; unit of angles of a .csv (rad)")
      ->check(CLI::IsMember({"m", "cm", "mm", "in", "ft", "rad", "deg"}))
      ->type_name("m|cm|mm|in|ft|rad|deg");
  command
      ->add_option("--up", options->animation.up,
                   "Axis that points up in a .bvh (default: y), or for the root in a .csv (default: z)")
      ->check(CLI::IsMember({"y", "z"}))
      ->type_name("y|z");
  CLI::Option* clip = command->add_option("--clip", options->clip, "Only this clip of the file");
  command
      ->add_option("--loops", options->loops,
                   "Judge the seams of clips whose names match, because they are loops; * is any text; may be repeated")
      ->type_name("PATTERN")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--max-gap-m", options->max_gap_m,
          "Report joints that are farther than this from their rest place in their parent, such as 0.01; in the "
          "file's unit, if that is not metres, as in many .bvh")
      ->check(CLI::Range(0.0, 1e6))
      ->check(refuse_nan);
  command
      ->add_flag("--all-clips", options->all_clips,
                 "Check every clip of every file and of all subfolders: one line for each clip, the worst first; implied by a folder")
      ->excludes(clip);
  command
      ->add_flag("--allow-unreadable", options->allow_unreadable,
                 "With --all-clips or a folder: list files that cannot be read; only the others decide the exit code");
  command
      ->add_option("--accept-list", options->accept_list,
                   "Known findings, by file, clip, check and joint, for which the check does not fail "
                   "(docs/reference/checking_files.md)")
      ->type_name("FILE");
  command
      ->add_option("--write-accept-list", options->write_accept_list,
                   "Write all findings of this run as such a list, with the reasons of --accept-list")
      ->type_name("FILE");
  command
      ->add_option("--report", options->report,
                   "Folder for a page of the clips, the worst first, each with the pose of its worst moment")
      ->type_name("DIR");
  command->add_option("--jobs", options->jobs, "Threads for many files (default: one per core)")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--max-speed-deg-s", options->max_speed_deg_s,
                   "Greatest angular speed of joints without their own limit")
      ->check(CLI::Range(1e-3, 1e6))
      ->check(refuse_nan)
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer(
      "The exit code is 1 if something was found. With --all-clips, files that cannot be read are listed and counted,\n"
      "and the exit code is 2; with --allow-unreadable that is no error as long as one file could be read.\n"
      "Example: contort check robot.glb --max-speed-deg-s 1500\n"
      "         contort check walk.bvh --character human --map bones.json\n"
      "         contort check log.csv --character panda\n"
      "         contort check captures --character hero --report clips");
  add_level_option(*command, of_spec->level);
  command
      ->add_option("--known", of_spec->known,
                   "Make no motion: say whether the rules of this corpus (contort explain) predict that the spec fails")
      ->type_name("CORPUS");
  command->callback([options, of_spec, command, rate, &context] {
    if (rate->count() > 0) options->rate_hz = options->animation.rate_hz;
    options->all_clips |= std::ranges::any_of(options->files, is_a_folder);
    if (rate->count() > 0 && !options->all_clips) options->animation.table_rate_hz = options->animation.rate_hz;
    if (rate->count() > 0 && options->character.empty()) options->animation.bvh_rate_hz = options->animation.rate_hz;
    run(*options, *of_spec, *command, context);
  });
}

}  // namespace contort::cli
