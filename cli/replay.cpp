// contort replay: does a stored case still do what it says?
#include "corpus/replay.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/print.h"
#include "corpus/corpus.h"
#include "generator/core/json_fields.h"

namespace contort::cli {

namespace {

using json_fields::Json;

struct Options {
  std::vector<std::string> paths;
  bool json = false;
  std::string level;
};

std::string explain(const Case& stored, const Replay& result) {
  std::string text;
  if (result.verdict == Verdict::refused) return to_line(result.issue);
  text += family_of(stored);
  if (result.verdict != Verdict::passes)
    text += "  " + short_number(result.now.worst_margin) + " " + result.now.unit + " at frame " +
            std::to_string(result.now.worst_frame);
  if (result.verdict == Verdict::different) text += " of " + result.now.check + " " + result.now.subject;
  if (result.first_difference >= 0) text += ", first differing frame " + std::to_string(result.first_difference);
  if (result.character_changed) text += ", the character has changed";
  return text;
}

Json as_json(const std::string& path, const Case& stored, const Replay& result) {
  Json out = {{"case", path},
              {"family", family_of(stored)},
              {"verdict", verdict_name(result.verdict)},
              {"character_changed", result.character_changed},
              {"motion_hash", result.now.motion_hash}};
  if (result.first_difference >= 0) out["first_differing_frame"] = result.first_difference;
  if (result.verdict == Verdict::refused) out["issue"] = to_line(result.issue);
  return out;
}

// Failing as before is what a stored case is for; anything else is a change that somebody has to look at.
int exit_code_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
    case Verdict::same_family: return kFindings;
    case Verdict::different: return kFindings;
    case Verdict::passes: return kClean;
    case Verdict::refused: return kBadInput;
  }
  return kInternal;
}

void run(const Options& options, Context& context) {
  const Library* library = context.load_library();
  if (library == nullptr) return;
  Level level;
  if (!options.level.empty()) {
    const Result<Level> parsed = parse_level(options.level);
    if (!parsed) return context.fail(parsed.issue());
    level = *parsed;
  }
  const Result<std::vector<std::string>> paths = expand_cases(options.paths);
  if (!paths) return context.fail(paths.issue());
  std::map<Verdict, int> counts;
  Json list = Json::array();
  Result<CheckSettings> settings = context.load_settings();
  if (!settings) return context.fail(settings.issue());
  CheckSettings without_waivers = std::move(settings).value();
  without_waivers.waivers.clear();  // what is waived is still there
  Evaluator evaluator(without_waivers);
  for (const std::string& path : *paths) {
    const Result<Case> stored = read_case(path);
    if (!stored) {
      context.fail(stored.issue());
      ++counts[Verdict::refused];
      continue;
    }
    const Replay result = replay(*stored, *library, evaluator, level);
    ++counts[result.verdict];
    if (context.exit_code != kBadInput) context.exit_code = std::max(context.exit_code, exit_code_of(result.verdict));
    if (options.json)
      list.push_back(as_json(path, *stored, result));
    else
      std::printf("%-11s  %s  %s\n", std::string(verdict_name(result.verdict)).c_str(), path.c_str(),
                  explain(*stored, result).c_str());
  }
  if (options.json) {
    std::printf("%s\n", list.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return;
  }
  std::printf("RESULT cases=%zu same=%d same_family=%d different=%d passes=%d refused=%d\n", paths->size(),
              counts[Verdict::same], counts[Verdict::same_family], counts[Verdict::different], counts[Verdict::passes],
              counts[Verdict::refused]);
}

}  // namespace

void add_replay(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("replay", "Run stored cases again and compare with what they say");
  command->add_option("CASE", options->paths, "Case files, or corpus folders")->required();
  command->add_option("--level", options->level,
                      "Only a sequence, a clip or a part of each case: sequence:2, clip:2/1, part:arm_right");
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer(
      "Verdicts: same (equal motion, equal finding), same family, different, passes, refused.\n"
      "Exit code 1 while a case still fails, 0 when all pass.\n"
      "Example: contort replay contort-out/corpus\n"
      "         contort replay CASE --level part:arm_right");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
