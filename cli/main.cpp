// contort: the command line. Each subcommand has its own file; this one parses and calls them.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/print.h"
#include "cli/start.h"
#include "cli/tested.h"
#include "cli/usage_text.h"

namespace contort::cli {

namespace {

// The day in UTC, so that it is the same on every machine.
std::string day_of_clock() {
  const auto day = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day date(day);
  char text[40];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()));
  return text;
}

std::string refuse_no_day(const std::string& text) {
  return is_day(text) ? "" : "\"" + text + "\" is not a date; write YYYY-MM-DD";
}

}  // namespace

Exit exit_of(const Issue& issue) {
  if (issue.code == "generator.ended") return kFindings;
  return issue.code == "file.unwritable" ? kInternal : kBadInput;
}

const Library* Context::load_library() {
  const Generator* generator = load_generator();
  return generator != nullptr ? generator->manifest().library : nullptr;
}

Generator* Context::load_generator() {
  static std::optional<Tested> tested;
  if (tested) return tested->generator.get();
  Result<Tested> loaded = load_tested(sources);
  if (!loaded) return fail(loaded.issue()), nullptr;
  tested.emplace(std::move(loaded).value());
  return tested->generator.get();
}

Result<CheckSettings> Context::load_settings() const {
  Result<CheckSettings> settings = load_settings_file(settings_file);
  if (!settings) return settings;
  CheckSettings dated = std::move(settings).value();
  dated.today = day();
  return dated;
}

Result<CheckSettings> Context::load_settings_without_waivers() const {
  Result<CheckSettings> settings = load_settings();
  if (!settings) return settings;
  CheckSettings bare = std::move(settings).value();
  bare.waivers.clear();
  return bare;
}

std::string Context::day() const { return today.empty() ? day_of_clock() : today; }

void Context::fail(const Issue& issue, Exit code) {
  const bool may_need_library = issue.code == "character.unknown_character" && sources.libraries.empty();
  std::fprintf(stderr, "contort: %s%s\n", printable(to_line(issue)).c_str(),
               may_need_library ? "; characters of your own need --library FOLDER" : "");
  exit_code = code;
}

namespace {

int run(int argc, char** argv) {
  CLI::App app("Contort finds the motions that your animation generator should never produce.", "contort");
  Context context;
  app.add_option("--library", context.sources.libraries,
                 "Folder with parts, objects, characters and actions (*.json) of your own; may be repeated")
      ->type_name("DIR");
  app.add_option("--generator", context.sources.generator,
                 "Test this program instead of the built-in generator (docs/reference/guests.md)")
      ->type_name("CMD");
  app.add_option("--settings", context.settings_file,
                 "File with limits to move and findings to waive (contort.settings/1)")
      ->type_name("FILE");
  app.add_option("--today", context.today, "Judge waivers and quarantines as on this day (default: today, UTC)")
      ->type_name("YYYY-MM-DD")
      ->check(refuse_no_day);
  app.add_option("--gl", context.gl, "Renderer of pictures: auto, osmesa or egl; none: draw no pictures")
      ->check(one_of({"auto", "osmesa", "egl", "none"}))
      ->capture_default_str();
  app.set_version_flag("--version", std::string("contort ") + CONTORT_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Exit codes: 0 nothing that should fail a build, 1 something that should, 2 bad usage or input, 3 internal error,\n"
      "4 inconclusive, 75 interrupted. 'contort COMMAND --help' and 'contort help COMMAND' explain one command.");
  for (const auto add :
       {add_fuzz, add_generator, add_guest_builtin, add_replay, add_generate, add_audit, add_check, add_measure, add_shrink, add_render, add_report,
        add_corpus, add_causes, add_explain, add_merge, add_import, add_contacts, add_list, add_schema, add_tables,
        add_serve, add_man, add_completion, add_version, add_help})
    add(app, context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {  // help or the version was printed
    return app.exit(answer);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "contort: usage: %s (see contort --help)\n", usage_text(app, argc, argv, error).c_str());
    return kBadInput;
  }
  return context.exit_code;
}

}  // namespace

}  // namespace contort::cli

int main(int argc, char** argv) { return contort::cli::run_to_the_end(argc, argv, contort::cli::run); }
