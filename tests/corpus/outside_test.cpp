// An untrusted corpus: none of its names and links makes an operation reach a file outside, and all other buckets are
// processed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "corpus/bucket_files.h"
#include "corpus/fsck.h"
#include "corpus/half_written.h"
#include "corpus/leads.h"
#include "corpus/lifecycle.h"
#include "corpus/lock.h"
#include "corpus/merge.h"
#include "corpus/runs.h"
#include "corpus/upkeep.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct BadName {
  const char* field;
  std::string says;
};
const BadName kBadNames[] = {
    {"orig", "../../../plain.json"},
    {"orig", "orig-/../../../../plain.json"},
    {"orig", "/etc/passwd"},
    {"orig", "bucket.json"},
    {"orig", "min-0123456789abcdef.json"},
    {"min", "../../../plain.json"},
    {"min", "orig-0123456789abcdef.json"},
    {"worst", "../../.lock"},
    {"worst", "worst-\n.json"},
    {"id", "../../../../plain"},
    {"id", "x/../../../plain"},
    {"id", "0123456789AB"},
    {"id", "0123456789abc"},
};

class StrangersCorpus : public testing::Test {
 protected:
  StrangersCorpus() : corpus_(create(folder_)) {
    EXPECT_TRUE(corpus_.add(found(160, 40, 1)));
    hostile_ = only_bucket(corpus_);
    Found other = found(165, 40, 2);
    other.minimal.expect.subject = other.original.expect.subject = "arm_right/elbow max";
    EXPECT_TRUE(corpus_.add(other));
    honest_ = bucket_of(other.minimal);
    fs::create_directories(folder_ / "elsewhere");
    spill(folder_ / "plain.json", "plain");
    spill(folder_ / "elsewhere/theirs.json", "theirs");
    spill(folder_ / "elsewhere/theirs.json.999999999.part", "theirs, too");
    outside_ = outside();
  }
  // Everything except the corpus.
  Tree outside() const {
    Tree tree = tree_of(folder_.path());
    std::erase_if(
        tree, [](const auto& file) { return file.first.starts_with("corpus/") || file.first.starts_with("into/"); });
    return tree;
  }
  void expect_outside_untouched() const { EXPECT_EQ(first_difference(outside_, outside()), ""); }
  std::string in_hostile(const std::string& name) const { return corpus_.folder_of(hostile_) + "/" + name; }

  // Writes bucket.json with one field changed.
  void say(const std::string& field, const std::string& text) {
    Bucket known = hostile_;
    known.state = BucketState::fixed, known.owner = "ana", known.changes = 3;
    Json json = Json::parse(print_bucket(known));
    json[field] = text;
    spill(in_hostile("bucket.json"), json.dump());
  }
  void make_honest_one_fixed() {
    ASSERT_TRUE(corpus_.change(honest_, [](const Bucket& b) -> Result<Bucket> {
      Bucket fixed = b;
      fixed.state = BucketState::fixed;
      return fixed;
    }));
  }
  void replace_by_link(const std::string& path, const std::string& to) {
    fs::remove_all(path);
    fs::create_symlink(to, path);
  }

  // Only the honest bucket is processed, and the other one is reported.
  void expect_refused(const std::string& code) {
    std::vector<Issue> damaged;
    const std::vector<Bucket> buckets = corpus_.buckets(damaged);
    ASSERT_EQ(buckets.size(), 1U);
    EXPECT_EQ(buckets[0].id, honest_.id);
    ASSERT_EQ(damaged.size(), 1U);
    EXPECT_EQ(damaged[0].code, code) << damaged[0].text;
    EXPECT_TRUE(is_untrusted(damaged[0]));
    EXPECT_EQ(left_alone(corpus_), damaged);
  }
  void expect_refused_no_more() {
    std::vector<Issue> damaged;
    EXPECT_EQ(corpus_.buckets(damaged).size(), 2U);
    EXPECT_TRUE(damaged.empty());
  }
  // Every operation on the whole corpus is done to the honest bucket alone.
  void expect_others_are_served() {
    make_honest_one_fixed();
    Tree before = tree_of(corpus_.folder());
    const Result<Changes> pruned = prune(corpus_);
    ASSERT_TRUE(pruned) << to_line(pruned.issue());
    EXPECT_EQ(pruned->size(), 1U);
    EXPECT_TRUE(rekey(corpus_));
    EXPECT_TRUE(migrate(corpus_));
    Tree after = tree_of(corpus_.folder());
    for (Tree* tree : {&before, &after})
      std::erase_if(*tree,
                    [&](const auto& file) { return file.first.find(folder_name(honest_)) != std::string::npos; });
    EXPECT_EQ(first_difference(before, after), "") << "the bucket was not left alone";
    const Result<Corpus> into = Corpus::create(folder_ / "into");
    const Result<Merged> merged = merge({corpus_}, *into);
    ASSERT_TRUE(merged) << to_line(merged.issue());
    EXPECT_EQ(merged->damaged.size(), 1U);
    EXPECT_EQ(only_bucket(*into).id, honest_.id);
  }
  std::vector<CorpusFault> repaired() {
    const Result<std::vector<CorpusFault>> faults = check_files(corpus_, true);
    EXPECT_TRUE(faults) << to_line(faults.issue());
    const Result<std::vector<CorpusFault>> left = check_files(corpus_, false);
    EXPECT_TRUE(left && left->empty()) << (left ? left->front().text : "");
    expect_outside_untouched();
    return faults ? *faults : std::vector<CorpusFault>();
  }

  TempFolder folder_;
  Corpus corpus_;
  Bucket hostile_, honest_;
  Tree outside_;
};

// ---- names

TEST_F(StrangersCorpus, ANameThatIsNotOfItsFormIsRefusedWithItsField) {
  for (const auto& [field, says] : kBadNames) {
    SCOPED_TRACE(field + (": " + says));
    say(field, says);
    const Result<Bucket> read = read_bucket(corpus_.folder_of(hostile_));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.issue().code, "bucket.bad_name");
    EXPECT_EQ(read.issue().pointer, std::string("/") + field);
    EXPECT_NE(read.issue().text.find("fsck --repair"), std::string::npos) << read.issue().text;
    expect_refused("bucket.bad_name");
    const auto note = [](const Bucket& b) { return Result<Bucket>(annotate(b, "seen")); };
    EXPECT_FALSE(corpus_.change(hostile_, note));
    EXPECT_FALSE(corpus_.add(found(160, 40, 3)));
    expect_outside_untouched();
  }
}

TEST_F(StrangersCorpus, ABucketWithABadNameIsLeftAloneAndTheOthersAreServed) {
  say("orig", "../../../plain.json");
  expect_others_are_served();
  expect_outside_untouched();
}

TEST_F(StrangersCorpus, FsckNamesTheFieldAndMendsItWithoutLosingStateOrCases) {
  for (const auto& [field, says] : kBadNames) {
    SCOPED_TRACE(field + (": " + says));
    say(field, says);
    const Tree before = tree_of(corpus_.folder());
    const Result<std::vector<CorpusFault>> seen = check_files(corpus_, false);
    ASSERT_TRUE(seen);
    ASSERT_FALSE(seen->empty());
    const CorpusFault& fault = seen->front();
    EXPECT_EQ(fault.code, "bad_name");
    EXPECT_NE(fault.text.find(std::string("/") + field), std::string::npos) << fault.text;
    EXPECT_EQ(first_difference(before, tree_of(corpus_.folder())), "") << "looking changed something";
    repaired();
    Bucket expected = hostile_;
    expected.state = BucketState::fixed, expected.owner = "ana", expected.changes = 3;
    EXPECT_EQ(*read_own_bucket(corpus_.folder_of(hostile_)), expected);
    for (const auto& [path, bytes] : before)
      if (!path.ends_with("/bucket.json")) {
        EXPECT_EQ(tree_of(corpus_.folder())[path], bytes) << path << " is lost";
      }
  }
}

// Otherwise it could make prune drop the other bucket's original.
TEST_F(StrangersCorpus, ABucketInTheFolderOfAnotherNameChangesNoOther) {
  make_honest_one_fixed();
  const std::string liar = corpus_.folder() + "/buckets/liar";
  fs::create_directories(liar);
  Bucket copy = *read_own_bucket(corpus_.folder_of(honest_));
  copy.note = "from the liar", copy.changes = 9;
  ASSERT_TRUE(write_bucket(liar, copy));
  std::vector<Issue> damaged;
  EXPECT_EQ(corpus_.buckets(damaged).size(), 2U);
  ASSERT_EQ(damaged.size(), 1U);
  EXPECT_EQ(damaged[0].code, "bucket.wrong_folder");
  EXPECT_NE(damaged[0].text.find(folder_name(honest_)), std::string::npos) << damaged[0].text;
  ASSERT_TRUE(prune(corpus_));
  EXPECT_EQ(read_own_bucket(corpus_.folder_of(honest_))->note, "");
}

// ---- links

TEST_F(StrangersCorpus, ACaseThatIsALinkToAFileOutsideIsNotRead) {
  for (const std::string& name : {hostile_.min, hostile_.worst, hostile_.orig}) {
    const std::string bytes = slurp(in_hostile(name));
    spill(folder_ / "elsewhere/case.json", bytes);  // even where it is a case
    outside_ = outside();
    replace_by_link(in_hostile(name), folder_ / "elsewhere/case.json");
    expect_refused("file.outside");
    EXPECT_FALSE(read_case_of(corpus_.folder_of(hostile_), name));
    Bucket bucket = hostile_;
    for (const Corpus::Stored& stored : corpus_.cases_of(bucket))
      if (stored.path.ends_with(name)) {
        EXPECT_EQ(stored.stored.issue().code, "file.outside");
      }
    fs::remove(in_hostile(name));
    spill(in_hostile(name), bytes);
  }
}

TEST_F(StrangersCorpus, ABucketWithALinkIsLeftAloneAndTheOthersAreServed) {
  replace_by_link(in_hostile(hostile_.orig), "../../../elsewhere/theirs.json");
  expect_others_are_served();
  expect_outside_untouched();
}

TEST_F(StrangersCorpus, FsckPutsALinkAsideAndNotWhatItLeadsTo) {
  replace_by_link(in_hostile(hostile_.worst), folder_ / "elsewhere/theirs.json");
  const std::vector<CorpusFault> faults = repaired();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, "outside");
  const std::string aside = corpus_.folder() + "/invalid/buckets/" + folder_name(hostile_) + "/" + hostile_.worst;
  EXPECT_TRUE(fs::is_symlink(aside));
  expect_refused_no_more();
}

TEST_F(StrangersCorpus, FsckRebuildsABucketFileThatIsALink) {
  spill(folder_ / "elsewhere/bucket.json", slurp(in_hostile("bucket.json")));
  outside_ = outside();
  replace_by_link(in_hostile("bucket.json"), folder_ / "elsewhere/bucket.json");
  expect_refused("file.outside");
  const std::vector<CorpusFault> faults = repaired();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, "outside");
  expect_refused_no_more();
}

TEST_F(StrangersCorpus, ABucketsFolderThatIsALinkIsNeitherReadNorWritten) {
  fs::rename(corpus_.folder_of(hostile_), folder_ / "elsewhere/bucket");
  outside_ = outside();
  fs::create_symlink("../../elsewhere/bucket", corpus_.folder_of(hostile_));
  expect_refused("file.outside");
  EXPECT_FALSE(corpus_.add(found(160, 40, 3)));
  EXPECT_FALSE(corpus_.change(hostile_, [](const Bucket& b) { return Result<Bucket>(annotate(b, "x")); }));
  EXPECT_FALSE(corpus_.remove(hostile_));
  const TempFolder other;
  const Corpus source = create(other);
  ASSERT_TRUE(source.add(found(155, 30, 1)));
  EXPECT_FALSE(corpus_.take(source, only_bucket(source)));
  expect_others_are_served();
  expect_outside_untouched();
  repaired();
  EXPECT_TRUE(corpus_.add(found(160, 40, 3)));
  expect_outside_untouched();
}

TEST_F(StrangersCorpus, ACorpusWhoseOwnFolderIsALinkIsNotOpened) {
  for (const char* own : {"buckets", "leads", "runs", "invalid", ".lock"}) {
    SCOPED_TRACE(own);
    const TempFolder other;
    fs::create_directories(other / "corpus/buckets");
    fs::create_directories(other / "elsewhere");
    replace_by_link(other / ("corpus/" + std::string(own)), "../elsewhere");
    for (const auto open : {Corpus::open, Corpus::create}) {
      const Result<Corpus> opened = open(other / "corpus");
      ASSERT_FALSE(opened);
      EXPECT_EQ(opened.issue().code, "file.outside");
      EXPECT_NE(opened.issue().text.find(own), std::string::npos) << opened.issue().text;
    }
    EXPECT_TRUE(tree_of(other / "elsewhere").empty());
  }
}

TEST_F(StrangersCorpus, AFileIsNotWrittenThroughALinkOfItsTemporaryName) {
  for (const std::string& name : {std::string("bucket.json"), hostile_.min, hostile_.worst})
    fs::create_symlink(folder_ / "plain.json", in_hostile(name + "." + std::to_string(::getpid()) + ".part"));
  ASSERT_TRUE(corpus_.add(found(155, 30, 3)));
  ASSERT_TRUE(corpus_.change(hostile_, [](const Bucket& b) { return Result<Bucket>(annotate(b, "x")); }));
  expect_outside_untouched();
}

// ---- leads and runs

TEST_F(StrangersCorpus, LeadsAreNeitherReadWrittenNorRemovedThroughALink) {
  const Lead lead{"seed_1", made_up(170, 30, 1), {}};
  ASSERT_TRUE(keep_lead(corpus_, lead));
  fs::rename(corpus_.folder() + "/leads/seed_1", folder_ / "elsewhere/seed_1");
  fs::copy_file(folder_ / "elsewhere/theirs.json", folder_ / "elsewhere/seed_1/x.json.999999999.part");
  outside_ = outside();
  fs::create_symlink(folder_ / "elsewhere/seed_1", corpus_.folder() + "/leads/seed_1");
  std::vector<Issue> damaged;
  EXPECT_TRUE(leads_of(corpus_, damaged).empty());
  EXPECT_FALSE(read_lead(lead_path(corpus_, lead)));
  EXPECT_FALSE(keep_lead(corpus_, {"seed_1", made_up(180, 30, 2), {}}));
  drop_lead(corpus_, lead);
  RunRecord run;
  run.name = "seed_1";
  EXPECT_TRUE(drop_half_written(corpus_, run));
  const TempFolder other;
  const Corpus source = create(other);
  ASSERT_TRUE(keep_lead(source, lead));
  ASSERT_TRUE(source.add(found(155, 30, 1)));
  const Result<Merged> merged = merge({source}, corpus_);
  ASSERT_TRUE(merged) << to_line(merged.issue());
  EXPECT_EQ(merged->damaged.size(), 1U);
  expect_outside_untouched();
  const std::vector<CorpusFault> faults = repaired();
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].path, "leads/seed_1");
  EXPECT_EQ(faults[0].code, "outside");
}

TEST_F(StrangersCorpus, ALeadOrARunThatIsALinkIsTold) {
  fs::create_directories(corpus_.folder() + "/leads/seed_1");
  fs::create_symlink(folder_ / "elsewhere/theirs.json", corpus_.folder() + "/leads/seed_1/lead.json");
  fs::create_symlink(folder_ / "elsewhere/theirs.json", corpus_.folder() + "/runs/seed_1.json");
  std::vector<Issue> damaged;
  EXPECT_TRUE(leads_of(corpus_, damaged).empty());
  EXPECT_TRUE(runs_of(corpus_, damaged).empty());
  ASSERT_EQ(damaged.size(), 2U);
  for (const Issue& issue : damaged) {
    EXPECT_EQ(issue.code, "file.outside");
    EXPECT_EQ(issue.text.find("theirs\""), std::string::npos);
  }
  const std::vector<CorpusFault> faults = repaired();
  ASSERT_EQ(faults.size(), 2U);
  for (const CorpusFault& fault : faults) EXPECT_EQ(fault.code, "outside");
}

TEST_F(StrangersCorpus, ARecordReplacesALinkAndNotWhatItLeadsTo) {
  fs::create_symlink(folder_ / "plain.json", corpus_.folder() + "/runs/seed_1.json");
  RunRecord run;
  run.name = "seed_1";
  ASSERT_TRUE(keep_run(corpus_, run));
  expect_outside_untouched();
  std::vector<Issue> damaged;
  EXPECT_EQ(runs_of(corpus_, damaged), std::vector<RunRecord>{run});
}

}  // namespace

}  // namespace contort
