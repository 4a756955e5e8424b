// Small rules that reviewers should not have to check.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <memory>
#include <sstream>

#include "tests/guards/source_text.h"

namespace contort::guards {
namespace {

constexpr int kMaxLines = 400;

// Longer files, each with the reason.
const std::map<std::string, std::string> kLongFiles = {};

bool is_text(const SourceFile& file) { return file.text.find('\0') == std::string::npos; }

bool is_shell_script(const SourceFile& file) {
  const std::string first_line = file.text.substr(0, file.text.find('\n'));
  const bool shebang = first_line.starts_with("#!") && first_line.ends_with("sh");
  return shebang || file.path.ends_with(".sh");
}

// Absolute paths of the machines that this project is written on. Put together here, so that this file has none itself.
const std::vector<std::string> kMachineFolders = {std::string("/wo") + "rk", std::string("/fa") + "rm"};
const std::string kTemporaryFolder = std::string("/tm") + "p/";

std::vector<Violation> machine_paths(const std::string& path, std::string_view text) {
  std::vector<Violation> violations;
  const auto look_for = [&](std::string_view folder, auto&& is_hit) {
    for (std::size_t at = text.find(folder); at != std::string_view::npos; at = text.find(folder, at + 1)) {
      const char before = at > 0 ? text[at - 1] : '\n';
      const char after = at + folder.size() < text.size() ? text[at + folder.size()] : '\n';
      if (is_word(before) || before == '.' || before == '-' || before == '}' || !is_hit(after)) continue;
      const auto line = 1 + std::ranges::count(text.substr(0, at), '\n');
      violations.push_back({path, static_cast<int>(line), "a path of one machine: " + std::string(folder)});
    }
  };
  for (const std::string& folder : kMachineFolders) {
    look_for(folder, [](char after) { return !is_word(after) && after != '-'; });
  }
  look_for(kTemporaryFolder, [](char after) { return is_word(after); });
  return violations;
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"), pclose);
  if (pipe == nullptr) return "cannot start " + command;
  std::string output;
  char block[4096];
  for (std::size_t n = 0; (n = fread(block, 1, sizeof block, pipe.get())) > 0;) output.append(block, n);
  return output;
}

TEST(Hygiene, NoPathsOfOneMachine) {
  std::vector<Violation> violations;
  for (const SourceFile& file : project_files()) {
    if (is_text(file)) std::ranges::copy(machine_paths(file.path, file.text), std::back_inserter(violations));
  }
  EXPECT_TRUE(violations.empty()) << to_text(violations);
}

TEST(Hygiene, RefusesPlantedPaths) {
  const std::string folder = kMachineFolders.front();
  const std::string temporary = kTemporaryFolder;
  for (const std::string& bad : {"see " + folder + "/main", folder, "cp x " + folder + "\n", "a=" + temporary + "x",
                                 "\"" + temporary + "corpus\"", "(" + kMachineFolders.back() + "/bin)"}) {
    EXPECT_EQ(machine_paths("docs/a.md", bad).size(), 1U) << bad;
  }
  for (const std::string& good : {"net" + folder, folder + "ers", "docs" + folder + "/x", folder + "-flow",
                                  "${TMPDIR:-" + temporary.substr(0, 4) + "}/x", "https://a.org" + folder + "/x"}) {
    EXPECT_TRUE(machine_paths("docs/a.md", good).empty()) << good;
  }
}

TEST(Hygiene, FilesAreShort) {
  for (const SourceFile& file : project_files()) {
    if (!is_cpp(file.path)) continue;
    const auto lines = std::ranges::count(file.text, '\n');
    if (kLongFiles.contains(file.path)) {
      EXPECT_GT(lines, kMaxLines) << file.path << " needs no exception any more";
    } else {
      EXPECT_LE(lines, kMaxLines) << file.path << " is too long for one sitting: split it";
    }
  }
}

// "Figure" of a line "struct Figure {" or "class Figure final : public Shape {"; "" of any other, declarations
// included.
std::string defined_type(std::string_view line) {
  for (const std::string_view keyword : {"struct ", "class ", "enum class "}) {
    if (!line.starts_with(keyword) || !line.ends_with("{")) continue;
    line.remove_prefix(keyword.size());
    const std::string name(line.substr(0, line.find_first_of(" :{<")));
    return line.substr(name.size()).starts_with("<") ? "" : name;  // a specialisation is not the type's own definition
  }
  return "";
}

// Two structs of one name in one namespace are undefined behaviour in one program, and no compiler reports it.
TEST(Hygiene, HeadersDefineEachTypeOnce) {
  std::map<std::string, std::string> home;
  for (const SourceFile& file : project_files()) {
    if (!file.path.ends_with(".h") || file.path.starts_with("tests/")) continue;
    if (file.path.starts_with("adapters/")) continue;  // they never meet our types: users copy them
    std::istringstream text(file.text);
    for (std::string line; std::getline(text, line);) {
      const std::string name = defined_type(line);
      if (name.empty()) continue;
      const auto [other, is_new] = home.emplace(name, file.path);
      EXPECT_TRUE(is_new) << name << " is in " << other->second << " and in " << file.path;
    }
  }
  EXPECT_GT(home.size(), 100U);
}

TEST(Hygiene, HeadersMayBeIncludedTwice) {
  int headers = 0;
  for (const SourceFile& file : project_files()) {
    if (!file.path.ends_with(".h")) continue;
    ++headers;
    EXPECT_TRUE(("\n" + file.text).find("\n#pragma once\n") != std::string::npos) << file.path;
  }
  EXPECT_GT(headers, 300);
}

TEST(Hygiene, ShellScriptsParse) {
  const std::string root = CONTORT_SOURCE_DIR;
  const bool has_shellcheck = !output_of("command -v shellcheck").empty();
  int scripts = 0;
  for (const SourceFile& file : project_files()) {
    if (!is_shell_script(file)) continue;
    ++scripts;
    const std::string in_root = "cd '" + root + "' && ";
    EXPECT_EQ(output_of(in_root + "bash -n '" + file.path + "'"), "");
    if (has_shellcheck) {
      EXPECT_EQ(output_of(in_root + "shellcheck --external-sources '" + file.path + "'"), "");
    }
  }
  EXPECT_GE(scripts, 4);  // run, test, .ci/run and their shared script
}

TEST(Hygiene, ScriptsOfTheRootCanBeStarted) {
  for (const char* script : {"run", "test", ".ci/run"}) {
    const auto permissions = std::filesystem::status(std::filesystem::path(CONTORT_SOURCE_DIR) / script).permissions();
    EXPECT_NE(permissions & std::filesystem::perms::owner_exec, std::filesystem::perms::none) << script;
  }
}

}  // namespace
}  // namespace contort::guards
