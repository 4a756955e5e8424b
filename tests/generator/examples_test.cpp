// Every file of docs/examples runs, and every file of docs/examples/bad fails with the code that is its name.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "generator/generate.h"
#include "model/core/files.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

std::set<fs::path> json_files(const std::string& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(CONTORT_SOURCE_DIR) / folder))
    if (entry.path().extension() == ".json") files.insert(entry.path());
  return files;
}

Result<Stage> stage_of_file(const fs::path& path, const Library& library = stock_library()) {
  const Result<std::string> text = read_file(path.string());
  if (!text) return text.issue();
  const Result<Spec> spec = parse_spec(*text);
  if (!spec) return spec.issue();
  return build_stage(*spec, library);
}

TEST(Examples, AllOfThemMove) {
  const std::set<fs::path> files = json_files("docs/examples");
  EXPECT_GE(files.size(), 6U);
  for (const fs::path& path : files) {
    const Result<Stage> stage = stage_of_file(path);
    ASSERT_TRUE(stage.ok()) << path << to_line(stage.issue());
    const Motion motion = generate(*stage);
    ASSERT_GT(motion.frame_count, 1) << path;
    const auto first = motion.row(0);
    bool moves = false;
    for (int f = 1; f < motion.frame_count; ++f)
      moves = moves || !std::equal(first.begin(), first.end(), motion.row(f).begin());
    EXPECT_TRUE(moves) << path << " stands still";
  }
}

TEST(Examples, AllActionsHaveOne) {
  std::set<std::string> seen;
  for (const fs::path& path : json_files("docs/examples")) {
    const Result<Stage> stage = stage_of_file(path);
    ASSERT_TRUE(stage.ok()) << path;
    for (const PlannedAction& action : stage->timeline.actions) seen.insert(std::string(action.def->name));
  }
  for (const ActionDef& action : all_actions()) EXPECT_TRUE(seen.contains(std::string(action.name))) << action.name;
}

TEST(Examples, ActionsOfAUsersOwnPlay) {
  Library library = stock_library();
  const std::string folder = CONTORT_SOURCE_DIR "/docs/examples/own_actions";
  ASSERT_TRUE(load_folder(folder, library).ok());
  ASSERT_TRUE(check_actions(library).ok());
  std::set<std::string> seen;
  for (const fs::path& path : json_files("docs/examples/with_own_actions")) {
    const Result<Stage> stage = stage_of_file(path, library);
    ASSERT_TRUE(stage.ok()) << path << to_line(stage.issue());
    for (const PlannedAction& action : stage->timeline.actions) seen.insert(action.name);
    EXPECT_GT(generate(*stage).frame_count, 1);
  }
  for (const ActionDesc& action : library.actions) EXPECT_TRUE(seen.contains(action.name)) << action.name;
}

TEST(Examples, BadOnesFailWithTheCodeThatIsTheirName) {
  const std::set<fs::path> files = json_files("docs/examples/bad");
  EXPECT_GE(files.size(), 14U);
  for (const fs::path& path : files) {
    const Result<Stage> stage = stage_of_file(path);
    ASSERT_FALSE(stage.ok()) << path;
    EXPECT_EQ(stage.issue().code, path.stem().string()) << to_line(stage.issue());
  }
}

// The position of the fault in the file, for faults found by building (for reading: tests/core/json_fields_test.cpp).
TEST(Examples, BadOnesPointToTheTrouble) {
  const std::pair<const char*, const char*> expected[] = {
      {"spec.unknown_action", "/sequences/0/clips/0/actions/0/action"},
      {"spec.unknown_slot", "/sequences/0/clips/0/actions/0/slot"},
      {"spec.unsupported_action", "/sequences/0/clips/0/actions/0/action"},
      {"spec.unknown_param", "/sequences/0/clips/0/actions/0/params/knee_deg"},
      {"spec.wrong_type", "/sequences/0/clips/0/actions/0/params/shoulder_deg"},
      {"spec.out_of_range", "/sequences/0/clips/0/actions/0/params/azimuth_deg"},
      {"spec.too_long", "/sequences/1"},
      {"character.unknown_character", "/character/name"},
      {"character.unknown_part", "/character/parts/head"},
      {"character.unknown_slot", "/character/parts/tail"},
      {"character.unknown_object", "/character/attachments/0/object"},
      {"character.unknown_socket", "/character/attachments/0/socket"},
      {"character.duplicate_object", "/character/attachments/1/object"},
  };
  for (const auto& [name, pointer] : expected) {
    const fs::path path = fs::path(CONTORT_SOURCE_DIR) / "docs/examples/bad" / (std::string(name) + ".json");
    const Result<Stage> stage = stage_of_file(path);
    ASSERT_FALSE(stage.ok()) << path;
    EXPECT_EQ(stage.issue().pointer, pointer) << name;
  }
}

}  // namespace
}  // namespace contort
