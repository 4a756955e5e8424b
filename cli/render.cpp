// contort render: hands over to contort-render, the program beside this one that loads OpenGL and OpenImageIO (261
// shared libraries, 216 ms and 130 MB), so that nothing else pays for them.
#include "cli/render.h"

#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cli/commands.h"

namespace contort::cli {

std::string renderer_path() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return (self.parent_path() / "contort-render").string();
}

Result<int> run_program(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) return Issue{"render.no_process", "", std::string("cannot start a process: ") + std::strerror(errno)};
  if (child == 0) {
    ::execv(arguments[0], arguments.data());
    std::fprintf(stderr, "contort: render.no_program: cannot start %s: %s\n", arguments[0], std::strerror(errno));
    ::_exit(kInternal);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(kInternal);
}

void add_render(CLI::App& app, Context& context) {
  struct Options {
    std::string input;
    std::string output;
    std::string subject;
    int tiles = 8;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("render", "Draw a case or spec as a film strip (PNG)");
  command->add_option("FILE", options->input, "Case or spec file")->required();
  command->add_option("-o,--output", options->output, "The picture")->required();
  command->add_option("--tiles", options->tiles, "Frames on the strip")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->footer("Example: contort render docs/examples/reach_hand.json -o strip.png");
  command->callback([options, &context] {
    std::vector<std::string> call = {renderer_path(), options->input, "-o",
                                     options->output, "--tiles",      std::to_string(options->tiles)};
    for (const std::string& folder : context.library_folders) call.insert(call.end(), {"--library", folder});
    const Result<int> code = run_program(call);
    if (!code) return context.fail(code.issue(), kInternal);
    context.exit_code = *code;
  });
}

}  // namespace contort::cli
