// contort guest-builtin: runs the built-in generator as a separate program, to try the protocol.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/commands.h"
#include "generator/built_in.h"
#include "guest/serve.h"

namespace contort::cli {

void add_guest_builtin(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand(
      "guest-builtin", "Serve the built-in generator over the protocol contort.generator/1, as an example of a program under test");
  auto characters = std::make_shared<std::vector<std::string>>(1, "human");
  command->add_option("--character", *characters, "The characters of the manifest")->capture_default_str();
  command->footer("Example: contort generator check \"contort guest-builtin --character quadruped\"");
  command->callback([=, &context] {
    const Library* library = context.load_library();
    if (library == nullptr) return;
    BuiltInGenerator generator(*library);
    if (const Result<Done> served = serve_guest(generator, *characters, stdin, stdout); !served)
      context.fail(served.issue());
  });
}

}  // namespace contort::cli
