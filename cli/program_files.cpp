#include "cli/program_files.h"

#include <filesystem>

namespace contort::cli {

namespace {

namespace fs = std::filesystem;

// `installed` is the path relative to the folder of an installed program. It is tried first, because the folder of an
// installed program also has other programs, which may have the same name.
std::string installed_or_beside(const std::string& installed, const std::string& name) {
  const fs::path folder = fs::path(own_path()).parent_path();
  std::error_code error;
  if (fs::exists(folder / installed, error)) return (folder / installed).lexically_normal().string();
  return (folder / name).string();
}

}  // namespace

std::string own_path() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).string();
}

std::string renderer_path() { return installed_or_beside("../libexec/contort/contort-render", "contort-render"); }

std::string pages_path() { return installed_or_beside("../share/contort/page", "page"); }

bool has_engine() {
  std::error_code error;
  return fs::exists(fs::path(pages_path()) / "engine.js", error);
}

}  // namespace contort::cli
