// Specs that are drawn for figures of any size can be built: they have limits of their own.
#include <gtest/gtest.h>

#include "fuzz/draw.h"
#include "generator/stage.h"
#include "tests/import/rigged_model.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

TEST(ImportedFuzz, EverySpecOfAGiantBuilds) {
  ImportOptions options;
  options.name = "figure";
  options.height_m = 25.0;  // arms of 10 m, 200 tonnes
  const Result<Imported> in = fixtures::imported(fixtures::rigged(fixtures::person()), options);
  ASSERT_TRUE(in.ok()) << to_line(in.issue());
  const Library library = fixtures::library_of(*in);
  BuiltInGenerator generator(library);
  int moved_by_forces = 0;
  for (int index = 0; index < 400; ++index) {
    const Spec spec = draw_spec({{"figure"}}, generator, 3, index);
    moved_by_forces += spec.dynamics.mode != Mode::kinematic;
    const Result<Spec> read = parse_spec(pretty_spec(spec));
    ASSERT_TRUE(read.ok()) << index << ": " << to_line(read.issue());
    const Result<Stage> stage = build_stage(spec, library);
    ASSERT_TRUE(stage.ok()) << index << ": " << to_line(stage.issue());
  }
  EXPECT_GT(moved_by_forces, 5);
}

}  // namespace
}  // namespace contort
