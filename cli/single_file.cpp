#include "cli/single_file.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string_view>
#include <vector>

#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/output.h"
#include "renders/case_data.h"
#include "renders/page_call.h"

namespace contort::cli {

namespace {

// The greatest size for mail: most servers refuse attachments above 25 MB, and base64 adds a third.
constexpr std::size_t kMostBytes = 18'000'000;

// The rows of the first screen come first, so that they have pictures even if not all have room.
std::vector<const ReportRow*> rows_by_use(const ReportModel& model) {
  std::map<std::string_view, std::size_t> place_of_key;
  for (const ReportCause& cause : model.causes) place_of_key.emplace(cause.key, place_of_key.size());
  const auto place = [&](const ReportRow* row) {
    const auto found = place_of_key.find(row->key);
    return found == place_of_key.end() ? place_of_key.size() : found->second;
  };
  std::vector<const ReportRow*> rows;
  for (const ReportRow& row : model.rows) rows.push_back(&row);
  std::ranges::stable_sort(rows, {}, place);
  return rows;
}

}  // namespace

Result<Done> write_single_file(const ReportModel& model, const std::string& folder, const std::string& path) {
  PageFiles inside;
  std::size_t room = kMostBytes;
  int left_out = 0;
  const auto text_of = [&](const std::string& name) {
    const Result<std::string> text = read_inside(folder, name, kMostBytes);
    return text ? *text : std::string();
  };
  const auto add = [&](const std::string& name, const std::string& text) {
    if (text.size() > room) ++left_out;
    if (text.empty() || text.size() > room) return;
    room -= text.size();
    inside[name] = text;
  };
  for (const char* name : {"viewer/viewer.css", "viewer/viewer.js", "viewer/engine.js", "viewer/library.js"}) add(name, text_of(name));
  for (const ReportRow* one : rows_by_use(model)) {
    const ReportRow& row = *one;
    if (!row.strip.empty()) add(row.strip, text_of(row.strip));
    if (const std::filesystem::path strip = row.strip; !row.strip.empty())
      add("strips/" + strip.stem().string() + ".json",
          data_of_page_call("contortStrip", strip.stem().string(), text_of("strips/" + strip.stem().string() + ".js")));
    if (row.has_motion) add("cases/" + row.key + ".json", data_of_script(row.key, text_of("cases/" + row.key + ".js")));
  }
  if (left_out > 0)
    std::fprintf(stderr, "contort: %s has the greatest size for mail; %d motions and pictures are only in %s\n",
                 path.c_str(), left_out, folder.c_str());
  return write_output(path, report_html(model, inside));
}

}  // namespace contort::cli
