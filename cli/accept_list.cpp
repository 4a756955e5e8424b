#include "cli/accept_list.h"

#include <algorithm>
#include <filesystem>

#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"

namespace contort::cli {

template <class V>
void fields(V& v, const AcceptedFinding*) {
  using json_fields::Text;
  v.field("file", &AcceptedFinding::file, {.text = Text::prose, .required = true},
          "File, below the folder that is checked.");
  v.field("clip", &AcceptedFinding::clip, {.text = Text::label, .required = true}, "Clip of the file.");
  v.field("check", &AcceptedFinding::check, {.required = true}, "Name of a check.");
  v.field("joint", &AcceptedFinding::joint, {.text = Text::label, .required = true}, "Subject of the finding.");
  v.field("reason", &AcceptedFinding::reason, {.text = Text::prose, .may_be_empty = true},
          "Reason for accepting the finding.");
}

template <class V>
void fields(V& v, const AcceptList*) {
  v.constant("format", "contort.accept/1");
  v.field("accepted", &AcceptList::accepted, {.max_count = 100000, .required = true}, "Findings that fail no run.");
}

Result<AcceptList> parse_accept_list(std::string_view text) {
  return json_fields::read_document<AcceptList>(text, "accept");
}

std::string print_accept_list(const AcceptList& list) { return json_fields::write_pretty(list); }

std::string accept_list_schema() { return json_fields::write_schema<AcceptList>("Contort accept list"); }

Result<AcceptList> read_accept_list(const std::string& path) {
  if (path.empty()) return AcceptList{};
  const Result<std::string> text = read_json_file(path, "an accept list (JSON)");
  if (!text) return text.issue();
  Result<AcceptList> list = parse_accept_list(*text);
  if (!list) return about_file(path, list.issue());
  return list;
}

std::string name_in_accept_list(const std::string& file, const std::vector<std::string>& named) {
  namespace fs = std::filesystem;
  std::error_code error;
  for (const std::string& folder : named) {
    if (!fs::is_directory(folder, error)) continue;
    const std::string below = fs::path(file).lexically_normal().lexically_relative(fs::path(folder).lexically_normal());
    if (!below.empty() && !below.starts_with("..")) return below;
  }
  return fs::path(file).filename().string();
}

int index_in(const AcceptList& list, const AcceptedFinding& finding) {
  const auto found = std::ranges::find_if(list.accepted, [&](const auto& entry) { return entry.is_same(finding); });
  return found == list.accepted.end() ? -1 : static_cast<int>(found - list.accepted.begin());
}

std::string accepted_text(const AcceptedFinding& f) {
  return f.file + ": clip " + f.clip + ": " + f.check + " at " + f.joint;
}

}  // namespace contort::cli
