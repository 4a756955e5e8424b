// The inputs that libFuzzer found once, in regressions/<target>/, and its seeds: without libFuzzer, in every test run.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

#include "tests/corpus/temp_folder.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {
namespace {

const std::string kRegressions = std::string(CONTORT_SOURCE_DIR) + "/tests/libfuzzer/regressions";

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// A seed that is refused is none: the target behind it would never be reached.
TEST(HostileFiles, SeedsAreAccepted) {
  for (const Target& target : all_targets())
    for (const std::string& seed : target.seeds())
      EXPECT_TRUE(target.run(seed)) << target.name << ": " << seed.substr(0, 3000);
}

// A sanitizer, an assert or a broken promise ends the test.
TEST(HostileFiles, WhatWasFoundIsAnsweredWithinASecond) {
  for (const Target& target : all_targets()) {
    const std::string folder = kRegressions + "/" + std::string(target.name);
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& [path, bytes] : tree_of(folder)) {
      const double start = cpu_seconds();
      target.run(bytes);
      EXPECT_LT(cpu_seconds() - start, 1.0) << target.name << "/" << path;
    }
  }
}

TEST(HostileFiles, EveryFolderOfRegressionsBelongsToATarget) {
  ASSERT_TRUE(std::filesystem::exists(kRegressions));
  for (const auto& entry : std::filesystem::directory_iterator(kRegressions)) {
    const std::string name = entry.path().filename().string();
    EXPECT_NE(std::ranges::find(all_targets(), name, &Target::name), all_targets().end()) << name;
  }
}

// Seeds of every length, and with every byte replaced in turn, in every build: the first steps of mutation.
TEST(HostileFiles, SeedsThatAreCutOrChangedAreAnswered) {
  for (const Target& target : all_targets()) {
    if (target.name == "spec" || target.name == "description" || target.name == "case") continue;  // slow, and JSON too
    const std::string seed = target.seeds().front();
    for (std::size_t size = 0; size < seed.size(); ++size) target.run(std::string_view(seed).substr(0, size));
    for (std::size_t at = 0; at < seed.size(); ++at) {
      std::string changed = seed;
      changed[at] = static_cast<char>(changed[at] ^ 0x15);
      target.run(changed);
    }
  }
}

}  // namespace
}  // namespace contort::hostile
