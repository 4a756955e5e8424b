// A shard gets its share of a run from the command line, or from the variables of schedulers.
#include "fuzz/shard.h"

#include <gtest/gtest.h>

#include <map>

#include "fuzz/islands.h"

namespace contort {
namespace {

Result<std::optional<Shard>> said_by(const std::map<std::string, std::string>& variables) {
  return shard_of_environment([&](const char* name) -> const char* {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

TEST(Shards, AreWrittenAsKOfN) {
  EXPECT_EQ(*parse_shard("3/16"), (Shard{3, 16}));
  EXPECT_EQ(*parse_shard("0/1"), (Shard{0, 1}));
  for (const char* text : {"", "3", "3/", "/3", "a/b", "1/2/3", "1.5/2", " 1/2", "+1/2"})
    EXPECT_EQ(parse_shard(text).issue().code, "shard.syntax") << text;
  for (const char* text : {"2/2", "-1/2", "0/0", "0/65"})
    EXPECT_EQ(parse_shard(text).issue().code, "shard.range") << text;
}

TEST(Shards, EveryIslandIsOfExactlyOne) {
  for (int count = 1; count <= kIslands; ++count)
    for (int island = 0; island < kIslands; ++island) {
      int owners = 0;
      for (int index = 0; index < count; ++index) owners += is_of({index, count}, island);
      ASSERT_EQ(owners, 1) << island << " of " << count;
    }
}

TEST(Shards, EachSchedulerIsUnderstood) {
  EXPECT_EQ(*said_by({}), std::nullopt);
  EXPECT_EQ(*said_by({{"GTEST_SHARD_INDEX", "2"}, {"GTEST_TOTAL_SHARDS", "5"}}), (Shard{2, 5}));
  EXPECT_EQ(*said_by({{"TEST_SHARD_INDEX", "2"}, {"TEST_TOTAL_SHARDS", "5"}}), (Shard{2, 5}));
  EXPECT_EQ(*said_by({{"SLURM_ARRAY_TASK_ID", "12"}, {"SLURM_ARRAY_TASK_MIN", "10"}, {"SLURM_ARRAY_TASK_COUNT", "4"}}),
            (Shard{2, 4}));
  EXPECT_EQ(*said_by({{"SLURM_ARRAY_TASK_ID", "4"},
                      {"SLURM_ARRAY_TASK_MIN", "0"},
                      {"SLURM_ARRAY_TASK_STEP", "2"},
                      {"SLURM_ARRAY_TASK_COUNT", "4"}}),
            (Shard{2, 4}));  // --array=0-6:2
  EXPECT_EQ(*said_by({{"JOB_COMPLETION_INDEX", "0"}, {"CONTORT_SHARDS", "8"}}), (Shard{0, 8}));
  EXPECT_EQ(*said_by({{"CI_NODE_INDEX", "1"}, {"CI_NODE_TOTAL", "4"}}), (Shard{0, 4}));
}

TEST(Shards, HalfOfWhatASchedulerSaysIsRefused) {
  EXPECT_EQ(said_by({{"JOB_COMPLETION_INDEX", "0"}}).issue().code, "shard.environment");
  EXPECT_EQ(said_by({{"SLURM_ARRAY_TASK_ID", "3"}, {"SLURM_ARRAY_TASK_COUNT", "4"}}).issue().code, "shard.environment");
  EXPECT_EQ(said_by({{"GTEST_SHARD_INDEX", "x"}, {"GTEST_TOTAL_SHARDS", "5"}}).issue().code, "shard.environment");
  EXPECT_EQ(said_by({{"CI_NODE_INDEX", "5"}, {"CI_NODE_TOTAL", "4"}}).issue().code, "shard.range");
  EXPECT_EQ(said_by({{"SLURM_ARRAY_TASK_ID", "14"}, {"SLURM_ARRAY_TASK_MIN", "10"}, {"SLURM_ARRAY_TASK_COUNT", "4"}})
                .issue()
                .code,
            "shard.range");  // an array with gaps
  EXPECT_EQ(said_by({{"SLURM_ARRAY_TASK_ID", "3"},
                     {"SLURM_ARRAY_TASK_MIN", "0"},
                     {"SLURM_ARRAY_TASK_STEP", "2"},
                     {"SLURM_ARRAY_TASK_COUNT", "4"}})
                .issue()
                .code,
            "shard.range");
}

}  // namespace
}  // namespace contort
