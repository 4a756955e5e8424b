#include "cli/surroundings.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "model/core/files.h"
#include "model/core/hash.h"

namespace contort::cli {

namespace fs = std::filesystem;

namespace {

std::string id_of_file(const std::string& path) {
  const Result<std::string> text = read_file(path);
  return content_id(text ? *text : "");
}

// Returns true for files that load_folder and load_recordings read. Reports and corpora may be in the same folder.
bool is_of_library(const fs::directory_entry& entry) {
  constexpr std::array<std::string_view, 7> kKinds = {".json", ".glb", ".gltf", ".bin", ".bvh", ".amc", ".asf"};
  std::error_code error;
  return entry.is_regular_file(error) && std::ranges::find(kKinds, entry.path().extension().string()) != kKinds.end();
}

}  // namespace

std::string surroundings_id(const Context& context, const Manifest& manifest) {
  std::string ids = id_of_file("/proc/self/exe") + id_of_file(context.settings_file) + manifest.build;
  for (const std::string& library : context.sources.libraries)
    for (const std::string& folder : {library, library + "/maps"}) {
      std::set<std::string> names;
      std::error_code error;
      for (const auto& entry : fs::directory_iterator(folder, error))
        if (is_of_library(entry)) names.insert(entry.path().filename().string());
      for (const std::string& name : names) ids += "\n" + name + "\n" + id_of_file(folder + "/" + name);
    }
  return content_id(ids);
}

}  // namespace contort::cli
