#include "server/take_maker.h"

#include <gtest/gtest.h>

#include "model/character/library.h"
#include "tests/stage_evaluator.h"

namespace contort::server {
namespace {

Spec mech_spec() {
  Spec spec;
  spec.character.name = "mech", spec.rate_hz = 30;
  return spec;
}

struct Workshop {
  explicit Workshop(const Limits& limits)
      : engine(limits, {}, stock_generator(), CheckSettings{}, "contort test"), maker(engine, "somebody", "") {}
  Engine engine;
  TakeMaker maker;
};

TEST(TakeMaker, PlaysASpecInEachModeAndAddsUpTheTime) {
  Workshop workshop({.take_s = 0.5});
  const Result<PlayedTake> take = workshop.maker.take(3, mech_spec(), {Mode::kinematic, Mode::dynamic});
  ASSERT_TRUE(take) << to_line(take.issue());
  EXPECT_EQ(take->number, 3);
  ASSERT_EQ(take->played.size(), 2u);
  EXPECT_EQ(take->played.at(Mode::dynamic)->frame_count, 16);
  const double cpu_s = workshop.maker.cpu_s();
  EXPECT_GT(cpu_s, 0.0);
  ASSERT_TRUE(workshop.maker.model(mech_spec()));
  EXPECT_GT(workshop.maker.cpu_s(), cpu_s);
}

TEST(TakeMaker, RefusesMotionsOfTooManyBytes) {
  Workshop wide({.take_s = 0.1});
  EXPECT_TRUE(wide.maker.take(1, mech_spec(), {Mode::kinematic}));
  Workshop narrow({.take_s = 0.1, .frame_bytes = kJointBytes});
  const Result<PlayedTake> take = narrow.maker.take(1, mech_spec(), {Mode::kinematic});
  ASSERT_FALSE(take);
  EXPECT_EQ(take.issue().code, "take.too_long");
}

TEST(TakeMaker, ModelsSayHowTheRootIsTurnedAtRest) {
  Spec spec = mech_spec();
  spec.character.name = "quadruped";
  Workshop workshop({});
  const Result<PlayedModel> model = workshop.maker.model(spec);
  const Result<Character> character = build_character(spec.character, stock_library());
  ASSERT_TRUE(model && character);
  EXPECT_EQ(model->rest, character->rest_root().q);
}

}  // namespace
}  // namespace contort::server
