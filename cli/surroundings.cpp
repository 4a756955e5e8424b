#include "cli/surroundings.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "generator/core/files.h"
#include "generator/core/hash.h"

namespace contort::cli {

namespace fs = std::filesystem;

namespace {

std::string id_of_file(const std::string& path) {
  const Result<std::string> text = read_file(path);
  return content_id(text ? *text : "");
}

}  // namespace

std::string surroundings_id(const Context& context) {
  std::string ids = id_of_file("/proc/self/exe") + id_of_file(context.settings_file);
  for (const std::string& folder : context.library_folders) {
    std::vector<std::string> files;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error))
      if (entry.is_regular_file(error)) files.push_back(entry.path().lexically_relative(folder).string());
    std::ranges::sort(files);
    for (const std::string& file : files) ids += "\n" + file + "\n" + id_of_file(folder + "/" + file);
  }
  return content_id(ids);
}

}  // namespace contort::cli
