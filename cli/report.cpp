// contort report: writes a corpus as HTML, and as files for CI.
#include "cli/against.h"
#include "cli/report.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "checks/check.h"
#include "cli/case_pages.h"
#include "cli/input.h"
#include "cli/measured_values.h"
#include "cli/print.h"
#include "cli/program_files.h"
#include "cli/progress_line.h"
#include "cli/render.h"
#include "cli/report_causes.h"
#include "cli/report_folder.h"
#include "cli/single_file.h"
#include "cli/tested.h"
#include "cli/variants.h"
#include "corpus/baseline.h"
#include "corpus/corpus.h"
#include "process/program.h"
#include "corpus/causes.h"
#include "corpus/leads.h"
#include "corpus/runs.h"
#include "fuzz/labels.h"
#include "fuzz/run_state.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"
#include "renders/needs.h"
#include "renders/report.h"
#include "renders/variety.h"

namespace contort::cli {

namespace {

struct Picture {
  std::string case_path;
  std::string png;
};

// The files beside the page.
struct Media {
  std::vector<Picture> pictures;
  std::vector<CasePage> cases;
};

// The path in the form that code hosts need: relative to the present folder, which in CI is the project's, or else to
// the corpus.
std::string location_of(const Corpus& corpus, const std::string& path) {
  std::error_code error;
  const std::string here = std::filesystem::proximate(path, error).generic_string();
  const bool is_below = !error && !here.starts_with("..") && !here.starts_with("/");
  return is_below ? here : std::filesystem::proximate(path, corpus.folder(), error).generic_string();
}

// Must change when strips of the same case look different: 2 joins nearest points and has skins, 3 rounds its numbers
// to three digits.
constexpr char kPictureStyle[] = "style 3";

// The name hashes everything that is drawn, so an existing file with this name need not be drawn again.
std::string picture_name(const ReportRow& row, const Case& stored, const std::string& settings) {
  const std::string shown = print_spec(stored.spec) + stored.expect.motion_hash + row.replay_command + settings +
                            CONTORT_VERSION + kPictureStyle;
  return "strips/" + row.key + "-" + content_id(shown).substr(0, 8);
}

// The context in which rows are made.
struct RowContext {
  const Corpus& corpus;
  const Baseline& known;
  const GroupCounts& now;        // counts of this corpus' runs that the baseline does not have
  const std::string settings;  // the text of --settings
  const Context& context;
  MeasuredValues& measured;
};

// A trace has four hex digits per frame (corpus/case.h).
int frames_of_trace(const std::string& trace) { return static_cast<int>(trace.size() / 4); }

// Makes a row from the data of the case alone. `key` is part of the names of the row's files.
ReportRow row_of_case(const Case& stored, const std::string& path, const std::string& key, const RowContext& with) {
  ReportRow row;
  row.family = print_family(family_of(stored)), row.check = stored.expect.check, row.key = key;
  row.character = stored.spec.character.name, row.has_motion = !is_abnormal_exit(stored.expect);
  row.printed = stored.expect.printed;
  row.subject = stored.spec.character.name + ": " + stored.expect.subject, row.unit = stored.expect.unit;
  row.worst_margin = stored.expect.worst_margin, row.measured = with.measured.text_of(stored);
  row.sentence = with.measured.sentence_of(stored);
  row.case_file = location_of(with.corpus, path);
  row.spec_json = pretty_spec(stored.spec);
  row.replay_command = replay_command(path, with.context.sources);
  if (row.has_motion && with.context.gl != "none") {
    const std::string name = picture_name(row, stored, with.settings);
    row.strip = name + ".png", row.clip = name + ".webp";
  }
  row.first_frame = stored.expect.first_frame, row.worst_frame = stored.expect.worst_frame,
  row.last_frame = stored.expect.last_frame;
  row.rate_hz = stored.spec.rate_hz;
  row.frame_count = frames_of_trace(stored.expect.trace);
  row.needs = needs_of(stored.spec);
  row.co_failures = stored.co_failures;
  row.since_base = sentence_about_base(stored.provenance);
  row.phase = stored.expect.phase, row.depth = stored.expect.depth, row.actions = action_names(stored.spec);
  for (const CheckDef& check : all_checks())
    if (check.name == row.check) row.meaning = check.help;
  return row;
}

ReportRow row_of(const Bucket& bucket, const Case& stored, const RowContext& with) {
  const std::string path = with.corpus.folder_of(bucket) + "/" + bucket.min, day = with.context.day();
  ReportRow row = row_of_case(stored, path, folder_name(bucket), with);
  row.family = print_family(bucket.family), row.features = bucket.features;
  row.bucket = bucket.id, row.state = state_name(bucket.state);
  row.gating = is_gating(bucket, day, with.known, with.now);
  row.note = with.known.contains(bucket) ? "in the baseline"
             : bucket.state == BucketState::fresh && may_be_chance(bucket.family, with.now, with.known)
                 ? "no more frequent than in the baseline, as far as so few cases tell"
                 : known_text(bucket, day);
  return row;
}

// Makes a row for a failure without a bucket. A failure that did not show again does not gate: the run has reported it.
ReportRow row_of(const Lead& lead, const std::set<Family>& known, const RowContext& with) {
  const std::string path = lead_path(with.corpus, lead);
  const std::string name = std::filesystem::path(path).stem().string();
  ReportRow row = row_of_case(lead.original, path, "lead-" + name, with);
  row.bucket = name;
  row.state = waits(lead) ? "waiting" : "unconfirmed";
  const Family family = family_of(lead.original);
  row.gating = waits(lead) && !known.contains(family) && !may_be_chance(family, with.now, with.known);
  row.note = waits(lead) ? "time was up before it could be shrunk: the next contort fuzz on this corpus shrinks it"
                         : "seen once: a second run did not show it";
  return row;
}

void add_row(ReportRow row, const CasePage& page, const std::string& out, ReportModel& model, Media& media) {
  model.rows.push_back(std::move(row));
  const ReportRow& added = model.rows.back();
  if (!added.has_motion) return;  // drawing it would end the renderer too
  if (!added.strip.empty()) media.pictures.push_back({page.folder + "/" + page.minimal, out + "/" + added.strip});
  media.cases.push_back(page);
  media.cases.back().strip = added.strip;
}

// Adds a row for each bucket, and returns the buckets with their minimal cases.
std::vector<CauseMember> add_bucket_rows(const std::vector<Bucket>& buckets, const RowContext& with, ReportModel& model,
                                         Media& media, const std::string& out, std::vector<Issue>& damaged) {
  std::vector<CauseMember> members = cause_members(with.corpus, buckets, damaged);
  for (const auto& [bucket, minimal, path] : members)
    add_row(row_of(bucket, minimal, with),
            {folder_name(bucket), with.corpus.folder_of(bucket), bucket.min, bucket.orig, bucket.worst, {}}, out, model,
            media);
  return members;
}

void add_lead_rows(const std::vector<Bucket>& buckets, const RowContext& with, ReportModel& model, Media& media,
                   const std::string& out, std::vector<Issue>& damaged) {
  const std::set<Family> known = known_families(buckets, with.context.day(), with.known, with.now);
  for (const Lead& lead : leads_of(with.corpus, damaged)) {
    if (!waits(lead) && !is_unsteady(lead)) continue;
    const std::filesystem::path path = lead_path(with.corpus, lead);
    const ReportRow row = row_of(lead, known, with);
    add_row(row, {row.key, path.parent_path().string(), path.filename().string(), "", "", {}}, out, model, media);
  }
}

// Adds the rows in the report's order (renders/variety.h), so that equal corpora give equal pages.
void fill_rows(const Corpus& corpus, const Baseline& known, MeasuredValues measured, ReportModel& model, Media& media,
               const std::string& out, Context& context) {
  std::vector<Issue> damaged;
  const Result<std::string> read = read_file(context.settings_file, json_fields::kMaxDocumentBytes);
  // The settings were read before without error; without --settings there is no file.
  std::vector<Issue> of_runs;  // add_runs reports them
  const std::vector<RunRecord> runs = runs_of(corpus, of_runs);
  const GroupCounts now = group_counts_of(runs, known.runs);
  const RowContext with{corpus, known, now, read ? *read : "", context, measured};
  const std::vector<Bucket> buckets = corpus.buckets(damaged);
  model.buckets = std::ssize(buckets);
  std::vector<CauseMember> members = add_bucket_rows(buckets, with, model, media, out, damaged);
  add_lead_rows(buckets, with, model, media, out, damaged);
  add_cause_rows(members, runs, known, now, model);
  if (const Result<Done> added = add_conditions(corpus, members, model); !added) damaged.push_back(added.issue());
  for (const Issue& issue : damaged) context.fail(issue);  // reported; everything else is still shown
  order_rows(model.rows);
}

// `seen` has the number of cases of all runs, by family.
void count_totals(const std::map<std::string, std::int64_t>& seen, ReportModel& model) {
  std::set<std::string> families;
  for (const ReportRow& row : model.rows) families.insert(row.family);
  model.families = static_cast<std::int64_t>(families.size());
  for (ReportRow& row : model.rows)
    if (const auto found = seen.find(row.family); found != seen.end()) row.cases_seen = found->second;
  for (const std::string& family : families)
    if (const auto found = seen.find(family); found != seen.end()) model.findings += found->second;
}

// Returns the number of cases that showed each family.
std::map<std::string, std::int64_t> add_runs(const Corpus& corpus, ReportModel& model, Context& context) {
  std::vector<Issue> damaged;
  std::map<std::string, std::int64_t> tested, seen;
  const std::vector<RunRecord> runs = runs_of(corpus, damaged);
  model.search = progress_of(runs);
  for (const RunRecord& run : runs) {
    model.cases += run.cases;
    model.frames += run.frames;
    model.refused += run.discarded;
    add_refusals(run.refusals, model.refusals);
    add_counts(run.tested, tested);
    add_counts(run.unmet, model.unmet);
    add_counts(run.not_judged, model.not_judged);
    for (const auto& [family, count] : run.families) seen[print_family(family)] += count.cases;
  }
  model.tested.assign(tested.begin(), tested.end());
  for (const Issue& issue : damaged) context.fail(issue);
  return seen;
}

// Adds the possible actions of the tested characters that never occurred, with count 0.
void add_never_tested(Generator& generator, ReportModel& model) {
  std::map<std::string, std::int64_t> tested(model.tested.begin(), model.tested.end());
  for_variants(*generator.manifest().library, [&](const Character& character) {
    if (!tested.contains("character " + character.name())) return;
    for (const std::string& label : possible_labels(generator, character)) tested.try_emplace(label, 0);
  });
  model.tested.assign(tested.begin(), tested.end());
}

// The strip, its animation, and its cameras, in the order of drawing.
std::vector<std::string> files_of(const Picture& picture) {
  const auto beside = [&](const char* kind) {
    return std::filesystem::path(picture.png).replace_extension(kind).string();
  };
  return {picture.png, beside(".webp"), beside(".js")};
}

bool is_drawn(const Picture& picture) {
  std::error_code error;
  return std::ranges::all_of(files_of(picture), [&](const auto& path) { return std::filesystem::exists(path, error); });
}

// Keeps the pictures that exist and are needed, and removes those that no row shows any more.
void tidy(const std::string& folder, std::vector<Picture>& pictures) {
  std::set<std::string> wanted;
  for (const Picture& picture : pictures)
    for (const std::string& path : files_of(picture)) wanted.insert(std::filesystem::path(path).filename().string());
  remove_old(folder, is_picture_file, wanted);
  std::error_code error;
  for (const Picture& picture : pictures)  // a link would be followed, and its target is not the report's
    for (const std::string& path : files_of(picture))
      if (std::filesystem::is_symlink(path, error)) std::filesystem::remove(path, error);
  std::erase_if(pictures, is_drawn);
}

void show_drawn(const std::vector<Picture>& pictures, const ProgressLine& line) {
  if (!line.wanted()) return;
  const auto drawn = std::ranges::count_if(pictures, is_drawn);
  line.show(static_cast<double>(drawn) / static_cast<double>(pictures.size()),
            std::to_string(drawn) + " of " + std::to_string(pictures.size()) + " failures drawn");
}

int draw(const std::vector<Picture>& pictures, const Context& context) {
  const ProgressLine line;
  std::vector<StripFile> strips;
  for (const Picture& picture : pictures) strips.push_back({picture.case_path, picture.png});
  const int code = draw_strips(strips, {"--clips", "--views"}, context, [&] { show_drawn(pictures, line); });
  line.clear();
  return code;
}

void write_page(const ReportRequest& request, const ReportModel& model, Media media, Generator& generator,
                Context& context) {
  // The summary comes first, because it marks the folder as a report's.
  if (const Result<Done> written = write_report(model, request.folder); !written)
    return context.fail(written.issue(), exit_of(written.issue()));
  if (const Result<Done> made = make_folder(request.folder + "/strips"); !made)
    return context.fail(made.issue(), kInternal);
  if (context.gl != "none") tidy(request.folder + "/strips", media.pictures);
  write_case_pages(media.cases, request.folder, generator, context);
  if (context.gl == "none") {
    std::fprintf(stderr, "contort: --gl none: the report has no pictures\n");
  } else if (const int code = draw(media.pictures, context); code != 0) {
    std::fprintf(stderr, "contort: some pictures are missing; the report is complete without them\n");
    context.exit_code = std::max<int>(context.exit_code, kInternal);
  }
  if (!request.single_file.empty())
    if (const Result<Done> written = write_single_file(model, request.folder, request.single_file); !written)
      return context.fail(written.issue(), kInternal);
  if (!request.announce) return;
  std::printf("report: %s/index.html (%s)\n", request.folder.c_str(), failures_text(model).c_str());
  if (model.unsettled > 0) std::printf("%s\n", unsettled_text(model.unsettled).c_str());
}

}  // namespace

void make_report(const ReportRequest& request, Generator& generator, Context& context) {
  const Result<Corpus> corpus = Corpus::open(request.corpus);
  if (!corpus) return context.fail(corpus.issue());
  if (const Result<Done> same = check_generator(*corpus, generator.manifest()); !same)
    return context.fail(same.issue());
  const Result<CheckSettings> settings = context.load_settings();
  if (!settings) return context.fail(settings.issue());
  const Result<Baseline> known = load_baseline(request.outputs.baseline);
  if (!known) return context.fail(known.issue());
  if (!request.folder.empty())
    if (const Result<Done> own = check_report_folder(request.folder); !own) return context.fail(own.issue());
  ReportModel model;
  model.title = "Contort report";
  model.tool = CONTORT_VERSION;
  model.has_baseline = !request.outputs.baseline.empty();
  // The page plays specs with the built-in generator.
  model.has_engine = has_engine() && context.sources.generator.empty();
  Media media;
  const MeasuredValues measured(*generator.manifest().library, *settings);
  fill_rows(*corpus, *known, measured, model, media, request.folder, context);
  count_totals(add_runs(*corpus, model, context), model);
  model.unsettled = unsettled_failures(*corpus);
  add_never_tested(generator, model);
  if (const auto written = write_outputs(request.outputs, model, request.announce ? stdout : stderr); !written)
    return context.fail(written.issue(), kInternal);
  if (!request.folder.empty()) write_page(request, model, std::move(media), generator, context);
  const bool gates = std::ranges::any_of(model.rows, [](const ReportRow& row) { return row.gating; });
  if (request.gate && gates && context.exit_code == kClean) context.exit_code = kFindings;
}

void add_report(CLI::App& app, Context& context) {
  auto request = std::make_shared<ReportRequest>();
  CLI::App* command = app.add_subcommand("report", "Report a corpus: HTML with film strips, or files for CI");
  command->add_option("CORPUS", request->corpus, "Corpus folder")->required();
  command->add_option("-o,--output", request->folder, "Folder of the page");
  command
      ->add_option("--single-file", request->single_file, "Write the page and all that it shows as one file, for mail")
      ->type_name("FILE");
  add_output_options(*command, request->outputs);
  command->add_flag("--gate", request->gate, "Exit with 1 if something gates");
  command->footer(
      "Example: contort report contort-out/corpus -o contort-out/report\n"
      "         contort report contort-out/corpus --junit contort.xml --github --baseline main/corpus --gate");
  command->callback([request, &context] {
    if (request->folder.empty() && !request->single_file.empty())
      return context.fail({"usage", "", "--single-file needs the folder of the page: -o DIR"});
    if (request->folder.empty() && !request->outputs.wanted() && !request->gate)
      return context.fail({"usage", "", "nothing to write: give -o, --junit, --sarif, --markdown, --github or --gate"});
    if (Generator* generator = context.load_generator()) make_report(*request, *generator, context);
  });
}

}  // namespace contort::cli
