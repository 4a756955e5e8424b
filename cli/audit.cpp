// contort audit: plays every action alone, over all its declared parameter values.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <thread>

#include "cli/audit_page.h"
#include "cli/commands.h"
#include "cli/input.h"
#include "cli/limits.h"
#include "cli/print.h"
#include "cli/progress_line.h"
#include "fuzz/audit.h"
#include "model/core/json_fields.h"
#include "model/core/number_text.h"

namespace contort::cli {

namespace {

using json_fields::Json;

struct AuditCommand {
  AuditOptions audit;
  LimitOptions limits;
  bool json = false;
  std::string dynamics = "kinematic";  // a name of mode_names()
  std::string folder;  // folder for the worst spec of each row; "": none
  std::string page;    // folder of the page; "": none
};

double percent(int count, int of) { return 100.0 * count / std::max(1, of); }

// Text such as "mech/arm_left (mech_arm_slim)" or "human/arm_left, rifle at hand_right/grip".
std::string place_of(const AuditRow& row) {
  const std::string object = object_of(row);
  return row.character.name + "/" + row.slot + (row.character.parts.empty() ? "" : " (" + row.part + ")") +
         (object.empty() ? "" : ", " + object);
}

void print_table(const std::vector<AuditRow>& rows) {
  std::printf("%-48s %-14s %-9s %7s %7s %7s %7s  %s\n", "part", "action", "point", "draws", "clean", "unmet", "still",
              "findings and reasons");
  for (const AuditRow& row : rows)
    std::printf("%-48s %-14s %-9s %7d %6.1f%% %6.1f%% %6.1f%%  %s\n", place_of(row).c_str(),
                row.action.c_str(), row.point.c_str(), row.draws, percent(row.clean, row.draws),
                percent(row.unmet, row.draws), percent(row.still, row.draws), printable(details_of(row)).c_str());
}

Json refusals_json(const AuditRow& row) {
  Json counts = Json::object();
  for (const RefusalCount& count : by_frequency(row.refusals)) counts[count.text] = count.cases;
  return counts;
}

Json row_json(const AuditRow& row) {
  return {{"character", row.character.name},
          {"slot", row.slot},
          {"part", row.part},
          {"object", object_of(row)},
          {"action", row.action},
          {"dynamics", mode_names()[static_cast<std::size_t>(row.dynamics)]},
          {"point", row.point},
          {"draws", row.draws},
          {"clean", row.clean},
          {"unmet", row.unmet},
          {"still", row.still},
          {"refused", row.refused},
          {"findings", row.findings},
          {"endings", row.endings},
          {"refusals", refusals_json(row)},
          {"reasons", row.reasons},
          {"depth", row.depth},
          {"worst", row.worst == Spec{} ? Json() : Json::parse(print_spec(row.worst))}};
}

Json rows_json(const std::vector<AuditRow>& rows) {
  Json list = Json::array();
  for (const AuditRow& row : rows) list.push_back(row_json(row));
  return list;
}

std::string command_of(const AuditCommand& options, const Context& context) {
  std::string command = "contort audit --draws " + std::to_string(options.audit.draws) + " --seed " +
                        std::to_string(options.audit.seed);
  const auto add = [&](const char* name, const std::vector<std::string>& values) {
    for (const std::string& value : values) command += std::string(" ") + name + " " + shell_quoted(value);
  };
  for (const std::string& argument : context.sources.arguments()) command += " " + shell_quoted(argument);
  add("--character", options.audit.characters);
  add("--action", options.audit.actions), add("--slot", options.audit.slots);
  if (options.audit.dynamics != Mode::kinematic) command += " --dynamics " + options.dynamics;
  if (options.limits.case_timeout_s != LimitOptions{}.case_timeout_s)
    command += " --case-timeout " + number_text(options.limits.case_timeout_s);
  return command + " --page " + shell_quoted(options.page);
}

// Findings take precedence over motions that were not judged.
Exit exit_code_of(const std::vector<AuditRow>& rows) {
  if (std::ranges::any_of(rows, [](const AuditRow& row) { return !row.findings.empty(); })) return kFindings;
  return std::ranges::any_of(rows, [](const AuditRow& row) { return row.refused > 0; }) ? kInconclusive : kClean;
}

int clean_rows(const std::vector<AuditRow>& rows) {
  return static_cast<int>(std::ranges::count_if(rows, [](const AuditRow& row) { return row.clean == row.draws; }));
}

void run(const AuditCommand& options, Context& context) {
  take_limits(options.limits, context.sources);
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<CheckSettings> settings = context.load_settings();
  if (!settings) return context.fail(settings.issue());
  Result<std::vector<AuditRow>> found = audit_rows(options.audit, *generator);
  if (!found) return context.fail(found.issue());
  std::vector<AuditRow> rows = std::move(found).value();
  const ProgressLine line;
  const auto progress = [&](int at) {
    if (line.wanted())
      line.show(static_cast<double>(at) / static_cast<double>(rows.size()), rows[static_cast<std::size_t>(at)].action);
  };
  const Result<Done> done = audit(options.audit, *settings, *generator, rows, progress);
  line.clear();
  if (!done) return context.fail(done.issue());
  if (!options.folder.empty())
    if (const Result<Done> written = write_worst(options.folder, rows); !written)
      return context.fail(written.issue(), kInternal);
  const int clean = clean_rows(rows);
  context.exit_code = exit_code_of(rows);
  if (!options.page.empty()) {
    const Result<Done> written = write_audit_page(options.page, command_of(options, context), rows, context);
    if (!written) return context.fail(written.issue(), kInternal);
  }
  if (options.json) {
    const std::string json = rows_json(rows).dump(2, ' ', false, Json::error_handler_t::replace);
    return void(std::printf("%s\n", json.c_str()));
  }
  print_table(rows);
  if (!options.page.empty()) std::printf("page: %s/index.html\n", options.page.c_str());
  std::printf("RESULT rows=%zu clean=%d\n", rows.size(), clean);
}

}  // namespace

void add_audit(CLI::App& app, Context& context) {
  auto options = std::make_shared<AuditCommand>();
  AuditOptions& audit = options->audit;
  audit.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  CLI::App* command =
      app.add_subcommand("audit", "Check every action alone, over all parameter values that it declares");
  command->add_option("--character", audit.characters, "Only this character; may be repeated");
  command->add_option("--action", audit.actions, "Only this action; may be repeated");
  command->add_option("--slot", audit.slots, "Only this slot; may be repeated");
  command->add_option("--draws", audit.draws, "Number of motions for each row")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", audit.seed, "Other seeds draw other motions")->capture_default_str();
  command->add_option("--jobs", audit.jobs, "Threads (default: one per core)")->check(CLI::Range(1, 1024));
  command
      ->add_option("--dynamics", options->dynamics,
                   "Figures without mass (kinematic), or with mass (tracking, dynamic)")
      ->check(CLI::IsMember(std::vector<std::string>(mode_names().begin(), mode_names().end())))
      ->type_name("MODE")
      ->capture_default_str();
  add_program_limit_options(*command, options->limits);
  command->add_option("--worst", options->folder, "Folder for the spec of each row's worst motion");
  command->add_option("--page", options->page, "Folder for a page with a picture of each row's worst motion")
      ->type_name("DIR");
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer("Example: contort audit --character human --action reach");
  command->callback([options, &context] {
    const auto mode = std::ranges::find(mode_names(), options->dynamics);
    options->audit.dynamics = static_cast<Mode>(mode - mode_names().begin());
    run(*options, context);
  });
}

}  // namespace contort::cli
