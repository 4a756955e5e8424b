// Shards become one run: in any grouping, any order, and however often they are merged.
#include "corpus/merge.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <deque>
#include <set>

#include "corpus/leads.h"
#include "corpus/runs.h"
#include "tests/checks/family_text.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

constexpr int kFirst = 2;  // failures of a family that go into buckets

struct Failure {
  int index = 0;
  int subject = 0;
  int rank = 0;             // position among the failures of this case
  std::vector<int> also{};  // subjects of the same index that the minimal spec shows too
  int named = -1;           // subject that names the minimal spec; -1: its own
};
using Failures = std::vector<Failure>;  // by index, then rank

std::string subject_text(int subject) { return "subject " + std::to_string(subject); }

Lead lead_of(const Failure& failure) {
  const auto shown = [&](int elbow_deg) {
    Case c = made_up(elbow_deg, 30, 1);
    c.expect.subject = subject_text(failure.subject);
    c.provenance.index = failure.index, c.provenance.rank = failure.rank;
    return c;
  };
  // Some are minimal in another bucket of their family, and any may be the smallest or the deepest of its bucket.
  Lead lead{"seed_1_0", shown(160 + failure.index), shown(151 + failure.index * 7 % 9)};
  if (failure.index % 3 == 0) lead.minimal->spec.sequences.push_back(lead.minimal->spec.sequences.front());
  if (failure.named >= 0 && failure.named != failure.subject) {
    lead.minimal->expect.subject = subject_text(failure.named);
    lead.shrunk_from = lead.original;
    lead.shrunk_from->expect.subject = subject_text(failure.named);
  }
  lead.minimal->provenance.shrunk_from = spec_id(lead.original.spec);
  for (const int subject : failure.also) {
    Case other = lead.original;
    other.expect.subject = subject_text(subject);
    lead.minimal->co_failures.push_back(family_of(other));
  }
  return lead;
}

RunRecord record_of(const Failures& failures, int shard, int shards) {
  RunRecord record;
  record.name = "seed_1_0", record.shard = shard, record.shards = shards, record.shrinks_per_family = kFirst;
  std::set<int> indices;
  for (const Failure& failure : failures) indices.insert(failure.index);
  record.cases = record.failing = std::ssize(indices);
  for (const Failure& failure : failures) {
    FamilyCount& count = record.families[family_of(lead_of(failure).original)];
    if (++count.cases <= kFirst) count.first_indices.push_back(failure.index);
    if (count.cases == 1) count.first_index = failure.index, count.first_arm = "arm_" + std::to_string(failure.index);
  }
  return record;
}

// Stores in the corpus what a run leaves: the first leads of each family. A whole run has filed them in buckets, except
// for those that the minimal spec of an earlier failure of the case shows too.
void leave(const Failures& failures, int shard, int shards, const Corpus& corpus) {
  const RunRecord record = record_of(failures, shard, shards);
  ASSERT_TRUE(keep_run(corpus, record));
  std::set<std::pair<int, int>> told;  // pairs of index and subject
  for (const Failure& failure : failures) {
    const Lead lead = lead_of(failure);
    const std::vector<std::int64_t>& first = record.families.at(family_of(lead.original)).first_indices;
    if (std::ranges::find(first, failure.index) == first.end()) continue;
    if (shards == 1 && told.contains({failure.index, failure.subject})) continue;
    ASSERT_TRUE(keep_lead(corpus, lead));
    if (shards > 1) continue;
    ASSERT_TRUE(file_lead(corpus, lead));
    for (const int subject : failure.also) told.insert({failure.index, subject});
    told.insert({failure.index, failure.named});
  }
}

// Corpora that live as long as the test.
class Corpora {
 public:
  const Corpus& make() { return all_.emplace_back(create(folders_.emplace_back())); }
  const std::deque<Corpus>& all() const { return all_; }

 private:
  std::deque<TempFolder> folders_;
  std::deque<Corpus> all_;
};

void leave_shards(const Failures& failures, int shards, Corpora& corpora) {
  for (int shard = 0; shard < shards; ++shard) {
    Failures own;
    for (const Failure& failure : failures)
      if (failure.index % shards == shard) own.push_back(failure);
    leave(own, shard, shards, corpora.make());
  }
}

void merge_all(const std::vector<Corpus>& sources, const Corpus& into) {
  const Result<Merged> merged = merge(sources, into);
  ASSERT_TRUE(merged) << to_line(merged.issue());
  for (const Issue& issue : merged->damaged) ADD_FAILURE() << to_line(issue);
}

TEST(Merge, OfOneShardOnceMoreChangesNothing) {
  // The first two of the run are in different shards; the second shard's own second came too late.
  const Failures failures = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {5, 1}};
  Corpora corpora;
  leave_shards(failures, 2, corpora);
  const Corpus& into = corpora.make();
  merge_all({corpora.all()[0], corpora.all()[1]}, into);
  const Tree tree = tree_of(into.folder());
  for (int shard = 0; shard < 2; ++shard) {
    merge_all({corpora.all()[static_cast<std::size_t>(shard)]}, into);
    EXPECT_EQ(first_difference(tree, tree_of(into.folder())), "") << shard;
  }
}

std::vector<int> draw_subjects() {
  return *rc::gen::resize(4, rc::gen::unique<std::vector<int>>(rc::gen::inRange(0, 4)));
}

// Draws for each case none, one or several failures, whose minimal specs show some of the others.
Failures draw_failures() {
  Failures failures;
  for (int index = 0; index < 10; ++index)
    for (int rank = 0; const int subject : draw_subjects())
      failures.push_back({index, subject, rank++, draw_subjects(), *rc::gen::inRange(-1, 4)});
  return failures;
}

// Draws corpora in any order, with repetition.
std::vector<Corpus> draw_some(const Corpora& corpora) {
  std::vector<Corpus> some;
  const int count = *rc::gen::inRange(1, 5);
  for (int i = 0; i < count; ++i)
    some.push_back(corpora.all()[*rc::gen::inRange<std::size_t>(0, corpora.all().size())]);
  return some;
}

RC_GTEST_PROP(MergeOfShardsSlow, InAnyGroupingAndAnyOrderIsOneRun, ()) {
  const Failures failures = draw_failures();
  Corpora whole, corpora;
  leave(failures, 0, 1, whole.make());
  const int shards = *rc::gen::inRange(2, 5);
  leave_shards(failures, shards, corpora);
  for (int group = 0; group < 3; ++group) {
    const std::vector<Corpus> some = draw_some(corpora);
    merge_all(some, corpora.make());
  }
  const Corpus& into = corpora.make();
  std::vector<int> order(corpora.all().size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[*rc::gen::inRange<std::size_t>(0, i)]);
  for (const int next : order) merge_all({corpora.all()[static_cast<std::size_t>(next)]}, into);
  const std::string difference = first_difference(tree_of(whole.all().front().folder()), tree_of(into.folder()));
  if (!difference.empty()) RC_FAIL(difference);
}

TEST(Merge, FilesNothingThatAnEarlierFailureOfTheCaseShowsToo) {
  Corpora corpora;
  leave_shards({{0, 0, 0, {1, 2}}, {0, 1, 1, {3}}, {0, 2, 2}, {0, 3, 3, {0}}, {1, 1, 0}}, 2, corpora);
  const Corpus& into = corpora.make();
  merge_all({corpora.all()[0], corpora.all()[1]}, into);
  std::vector<Issue> damaged;
  std::set<std::pair<std::string, std::int64_t>> filed;
  for (const Bucket& bucket : into.buckets(damaged)) {
    const Case min = *read_case(into.folder_of(bucket) + "/" + bucket.min);
    filed.insert({min.expect.subject, min.provenance.index});
  }
  // Failures that the first minimal spec shows are not filed, and neither are those that only they would have covered.
  // Another case covers none of this case's failures.
  EXPECT_EQ(filed, (std::set<std::pair<std::string, std::int64_t>>{
                       {subject_text(0), 0}, {subject_text(3), 0}, {subject_text(1), 1}}));
}

TEST(Merge, FilesUnderTheFamilyThatNamesTheMinimalSpec) {
  Corpora corpora;
  leave_shards({{0, 0, 0, {}, 1}, {0, 1, 1}, {0, 2, 2}}, 2, corpora);
  Lead told = lead_of({0, 1, 1});  // covered by the first failure, which has this name
  told.minimal->spec.hold_frames = 1, told.minimal->spec.sequences.resize(1);
  ASSERT_TRUE(keep_lead(corpora.all()[0], told));
  const Corpus& into = corpora.make();
  merge_all({corpora.all()[0], corpora.all()[1]}, into);
  std::vector<Issue> damaged;
  std::set<std::pair<std::string, std::string>> filed;
  for (const Bucket& bucket : into.buckets(damaged)) {
    const Case min = *read_case(into.folder_of(bucket) + "/" + bucket.min);
    EXPECT_NE(min.spec, told.minimal->spec);
    filed.insert({min.expect.subject, read_case(into.folder_of(bucket) + "/" + bucket.orig)->expect.subject});
  }
  EXPECT_EQ(filed, (std::set<std::pair<std::string, std::string>>{{subject_text(1), subject_text(1)},
                                                                  {subject_text(2), subject_text(2)}}));
}

TEST(Merge, WhatWasMetWhileShrinkingSuchAFailureIsNotFiled) {
  Corpora corpora;
  leave_shards({{0, 0, 0, {1}}, {0, 1, 1}}, 2, corpora);
  const Corpus& shard = corpora.all()[0];
  for (const int shrunk : {0, 1}) {
    Lead met = lead_of({0, 2, shrunk});
    met.original.provenance.met_shrinking = family_of(lead_of({0, shrunk, shrunk}).original);
    met.minimal->provenance.met_shrinking = met.original.provenance.met_shrinking;
    ASSERT_TRUE(keep_lead(shard, met));
  }
  const Corpus& into = corpora.make();
  merge_all({shard, corpora.all()[1]}, into);
  std::vector<Issue> damaged;
  std::set<Family> met;
  for (const Bucket& bucket : into.buckets(damaged))
    met.insert(read_case(into.folder_of(bucket) + "/" + bucket.min)->provenance.met_shrinking);
  EXPECT_EQ(met, (std::set<Family>{{}, family_of(lead_of({0, 0}).original)}));
}

TEST(RunRecords, AddUpToTheFirstOfAllShards) {
  const Failures failures = {{1, 0}, {2, 0}, {3, 0}, {4, 1}, {7, 1}};
  const RunRecord odd = record_of({{1, 0}, {3, 0}, {7, 1}}, 1, 2), even = record_of({{2, 0}, {4, 1}}, 0, 2);
  EXPECT_EQ(added_up({odd, even}), record_of(failures, 0, 1));
  EXPECT_EQ(added_up({even, odd}), record_of(failures, 0, 1));
}

}  // namespace

}  // namespace contort
