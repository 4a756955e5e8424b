// The labels that are counted of a case: by example.
#include "fuzz/labels.h"

#include <algorithm>

#include "fuzz/draw.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

std::vector<std::string> labels_of_scene(std::vector<SequenceDesc> sequences) {
  Spec spec;
  spec.sequences = std::move(sequences);
  const Result<Execution> execution = execute(stock_generator(), spec);
  if (!execution) throw std::logic_error(to_line(execution.issue()));
  return labels_of(spec, stock_generator(), *execution);
}

std::int64_t times(const std::vector<std::string>& labels, const std::string& label) {
  return std::ranges::count(labels, label);
}

ActionUse elbow(int start_frame, int duration_frames) { return fixtures::elbow(start_frame, duration_frames, 40.0); }

TEST(Labels, AnActionCountsOnceForEachUseAndOnceForEachPhaseOfIt) {
  ActionUse look = use("look_at", "head", 0, 40, {{"target_m", Vec3(1, 1.5, 2)}});
  look.blend_in_frames = 8;
  const auto labels = labels_of_scene({sequence({elbow(0, 30), elbow(50, 30), look})});
  EXPECT_EQ(times(labels, "action pose (overwrite) on arm_left"), 2);
  EXPECT_EQ(times(labels, "action pose (overwrite) on arm_left in mid_clip"), 2);
  EXPECT_EQ(times(labels, "action pose (overwrite) on arm_left in impact"), 0);
  EXPECT_EQ(times(labels, "action look_at (ik) on head in blend"), 1);
  EXPECT_EQ(times(labels, "character human"), 1);
  EXPECT_EQ(times(labels, "ground plane"), 1);
}

// The one ends in the frame in which the other begins: they have never moved the arm together.
TEST(Labels, ActionsThatOnlyTouchAreNoPair) {
  const std::string pair = "pair pose + pose on arm_left";
  EXPECT_EQ(times(labels_of_scene({sequence({elbow(0, 30), elbow(30, 30)})}), pair), 0);
  EXPECT_EQ(times(labels_of_scene({sequence({elbow(0, 30), elbow(29, 30)})}), pair), 1);
  EXPECT_EQ(times(labels_of_scene({sequence({elbow(0, 30), elbow(40, 30)})}), pair), 0);
}

TEST(Labels, WhatIsCountedIsAmongWhatIsPossible) {
  const std::set<std::string> of_human = possible_labels(stock_generator(), *fixtures::shared_human());
  EXPECT_TRUE(of_human.contains("action pose (overwrite) on arm_left"));
  EXPECT_TRUE(of_human.contains("pair look_at + look_at on head"));
  EXPECT_FALSE(of_human.contains("action walk (ik) on head"));
  Profile plain;
  plain.swaps = plain.objects = 0.0;
  int seen = 0;
  for (int i = 0; i < 40; ++i) {
    const Spec spec = draw_spec({{"human"}, plain}, stock_generator(), 1, i);
    const Result<Execution> execution = execute(stock_generator(), spec);
    ASSERT_TRUE(execution) << to_line(execution.issue());
    for (const std::string& label : labels_of(spec, stock_generator(), *execution)) {
      const bool is_use = label.starts_with("action ") || label.starts_with("pair ");
      if (!is_use) continue;
      EXPECT_TRUE(of_human.contains(label.substr(0, label.find(" in ")))) << label;
      ++seen;
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(Labels, NameEachUnmetRequestOnceWithItsReason) {
  Spec spec;
  spec.sequences = {sequence({elbow(0, 20)})};
  Execution execution = execute(stock_generator(), spec).value();
  const int arm = execution.character->find_part("arm_left"), leg = execution.character->find_part("leg_left");
  execution.intent.emplace().unmet = {{0, 3, leg, "reach", Shortfall::clearance},
                                      {0, 3, arm, "reach", Shortfall::out_of_reach},
                                      {9, 12, arm, "reach", Shortfall::out_of_reach}};
  EXPECT_EQ(unmet_labels(execution), (std::vector<std::string>{"reach on arm_left: out_of_reach",
                                                               "reach on leg_left: clearance"}));
  execution.intent.reset();
  EXPECT_TRUE(unmet_labels(execution).empty()) << "a generator without an intent says nothing of it";
}

}  // namespace
}  // namespace contort
