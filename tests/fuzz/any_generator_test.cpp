// Everything above the interface works with any generator: drawing, checks, shrinking, the corpus, replay, the report.
#include <gtest/gtest.h>

#include "corpus/replay.h"
#include "fuzz/draw.h"
#include "fuzz/labels.h"
#include "fuzz/run.h"
#include "renders/case_data.h"
#include "tests/checks/family_text.h"
#include "tests/corpus/temp_folder.h"
#include "tests/fuzz/small_runs.h"
#include "tests/swing_generator.h"

namespace contort {
namespace {

using swing::SwingGenerator;

RunConfig config_of_swings() {
  RunConfig config = small_runs::config_of(40, 2);
  config.draw.characters = {"pendulum"};
  config.shrink.max_evaluations = 200;
  return config;
}

RunResult run_swings(const Corpus& corpus) {
  SwingGenerator generator;
  return run_fuzz(
      config_of_swings(), generator, corpus, [](const RunProgress&) {}, [] { return false; });
}

TEST(AnyGenerator, IsAskedForNothingThatItsManifestDoesNotOffer) {
  SwingGenerator generator;
  int actions = 0;
  for (int i = 0; i < 200; ++i) {
    const Spec spec = draw_spec({{"pendulum"}}, generator, 3, i);
    EXPECT_TRUE(spec.interrupts.empty());
    EXPECT_EQ(spec.environment, EnvironmentDesc{});
    EXPECT_EQ(spec.dynamics, DynamicsDesc{});
    for (const SequenceDesc& sequence : spec.sequences)
      for (const ClipDesc& clip : sequence.clips)
        for (const ActionUse& use : clip.actions) {
          EXPECT_EQ(use.action, "swing");
          EXPECT_LE(std::abs(std::get<double>(use.params.at("angle_deg"))), 120.0);
          ++actions;
        }
  }
  EXPECT_GT(actions, 400);
}

TEST(AnyGenerator, IsCountedByWhatItsSpecsAreMadeOf) {
  SwingGenerator generator;
  const Spec spec = draw_spec({{"pendulum"}}, generator, 3, 1);
  const Result<Execution> execution = execute(generator, spec);
  ASSERT_TRUE(execution) << to_line(execution.issue());
  const std::vector<std::string> labels = labels_of(spec, generator, *execution);
  EXPECT_NE(std::ranges::find(labels, "action swing (overwrite) on body"), labels.end());
  EXPECT_TRUE(possible_labels(generator, *execution->character).contains("pair swing + swing on body"));
}

TEST(AnyGenerator, IsSearchedShrunkStoredAndReplayed) {
  const TempFolder folder;
  const Corpus corpus = small_runs::create(folder / "corpus");
  const RunResult result = run_swings(corpus);
  EXPECT_FALSE(result.new_buckets.empty());
  SwingGenerator generator;
  Evaluator evaluator(generator);
  for (const Bucket& bucket : small_runs::buckets_of(corpus)) {
    const Result<Case> stored = read_case(corpus.folder_of(bucket) + "/" + bucket.min);
    ASSERT_TRUE(stored) << to_line(stored.issue());
    EXPECT_EQ(replay(*stored, evaluator).verdict, Verdict::same) << bucket.family;
    EXPECT_TRUE(stored->expect.phase.empty()) << "a phase is the generator's to say";
    ASSERT_EQ(stored->spec.sequences.size(), 1U);
    ASSERT_EQ(stored->spec.sequences[0].clips.size(), 1U);
    EXPECT_EQ(stored->spec.sequences[0].clips[0].actions.size(), 1U) << "one swing in one frame is enough";
  }
}

TEST(AnyGenerator, IsShownInTheReport) {
  const TempFolder folder;
  const Corpus corpus = small_runs::create(folder / "corpus");
  run_swings(corpus);
  SwingGenerator generator;
  const Bucket bucket = small_runs::buckets_of(corpus).front();
  const Result<Case> stored = read_case(corpus.folder_of(bucket) + "/" + bucket.min);
  ASSERT_TRUE(stored) << to_line(stored.issue());
  const ShownCase shown[] = {{"minimal", *stored}};
  const Result<std::string> data = case_data("key", shown, generator, {});
  ASSERT_TRUE(data) << to_line(data.issue());
  EXPECT_NE(data->find("\"spans\":[]"), std::string::npos);
  EXPECT_NE(data->find("\"check\":\"" + bucket.check + "\""), std::string::npos);
}

TEST(AnyGenerator, ThatRefusesALibraryKeepsItsOwn) {
  EXPECT_EQ(SwingGenerator().with(stock_library()).issue().code, "generator.own_characters");
}

}  // namespace
}  // namespace contort
