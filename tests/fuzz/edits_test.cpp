// The edits that shrinking is made of.
#include "fuzz/edits.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "fuzz/draw.h"
#include "generator/character/library.h"
#include "tests/corpus/sample_cases.h"

namespace contort {

namespace {

Spec drawn() {
  return draw_spec({{"human", "mech"}}, stock_library(), *rc::gen::inRange(0, 100), *rc::gen::inRange(0, 1000));
}

RC_GTEST_PROP(Edits, RemovingUnitsLowersTheirNumberByThatMany, ()) {
  const Spec spec = drawn();
  for (const UnitKind& kind : unit_kinds()) {
    const int count = kind.count(spec);
    const int first = *rc::gen::inRange(0, count + 1);
    const int chunk = *rc::gen::inRange(0, count - first + 1);
    Spec smaller = spec;
    kind.remove(smaller, first, chunk);
    RC_ASSERT(kind.count(smaller) == count - chunk);
    if (chunk == 0) RC_ASSERT(smaller == spec);
  }
}

RC_GTEST_PROP(Edits, RemovingOneByOneIsRemovingAtOnce, ()) {
  const Spec spec = drawn();
  for (const UnitKind& kind : unit_kinds()) {
    const int count = kind.count(spec);
    const int first = *rc::gen::inRange(0, count + 1);
    const int chunk = *rc::gen::inRange(0, count - first + 1);
    Spec at_once = spec, one_by_one = spec;
    kind.remove(at_once, first, chunk);
    for (int i = 0; i < chunk; ++i) kind.remove(one_by_one, first, 1);
    RC_ASSERT(at_once == one_by_one);
  }
}

RC_GTEST_PROP(Edits, RemovingPastTheEndRemovesWhatThereIs, ()) {
  const Spec spec = drawn();
  for (const UnitKind& kind : unit_kinds()) {
    Spec smaller = spec;
    kind.remove(smaller, 0, kind.count(spec) + 5);
    RC_ASSERT(kind.count(smaller) == 0);
    kind.remove(smaller, 3, 2);
    RC_ASSERT(kind.count(smaller) == 0);
  }
}

RC_GTEST_PROP(Edits, EveryNumberCanBeReadAndSetAlone, ()) {
  const Spec spec = drawn();
  const std::vector<NumberRef> numbers = numbers_of(spec);
  if (numbers.empty()) return;
  const std::size_t one = *rc::gen::inRange<std::size_t>(0, numbers.size());
  Spec changed = spec;
  numbers[one].at(changed) += 1000.0;
  RC_ASSERT(changed != spec);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    Spec copy = spec;
    RC_ASSERT(numbers[i].at(changed) == numbers[i].at(copy) + (i == one ? 1000.0 : 0.0));
  }
}

RC_GTEST_PROP(Edits, DefaultsAreReachedByApplyingAllEdits, ()) {
  Spec spec = drawn();
  spec.rate_hz = 30;
  spec.sequences[0].name = spec.sequences[0].clips[0].name = "named";
  spec.sequences[0].duration_frames = 77;
  for (const Edit& edit : default_edits(spec)) edit(spec);
  RC_ASSERT(spec.hold_frames == 0 && spec.rate_hz == 60.0);
  for (const SequenceDesc& sequence : spec.sequences) {
    RC_ASSERT(sequence.name.empty() && sequence.duration_frames == 0);
    for (const ClipDesc& clip : sequence.clips) {
      RC_ASSERT(clip == (ClipDesc{"", 0, 0, 1.0, clip.actions}));
      for (const ActionUse& use : clip.actions)
        RC_ASSERT(use.start_frame == 0 && use.duration_frames == 30 && use.speed == 1.0);
    }
  }
}

TEST(Edits, EveryEditStandsOnItsOwnAndAfterAllOthers) {
  Spec spec = spec_of({pose_use("arm_right", {{"elbow_deg", 80.0}})});
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.loads = {{"torso", "back", {}, {}, 3.0}};
  spec.dynamics.impacts = {{3, "head", "", {}, {1, 2, 3}}, {9, "torso", "", {}, {3, 2, 1}}};
  Spec all = spec;
  for (const Edit& edit : default_edits(spec)) edit(all);
  EXPECT_EQ(all.dynamics.loads.size() + all.dynamics.impacts.size(), 0U);
  EXPECT_EQ(all.dynamics.ticks_per_frame, 0);
}

TEST(Edits, KindsGoFromCoarseToFine) {
  std::vector<std::string> names;
  for (const UnitKind& kind : unit_kinds()) names.push_back(kind.name);
  const std::vector<std::string> expected = {"interrupts", "sequences", "clips", "actions", "impacts",
                                             "loads", "attachments", "swaps", "params"};
  EXPECT_EQ(names, expected);
}

TEST(Edits, NumbersOfAPoseAreOnTheLatticesOfTheirUnits) {
  Spec spec =
      spec_of({pose_use("arm_right", {{"elbow_deg", 80.0}, {"extend_m", 0.3}, {"shoulder_deg", Vec3(1, 2, 3)}})});
  std::multiset<double> steps, values;
  for (const NumberRef& number : numbers_of(spec)) {
    steps.insert(number.steps_per_unit);
    values.insert(number.at(spec));
    EXPECT_EQ(number.preset, 0.0);
  }
  EXPECT_EQ(steps, (std::multiset<double>{1, 1, 1, 1, 100}));
  EXPECT_EQ(values, (std::multiset<double>{0.3, 1, 2, 3, 80}));
}

TEST(Edits, ASpecWithoutAnythingHasNothingToRemove) {
  for (const UnitKind& kind : unit_kinds()) EXPECT_EQ(kind.count(Spec{}), 0) << kind.name;
  EXPECT_TRUE(numbers_of(Spec{}).empty());
}

}  // namespace

}  // namespace contort
