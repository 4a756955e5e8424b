// The choice of the name of a failure that occurs together with others.
#include "fuzz/precursor.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/checks/family_text.h"
#include "tests/corpus/sample_cases.h"
#include "tests/fuzz/small_runs.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

Case shown(const std::string& subject, int first_frame, int last_frame, double depth) {
  Case other;
  other.expect.check = "check", other.expect.subject = subject;
  other.expect.first_frame = first_frame, other.expect.last_frame = last_frame;
  other.expect.worst_margin = -depth, other.expect.depth = std::isnan(depth) ? 0.0 : depth;
  return other;
}

std::string precursor_among(const Case& failure, const std::vector<Case>& others) {
  const Case* precursor = precursor_of(failure, others);
  return precursor == nullptr ? "" : precursor->expect.subject;
}

TEST(Precursor, IsTheEarliestOfThoseAsDeep) {
  const Case hip = shown("hip", 50, 52, 1.0);
  EXPECT_EQ(precursor_among(hip, {shown("knee", 49, 50, 3.0), shown("ankle", 48, 50, 1.5)}), "ankle");
  EXPECT_EQ(precursor_among(hip, {shown("knee", 49, 50, 3.0), shown("ankle", 48, 50, 0.9)}), "knee");
  EXPECT_EQ(precursor_among(hip, {shown("knee", 49, 50, 1.0)}), "knee") << "as deep";
  EXPECT_EQ(precursor_among(hip, {shown("knee", 51, 52, 3.0)}), "") << "later";
  EXPECT_EQ(precursor_among(hip, {}), "");
}

TEST(Precursor, OfThoseThatBeginTogetherIsTheDeepest) {
  const Case hip = shown("hip", 50, 52, 1.0);
  EXPECT_EQ(precursor_among(hip, {shown("knee", 50, 50, 3.0), shown("ankle", 50, 90, 2.0)}), "knee");
  EXPECT_EQ(precursor_among(hip, {shown("knee", 50, 50, 3.0), shown("ankle", 50, 50, std::nan(""))}), "ankle");
  EXPECT_EQ(precursor_among(shown("hip", 50, 52, std::nan("")), {shown("knee", 40, 50, 3.0)}), "")
      << "no number is deeper";
}

TEST(Precursor, OfNaNInEveryCheckIsTheOneThatTellsIt) {
  const double nan = std::nan("");
  Case range = shown("knee", 50, 52, nan), finite = shown("knee", 50, 52, nan);
  range.expect.check = "joint_range", finite.expect.check = "non_finite";
  const std::vector<Case> others{finite};
  const Case* precursor = precursor_of(range, others);
  ASSERT_NE(precursor, nullptr);
  EXPECT_EQ(precursor->expect.check, "non_finite");
  EXPECT_EQ(precursor_of(finite, {range}), nullptr);
}

TEST(Precursor, IsNoFurtherThanAFifthOfASecond) {
  Case hip = shown("hip", 50, 52, 1.0);
  EXPECT_EQ(precursor_among(hip, {shown("knee", 20, 38, 3.0)}), "knee");
  EXPECT_EQ(precursor_among(hip, {shown("knee", 20, 37, 3.0)}), "");
  hip.spec.rate_hz = 120.0;
  EXPECT_EQ(precursor_among(hip, {shown("knee", 20, 26, 3.0)}), "knee");
  EXPECT_EQ(precursor_among(hip, {shown("knee", 20, 25, 3.0)}), "");
}

TEST(Precursor, IsNoneThatWasLeft) {
  const std::vector<Case> others{shown("knee", 49, 50, 3.0), shown("ankle", 48, 50, 1.5)};
  const Case* precursor = precursor_of(shown("hip", 50, 52, 1.0), others, {family_of(others[1])});
  ASSERT_NE(precursor, nullptr);
  EXPECT_EQ(precursor->expect.subject, "knee");
}

std::vector<Case> draw_motion() {
  std::vector<Case> all;
  const int count = *rc::gen::inRange(1, 12);
  for (int i = 0; i < count; ++i) {
    const int first = *rc::gen::inRange(0, 60);
    all.push_back(shown(std::to_string(i), first, first + *rc::gen::inRange(0, 20), *rc::gen::inRange(1, 6)));
  }
  return all;
}

// The precursors of one motion have one order: going from precursor to precursor ends at the same family, for any order
// in which they are listed.
RC_GTEST_PROP(PrecursorOfAMotion, IsReachedFromAllThatLeadToIt, ()) {
  std::vector<Case> motion = draw_motion();
  const auto last_of = [&] {
    const Case* at = &motion.front();
    for (std::size_t steps = 0; const Case* before = precursor_of(*at, motion); at = before)
      RC_ASSERT(++steps <= motion.size());
    return at->expect.subject;
  };
  const std::string forward = last_of();
  std::reverse(motion.begin() + 1, motion.end());
  RC_ASSERT(last_of() == forward);
}

Shrunk minimal_of(const Case& original, const std::string& precursor, int evaluations) {
  Shrunk shrunk;
  shrunk.original = shrunk.minimal = shrunk.worst = original;
  shrunk.minimal.spec.hold_frames = evaluations;
  shrunk.minimal.provenance.shrink_evaluations = shrunk.worst.provenance.shrink_evaluations = evaluations;
  if (!precursor.empty()) shrunk.precursor = shown(precursor, 0, 0, 1.0);
  shrunk.stopped = "fixpoint", shrunk.evaluations = evaluations;
  return shrunk;
}

TEST(ShrinkToPrecursor, GoesOnFromWhatItHas) {
  std::vector<PrimarySearch> asked;
  const Shrunk shrunk = shrink_to_precursor(shown("hip", 0, 0, 1.0), [&](const Case& original, const auto& search) {
    asked.push_back(search);
    const std::map<std::string, std::string> before = {{"hip", "knee"}, {"knee", "ankle"}, {"ankle", ""}};
    return minimal_of(original, before.at(original.expect.subject), 10 * static_cast<int>(asked.size()));
  });
  EXPECT_EQ(shrunk.minimal.expect.subject, "ankle");
  EXPECT_EQ(shrunk.original.expect.subject, "ankle");
  EXPECT_EQ(shrunk.evaluations, 60);
  EXPECT_EQ(shrunk.minimal.provenance.shrink_evaluations, 60);
  ASSERT_EQ(asked.size(), 3U);
  EXPECT_FALSE(asked[0].begin_with);
  EXPECT_EQ(asked[2].begin_with->hold_frames, 20);
  EXPECT_EQ(asked[2].left, (std::set<Family>{family("check|human|hip"), family("check|human|knee")}));
}

TEST(ShrinkToPrecursor, HandsBackTheCheapestOfWhatWasMetOnTheWay) {
  const Shrunk shrunk = shrink_to_precursor(shown("hip", 0, 0, 1.0), [&](const Case& original, const auto& search) {
    Shrunk next = minimal_of(original, search.begin_with ? "" : "knee", 1);
    next.met = {shown("crash", 0, 0, 1.0), shown(search.begin_with ? "second" : "first", 0, 0, 1.0)};
    if (search.begin_with) next.met[0].spec = spec_of({pose_use("head", {})});
    return next;
  });
  ASSERT_EQ(shrunk.met.size(), 3U);
  for (const Case& met : shrunk.met) EXPECT_TRUE(met.spec.sequences.empty()) << met.expect.subject;
}

TEST(ShrinkToPrecursor, StaysWithWhatIsSteady) {
  const Shrunk shrunk = shrink_to_precursor(shown("hip", 0, 0, 1.0), [&](const Case& original, const auto& search) {
    Shrunk next = minimal_of(original, "knee", 10);
    if (search.begin_with) next.stopped = "flaky";
    return next;
  });
  EXPECT_EQ(shrunk.minimal.expect.subject, "hip");
  EXPECT_EQ(shrunk.stopped, "fixpoint");
}

// A trial in which the elbow fails by a rule on the spec, together with all other planted failures.
class PlantedMotion final : public Trial {
 public:
  explicit PlantedMotion(std::vector<Case> others) : others_(std::move(others)) {}
  TrialResult run(const Spec& spec, int) override {
    const Result<Stage> stage = build_stage(spec, stock_library());
    TrialResult shown;
    if (!stage) return shown;
    shown.built = true, shown.character = stage->character, shown.most_frames = stage->most_frames;
    shown.fails = print_spec(spec).find("elbow_deg") != std::string::npos;
    shown.depth = 1.0;
    shown.expect = {"check", "elbow", "", 20, 20, 20, -1.0, 1.0, "0", "0", ""};
    return shown;
  }
  std::vector<Case> others(const Spec& spec) override {
    std::vector<Case> all = others_;
    for (Case& other : all) other.spec = spec;
    return all;
  }

 private:
  std::vector<Case> others_;
};

Case preceded_elbow_case() {
  Case original;
  original.spec = spec_of({pose_use("arm_left", {{"elbow_deg", 90.0}}), pose_use("head", {})});
  original.expect = {"check", "elbow", "", 20, 20, 20, -1.0, 1.0, "0", "0", ""};
  original.provenance.index = 7;
  return original;
}

TEST(ShrinkPrimarySearch, TellsThePrecursorAsTheOriginalShowsIt) {
  PlantedMotion trial({shown("wrist", 19, 20, 2.0)});
  const Case original = preceded_elbow_case();
  ShrinkConfig config;
  config.search = PrimarySearch{};
  const Shrunk result = shrink_with(trial, original, stock_generator(), config);
  ASSERT_TRUE(result.precursor);
  EXPECT_EQ(result.precursor->expect.subject, "wrist");
  EXPECT_EQ(result.precursor->spec, original.spec);
  EXPECT_EQ(result.precursor->provenance.index, 7);
  EXPECT_EQ(result.minimal.expect.subject, "elbow") << "shrinking keeps the family";
}

TEST(ShrinkPrimarySearch, LooksCloserOnlyAtWhatHasNoPrecursor) {
  PlantedMotion crowded({shown("wrist", 19, 20, 2.0)}), alone({});
  ShrinkConfig alone_config, search;
  search.search = PrimarySearch{};
  const int looked = shrink_with(crowded, preceded_elbow_case(), stock_generator(), alone_config).evaluations;
  EXPECT_LT(shrink_with(crowded, preceded_elbow_case(), stock_generator(), search).evaluations, looked);
  EXPECT_EQ(shrink_with(alone, preceded_elbow_case(), stock_generator(), search).evaluations, looked);
}

TEST(ShrinkPrimarySearch, BeginsWithTheSpecThatTheOtherCameTo) {
  PlantedMotion trial({});
  ShrinkConfig config;
  const Shrunk slow = shrink_with(trial, preceded_elbow_case(), stock_generator(), config);
  config.search = PrimarySearch{slow.minimal.spec, {}};
  const Shrunk quick = shrink_with(trial, preceded_elbow_case(), stock_generator(), config);
  EXPECT_EQ(quick.minimal.spec, slow.minimal.spec);
  EXPECT_EQ(quick.minimal.provenance.shrunk_from, spec_id(preceded_elbow_case().spec));
  EXPECT_LT(quick.evaluations, slow.evaluations);
}

// The deepest of each other family, as shrinking sees them.
std::vector<Case> others_of(const Case& stored) {
  const Result<Stage> stage = build_stage(stored.spec, small_runs::library());
  StageEvaluator evaluator;
  const Evaluation evaluation = evaluator.run(*stage);
  std::map<Family, Case> deepest;
  for (const Finding& finding : evaluation.findings) {
    const Case other{stored.spec, expectation_of(evaluator.execution(), evaluation, finding), {}};
    const auto [known, is_new] = deepest.try_emplace(family_of(other), other);
    if (!is_new && depth_of(known->second.expect) < depth_of(other.expect)) known->second = other;
  }
  std::vector<Case> others;
  for (const auto& [family, other] : deepest)
    if (family != family_of(stored)) others.push_back(other);
  return others;
}

class NamedRuns : public testing::Test {
 protected:
  static RunConfig config_of(std::int64_t cases) {
    RunConfig config = small_runs::config_of(cases, 2);
    config.draw.characters = {"human"};
    config.shrink.max_evaluations = 400;
    return config;
  }
  TempFolder folder_;
};

// Some cases form a cycle: shrunk for the first failure, the second is earlier and deeper, and vice versa.
TEST_F(NamedRuns, NoMinimalSpecShowsWhatWouldNameItUnlessItCameByThat) {
  const Corpus corpus = small_runs::create(folder_ / "corpus");
  const RunResult result = small_runs::run(config_of(12), corpus);
  small_runs::expect_all_replay_as_the_same(corpus);
  int whole = 0, renamed = 0, went_round = 0;
  for (const Bucket& bucket : small_runs::buckets_of(corpus)) {
    const Case min = *read_case(corpus.folder_of(bucket) + "/" + bucket.min);
    const auto& first = result.record.families.find(bucket.family);
    const bool was_wanted = first != result.record.families.end() &&
                            std::ranges::count(first->second.first_indices, min.provenance.index) > 0;
    renamed += !was_wanted;
    if (min.provenance.shrink_stopped != "fixpoint") continue;
    ++whole;
    const std::vector<Case> others = others_of(min);
    const Case* precursor = precursor_of(min, others);
    if (precursor == nullptr) continue;
    ++went_round;
    EXPECT_EQ(family_of(*precursor), min.provenance.met_shrinking) << bucket.family;
  }
  EXPECT_LT(20 * went_round, whole);
  EXPECT_GT(renamed, 0);
}

// With this seed a later failure of some case is covered by one that is named after it.
TEST_F(NamedRuns, AreTheSameInShards) {
  RunConfig config = config_of(5);
  config.seed = 9;
  small_runs::expect_shards_make_one_run(folder_, config, 2);
}

}  // namespace

}  // namespace contort
