// contort: the command line. One file per subcommand; this one parses and hands over.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>

#include "cli/commands.h"
#include "cli/input.h"

namespace contort::cli {

const Library* Context::load_library() {
  if (library != nullptr) return library;
  if (library_folders.empty()) return library = &stock_library();
  static Result<Library> merged = load_libraries(library_folders);
  if (!merged) return fail(merged.issue()), nullptr;
  return library = &*merged;
}

void Context::fail(const Issue& issue, Exit code) {
  std::fprintf(stderr, "contort: %s\n", to_line(issue).c_str());
  exit_code = code;
}

namespace {

int run(int argc, char** argv) {
  CLI::App app("Contort finds the motions that your animation generator should never produce.", "contort");
  Context context;
  app.add_option("--library", context.library_folders,
                 "Folder with parts, objects, characters and actions (*.json) of your own; may be repeated")
      ->type_name("DIR");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Exit codes: 0 nothing gating, 1 gating findings, 2 bad usage or input, 3 internal error,\n"
      "4 inconclusive, 75 interrupted. 'contort COMMAND --help' explains one command.");
  for (const auto add : {add_fuzz, add_replay, add_generate, add_check, add_shrink, add_render, add_report, add_list,
                         add_schema, add_tables, add_version})
    add(app, context);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "contort: usage: %s (see contort --help)\n", error.what());
    return kBadInput;
  }
  return context.exit_code;
}

}  // namespace

}  // namespace contort::cli

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return contort::cli::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contort: internal error: %s\n", error.what());
    return contort::cli::kInternal;
  }
}
