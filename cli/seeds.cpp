#include "cli/seeds.h"

#include <algorithm>
#include <filesystem>

#include "cli/input.h"
#include "process/isolate.h"
#include "model/core/file_kind.h"
#include "model/core/inside_folder.h"

namespace contort::cli {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_of(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
  std::ranges::sort(paths);
  return paths;
}

// The reason for which a spec does not build; "" if it does. A spec that ends the process is a case for the run.
std::string refusal_of(const Spec& spec, Generator& generator) {
  const Result<Ending> ending = isolate([&] {
    const Result<Admission> admitted = generator.admit(spec);
    return admitted ? std::string() : to_line(admitted.issue());
  });
  return ending ? ending->result : to_line(ending.issue());
}

}  // namespace

Result<std::vector<Spec>> read_seeds(const std::string& folder, Generator& generator) {
  std::vector<Spec> seeds;
  for (const std::string& path : files_of(folder)) {
    if (const Result<Done> inside = check_inside(folder, path); !inside) return inside.issue();
    const Result<std::string> text = read_json_file(path, "a spec or a case (JSON)");
    if (!text) return text.issue();
    const Result<SpecInput> input = parse_spec_input(*text, path);
    if (!input) return input.issue();
    if (const std::string why = refusal_of(input->spec, generator); !why.empty())
      return Issue{"seeds.refused", "", path + ": " + why};
    seeds.push_back(input->spec);
  }
  if (seeds.empty()) return Issue{"seeds.none", "", folder + " is no folder with specs or cases (*.json)"};
  return seeds;
}

}  // namespace contort::cli
