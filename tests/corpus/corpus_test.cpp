// The corpus as a map from bucket to the best case: minima and maxima, so that no order of adding matters.
#include "corpus/corpus.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "corpus/leads.h"
#include "tests/corpus/sample_corpus.h"
#include "tests/corpus/temp_folder.h"

namespace contort {

namespace {

Tree corpus_of(const std::vector<Found>& founds) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  for (const Found& f : founds) {
    const auto added = corpus.add(f);
    EXPECT_TRUE(added) << to_line(added.issue());
  }
  return tree_of(corpus.folder());
}

// Few different values, so that equal minimal specs with different origins, equal depths and equal runs all occur.
Found draw_found() {
  Found f = found(151 + *rc::gen::inRange(0, 3), 30, *rc::gen::inRange(0, 3));
  f.original = made_up(160 + *rc::gen::inRange(0, 3), 60 + *rc::gen::inRange(0, 2), f.original.provenance.seed);
  f.minimal.provenance.shrunk_from = spec_id(f.original.spec);
  if (*rc::gen::inRange(0, 4) == 0) f.minimal.expect.subject = f.original.expect.subject = "arm_right/elbow max";
  if (*rc::gen::inRange(0, 8) == 0) f.original = made_up_nan(f.original);
  return f;
}

std::vector<Found> draw_founds() {
  std::vector<Found> founds;
  const int count = *rc::gen::inRange(1, 5);
  for (int i = 0; i < count; ++i) founds.push_back(draw_found());
  return founds;
}

RC_GTEST_PROP(CorpusAdd, AnyOrderLeavesTheSameBytes, ()) {
  const std::vector<Found> founds = draw_founds();
  std::vector<Found> shuffled = founds;
  for (std::size_t i = shuffled.size(); i > 1; --i)
    std::swap(shuffled[i - 1], shuffled[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(i)))]);
  const std::string difference = first_difference(corpus_of(founds), corpus_of(shuffled));
  if (!difference.empty()) RC_FAIL(difference);
}

RC_GTEST_PROP(CorpusAdd, AddingAllTwiceChangesNothing, ()) {
  const std::vector<Found> founds = draw_founds();
  std::vector<Found> twice = founds;
  twice.insert(twice.end(), founds.begin(), founds.end());
  const std::string difference = first_difference(corpus_of(founds), corpus_of(twice));
  if (!difference.empty()) RC_FAIL(difference);
}

TEST(CorpusAdd, KeepsTheCheapestAsMinWithItsOriginAndTheDeepestAsWorst) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  Found cheap = found(160, 40, 2);  // the same length of text: 160 stands before 161
  Found deep = found(161, 40, 1);
  deep.original = made_up(199, 99, 1);
  for (const Found* f : {&deep, &cheap}) ASSERT_TRUE(corpus.add(*f));
  const Bucket bucket = only_bucket(corpus);
  EXPECT_EQ(stored(corpus, bucket, bucket.min), cheap.minimal);
  EXPECT_EQ(stored(corpus, bucket, bucket.orig), cheap.original);
  EXPECT_EQ(stored(corpus, bucket, bucket.worst), deep.original);
  EXPECT_EQ(tree_of(corpus.folder()).size(), 5U) << "files that were replaced are still there";
}

TEST(CorpusAdd, AMinimalCaseThatIsDeeperThanItsOriginIsTheWorst) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  Found f = found(160, 40, 1);
  std::swap(f.minimal.expect.depth, f.original.expect.depth);
  std::swap(f.minimal.expect.worst_margin, f.original.expect.worst_margin);
  ASSERT_TRUE(corpus.add(f));
  const Bucket bucket = only_bucket(corpus);
  EXPECT_EQ(stored(corpus, bucket, bucket.worst), f.minimal);
}

TEST(CorpusAdd, NothingIsDeeperThanNaN) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  Found f = found(160, 40, 1);
  f.original = made_up_nan(f.original);
  ASSERT_TRUE(corpus.add(f));
  Found finite = found(161, 40, 2);
  finite.original = made_up(300, 99, 2);
  ASSERT_TRUE(corpus.add(finite));
  const Bucket bucket = only_bucket(corpus);
  EXPECT_TRUE(std::isnan(stored(corpus, bucket, bucket.worst).expect.worst_margin));
}

TEST(CorpusAdd, ABucketIsNewOnceAndNamesARunOnce) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const auto first = corpus.add(found(160, 40, 2));
  const auto again = corpus.add(found(160, 40, 2));
  const auto other = corpus.add(found(165, 40, 1));
  ASSERT_TRUE(first && again && other);
  EXPECT_TRUE(first->is_new);
  EXPECT_FALSE(again->is_new);
  EXPECT_FALSE(other->is_new);
  EXPECT_EQ(first->bucket, other->bucket);
  const std::vector<std::string> runs = {"seed_1", "seed_2"};
  EXPECT_EQ(only_bucket(corpus).runs, runs);
}

TEST(CorpusAdd, KeepsTheStateThatAPersonGaveABucket) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const auto added = corpus.add(found(160, 40, 1));
  ASSERT_TRUE(added);
  std::string text = slurp(added->bucket + "/bucket.json");
  const std::size_t at = text.find("\"state\": \"new\"");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, 14, "\"state\": \"open\"");
  spill(added->bucket + "/bucket.json", text);
  ASSERT_TRUE(corpus.add(found(155, 40, 2)));
  EXPECT_EQ(only_bucket(corpus).state, BucketState::open);
}

TEST(CorpusAdd, ABucketThatCannotBeReadIsAnErrorAndStaysAsItIs) {
  for (const std::string bad : {"{", "{\"format\": \"contort.bucket/9\"}", ""}) {
    const TempFolder folder;
    const Corpus corpus = create(folder);
    const auto added = corpus.add(found(160, 40, 1));
    ASSERT_TRUE(added);
    spill(added->bucket + "/bucket.json", bad);
    const Tree before = tree_of(corpus.folder());
    const auto refused = corpus.add(found(155, 30, 2));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.issue().text.find("bucket.json"), std::string::npos) << refused.issue().text;
    EXPECT_EQ(first_difference(before, tree_of(corpus.folder())), "");
    std::vector<Issue> damaged;
    EXPECT_TRUE(corpus.buckets(damaged).empty());
    EXPECT_EQ(damaged.size(), 1U);
  }
}

TEST(CorpusAdd, AStateThatDoesNotExistIsRefused) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const auto added = corpus.add(found(160, 40, 1));
  ASSERT_TRUE(added);
  std::string text = slurp(added->bucket + "/bucket.json");
  text.replace(text.find("\"new\""), 5, "\"odd\"");
  spill(added->bucket + "/bucket.json", text);
  const auto refused = corpus.add(found(160, 40, 1));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.issue().code, "bucket.unknown_name");
}

TEST(Leads, AreKeptWithAndWithoutTheirMinimalCaseUntilTheyAreDropped) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const Found f = found(160, 40, 1);
  Lead lead{"seed_1", f.original, {}};
  ASSERT_TRUE(keep_lead(corpus, lead));
  std::vector<Issue> damaged;
  EXPECT_EQ(leads_of(corpus, damaged), std::vector<Lead>{lead});
  lead.minimal = f.minimal;
  ASSERT_TRUE(keep_lead(corpus, lead));
  EXPECT_EQ(leads_of(corpus, damaged), std::vector<Lead>{lead});
  tidy_leads(corpus, "seed_1");  // not while there are any
  EXPECT_EQ(leads_of(corpus, damaged).size(), 1U);
  drop_lead(corpus, lead);
  tidy_leads(corpus, "seed_1");
  EXPECT_TRUE(damaged.empty());
  EXPECT_TRUE(std::filesystem::is_empty(corpus.folder() + "/leads"));
}

TEST(Leads, ThatCannotBeReadAreReportedAndTheOthersGiven) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const Lead lead{"seed_1", found(160, 40, 1).original, {}};
  ASSERT_TRUE(keep_lead(corpus, lead));
  spill(corpus.folder() + "/leads/seed_1/odd.json", "{");
  std::vector<Issue> damaged;
  EXPECT_EQ(leads_of(corpus, damaged), std::vector<Lead>{lead});
  EXPECT_EQ(damaged.size(), 1U);
}

// Root may write everywhere, so the obstacles here are files in place of folders, and folders in place of files.
TEST(CorpusUnwritable, ABucketFolderThatCannotBeMadeLosesNothing) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const Found f = found(160, 40, 1);
  Bucket bucket;
  bucket.check = "joint_range";
  bucket.id = bucket_id(family_of(f.minimal), features_of(f.minimal.spec));
  spill(corpus.folder_of(bucket), "in the way");
  const auto added = corpus.add(f);
  ASSERT_FALSE(added);
  EXPECT_EQ(added.issue().code, "file.unwritable");
  EXPECT_EQ(slurp(corpus.folder_of(bucket)), "in the way");
}

TEST(CorpusUnwritable, ABucketFileThatCannotBeReplacedKeepsTheOldCases) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const auto added = corpus.add(found(160, 40, 1));
  ASSERT_TRUE(added);
  const Found better = found(155, 30, 2);
  const std::string blocked = added->bucket + "/min-" + spec_id(better.minimal.spec).substr(0, 16) + ".json";
  std::filesystem::create_directories(blocked + "/x");
  const auto refused = corpus.add(better);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.issue().code, "file.unwritable");
  const Bucket bucket = only_bucket(corpus);
  for (const std::string& file : {bucket.min, bucket.orig, bucket.worst}) stored(corpus, bucket, file);
}

// A kill just before bucket.json is replaced must leave the files that the old one names.
TEST(CorpusUnwritable, WithoutANewBucketFileTheOldOneStillNamesFilesThatAreThere) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const auto added = corpus.add(found(160, 40, 1));
  ASSERT_TRUE(added);
  const std::string part = added->bucket + "/bucket.json." + std::to_string(::getpid()) + ".part";
  std::filesystem::create_directories(part);  // where write_file puts its temporary file
  Found better = found(155, 30, 2);
  better.original = made_up(199, 99, 2);
  ASSERT_FALSE(corpus.add(better));
  const Bucket bucket = only_bucket(corpus);
  for (const std::string& file : {bucket.min, bucket.orig, bucket.worst}) stored(corpus, bucket, file);
}

// A folder without bucket.json would be reported as damage.
TEST(CorpusUnwritable, ABucketThatFindsNoRoomIsNotHalfThere) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const rlimit none{0, RLIM_INFINITY}, all{RLIM_INFINITY, RLIM_INFINITY};
  ::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &none), 0);
  const auto added = corpus.add(found(160, 40, 1));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &all), 0);
  ASSERT_FALSE(added);
  EXPECT_EQ(added.issue().code, "file.unwritable");
  std::vector<Issue> damaged;
  EXPECT_TRUE(corpus.buckets(damaged).empty());
  EXPECT_TRUE(damaged.empty());
}

// One process adds ever cheaper cases, so that files are replaced all the time. Another one always reads complete
// files.
TEST(CorpusReaders, AreNotDisturbedByAWriter) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int round = 0; round < 300; ++round) {
      Found f = found(160, 900 - round, 1);
      f.minimal.expect.subject = f.original.expect.subject = "subject " + std::to_string(round % 30);
      EXPECT_TRUE(corpus.add(f));
    }
    done = true;
  });
  int reads = 0;
  while (!done) {
    std::vector<Issue> damaged;
    for (Bucket& bucket : corpus.buckets(damaged)) {
      for (const Corpus::Stored& one : corpus.cases_of(bucket)) EXPECT_TRUE(one.stored) << to_line(one.stored.issue());
      const Result<Case> minimal = corpus.minimal_of(bucket);
      EXPECT_TRUE(minimal) << to_line(minimal.issue());
      ++reads;
    }
    for (const Issue& issue : damaged) ADD_FAILURE() << to_line(issue);
  }
  writer.join();
  EXPECT_GT(reads, 100);
}

TEST(CorpusUnwritable, AFolderBelowAFileIsRefusedAtOnce) {
  const TempFolder folder;
  spill(folder / "file", "x");
  const Result<Corpus> corpus = Corpus::create(folder / "file/corpus");
  ASSERT_FALSE(corpus);
  EXPECT_EQ(corpus.issue().code, "file.unwritable");
  const Result<Corpus> in_proc = Corpus::create("/proc/contort");
  ASSERT_FALSE(in_proc);
  EXPECT_EQ(in_proc.issue().code, "file.unwritable");
}

TEST(CorpusUnwritable, AFolderThatHoldsNoCorpusIsNotOpened) {
  const TempFolder folder;
  for (const std::string& path : {folder.path(), folder / "missing"}) {
    const Result<Corpus> corpus = Corpus::open(path);
    ASSERT_FALSE(corpus);
    EXPECT_EQ(corpus.issue().code, "corpus.not_found");
  }
}

TEST(CorpusCost, FewerActionsThenShorterTextThenTheText) {
  Spec two = bent_elbow(160);
  two.sequences[0].clips[0].actions.push_back(pose_use("arm_right", {}));
  EXPECT_TRUE(cheaper(bent_elbow(160.123456789), two));
  EXPECT_TRUE(cheaper(bent_elbow(160), bent_elbow(160.5)));
  EXPECT_TRUE(cheaper(bent_elbow(160), bent_elbow(161)));
  EXPECT_FALSE(cheaper(bent_elbow(160), bent_elbow(160)));
}

// A sequence that shrinking moves from an interrupt into the queue costs less there, not more.
TEST(CorpusCost, AnInterruptCostsMoreThanItsSequenceInTheQueue) {
  Spec queued = bent_elbow(160), interrupted = bent_elbow(160);
  queued.sequences.push_back(queued.sequences[0]);
  InterruptDesc interrupt;
  interrupt.sequence = queued.sequences[0];
  interrupted.interrupts = {interrupt};
  EXPECT_TRUE(cheaper(queued, interrupted));
  EXPECT_FALSE(cheaper(interrupted, queued));
}

TEST(CorpusCost, FeaturesNameWhatAMinimalSpecNeeds) {
  EXPECT_EQ(features_of(bent_elbow(160)), "actions=pose clips=1 sequences=1");
  Spec spec = bent_elbow(160);
  ActionUse reach = pose_use("arm_left", {});
  reach.action = "reach";
  spec.sequences[0].clips.push_back({"", 0, 0, 1.0, {reach}});
  spec.sequences.resize(4, spec.sequences[0]);
  spec.character.parts["head"] = "human_head";
  spec.character.attachments.push_back({"rifle", "hand_left", "grip"});
  EXPECT_EQ(features_of(spec), "actions=pose,reach clips=3+ sequences=3+ swap attachment");
  EXPECT_EQ(features_of(Spec{}), "actions= clips=0 sequences=0");
}

TEST(CorpusCost, FeaturesNameWhatCutsInAndWhatActsFromOutside) {
  Spec spec = bent_elbow(160);
  InterruptDesc interrupt;
  interrupt.sequence = spec.sequences[0];
  interrupt.sequence.clips[0].actions[0].action = "reach";
  spec.interrupts.push_back(interrupt);
  EXPECT_EQ(features_of(spec), "actions=pose,reach clips=1 sequences=1 interrupt");
  spec.interrupts.clear();
  spec.environment.ground = StepsGround{};
  spec.environment.obstacles.emplace_back();
  EXPECT_EQ(features_of(spec), "actions=pose clips=1 sequences=1 ground obstacle");
  spec.environment = {};
  spec.dynamics.loads.emplace_back();
  spec.dynamics.impacts.emplace_back();
  spec.dynamics.mode = Mode::tracking;
  EXPECT_EQ(features_of(spec), "actions=pose clips=1 sequences=1 load impact tracking");
}

TEST(CorpusCost, FeaturesHoldNoNumbers) {
  EXPECT_EQ(features_of(bent_elbow(160)), features_of(bent_elbow(200, 99)));
  const Family a{"pop", "human", "a"}, b{"pop", "human", "b"};
  EXPECT_NE(bucket_id(a, "b"), bucket_id(a, "c"));
  EXPECT_NE(bucket_id(a, "b"), bucket_id(b, "b"));
  EXPECT_EQ(bucket_id(a, "b").size(), 12U);
}

}  // namespace

}  // namespace contort
