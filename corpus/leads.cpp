#include "corpus/leads.h"

#include <algorithm>
#include <filesystem>

#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

// The files of a lead besides its original. The minimal case is written last: if it exists, all files do.
struct Beside {
  std::string_view ending;
  std::optional<Case> Lead::*stored;
};
constexpr Beside kBeside[] = {
    {"-orig.json", &Lead::shrunk_from}, {"-worst.json", &Lead::worst}, {"-min.json", &Lead::minimal}};

bool is_beside(const std::string& path) {
  return std::ranges::any_of(kBeside, [&](const Beside& beside) { return path.ends_with(beside.ending); });
}

std::string folder_of(const Corpus& corpus, const std::string& run) { return corpus.folder() + "/leads/" + run; }

// Reads RUN/FILE below leads/, not below the run's own folder, which may be a link that leads elsewhere.
Result<Case> read_case_of_lead(const std::string& path) {
  const fs::path file(path), folder = file.parent_path();
  return read_case_of(folder.parent_path().string(), (folder.filename() / file.filename()).string());
}

Result<Done> write_case_of_lead(const Corpus& corpus, const std::string& path, const Case& stored) {
  const std::string folder = corpus.folder() + "/leads";
  return write_inside(folder, path.substr(folder.size() + 1), print_case(stored));
}

// The path without ".json". Indices in file names have equal length, so that names sort like indices.
std::string stem_of(const Corpus& corpus, const Lead& lead) {
  const Provenance& from = lead.original.provenance;
  std::string digits = std::to_string(from.index);
  digits.insert(0, 16 - std::min<std::size_t>(16, digits.size()), '0');
  return folder_of(corpus, lead.run) + "/" + bucket_id(family_of(lead.original), print_family(from.met_shrinking)) +
         "-" + digits;
}

std::vector<std::string> case_files(const Corpus& corpus) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(corpus.folder() + "/leads", error))
    if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

bool waits(const Lead& lead) { return !lead.minimal && lead.original.provenance.shrink_stopped == kWaits; }
bool is_unsteady(const Lead& lead) { return !lead.minimal && lead.original.provenance.shrink_stopped == kUnsteady; }

std::set<Family> families_told_by(const Lead& lead) {
  if (!lead.minimal) return {};
  std::set<Family> told(lead.minimal->co_failures.begin(), lead.minimal->co_failures.end());
  told.insert(family_of(*lead.minimal));
  return told;
}

Result<Lead> read_lead(const std::string& path) {
  Result<Case> original = read_case_of_lead(path);
  if (!original) return original.issue();
  Lead lead{fs::path(path).parent_path().filename().string(), std::move(original).value(), {}};
  const std::string stem = path.substr(0, path.size() - 5);
  for (const Beside& beside : kBeside) {
    const std::string other = stem + std::string(beside.ending);
    if (std::error_code error; !fs::exists(other, error)) continue;
    Result<Case> stored = read_case_of_lead(other);
    if (!stored) return stored.issue();
    lead.*beside.stored = std::move(stored).value();
  }
  return lead;
}

std::string lead_path(const Corpus& corpus, const Lead& lead) { return stem_of(corpus, lead) + ".json"; }

Result<std::string> keep_lead(const Corpus& corpus, const Lead& lead) {
  const Result<std::string> folder = place_inside(corpus.folder() + "/leads", lead.run);
  if (!folder) return folder.issue();
  if (const Result<Done> inside = check_inside(corpus.folder(), *folder); !inside) return inside.issue();
  if (const Result<Done> made = make_folder(*folder); !made) return made.issue();
  const std::string stem = stem_of(corpus, lead);
  if (const Result<Done> kept = write_case_of_lead(corpus, stem + ".json", lead.original); !kept) return kept.issue();
  for (const Beside& beside : kBeside)
    if (const std::optional<Case>& stored = lead.*beside.stored)
      if (const Result<Done> kept = write_case_of_lead(corpus, stem + std::string(beside.ending), *stored); !kept)
        return kept.issue();
  return stem + ".json";
}

std::vector<Lead> leads_of(const Corpus& corpus, std::vector<Issue>& damaged) {
  std::vector<Lead> all;
  for (const std::string& path : case_files(corpus)) {
    if (is_beside(path)) continue;
    Result<Lead> lead = read_lead(path);
    if (lead)
      all.push_back(std::move(lead).value());
    else
      damaged.push_back(lead.issue());
  }
  return all;
}

Result<Corpus::Added> file_lead(const Corpus& corpus, const Lead& lead) {
  if (!lead.minimal) return Issue{"lead.not_shrunk", "", stem_of(corpus, lead) + ".json is not shrunk yet"};
  Result<Corpus::Added> added =
      corpus.add({*lead.minimal, lead.shrunk_from.value_or(lead.original), lead.run, lead.worst});
  if (added) drop_lead(corpus, lead);
  return added;
}

void drop_lead(const Corpus& corpus, const Lead& lead) {
  std::error_code ignored;
  const std::string stem = stem_of(corpus, lead);
  if (!check_inside(corpus.folder(), fs::path(stem).parent_path().string())) return;
  for (const Beside& beside : kBeside) fs::remove(stem + std::string(beside.ending), ignored);
  fs::remove(stem + ".json", ignored);
}

void tidy_leads(const Corpus& corpus, const std::string& run) {
  std::error_code ignored;
  fs::remove(folder_of(corpus, run), ignored);  // removes only an empty folder
}

}  // namespace contort
