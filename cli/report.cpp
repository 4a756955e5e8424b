// contort report: corpus to HTML, and to what CI reads.
#include "cli/report.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <thread>

#include "cli/input.h"
#include "cli/print.h"
#include "cli/render.h"
#include "cli/variants.h"
#include "corpus/baseline.h"
#include "corpus/corpus.h"
#include "corpus/runs.h"
#include "fuzz/parallel.h"
#include "generator/actions/action.h"
#include "generator/core/files.h"
#include "renders/report.h"

namespace contort::cli {

namespace {

struct Picture {
  std::string case_path;
  std::string png;
};

// As code hosts want it: below the folder where we are, which in CI is the project's, or else below the corpus.
std::string location_of(const Bucket& bucket, const std::string& path) {
  std::error_code error;
  const std::string here = std::filesystem::proximate(path, error).generic_string();
  const bool is_below = !error && !here.starts_with("..") && !here.starts_with("/");
  return is_below ? here : "buckets/" + folder_name(bucket) + "/" + bucket.min;
}

ReportRow row_of(const Bucket& bucket, const std::string& folder, const Case& stored, const Baseline& known,
                 const Context& context) {
  ReportRow row;
  const std::string path = folder + "/" + bucket.min;
  row.family = bucket.family, row.check = bucket.check,
  row.subject = stored.spec.character.name + ": " + stored.expect.subject, row.unit = stored.expect.unit;
  row.worst_margin = stored.expect.worst_margin;
  row.bucket = bucket.id, row.state = state_name(bucket.state);
  row.gating = is_gating(bucket, context.day(), known);
  row.note = known.contains(bucket.id) ? "in the baseline" : known_text(bucket, context.day());
  row.case_file = location_of(bucket, path);
  row.spec_json = pretty_spec(stored.spec);
  row.replay_command = replay_command(path, context.library_folders);
  row.strip = "strips/" + bucket.check + "-" + bucket.id + ".png";
  row.first_frame = stored.expect.first_frame, row.worst_frame = stored.expect.worst_frame,
  row.last_frame = stored.expect.last_frame;
  row.rate_hz = stored.spec.rate_hz;
  row.features = bucket.features;
  return row;
}

// Rows by how deep the failure is; ties by name, so that equal corpora give equal pages.
void fill_rows(const Corpus& corpus, const Baseline& known, ReportModel& model, std::vector<Picture>& pictures,
               const std::string& out, Context& context) {
  std::vector<Issue> damaged;
  std::vector<std::pair<double, ReportRow>> rows;
  for (const Bucket& bucket : corpus.buckets(damaged)) {
    const std::string folder = corpus.folder_of(bucket);
    const Result<Case> stored = read_case(folder + "/" + bucket.min);
    if (!stored) {
      damaged.push_back(stored.issue());
      continue;
    }
    rows.emplace_back(stored->expect.depth, row_of(bucket, folder, *stored, known, context));
    pictures.push_back({folder + "/" + bucket.min, out + "/" + rows.back().second.strip});
  }
  for (const Issue& issue : damaged) context.fail(issue);  // reported, and the rest is still shown
  std::stable_sort(rows.begin(), rows.end(), [](const auto& l, const auto& r) {
    return l.first != r.first ? l.first > r.first : l.second.bucket < r.second.bucket;
  });
  for (auto& [depth, row] : rows) model.rows.push_back(std::move(row));
}

// `seen`: cases of all runs, by family.
void count_totals(const std::map<std::string, std::int64_t>& seen, ReportModel& model) {
  std::set<std::string> families;
  for (const ReportRow& row : model.rows) families.insert(row.family);
  model.families = static_cast<std::int64_t>(families.size());
  model.buckets = static_cast<std::int64_t>(model.rows.size());
  for (ReportRow& row : model.rows)
    if (const auto found = seen.find(row.family); found != seen.end()) row.cases_seen = found->second;
  for (const std::string& family : families)
    if (const auto found = seen.find(family); found != seen.end()) model.findings += found->second;
}

// Gives the cases that showed each family.
std::map<std::string, std::int64_t> add_runs(const Corpus& corpus, ReportModel& model, Context& context) {
  std::vector<Issue> damaged;
  std::map<std::string, std::int64_t> tested, seen;
  for (const RunRecord& run : runs_of(corpus, damaged)) {
    model.cases += run.cases;
    model.frames += run.frames;
    for (const auto& [what, count] : run.tested) tested[what] += count;
    for (const auto& [family, count] : run.families) seen[family] += count.cases;
  }
  model.tested.assign(tested.begin(), tested.end());
  for (const Issue& issue : damaged) context.fail(issue);
  return seen;
}

// For each slot the pairs, an action with itself too, of what its parts can do, in any character of the library.
std::int64_t pairs_possible(const Library& library, const ReportModel& model) {
  std::map<std::string, std::set<std::string>> actions;  // by slot, also of those that move the part from elsewhere
  for_variants(library, [&](const Character& character) {
    for (std::size_t p = 0; p < character.parts().size(); ++p)
      for (const Action& action : actions_of(character, character.parts()[p]))
        for (const int moved : parts_moved(*action.def, character, static_cast<int>(p)))
          actions[character.parts()[static_cast<std::size_t>(moved)].slot].emplace(action.name);
  });
  std::set<std::string> pairs;
  for (const auto& [slot, names] : actions)
    for (auto a = names.begin(); a != names.end(); ++a)
      for (auto b = a; b != names.end(); ++b) pairs.insert("pair " + *a + " + " + *b + " on " + slot);
  for (const auto& [name, count] : model.tested)
    if (name.rfind("pair ", 0) == 0) pairs.insert(name);
  return static_cast<std::int64_t>(pairs.size());
}

// Each process draws a share of the pictures; Mesa renders in one thread of each (docs/rendering.md).
int draw(const std::vector<Picture>& pictures, const Context& context) {
  const int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<int> codes(static_cast<std::size_t>(jobs), 0);
  parallel_for(
      jobs, jobs,
      [&](int, int share) {
        std::vector<std::string> call = {renderer_path(), "--many"};
        for (const std::string& folder : context.library_folders) call.insert(call.end(), {"--library", folder});
        for (std::size_t i = static_cast<std::size_t>(share); i < pictures.size(); i += static_cast<std::size_t>(jobs))
          call.insert(call.end(), {pictures[i].case_path, pictures[i].png});
        const std::size_t fixed = 2 + 2 * context.library_folders.size();
        const Result<int> code = call.size() > fixed ? run_program(call) : Result<int>(0);
        codes[static_cast<std::size_t>(share)] = code ? *code : kInternal;
      },
      [] {});
  return *std::max_element(codes.begin(), codes.end());
}

}  // namespace

Result<std::string> bucket_line(const std::string& bucket_folder, const std::vector<std::string>& library_folders) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(bucket_folder, error)) {
    if (entry.path().filename().string().rfind("min-", 0) != 0) continue;
    const Result<Case> stored = read_case(entry.path().string());
    if (!stored) return stored.issue();
    return "NEW " + family_of(*stored) + "  " + short_number(stored->expect.worst_margin) + " " + stored->expect.unit +
           "  " + replay_command(entry.path().string(), library_folders);
  }
  return Issue{"corpus.no_case", "", bucket_folder + " holds no minimal case"};
}

namespace {

void write_page(const ReportRequest& request, const ReportModel& model, const std::vector<Picture>& pictures,
                Context& context) {
  if (const Result<Done> made = make_folder(request.folder + "/strips"); !made)
    return context.fail(made.issue(), kInternal);
  if (const Result<Done> written = write_report(model, request.folder); !written)
    return context.fail(written.issue(), kInternal);
  if (const int code = draw(pictures, context); code != 0) {
    std::fprintf(stderr, "contort: some pictures are missing; the report is complete without them\n");
    context.exit_code = std::max<int>(context.exit_code, kInternal);
  }
  if (!request.announce) return;
  std::printf("report: %s/index.html (%zu buckets, %lld families)\n", request.folder.c_str(), model.rows.size(),
              static_cast<long long>(model.families));
}

}  // namespace

void make_report(const ReportRequest& request, const Library& library, Context& context) {
  const Result<Corpus> corpus = Corpus::open(request.corpus);
  if (!corpus) return context.fail(corpus.issue());
  const Result<Baseline> known = load_baseline(request.outputs.baseline);
  if (!known) return context.fail(known.issue());
  ReportModel model;
  model.title = "Contort report";
  model.tool = CONTORT_VERSION;
  std::vector<Picture> pictures;
  fill_rows(*corpus, *known, model, pictures, request.folder, context);
  count_totals(add_runs(*corpus, model, context), model);
  model.pairs_possible = pairs_possible(library, model);
  if (const auto written = write_outputs(request.outputs, model, request.announce ? stdout : stderr); !written)
    return context.fail(written.issue(), kInternal);
  if (!request.folder.empty()) write_page(request, model, pictures, context);
  const bool gates = std::ranges::any_of(model.rows, [](const ReportRow& row) { return row.gating; });
  if (request.gate && gates && context.exit_code == kClean) context.exit_code = kFindings;
}

void add_report(CLI::App& app, Context& context) {
  auto request = std::make_shared<ReportRequest>();
  CLI::App* command = app.add_subcommand("report", "Report a corpus: HTML with film strips, or what CI reads");
  command->add_option("CORPUS", request->corpus, "Corpus folder")->required();
  command->add_option("-o,--output", request->folder, "Folder of the page");
  add_output_options(*command, request->outputs);
  command->add_flag("--gate", request->gate, "Exit with 1 where something gates");
  command->footer(
      "Example: contort report contort-out/corpus -o contort-out/report\n"
      "         contort report contort-out/corpus --junit contort.xml --github --baseline main/corpus --gate");
  command->callback([request, &context] {
    if (request->folder.empty() && !request->outputs.wanted() && !request->gate)
      return context.fail({"usage", "", "nothing to write: give -o, --junit, --sarif, --markdown, --github or --gate"});
    if (const Library* library = context.load_library()) make_report(*request, *library, context);
  });
}

}  // namespace contort::cli
