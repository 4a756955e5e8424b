#include "cli/case_pages.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <thread>

#include "process/children.h"
#include "cli/engine_files.h"
#include "cli/program_files.h"
#include "cli/progress_line.h"
#include "cli/report_folder.h"
#include "cli/surroundings.h"
#include "corpus/corpus.h"
#include "model/core/files.h"
#include "process/ended.h"
#include "model/core/hash.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"
#include "renders/case_data.h"
#include "renders/page_call.h"

namespace contort::cli {

namespace fs = std::filesystem;

namespace {

constexpr int kMostSeconds = 60;  // time limit for the motions of one bucket

// Reads the case files of a bucket.
Result<std::string> data_of(const CasePage& page, Generator& generator, const CheckSettings& settings) {
  std::vector<std::pair<std::string, Case>> cases;
  for (const auto& [role, file] :
       {std::pair("minimal", page.minimal), std::pair("original", page.original), std::pair("worst", page.worst)}) {
    if (file.empty()) continue;
    Result<Case> stored = read_case_of(page.folder, file);
    if (!stored && cases.empty()) return stored.issue();
    const auto is_there = [&](const auto& other) { return other.second.spec == stored->spec; };
    if (stored && !is_abnormal_exit(stored->expect) && std::ranges::none_of(cases, is_there))
      cases.emplace_back(role, std::move(stored).value());
  }
  std::vector<ShownCase> shown;
  for (const auto& [role, stored] : cases) shown.push_back({role, stored});
  return case_data(page.key, shown, generator, settings, page.strip);
}

// ---- the inputs of a file

std::string stamp_of(const CasePage& page, const std::string& surroundings) {
  std::string made_of = surroundings + "\n" + page.key + "\n" + page.strip;
  for (const std::string& file : {page.minimal, page.original, page.worst}) {
    const Result<std::string> text =
        file.empty() ? std::string() : read_inside(page.folder, file, json_fields::kMaxDocumentBytes);
    made_of += "\n" + (text ? content_id(*text) : std::string("missing"));
  }
  return content_id(made_of).substr(0, 16);
}

// A page with only a reason has no stamp, so that it is tried again.
bool is_there(const std::string& folder, const CasePage& page, const std::string& stamp) {
  const Result<std::string> text = read_file(folder + "/cases/" + page.key + ".js");
  return text && stamp_of_page_call(text->substr(0, text->find('\n') + 1)) == stamp;
}

// ----

Result<Done> write_case(const std::string& folder, const std::string& key, const std::string& data,
                        const std::string& stamp) {
  return write_file(folder + "/cases/" + key + ".js", case_script(key, data, stamp));
}

void warn(const std::string& what, const Issue& issue) {
  std::fprintf(stderr, "contort: %s: %s\n", what.c_str(), to_line(issue).c_str());
}

// Prints the reason for which a case cannot be shown, and writes it to the case's file.
void write_problem(const std::string& folder, const std::string& key, const Issue& issue) {
  warn("the report cannot show " + key, issue);
  if (const Result<Done> written = write_case(folder, key, case_problem(key, issue.text), ""); !written)
    warn(key, written.issue());
}

struct Stamped {
  CasePage page;
  std::string stamp;
};

void write_one(const Stamped& one, const std::string& folder, Generator& generator, const CheckSettings& settings) {
  const CasePage& page = one.page;
  const Result<std::string> data = unless_it_ends([&] { return data_of(page, generator, settings); });
  const Result<Done> written = data ? write_case(folder, page.key, *data, one.stamp) : Done{};
  if (!data) write_problem(folder, page.key, data.issue());
  if (!written) warn(page.key, written.issue());
}

Result<Done> copy_viewer(const std::string& folder) {
  const std::string from = pages_path();
  if (const Result<Done> made = make_folder(folder); !made) return made;
  for (const char* name : {"viewer.js", "viewer.css", "engine.js"}) {
    if (name == std::string_view("engine.js") && !has_engine()) continue;
    const Result<std::string> text = read_file(from + "/" + name, std::size_t{1} << 26);
    if (!text) return text.issue();
    if (const Result<Done> written = write_file(folder + "/" + name, *text); !written) return written;
  }
  return Done{};
}

Result<Done> write_library(const std::string& path, const Generator& generator, const Context& context) {
  if (!has_engine()) return Done{};
  const Result<std::string> script = library_script(*generator.manifest().library, context);
  return script ? write_file(path, *script) : script.issue();
}

// Runs in child processes, so that a case that crashes this build, or never ends in it, does not lose the report.
void write_all(const std::vector<Stamped>& pages, const std::string& folder, Generator& generator,
               const CheckSettings& settings) {
  const ProgressLine line;
  const int count = static_cast<int>(pages.size());
  const auto write = [&](int i) { write_one(pages[static_cast<std::size_t>(i)], folder, generator, settings); };
  const auto show = [&](int done) {
    line.show(static_cast<double>(done) / std::max(1, count), std::to_string(done) + " cases made ready to look at");
  };
  const int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (const int i : in_children(jobs, count, kMostSeconds, write, show))
    write_problem(folder, pages[static_cast<std::size_t>(i)].page.key,
                  {"report.case_lost", "", "generating it ended the program, or took more than a minute"});
  line.clear();
}

}  // namespace

void write_case_pages(const std::vector<CasePage>& pages, const std::string& folder, Generator& generator,
                      Context& context) {
  const Result<CheckSettings> settings = context.load_settings_without_waivers();
  if (!settings) return context.fail(settings.issue());
  if (const Result<Done> copied = copy_viewer(folder + "/viewer"); !copied)
    warn("the report has no viewer", copied.issue());
  if (const Result<Done> written = write_library(folder + "/viewer/library.js", generator, context); !written)
    warn("the report cannot play specs", written.issue());
  if (const Result<Done> made = make_folder(folder + "/cases"); !made) return context.fail(made.issue(), kInternal);
  const std::string surroundings = surroundings_id(context, generator.manifest());
  std::set<std::string> wanted;
  std::vector<Stamped> missing;
  for (const CasePage& page : pages) {
    wanted.insert(page.key + ".js");
    const std::string stamp = stamp_of(page, surroundings);
    if (!is_there(folder, page, stamp)) missing.push_back({page, stamp});
  }
  remove_old(folder + "/cases", is_case_file, wanted);
  write_all(missing, folder, generator, *settings);
}

}  // namespace contort::cli
