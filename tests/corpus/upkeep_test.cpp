// Operations on whole corpora, and corpora that several processes or no process may write.
#include "corpus/upkeep.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "corpus/bucket_files.h"
#include "corpus/fsck.h"
#include "corpus/lifecycle.h"
#include "corpus/lock.h"
#include "model/core/files.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

Changes done(const Result<Changes>& changes) {
  EXPECT_TRUE(changes) << to_line(changes.issue());
  return changes ? *changes : Changes{};
}

class Upkeep : public testing::Test {
 protected:
  Upkeep() : corpus_(create(folder_)) {
    EXPECT_TRUE(corpus_.add(found(160, 40, 1)));
    bucket_ = only_bucket(corpus_);
  }
  void write(const Bucket& bucket) { EXPECT_TRUE(write_bucket(corpus_.folder_of(bucket_), bucket)); }
  void expect_nothing_to_do(Result<Changes> (*upkeep)(const Corpus&)) {
    const Tree before = tree_of(corpus_.folder());
    EXPECT_TRUE(done(upkeep(corpus_)).empty());
    EXPECT_EQ(first_difference(before, tree_of(corpus_.folder())), "");
  }
  // Returns the bucket as if other rules had named it.
  Bucket named_otherwise(const std::string& features) {
    Bucket old = bucket_;
    old.features = features;
    old.id = bucket_id(old.family, features);
    fs::rename(corpus_.folder_of(bucket_), corpus_.folder_of(old));
    EXPECT_TRUE(write_bucket(corpus_.folder_of(old), old));
    return old;
  }
  TempFolder folder_;
  Corpus corpus_;
  Bucket bucket_;
};

TEST_F(Upkeep, NothingIsToDoInAFreshCorpus) {
  for (const auto upkeep : {rekey, prune, migrate}) expect_nothing_to_do(upkeep);
}

TEST_F(Upkeep, RekeyNamesABucketByTodaysRulesAndKeepsItsState) {
  Bucket old = named_otherwise("made by other rules");
  old.state = BucketState::open, old.owner = "ana", old.ticket = "12", old.changes = 1;
  ASSERT_TRUE(write_bucket(corpus_.folder_of(old), old));
  EXPECT_EQ(done(rekey(corpus_)).size(), 1U);
  Bucket expected = bucket_;
  expected.state = BucketState::open, expected.owner = "ana", expected.ticket = "12", expected.changes = 1;
  EXPECT_EQ(only_bucket(corpus_), expected);
  EXPECT_FALSE(fs::exists(corpus_.folder_of(old)));
  expect_nothing_to_do(rekey);
}

// A file of the first version has no version of the rules.
TEST_F(Upkeep, BucketsOfOtherRulesAreCountedUntilTheyAreRekeyed) {
  EXPECT_EQ(named_by_other_rules(corpus_), 0);
  Bucket old = named_otherwise("made by other rules");
  old.signature = 1;
  ASSERT_TRUE(write_bucket(corpus_.folder_of(old), old));
  EXPECT_EQ(read_file(corpus_.folder_of(old) + "/bucket.json").value().find("signature"), std::string::npos);
  EXPECT_EQ(named_by_other_rules(corpus_), 1);
  done(rekey(corpus_));
  EXPECT_EQ(named_by_other_rules(corpus_), 0);
  EXPECT_EQ(only_bucket(corpus_), bucket_);
}

TEST_F(Upkeep, RekeyMergesBucketsThatAreOneNow) {
  Bucket old = named_otherwise("made by other rules");
  old.state = BucketState::open, old.owner = "ana", old.ticket = "12", old.changes = 1;
  ASSERT_TRUE(write_bucket(corpus_.folder_of(old), old));
  const Found better = found(155, 30, 2);
  ASSERT_TRUE(corpus_.add(better));
  done(rekey(corpus_));
  const Bucket now = only_bucket(corpus_);
  EXPECT_EQ(now.state, BucketState::open);
  EXPECT_EQ(now.runs, (std::vector<std::string>{"seed_1", "seed_2"}));
  EXPECT_EQ(stored(corpus_, now, now.min), better.minimal);
  EXPECT_EQ(stored(corpus_, now, now.worst), found(160, 40, 1).original) << "the deeper one was in the old bucket";
  EXPECT_TRUE(done(rekey(corpus_)).empty());
}

TEST_F(Upkeep, PruneDropsTheOriginalOfWhatIsFixedAndNothingElse) {
  bucket_.state = BucketState::fixed;
  write(bucket_);
  Tree expected = tree_of(corpus_.folder());
  expected.erase("buckets/" + folder_name(bucket_) + "/" + bucket_.orig);
  EXPECT_EQ(done(prune(corpus_)).size(), 1U);
  Tree now = tree_of(corpus_.folder());
  EXPECT_EQ(only_bucket(corpus_).orig, "");
  for (Tree* tree : {&expected, &now}) tree->erase("buckets/" + folder_name(bucket_) + "/bucket.json");
  EXPECT_EQ(first_difference(expected, now), "");
  expect_nothing_to_do(prune);
}

TEST_F(Upkeep, APrunedBucketKeepsItsMinimalCaseAgainstADearerOne) {
  bucket_.state = BucketState::fixed;
  write(bucket_);
  done(prune(corpus_));
  ASSERT_TRUE(corpus_.add(found(161, 45, 2)));
  EXPECT_EQ(only_bucket(corpus_).min, bucket_.min);
  ASSERT_TRUE(corpus_.add(found(155, 30, 3)));
  EXPECT_EQ(stored(corpus_, only_bucket(corpus_), only_bucket(corpus_).min), found(155, 30, 3).minimal);
}

TEST_F(Upkeep, MigrateWritesEveryFileAsThisVersionDoes) {
  const Tree expected = tree_of(corpus_.folder());
  for (const auto& [path, bytes] : expected)
    if (path.ends_with(".json")) spill(corpus_.folder() + "/" + path, bytes + "\n\n");
  EXPECT_EQ(done(migrate(corpus_)).size(), 4U);
  EXPECT_EQ(first_difference(expected, tree_of(corpus_.folder())), "");
}

TEST_F(Upkeep, ADamagedBucketStopsItBeforeAnythingChanges) {
  named_otherwise("made by other rules");
  fs::create_directories(corpus_.folder() + "/buckets/pop-0123456789ab");
  spill(corpus_.folder() + "/buckets/pop-0123456789ab/bucket.json", "{");
  const Tree before = tree_of(corpus_.folder());
  for (const auto upkeep : {rekey, prune, migrate}) {
    const Result<Changes> refused = upkeep(corpus_);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.issue().code, "json.syntax");
    EXPECT_EQ(first_difference(before, tree_of(corpus_.folder())), "");
  }
}

TEST_F(Upkeep, BeingFoundAgainIsARegressionOfWhatWasFixed) {
  bucket_.state = BucketState::fixed;
  write(bucket_);
  ASSERT_TRUE(corpus_.add(found(160, 40, 1)));
  EXPECT_EQ(only_bucket(corpus_).state, BucketState::regressed);
  const Tree before = tree_of(corpus_.folder());
  ASSERT_TRUE(corpus_.add(found(160, 40, 1)));
  EXPECT_EQ(first_difference(before, tree_of(corpus_.folder())), "");
}

// ---- one corpus from several

// A copy of a corpus with one bucket, as another machine may have it: with its own cases and changes.
Corpus draw_copy(const TempFolder& folder) {
  const Corpus corpus = create(folder);
  const int count = *rc::gen::inRange(1, 3);
  for (int i = 0; i < count; ++i)
    RC_ASSERT(bool(corpus.add(found(151 + *rc::gen::inRange(0, 3), 30, *rc::gen::inRange(0, 3)))));
  Bucket bucket = only_bucket(corpus);
  const int steps = *rc::gen::inRange(0, 4);
  for (int i = 0; i < steps; ++i)
    bucket = next_state(bucket,
                        {*rc::gen::element(Shown::fails, Shown::gone), *rc::gen::element<std::string>("a", "b")}, "");
  if (const auto known = acknowledge(bucket, "ana", "12"); known && *rc::gen::inRange(0, 3) == 0) bucket = *known;
  RC_ASSERT(bool(write_bucket(corpus.folder_of(bucket), bucket)));
  if (*rc::gen::inRange(0, 2) == 0) RC_ASSERT(bool(prune(corpus)));
  return corpus;
}

Tree merged(const std::vector<const Corpus*>& sources) {
  const TempFolder folder;
  const Corpus into = create(folder);
  for (const Corpus* source : sources) RC_ASSERT(bool(into.take(*source, only_bucket(*source))));
  return tree_of(into.folder());
}

RC_GTEST_PROP(CorpusTake, AnyOrderAndAnyRepetitionLeaveTheSameBytes, ()) {
  const TempFolder folders[3];
  const Corpus a = draw_copy(folders[0]), b = draw_copy(folders[1]), c = draw_copy(folders[2]);
  const std::string difference = first_difference(merged({&a, &b, &c}), merged({&c, &a, &a, &b, &c}));
  if (!difference.empty()) RC_FAIL(difference);
}

TEST_F(Upkeep, ABucketThatIsTakenBringsItsStateAndDoesNotRegressByThat) {
  bucket_.state = BucketState::fixed, bucket_.changes = 2;
  write(bucket_);
  done(prune(corpus_));
  const TempFolder other;
  const Corpus into = create(other);
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(into.take(corpus_, only_bucket(corpus_)));
  EXPECT_EQ(first_difference(tree_of(corpus_.folder()), tree_of(into.folder())), "");
}

// ---- several writers

// Runs it in a child process, and returns its result.
template <class Work>
pid_t in_child(const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work() ? 0 : 1);
  return child;
}
bool succeeded(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(CorpusWriters, ProcessesThatAddToOneBucketLeaveTheSameAsOneAfterTheOther) {
  constexpr int kWriters = 4, kEach = 10;
  const auto add_share = [](const Corpus& corpus, int writer) {
    for (int i = 0; i < kEach; ++i)
      if (!corpus.add(found(155 + (writer * 7 + i * 3) % 20, 30 + i, writer))) return false;
    return true;
  };
  const TempFolder folder, other;
  const Corpus together = create(folder), in_turn = create(other);
  std::vector<pid_t> children;
  for (int w = 0; w < kWriters; ++w) children.push_back(in_child([&] { return add_share(together, w); }));
  for (const pid_t child : children) EXPECT_TRUE(succeeded(child));
  for (int w = 0; w < kWriters; ++w) EXPECT_TRUE(add_share(in_turn, w));
  EXPECT_EQ(first_difference(tree_of(together.folder()), tree_of(in_turn.folder())), "");
}

TEST(CorpusWriters, ALockGoesWithTheProcessThatHeldIt) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  EXPECT_TRUE(succeeded(in_child([&] {
    const Result<CorpusLock> lock = CorpusLock::take(corpus.folder());
    ::_exit(lock ? 0 : 1);  // as if the process was killed
    return true;
  })));
  EXPECT_TRUE(CorpusLock::take(corpus.folder()));
}

template <class T>
Issue why(const Result<T>& result) {
  return result ? Issue{"done", "", "nothing stopped it"} : result.issue();
}

// Root may write everywhere, so the test runs as the user nobody for a while.
class AsNobody {
 public:
  AsNobody() : was_(::geteuid()) {
    if (was_ == 0 && ::seteuid(65534) != 0) ADD_FAILURE() << "cannot become nobody";
  }
  ~AsNobody() { EXPECT_EQ(::seteuid(was_), 0); }

 private:
  uid_t was_;
};

TEST_F(Upkeep, AReadOnlyCorpusIsAnErrorThatKeepsWhatWasThere) {
  ::chmod(folder_.path().c_str(), 0755);
  for (const auto& entry : fs::recursive_directory_iterator(corpus_.folder()))
    fs::permissions(entry.path(), entry.is_directory() ? fs::perms(0555) : fs::perms(0444));
  fs::permissions(corpus_.folder(), fs::perms(0555));
  const Tree before = tree_of(corpus_.folder());
  const auto acknowledged = [](const Bucket& b) { return acknowledge(b, "ana", "12"); };
  std::vector<Issue> issues;
  {
    const AsNobody nobody;
    issues = {why(corpus_.add(found(155, 30, 2))),
              why(corpus_.change(bucket_, acknowledged)),
              why(check_files(corpus_, true)),
              why(rekey(corpus_)),
              why(prune(corpus_)),
              why(Corpus::create(corpus_.folder()))};
    EXPECT_TRUE(check_files(corpus_, false)) << "reading needs no rights to write";
  }
  for (const Issue& issue : issues) EXPECT_EQ(issue.code, "file.unwritable") << issue.text;
  EXPECT_EQ(first_difference(before, tree_of(corpus_.folder())), "");
  for (const auto& entry : fs::recursive_directory_iterator(corpus_.folder()))
    if (entry.is_directory()) fs::permissions(entry.path(), fs::perms(0755));
  fs::permissions(corpus_.folder(), fs::perms(0755));
}

// A file system of 64 KiB.
class TinyDisk {
 public:
  explicit TinyDisk(std::string path) : path_(std::move(path)) {
    fs::create_directories(path_);
    mounted_ = ::mount("tmpfs", path_.c_str(), "tmpfs", 0, "size=65536") == 0;
  }
  ~TinyDisk() {
    if (mounted_) ::umount(path_.c_str());
  }
  bool is_there() const { return mounted_; }

 private:
  std::string path_;
  bool mounted_ = false;
};

TEST(CorpusWriters, AFullDiskIsAnErrorThatKeepsWhatWasThere) {
  const TempFolder folder;
  const TinyDisk disk(folder / "disk");
  if (!disk.is_there()) GTEST_SKIP() << "only root may mount";
  const Result<Corpus> corpus = Corpus::create(folder / "disk/corpus");
  ASSERT_TRUE(corpus) << to_line(corpus.issue());
  Issue full;
  for (int i = 0; i < 100 && full.code.empty(); ++i) {
    Found f = found(155, 40, i);
    f.minimal.expect.subject = f.original.expect.subject = "arm_left/finger_" + std::to_string(i);
    if (const auto added = corpus->add(f); !added) full = added.issue();
  }
  EXPECT_EQ(full.code, "file.unwritable");
  EXPECT_NE(full.text.find("No space left"), std::string::npos) << full.text;
  std::vector<Issue> damaged;
  const std::vector<Bucket> buckets = corpus->buckets(damaged);
  EXPECT_GE(buckets.size(), 3U);
  for (const Bucket& bucket : buckets)
    for (const std::string& file : files_of(bucket)) stored(*corpus, bucket, file);
  EXPECT_LE(damaged.size(), 1U) << "the bucket that did not fit any more has no file yet";
}

}  // namespace

}  // namespace contort
