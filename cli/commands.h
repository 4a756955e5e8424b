// The subcommands. Each adds itself to the parser and, when it is called, leaves its exit code in the context.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checks/settings.h"
#include "cli/sources.h"
#include "model/generator.h"
#include "model/core/result.h"

namespace CLI {
class App;
}

namespace contort::cli {

// docs/reference/cli.md lists them too.
enum Exit : int {
  kClean = 0,         // nothing gating
  kFindings = 1,      // new or regressed failures
  kBadInput = 2,      // usage, configuration, unreadable input
  kInternal = 3,      // an error of Contort or of the machine: the corpus cannot be written, no renderer
  kInconclusive = 4,  // a second run differed, or not all requested work was done
  kInterrupted = 75,  // stopped early; findings are kept
  kNobodyReads = 141  // standard output is a pipe that was closed: 128 + SIGPIPE, as in other programs
};

// The exit code of an issue: kInternal if something cannot be written, kFindings if a program under test ended while it
// made a motion, else kBadInput.
Exit exit_of(const Issue& issue);

struct Context {
  int exit_code = kClean;
  Sources sources;                           // --library, --generator
  std::string settings_file;                 // --settings
  std::string today;                         // --today, for waivers and quarantines
  std::string gl = "auto";                   // --gl: the renderer; "none": no pictures

  // Returns the library, or nothing; it then has printed the reason and set the exit code.
  const Library* load_library();

  // The generator under test: the program of --generator with its own characters, or the built-in one over that
  // library. If it is not available, this prints the reason and returns nothing.
  Generator* load_generator();

  // The settings of checks; the defaults without --settings.
  Result<CheckSettings> load_settings() const;

  // The settings for cases that a user names, in which waivers hide nothing.
  Result<CheckSettings> load_settings_without_waivers() const;

  // --today, else the day of the clock, UTC.
  std::string day() const;

  // Prints an issue in one line, and sets the exit code.
  void fail(const Issue& issue, Exit code = kBadInput);
};

void add_generator(CLI::App& app, Context& context);
void add_guest_builtin(CLI::App& app, Context& context);
void add_fuzz(CLI::App& app, Context& context);
void add_replay(CLI::App& app, Context& context);
void add_generate(CLI::App& app, Context& context);
void add_audit(CLI::App& app, Context& context);
void add_check(CLI::App& app, Context& context);
void add_measure(CLI::App& app, Context& context);
void add_shrink(CLI::App& app, Context& context);
void add_render(CLI::App& app, Context& context);
void add_import(CLI::App& app, Context& context);
void add_contacts(CLI::App& app, Context& context);
void add_report(CLI::App& app, Context& context);
void add_merge(CLI::App& app, Context& context);
void add_corpus(CLI::App& app, Context& context);
void add_causes(CLI::App& app, Context& context);
void add_explain(CLI::App& app, Context& context);
void add_list(CLI::App& app, Context& context);
void add_schema(CLI::App& app, Context& context);
void add_tables(CLI::App& app, Context& context);
void add_man(CLI::App& app, Context& context);
void add_completion(CLI::App& app, Context& context);
void add_version(CLI::App& app, Context& context);
void add_help(CLI::App& app, Context& context);
void add_serve(CLI::App& app, Context& context);

}  // namespace contort::cli
