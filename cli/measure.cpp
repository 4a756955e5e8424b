// contort measure: answers specs, one line for each, so that another build can compare itself with this one.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "cli/commands.h"
#include "corpus/measurement.h"
#include "process/ended.h"

namespace contort::cli {

namespace {

constexpr std::size_t kMostRequestBytes = std::size_t{16} << 20;

enum class LineRead { line, too_long, end };

// A line that is too long is read to its end and dropped.
LineRead read_request_line(std::string& line) {
  line.clear();
  bool is_too_long = false;
  for (int c = std::getchar(); c != EOF; c = std::getchar()) {
    if (c == '\n') return is_too_long ? LineRead::too_long : LineRead::line;
    is_too_long = is_too_long || line.size() >= kMostRequestBytes;
    if (!is_too_long) line.push_back(static_cast<char>(c));
  }
  if (is_too_long) return LineRead::too_long;
  return line.empty() ? LineRead::end : LineRead::line;
}

std::string answer_to(const std::string& line, bool is_too_long, Evaluator& evaluator) {
  Measurement refused;
  if (is_too_long) {
    refused.refusal = Issue{"measure.too_long", "", "a line has more than 16 MiB"};
    return print_line(refused);
  }
  const Result<MeasureRequest> request = parse_request(line);
  if (request) {
    const Result<Measurement> measured =
        unless_it_ends([&]() -> Result<Measurement> { return measure(*request, evaluator); });
    if (measured) return print_line(*measured);
    refused.id = request->id, refused.refusal = measured.issue();
    return print_line(refused);
  }
  refused.refusal = request.issue();
  return print_line(refused);
}

bool print_now(const std::string& line) { return std::printf("%s\n", line.c_str()) >= 0 && std::fflush(stdout) == 0; }

void run_measure(Context& context) {
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<CheckSettings> settings = context.load_settings();
  if (!settings) return context.fail(settings.issue());
  Evaluator evaluator(*generator, *settings);
  if (!print_now(print_line(own_hello(CONTORT_VERSION)))) return;
  std::string line;
  for (LineRead read = read_request_line(line); read != LineRead::end; read = read_request_line(line))
    if (!print_now(answer_to(line, read == LineRead::too_long, evaluator))) return;
}

}  // namespace

void add_measure(CLI::App& app, Context& context) {
  CLI::App* command =
      app.add_subcommand("measure", "Print the margins of specs that come on standard input, one JSON line for each");
  command->footer(
      "docs/reference/against.md has the protocol. A request is a spec on one line, or an object with \"spec\".\n"
      "Example: jq -c . spec.json | contort measure");
  command->callback([&context] { run_measure(context); });
}

}  // namespace contort::cli
