#include "cli/case_pages.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <thread>

#include "cli/render.h"
#include "corpus/corpus.h"
#include "fuzz/parallel.h"
#include "generator/core/files.h"
#include "renders/case_data.h"

namespace contort::cli {

namespace fs = std::filesystem;

namespace {

// The files of a bucket that are cases of their own.
Result<std::string> data_of(const CasePage& page, const Library& library, const CheckSettings& settings) {
  std::vector<std::pair<std::string, Case>> cases;
  for (const auto& [role, file] : {std::pair("minimal", page.minimal), std::pair("original", page.original),
                                   std::pair("worst", page.worst)}) {
    if (file.empty()) continue;
    Result<Case> stored = read_case(page.folder + "/" + file);
    if (!stored && cases.empty()) return stored.issue();
    const auto is_there = [&](const auto& other) { return other.second.spec == stored->spec; };
    if (stored && !is_ending(stored->expect) && std::ranges::none_of(cases, is_there))
      cases.emplace_back(role, std::move(stored).value());
  }
  std::vector<ShownCase> shown;
  for (const auto& [role, stored] : cases) shown.push_back({role, stored});
  return case_data(page.key, shown, library, settings);
}

Result<Done> write_one(const CasePage& page, const std::string& folder, const Library& library,
                       const CheckSettings& settings) {
  const std::string path = folder + "/cases/" + page.key + ".js";
  const Result<std::string> data = data_of(page, library, settings);
  if (data) return write_file(path, case_script(page.key, *data));
  std::error_code ignored;
  fs::remove(path, ignored);  // of an earlier report
  return data.issue();
}

// viewer.js and viewer.css lie in page/, beside the program.
Result<Done> copy_viewer(const std::string& folder) {
  const std::string from = (fs::path(renderer_path()).parent_path() / "page").string();
  if (const Result<Done> made = make_folder(folder); !made) return made;
  for (const char* name : {"viewer.js", "viewer.css"}) {
    const Result<std::string> text = read_file(from + "/" + name, std::size_t{1} << 26);
    if (!text) return text.issue();
    if (const Result<Done> written = write_file(folder + "/" + name, *text); !written) return written;
  }
  return Done{};
}

// Of buckets that an earlier report had.
void remove_others(const std::string& folder, const std::vector<CasePage>& pages) {
  std::set<std::string> wanted;
  for (const CasePage& page : pages) wanted.insert(page.key + ".js");
  std::error_code error;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".js" && !wanted.contains(entry.path().filename().string()))
      old.push_back(entry.path());
  for (const fs::path& path : old) fs::remove(path, error);
}

void warn(const std::string& what, const Issue& issue) {
  std::fprintf(stderr, "contort: %s: %s\n", what.c_str(), to_line(issue).c_str());
}

}  // namespace

void write_case_pages(const std::vector<CasePage>& pages, const std::string& folder, const Library& library,
                      Context& context) {
  const Result<CheckSettings> settings = context.load_settings_without_waivers();
  if (!settings) return context.fail(settings.issue());
  if (const Result<Done> copied = copy_viewer(folder + "/viewer"); !copied)
    warn("the report has no viewer", copied.issue());
  if (const Result<Done> made = make_folder(folder + "/cases"); !made) return context.fail(made.issue(), kInternal);
  remove_others(folder + "/cases", pages);
  std::vector<std::optional<Issue>> missing(pages.size());
  parallel_for(
      static_cast<int>(std::max(1U, std::thread::hardware_concurrency())), static_cast<int>(pages.size()),
      [&](int, int i) {
        const auto at = static_cast<std::size_t>(i);
        const Result<Done> written = write_one(pages[at], folder, library, *settings);
        if (!written) missing[at] = written.issue();
      },
      [] {});
  for (std::size_t i = 0; i < pages.size(); ++i)
    if (missing[i]) warn("the report cannot show " + pages[i].key, *missing[i]);
}

}  // namespace contort::cli
