#include "cli/library_folder.h"

#include <filesystem>

#include "cli/animation.h"
#include "model/core/files.h"
#include "model/core/own_folder.h"

namespace contort::cli {

namespace {

namespace fs = std::filesystem;

bool is_of_library(const fs::path& path) {
  if (path.filename() == "aim" || is_animation(path.string())) return true;
  if (path.extension() != ".json") return false;
  const Result<std::string> text = read_file(path.string());
  return text && text->find("\"contort.") != text->npos;
}

}  // namespace

Result<Done> check_library_folder(const std::string& folder) {
  bool found = false;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && !found && entry != fs::directory_iterator(); entry.increment(error))
    found = is_of_library(entry->path());
  return check_own_folder(folder, found, "a library folder");
}

}  // namespace contort::cli
