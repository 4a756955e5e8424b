#include "model/core/own_folder.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace contort {

namespace {

constexpr std::size_t kShownNames = 3;

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    if (const std::string name = entry->path().filename().string(); !name.starts_with(".")) names.push_back(name);
  std::ranges::sort(names);
  return names;
}

}  // namespace

Result<Done> check_own_folder(const std::string& folder, bool is_ours, const std::string& kind) {
  if (is_ours) return Done{};
  const std::vector<std::string> names = names_in(folder);
  if (names.empty()) return Done{};
  std::string shown;
  for (std::size_t i = 0; i < std::min(kShownNames, names.size()); ++i) shown += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kShownNames) shown += " and " + std::to_string(names.size() - kShownNames) + " more";
  return Issue{"folder.other_files", "",
               folder + " is not " + kind + " and holds other files (" + shown +
                   "), which stay as they are: name a new folder, an empty one or " + kind};
}

}  // namespace contort
