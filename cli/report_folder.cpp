#include "cli/report_folder.h"

#include <filesystem>
#include <string_view>
#include <vector>

#include "model/core/files.h"
#include "model/core/own_folder.h"

namespace contort::cli {

namespace fs = std::filesystem;

namespace {

bool is_hex(std::string_view text, std::size_t digits) {
  return text.size() == digits && text.find_first_not_of("0123456789abcdef") == text.npos;
}

// Returns true for names such as "joint_range-0123456789ab".
bool is_key(std::string_view text) {
  const std::size_t dash = text.find('-');
  return dash != text.npos && dash > 0 && is_hex(text.substr(dash + 1), 12);
}

}  // namespace

bool is_case_file(const std::string& name) { return name.ends_with(".js") && is_key(fs::path(name).stem().string()); }

bool is_picture_file(const std::string& name) {
  if (!name.ends_with(".png") && !name.ends_with(".webp") && !name.ends_with(".js")) return false;
  const std::string stem = fs::path(name).stem().string();
  const std::size_t dash = stem.rfind('-');
  return dash != stem.npos && is_hex(std::string_view(stem).substr(dash + 1), 8) && is_key(stem.substr(0, dash));
}

Result<Done> check_report_folder(const std::string& folder) {
  const Result<std::string> summary = read_file(folder + "/report.json");
  return check_own_folder(folder, summary && summary->find("\"contort.report/1\"") != summary->npos, "a report");
}

void remove_old(const std::string& folder, bool (*is_ours)(const std::string&), const std::set<std::string>& wanted) {
  std::error_code error;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (is_ours(name) && !wanted.contains(name)) old.push_back(entry.path());
  }
  for (const fs::path& path : old) fs::remove(path, error);
}

}  // namespace contort::cli
