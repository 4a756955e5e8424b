#include "cli/single_file.h"

#include "generator/core/files.h"
#include "renders/case_data.h"

namespace contort::cli {

namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 26;  // of one file

}  // namespace

Result<Done> write_single_file(const ReportModel& model, const std::string& folder, const std::string& path) {
  PageFiles inside;
  const auto text_of = [&](const std::string& name) {
    const Result<std::string> text = read_file(folder + "/" + name, kMostBytes);
    return text ? *text : std::string();
  };
  const auto add = [&](const std::string& name, const std::string& text) {
    if (!text.empty()) inside[name] = text;
  };
  for (const char* name : {"viewer/viewer.css", "viewer/viewer.js"}) add(name, text_of(name));
  for (const ReportRow& row : model.rows) {
    if (!row.strip.empty()) add(row.strip, text_of(row.strip));
    if (row.has_motion) add("cases/" + row.key + ".json", data_of_script(row.key, text_of("cases/" + row.key + ".js")));
  }
  return write_file(path, report_html(model, inside));
}

}  // namespace contort::cli
