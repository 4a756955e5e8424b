// A night under a scheduler: killed runs, shards, and merging.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <random>
#include <thread>

#include "tests/cli/program.h"
#include "tests/cli/small_library.h"

namespace contort {
namespace {

class Night : public ::testing::Test {
 protected:
  // Arguments of a run of the small character, a hundred times as fast as the stock ones.
  std::vector<std::string> fuzz(const std::string& corpus, int cases, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"fuzz",    "--character",          "small",  "--library", library_,
                                          "--cases", std::to_string(cases),  "--seed", "4",         "--corpus",
                                          corpus,    "--shrink-evaluations", "6"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void SetUp() override {
    library_ = folder_ / "library";
    small::write_library(library_);
  }
  TempFolder folder_;
  std::string library_;
};
class NightSlow : public Night {};

// The run is killed while it starts, searches, shrinks and writes. It stores its state once a second, so some kills
// come before any progress.
TEST_F(NightSlow, KilledFiftyTimesAndResumedItLeavesTheSameBytes) {
  const std::string whole = folder_ / "whole", killed = folder_ / "killed";
  constexpr int kCases = 45000;
  ASSERT_EQ(contort_program(fuzz(whole, kCases)).code, 1);
  std::mt19937 dice(50);
  for (int kills = 0; kills < 50; ++kills) {
    const Program program(fuzz(killed, kCases, {"--resume"}), folder_.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(dice() % 1500));
    program.send(SIGKILL);
    ASSERT_EQ(program.wait().code, 1000 + SIGKILL) << "it ended before kill " << kills;
  }
  EXPECT_EQ(contort_program(fuzz(killed, kCases, {"--resume"})).code, 1);
  EXPECT_EQ(first_difference(tree_of(whole), tree_of(killed)), "");
}

TEST_F(Night, ShardsSayWhatToDoAndMergeToTheRunThatTheyAreOf) {
  const std::string whole = folder_ / "whole", merged = folder_ / "merged";
  ASSERT_EQ(contort_program(fuzz(whole, 80)).code, 1);
  for (const char* shard : {"0/2", "1/2"}) {
    const std::string corpus = folder_ / std::string(1, shard[0]);
    const Ran ran = contort_program(fuzz(corpus, 80, {"--shard", shard}));
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_NE(ran.out.find("waits in " + corpus + "/leads for contort merge"), std::string::npos) << ran.out;
  }
  const Ran half = contort_program({"merge", folder_ / "0", "-o", merged, "--require-complete"});
  EXPECT_EQ(half.code, 4) << half.out << half.err;
  EXPECT_NE(half.out.find("shards 1 of 2 are missing"), std::string::npos) << half.out;
  for (int again = 0; again < 2; ++again) {
    const Ran both = contort_program({"merge", folder_ / "0", folder_ / "1", "-o", merged, "--require-complete"});
    EXPECT_EQ(both.code, 0) << both.out << both.err;
    EXPECT_EQ(first_difference(tree_of(whole), tree_of(merged)), "");
  }
}

TEST_F(Night, TheEnvironmentSaysWhichShard) {
  ::setenv("CI_NODE_INDEX", "2", 1);
  ::setenv("CI_NODE_TOTAL", "4", 1);
  const Ran ran = contort_program(fuzz(folder_ / "corpus", 16, {"--json"}));
  ::unsetenv("CI_NODE_INDEX");
  ::unsetenv("CI_NODE_TOTAL");
  EXPECT_NE(ran.out.find("\"shard\": 1"), std::string::npos) << ran.out << ran.err;
}

// Counts of two generators are not to be added up, nor a run begun by the one to be ended by the other.
TEST_F(Night, WithAnotherLibraryItIsAnotherRun) {
  const std::string corpus = folder_ / "corpus", elsewhere = folder_ / "elsewhere";
  const auto records = [&] { return tree_of(corpus + "/runs").size(); };
  contort_program(fuzz(corpus, 8));
  std::filesystem::copy(library_, elsewhere, std::filesystem::copy_options::recursive);
  library_ = elsewhere;
  contort_program(fuzz(corpus, 8));
  EXPECT_EQ(records(), 1U) << "where it lies does not matter";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(library_))
    if (entry.is_regular_file()) spill(entry.path(), slurp(entry.path()) + "\n");
  spill(corpus + "/runs/seed_4_deadbeef.state", "{}");
  const Ran other = contort_program(fuzz(corpus, 8, {"--resume"}));
  EXPECT_EQ(records(), 3U) << "two records and the state";
  EXPECT_NE(other.err.find("seed_4_deadbeef was stopped"), std::string::npos) << other.err;
}

TEST_F(Night, TellsBazelThatItKnowsOfShards) {
  const std::string touched = folder_ / "touched";
  ::setenv("TEST_SHARD_STATUS_FILE", touched.c_str(), 1);
  contort_program(fuzz(folder_ / "corpus", 1));
  ::unsetenv("TEST_SHARD_STATUS_FILE");
  EXPECT_TRUE(std::filesystem::exists(touched));
}

TEST_F(Night, BadOptionsAreOneLineAndExitCode2) {
  const std::string profile = folder_ / "odd.json";
  spill(profile, R"({"format": "contort.profile/1", "name": "odd", "actions": ["fly"]})");
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--shard", "2/2"}, {"--shard", "x"}, {"--profile", "weekly"}, {"--profile", profile}}) {
    const Ran ran = contort_program(fuzz(folder_ / "corpus", 8, more));
    EXPECT_EQ(ran.code, 2) << more[1];
    EXPECT_EQ(lines_of(ran.err).size(), 1U) << ran.err;
  }
  EXPECT_EQ(contort_program({"merge", folder_ / "nowhere", "-o", folder_ / "out"}).code, 2);
}

TEST_F(Night, WritesWhatCiReadsOfItsCorpus) {
  const std::string corpus = folder_ / "corpus", junit = folder_ / "j.xml", sarif = folder_ / "s.sarif",
                    markdown = folder_ / "m.md";
  const Ran ran =
      contort_program(fuzz(corpus, 4, {"--junit", junit, "--sarif", sarif, "--markdown", markdown, "--github"}));
  ASSERT_EQ(ran.code, 1) << ran.err;
  std::ptrdiff_t annotations = 0;
  for (const std::string& line : lines_of(ran.out)) annotations += line.starts_with("::error file=");
  EXPECT_GT(annotations, 0) << ran.out;
  EXPECT_TRUE(last_line(ran.out).starts_with("RESULT ")) << ran.out;
  const Ran again = contort_program({"report", corpus, "--library", library_, "--junit", junit + "2", "--sarif",
                                     sarif + "2", "--markdown", markdown + "2"});
  ASSERT_EQ(again.code, 0) << again.err;
  for (const std::string& path : {junit, sarif, markdown}) {
    EXPECT_FALSE(slurp(path).empty());
    EXPECT_EQ(slurp(path), slurp(path + "2"));
  }
}

TEST_F(Night, AcknowledgedFailuresDoNotFailABuildAndNewOnesDo) {
  const std::string corpus = folder_ / "corpus";
  ASSERT_EQ(contort_program(fuzz(corpus, 24)).code, 1);
  EXPECT_EQ(contort_program(fuzz(folder_ / "other", 24, {"--baseline", corpus})).code, 0);
  std::vector<std::string> ack = {"corpus", "ack", corpus};
  for (const auto& entry : std::filesystem::directory_iterator(corpus + "/buckets"))
    ack.push_back(entry.path().filename().string().substr(entry.path().filename().string().rfind('-') + 1));
  for (const char* more : {"--owner", "ana", "--ticket", "T-1"}) ack.push_back(more);
  const Ran acknowledged = contort_program(ack);
  ASSERT_EQ(acknowledged.code, 0) << acknowledged.err;
  EXPECT_EQ(contort_program(fuzz(corpus, 24)).code, 0);
}

}  // namespace
}  // namespace contort
