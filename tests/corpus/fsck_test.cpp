// Damage to the files of a corpus: each kind is reported and repaired, and nothing is lost.
#include "corpus/fsck.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "corpus/bucket_files.h"
#include "corpus/leads.h"
#include "corpus/runs.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

std::vector<CorpusFault> checked(const Corpus& corpus, bool repair = false) {
  const Result<std::vector<CorpusFault>> faults = check_files(corpus, repair);
  EXPECT_TRUE(faults) << to_line(faults.issue());
  return faults ? *faults : std::vector<CorpusFault>{};
}

class Fsck : public testing::Test {
 protected:
  Fsck() : corpus_(create(folder_)) {
    EXPECT_TRUE(corpus_.add(found(160, 40, 1)));
    bucket_ = only_bucket(corpus_);
  }
  std::string in_bucket(const std::string& name) const { return corpus_.folder_of(bucket_) + "/" + name; }

  // The one fault is there, is mended, and is gone then.
  void expect_mended(const std::string& code, const std::string& path) {
    const Tree before = tree_of(corpus_.folder());
    const std::vector<CorpusFault> faults = checked(corpus_);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults.front().code, code);
    EXPECT_NE(faults.front().path.find(path), std::string::npos) << faults.front().path;
    EXPECT_EQ(faults.front().mended, "");
    EXPECT_EQ(first_difference(before, tree_of(corpus_.folder())), "") << "looking changed something";
    const std::vector<CorpusFault> mended = checked(corpus_, true);
    ASSERT_EQ(mended.size(), 1U);
    EXPECT_NE(mended.front().mended, "");
    EXPECT_TRUE(checked(corpus_).empty());
  }
  bool is_aside(const std::string& path) const { return fs::exists(corpus_.folder() + "/invalid/" + path); }

  TempFolder folder_;
  Corpus corpus_;
  Bucket bucket_;
};

TEST_F(Fsck, ACorpusThatWasOnlyWrittenByUsHasNoFaults) {
  ASSERT_TRUE(corpus_.add(found(155, 30, 2)));
  ASSERT_TRUE(keep_lead(corpus_, {"seed_1", made_up(170, 30, 1), {}}));
  EXPECT_TRUE(checked(corpus_).empty());
  const Tree before = tree_of(corpus_.folder());
  EXPECT_TRUE(checked(corpus_, true).empty());
  EXPECT_EQ(first_difference(before, tree_of(corpus_.folder())), "");
}

TEST_F(Fsck, ATemporaryFileOfADeadProcessGoes) {
  spill(in_bucket("bucket.json.999999999.part"), "{");  // a process number that no system uses
  expect_mended("temporary", "999999999.part");
  EXPECT_FALSE(fs::exists(in_bucket("bucket.json.999999999.part")));
}

TEST_F(Fsck, ATemporaryFileOfALivingProcessStays) {
  spill(in_bucket("bucket.json." + std::to_string(::getpid()) + ".part"), "{");
  EXPECT_TRUE(checked(corpus_, true).empty());
}

TEST_F(Fsck, AMissingMinimalCaseIsReplacedByOneThatIsThere) {
  fs::remove(in_bucket(bucket_.min));
  expect_mended("missing_case", bucket_.min);
  const Bucket now = only_bucket(corpus_);
  EXPECT_EQ(stored(corpus_, now, now.min).spec, stored(corpus_, now, now.worst).spec);
}

TEST_F(Fsck, AMissingCaseIsReplacedByOneOfTheSameSpecUnderTheSameName) {
  Found same = found(165, 40, 2);
  same.minimal.expect.subject = same.original.expect.subject = "arm_right/elbow max";
  same.original = same.minimal;
  ASSERT_TRUE(corpus_.add(same));
  const Bucket bucket = bucket_of(same.minimal);
  const std::string worst = corpus_.folder_of(bucket) + "/" + case_file_name("worst", same.minimal.spec);
  fs::remove(worst);
  expect_mended("missing_case", fs::path(worst).filename().string());
  EXPECT_EQ(slurp(worst), print_case(same.minimal));
}

TEST_F(Fsck, AMissingOriginalIsForgotten) {
  fs::remove(in_bucket(bucket_.orig));
  expect_mended("missing_case", bucket_.orig);
  EXPECT_EQ(only_bucket(corpus_).orig, "");
}

TEST_F(Fsck, ACaseThatSomebodyEditedGetsTheNameOfItsContent) {
  Case edited = stored(corpus_, bucket_, bucket_.min);
  edited.spec = bent_elbow(158, 33);
  spill(in_bucket(bucket_.min), print_case(edited));
  expect_mended("wrong_name", bucket_.min);
  const Bucket now = only_bucket(corpus_);
  EXPECT_EQ(stored(corpus_, now, now.min), edited);
  EXPECT_EQ(now.min, case_file_name("min", edited.spec));
  EXPECT_FALSE(fs::exists(in_bucket(bucket_.min)));
}

TEST_F(Fsck, ACaseOfAnotherFamilyIsPutAside) {
  Case stranger = stored(corpus_, bucket_, bucket_.orig);
  stranger.expect.subject = "arm_right/elbow max";
  spill(in_bucket(bucket_.orig), print_case(stranger));
  expect_mended("wrong_name", bucket_.orig);
  EXPECT_TRUE(is_aside("buckets/" + folder_name(bucket_) + "/" + bucket_.orig));
}

TEST_F(Fsck, ACaseThatCannotBeReadIsPutAside) {
  spill(in_bucket(bucket_.worst), "{\"format\": ");
  expect_mended("unreadable", bucket_.worst);
  EXPECT_TRUE(is_aside("buckets/" + folder_name(bucket_) + "/" + bucket_.worst));
  EXPECT_NE(only_bucket(corpus_).worst, "");
}

TEST_F(Fsck, ABucketInAWrongFolderMovesToItsOwn) {
  fs::rename(corpus_.folder_of(bucket_), corpus_.folder() + "/buckets/joint_range-ffffffffffff");
  expect_mended("wrong_folder", "joint_range-ffffffffffff");
  EXPECT_EQ(only_bucket(corpus_), bucket_);
  EXPECT_TRUE(fs::exists(in_bucket(bucket_.min)));
}

TEST_F(Fsck, ACopyOfABucketIsPutAside) {
  fs::copy(corpus_.folder_of(bucket_), corpus_.folder() + "/buckets/copy");
  expect_mended("wrong_folder", "copy");
  EXPECT_TRUE(is_aside("buckets/copy/bucket.json"));
  EXPECT_EQ(only_bucket(corpus_), bucket_);
}

TEST_F(Fsck, UnknownFilesArePutAside) {
  spill(in_bucket("notes.txt"), "look at this");
  expect_mended("unknown_file", "notes.txt");
  EXPECT_EQ(slurp(corpus_.folder() + "/invalid/buckets/" + folder_name(bucket_) + "/notes.txt"), "look at this");
  spill(corpus_.folder() + "/buckets/stray.json", "{}");
  expect_mended("unknown_file", "stray.json");
  spill(corpus_.folder() + "/runs/notes.txt", "x");
  expect_mended("unknown_file", "runs/notes.txt");
}

TEST_F(Fsck, AsideNothingIsOverwritten) {
  for (const char* text : {"one", "two", "three"}) {
    spill(in_bucket("notes.txt"), text);
    checked(corpus_, true);
  }
  const std::string aside = corpus_.folder() + "/invalid/buckets/" + folder_name(bucket_) + "/notes.txt";
  EXPECT_EQ(slurp(aside) + slurp(aside + ".2") + slurp(aside + ".3"), "onetwothree");
}

TEST_F(Fsck, ABucketFileThatCannotBeReadIsMadeAnewFromTheCases) {
  for (const std::string bad : {"{", "", "{\"format\": \"contort.bucket/9\"}"}) {
    spill(in_bucket("bucket.json"), bad);
    expect_mended("unreadable", "bucket.json");
    Bucket made = bucket_;
    made.runs.clear();  // only the file has the names of the runs
    EXPECT_EQ(only_bucket(corpus_), made);
  }
  EXPECT_TRUE(is_aside("buckets/" + folder_name(bucket_) + "/bucket.json"));
}

TEST_F(Fsck, ABucketWithoutAnyCaseIsPutAsideWhole) {
  for (const std::string& file : files_of(bucket_)) fs::remove(in_bucket(file));
  const std::vector<CorpusFault> mended = checked(corpus_, true);
  EXPECT_GT(mended.size(), 1U);
  EXPECT_TRUE(is_aside("buckets/" + folder_name(bucket_) + "/bucket.json"));
  EXPECT_TRUE(checked(corpus_).empty());
}

// Its counts may mean something else; reports and merges cannot take it.
TEST_F(Fsck, ARecordOfAnotherFormatIsPutAside) {
  spill(corpus_.folder() + "/runs/seed_1_0123abcd.json", R"({"format":"contort.run/3","name":"seed_1_0123abcd"})");
  std::vector<Issue> damaged;
  EXPECT_TRUE(runs_of(corpus_, damaged).empty());
  ASSERT_EQ(damaged.size(), 1U);
  EXPECT_NE(damaged[0].text.find("fsck --repair"), std::string::npos) << damaged[0].text;
  expect_mended("unreadable", "runs/seed_1_0123abcd.json");
  EXPECT_TRUE(is_aside("runs/seed_1_0123abcd.json"));
}

TEST_F(Fsck, LeadsAndRunsThatCannotBeReadArePutAside) {
  spill(corpus_.folder() + "/runs/seed_1.json", "{");
  expect_mended("unreadable", "runs/seed_1.json");
  fs::create_directories(corpus_.folder() + "/leads/seed_1");
  spill(corpus_.folder() + "/leads/seed_1/x.json", "{}");
  expect_mended("unreadable", "leads/seed_1/x.json");
  EXPECT_TRUE(is_aside("leads/seed_1/x.json"));
}

// Bytes that are only in a case file must be somewhere afterwards.
bool is_kept(const Tree& tree, const std::string& bytes) {
  return std::ranges::any_of(tree, [&](const auto& file) { return file.second == bytes; });
}

RC_GTEST_PROP(FsckRepair, AnyDamageIsMendedAtOnceAndNoCaseIsLost, ()) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  for (const int elbow : {160, 170}) RC_ASSERT(bool(corpus.add(found(elbow, 40, elbow))));
  Found other = found(165, 40, 3);
  other.minimal.expect.subject = other.original.expect.subject = "arm_right/elbow max";
  RC_ASSERT(bool(corpus.add(other)));
  const Tree whole = tree_of(corpus.folder());
  const int blows = *rc::gen::inRange(1, 5);
  for (int i = 0; i < blows; ++i) {
    const Tree now = tree_of(corpus.folder());
    if (now.empty()) break;
    const auto hit = std::next(now.begin(), *rc::gen::inRange(0, static_cast<int>(now.size())));
    const std::string path = corpus.folder() + "/" + hit->first;
    switch (*rc::gen::inRange(0, 4)) {
      case 0: fs::remove(path); break;
      case 1: spill(path, hit->second.substr(0, hit->second.size() / 2)); break;
      case 2: fs::rename(path, path + ".old"); break;
      default: spill(path + ".json", hit->second);
    }
  }
  const Tree damaged = tree_of(corpus.folder());
  const Result<std::vector<CorpusFault>> mended = check_files(corpus, true);
  RC_ASSERT(bool(mended));
  const Result<std::vector<CorpusFault>> left = check_files(corpus, false);
  RC_ASSERT(bool(left));
  for (const CorpusFault& fault : *left) RC_FAIL(fault.path + " " + fault.code + " " + fault.text);
  std::vector<Issue> unreadable;
  corpus.buckets(unreadable);
  RC_ASSERT(unreadable.empty());
  const Tree after = tree_of(corpus.folder());
  for (const auto& [path, bytes] : damaged)
    if (parse_case(bytes) && !is_kept(after, bytes)) RC_FAIL(path + " is lost");
}

}  // namespace

}  // namespace contort
