// The edits by which shrinking takes things out of a spec.
#include "fuzz/edits.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fuzz/draw.h"
#include "model/character/library.h"
#include "tests/corpus/sample_cases.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

Spec drawn() {
  return draw_spec({{"human", "mech"}}, stock_generator(), *rc::gen::inRange(0, 100), *rc::gen::inRange(0, 1000));
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

TEST(Edits, KindsGoFromCoarseToFine) {
  std::vector<std::string> names;
  for (const UnitKind& kind : unit_kinds()) names.push_back(kind.name);
  const std::vector<std::string> expected = {"sequences", "interrupts", "clips",       "actions", "impacts",
                                             "loads",     "obstacles",  "attachments", "swaps",   "params"};
  EXPECT_EQ(names, expected);
}

TEST(Edits, ASpecWithoutAnythingHasNothingToRemove) {
  for (const UnitKind& kind : unit_kinds()) EXPECT_EQ(kind.count(Spec{}), 0) << kind.name;
}

}  // namespace

}  // namespace contort
