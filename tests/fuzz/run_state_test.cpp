// The state that a run keeps between rounds lies in the corpus, and so may be a stranger's.
#include "fuzz/run_state.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/checks/family_text.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

class KeptState : public testing::Test {
 protected:
  KeptState() : corpus_(create(folder_)) {
    state_.plan = "plan";
    state_.record.name = "seed_1_0123abcd";
  }
  Result<std::optional<RunState>> kept() {
    EXPECT_TRUE(keep_state(corpus_, state_));
    return load_state(corpus_, state_.record, state_.plan);
  }
  // Expects a refusal at this place, with a message that names the remedy.
  void expect_refused(const std::string& code, const std::string& pointer) {
    const auto read = kept();
    ASSERT_FALSE(read);
    EXPECT_EQ(read.issue().code, code);
    EXPECT_EQ(read.issue().pointer, pointer);
    EXPECT_NE(read.issue().text.find(state_path(corpus_, state_.record)), std::string::npos) << read.issue().text;
  }
  void expect_changed_is_refused(const std::string& before, const std::string& after, const std::string& code,
                                 const std::string& pointer) {
    const std::string path = state_path(corpus_, state_.record);
    std::string text = slurp(path);
    ASSERT_NE(text.find(before), std::string::npos) << text;
    spill(path, text.replace(text.find(before), before.size(), after));
    const auto read = load_state(corpus_, state_.record, state_.plan);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.issue().code, code);
    EXPECT_EQ(read.issue().pointer, pointer) << to_line(read.issue());
    EXPECT_NE(read.issue().text.find("remove the file to begin the run anew"), std::string::npos);
  }
  TempFolder folder_;
  Corpus corpus_;
  RunState state_;
};

TEST_F(KeptState, NamesOfBucketsAreNamesOfFolders) {
  state_.new_buckets = {"joint_range-0123456789ab"};
  ASSERT_TRUE(kept());
  state_.new_buckets = {"../../elsewhere"};
  expect_refused("state.bad_text", "/new_buckets/0");
  state_.new_buckets = {}, state_.known_buckets = {"joint_range-0123456789ab", "/etc"};
  expect_refused("state.bad_text", "/known_buckets/1");
}

TEST_F(KeptState, LeadsAreThoseOfTheCorpusThatIsOpen) {
  state_.unconfirmed = {"another/spelling/of/the/corpus/leads/seed_1/0123456789ab-0000000000000001.json"};
  const auto read = kept();
  ASSERT_TRUE(read && *read);
  EXPECT_EQ((*read)->unconfirmed,
            std::vector<std::string>{corpus_.folder() + "/leads/seed_1/0123456789ab-0000000000000001.json"});
  state_.unconfirmed = {"leads/seed_1/.."};
  expect_refused("file.bad_name", "/unconfirmed/0");
}

// Leads that wait are looked for in the corpus.
TEST_F(KeptState, ATaskNamesNoFile) {
  SettleTask task;
  task.lineage = {1}, task.family = family("pop|human|x");
  state_.wanted = {task};
  ASSERT_TRUE(kept());
  expect_changed_is_refused(R"({"family":)", R"({"lead": "../../plain.json", "family":)", "state.unknown_field",
                            "/wanted/0/lead");
}

TEST_F(KeptState, OfAnOlderVersionIsRefused) {
  ASSERT_TRUE(kept());
  expect_changed_is_refused("contort.state/5", "contort.state/4", "state.wrong_format", "/format");
}

TEST_F(KeptState, ItIsOfItsOwnRun) {
  ASSERT_TRUE(keep_state(corpus_, state_));
  RunRecord other = state_.record;
  other.name = "seed_2_0123abcd";
  fs::rename(state_path(corpus_, state_.record), state_path(corpus_, other));
  const auto read = load_state(corpus_, other, state_.plan);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.issue().code, "state.other_run");
}

TEST_F(KeptState, ALinkIsNeitherReadNorWrittenThrough) {
  ASSERT_TRUE(keep_state(corpus_, state_));
  const std::string path = state_path(corpus_, state_.record), theirs = folder_ / "theirs.state";
  fs::rename(path, theirs);
  const std::string bytes = slurp(theirs);
  fs::create_symlink(theirs, path);
  const auto read = load_state(corpus_, state_.record, state_.plan);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.issue().code, "file.outside");
  fs::create_symlink(theirs, corpus_.folder() + "/runs/" + state_.record.name + ".lock");
  EXPECT_FALSE(RunLock::take(corpus_, state_.record));
  state_.next = 7;
  ASSERT_TRUE(keep_state(corpus_, state_));
  EXPECT_EQ(slurp(theirs), bytes);
}

}  // namespace

}  // namespace contort
