#include "cli/program_files.h"

#include <filesystem>

namespace contort::cli {

namespace {

namespace fs = std::filesystem;

// `installed` is the way from the folder of an installed program. Without either, the name beside the program is told,
// for messages.
std::string beside_or(const std::string& name, const std::string& installed) {
  const fs::path folder = fs::path(own_path()).parent_path();
  std::error_code error;
  const bool is_beside = fs::exists(folder / name, error) || !fs::exists(folder / installed, error);
  return (is_beside ? folder / name : (folder / installed).lexically_normal()).string();
}

}  // namespace

std::string own_path() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).string();
}

std::string renderer_path() { return beside_or("contort-render", "../libexec/contort/contort-render"); }

std::string pages_path() { return beside_or("page", "../share/contort/page"); }

}  // namespace contort::cli
