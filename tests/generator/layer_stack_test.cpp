// The layer stack by itself: a timeline of a few actions on one part, the queue's history by hand, and no figure.
#include "generator/layer_stack.h"

#include <gtest/gtest.h>

#include "generator/additive.h"

namespace contort {
namespace {

constexpr double kRate_hz = 60.0;

ActionDef def_of(Layer layer, Timing timing, Spread spread = Spread::own) {
  ActionDef def{};
  def.layer = layer, def.timing = timing, def.spread = spread;
  return def;
}
const ActionDef kKeyPose = def_of(Layer::overwrite, Timing::goal);
const ActionDef kReach = def_of(Layer::ik, Timing::goal);
const ActionDef kLook = def_of(Layer::ik, Timing::course);
const ActionDef kWalk = def_of(Layer::ik, Timing::course, Spread::legs);
const ActionDef kBlow = def_of(Layer::additive, Timing::course);

PlannedAction action(const ActionDef& def, int first_frame, int last_frame, double blend = 0.0) {
  PlannedAction planned;
  planned.def = &def;
  planned.start = planned.first_frame = first_frame, planned.end = planned.last_frame = last_frame;
  planned.blend_in = planned.blend_out = blend;
  return planned;
}

// One sequence on one part, played by a queue whose history is given by the test.
struct Scene {
  explicit Scene(std::vector<PlannedAction> actions, std::vector<QueueSpan> runs = {{0, 200, 0, 0}})
      : history(std::move(runs)) {
    timeline.actions = std::move(actions);
    timeline.part_order = {0};
    timeline.of_part.resize(1);
    for (int i = 0; i < static_cast<int>(timeline.actions.size()); ++i) timeline.of_part[0].push_back(i);
  }
  LevelPlay whole;
  Playback at_frame(int frame) const { return {timeline, history, whole, {}, kRate_hz, frame}; }
  LayerStack::Change advance(int frame, std::size_t part = 0) { return stack.advance(at_frame(frame), part, {}); }
  LayerStack::Change play_to(int frame) {
    LayerStack::Change change;
    for (int f = now; f <= frame; ++f) change = advance(f);
    now = frame + 1;
    return change;
  }

  Timeline timeline;
  std::vector<QueueSpan> history;
  LayerStack stack;
  int now = 0;
};

TEST(LayerStack, ALayerIsEmptyBeforeItsActionBeginsAndAfterItsLastFrame) {
  Scene scene({action(kLook, 10, 20)});
  EXPECT_EQ(scene.play_to(9), LayerStack::Change{});
  EXPECT_EQ(scene.stack.ik(), LayerHold{});
  EXPECT_TRUE(scene.play_to(10).ik_begins);
  EXPECT_EQ(scene.stack.ik().action, 0);
  EXPECT_EQ(scene.stack.ik().frame, 10);
  EXPECT_FALSE(scene.play_to(20).ik_begins);
  EXPECT_EQ(scene.stack.ik().action, 0);
  scene.play_to(21);
  EXPECT_EQ(scene.stack.ik().action, -1);
  EXPECT_EQ(scene.stack.ik().since_action, 0);
}

TEST(LayerStack, TheLaterActionTakesTheLayerAndTheEarlierOneDoesNotComeBack) {
  Scene scene({action(kKeyPose, 0, 60), action(kKeyPose, 20, 30)});
  scene.play_to(19);
  EXPECT_EQ(scene.stack.overwrite().action, 0);
  EXPECT_FALSE(scene.play_to(20).overwrite_begins);  // in its first frame an action has not moved yet
  EXPECT_TRUE(scene.play_to(21).overwrite_begins);
  EXPECT_EQ(scene.stack.overwrite().action, 1);
  scene.play_to(31);
  EXPECT_EQ(scene.stack.overwrite().action, -1);
}

TEST(LayerStack, LayersOfAPartAreIndependent) {
  Scene scene({action(kKeyPose, 0, 60), action(kLook, 20, 30)});
  scene.play_to(20);
  EXPECT_EQ(scene.stack.overwrite().action, 0);
  EXPECT_EQ(scene.stack.ik().action, 1);
}

TEST(LayerStack, IkThatEndsSettlesIntoTheBaseAndRestartsTheEasingOfTheKeyPoseBeneath) {
  Scene scene({action(kKeyPose, 0, 60), action(kReach, 10, 30)});
  scene.play_to(30);
  EXPECT_EQ(scene.stack.overwrite().eased, 0.0);
  EXPECT_TRUE(scene.play_to(31).settles);
  EXPECT_DOUBLE_EQ(scene.stack.overwrite().eased, ease(30.0 / 60.0));
  EXPECT_FALSE(scene.play_to(32).settles);
}

TEST(LayerStack, IkThatHasFadedOutLeavesTheBaseAsItIs) {
  Scene scene({action(kLook, 10, 30, 8.0)});
  scene.play_to(30);
  EXPECT_EQ(left_of(scene.at_frame(30), scene.stack.ik()), 0.0);
  EXPECT_FALSE(scene.play_to(31).settles);
}

TEST(LayerStack, IkFollowsIkFromWhatWasShownWithoutSettling) {
  Scene scene({action(kReach, 0, 40), action(kReach, 20, 40)});
  scene.play_to(20);
  const LayerStack::Change change = scene.play_to(21);
  EXPECT_TRUE(change.ik_begins && change.ik_follows);
  EXPECT_FALSE(change.settles);
}

TEST(LayerStack, IkThatEndsWhereTheNextBeginsSettlesAsIfNoneFollowed) {
  Scene scene({action(kReach, 0, 19), action(kReach, 20, 40)});
  scene.play_to(19);
  const LayerStack::Change change = scene.play_to(20);
  EXPECT_TRUE(change.ik_begins && change.settles);
  EXPECT_FALSE(change.ik_follows);
}

TEST(LayerStack, TheWayIsCoveredAtTheEndHoweverFarTheEasingWasAtTheTakeOver) {
  // Cut in its middle by an interrupt of 10 frames: a goal that continues at content frame 20 of 40.
  Scene scene({action(kReach, 0, 40)}, {{0, 20, 0, 0}});
  scene.play_to(20);
  scene.history[0].last_frame = 20;
  scene.now = 21;
  scene.play_to(29);
  EXPECT_EQ(scene.stack.ik().action, -1);
  scene.history.push_back({30, 60, 0, 20});
  EXPECT_TRUE(scene.play_to(30).ik_begins);
  EXPECT_DOUBLE_EQ(scene.stack.ik().came, 20.0);
  EXPECT_DOUBLE_EQ(scene.stack.ik().eased, ease(19.0 / 40.0));
  double before = 0.0;
  for (int frame = 30; frame <= 50; ++frame) {
    scene.play_to(frame);
    const double share = covered(scene.at_frame(frame), scene.stack.ik());
    EXPECT_GT(share, before) << frame;
    before = share;
  }
  EXPECT_DOUBLE_EQ(before, 1.0);
}

TEST(LayerStack, ACourseOfLegsThatFollowsLegsPlacesTheFeetAtOnceAndTheRootBlends) {
  Scene scene({action(kWalk, 0, 60, 10.0)});
  LayerStack foot;
  scene.advance(0);
  foot.advance(scene.at_frame(0), 0, {});
  EXPECT_FALSE(places_foot(scene.at_frame(0), scene.stack.ik(), 0));
  LayerStack leg;
  scene.timeline.part_order = {0, 1};
  scene.timeline.of_part = {{0}, {0}};
  leg.advance(scene.at_frame(0), 1, scene.stack.ik());
  EXPECT_TRUE(places_foot(scene.at_frame(0), leg.ik(), 1));

  // A key pose has bent the leg before, so it approaches the course step by step.
  Scene bent({action(kKeyPose, 0, 5), action(kWalk, 10, 60, 10.0)});
  bent.timeline.part_order = {0, 1};
  bent.timeline.of_part = {{}, {0, 1}};
  LayerStack bent_leg;
  LayerStack::Change change;
  for (int frame = 0; frame <= 10; ++frame) change = bent_leg.advance(bent.at_frame(frame), 1, {});
  EXPECT_EQ(bent_leg.ik().action, 1);
  EXPECT_TRUE(change.returns);
}

TEST(LayerStack, ALegReturnsToTheCourseOfTheRootWhenItsOwnActionEndsOrFades) {
  for (const double fade : {0.0, 8.0}) {
    Scene scene({action(kWalk, 0, 60), action(kReach, 10, 30, fade)});
    scene.timeline.actions[1].use = scene.timeline.actions[0].use + 1;
    scene.timeline.part_order = {0, 1};
    scene.timeline.of_part = {{0}, {0, 1}};
    LayerStack leg;
    for (int frame = 0; frame <= 60; ++frame) {
      const Playback playback = scene.at_frame(frame);
      scene.stack.advance(playback, 0, {});
      const LayerStack::Change change = leg.advance(playback, 1, scene.stack.ik());
      EXPECT_EQ(change.returns, frame == (fade > 0.0 ? 23 : 31)) << frame;
      EXPECT_EQ(leg.ik().action, frame > 10 && frame < (fade > 0.0 ? 23 : 31) ? 1 : 0) << frame;
    }
  }
}

TEST(LayerStack, ACourseThatWaitsForAFrameComesInFromItsBegin) {
  Scene scene({action(kWalk, 0, 60), action(kWalk, 20, 60, 1.0)});
  scene.play_to(21);
  EXPECT_EQ(scene.stack.ik().action, 1);
  EXPECT_EQ(come_in(scene.at_frame(21), scene.stack.ik()), 0.0);
}

TEST(AdditiveWeight, ACutAdditiveFadesOutWithinItsFadeAndInAgainWhereItGoesOn) {
  const Scene scene({action(kBlow, 0, 100)}, {{0, 50, 0, 0}, {80, 200, 0, 50}});
  const PlannedAction& blow = scene.timeline.actions[0];
  const auto weight = [&](int frame, std::size_t run) {
    return additive_weight(scene.at_frame(frame), blow, scene.history[run]);
  };
  const int fade = cut_fade_frames(kRate_hz);
  ASSERT_EQ(fade, 9);
  EXPECT_EQ(weight(50, 0), 1.0);
  for (int frame = 51; frame < 50 + fade; ++frame) EXPECT_LT(*weight(frame, 0), *weight(frame - 1, 0)) << frame;
  EXPECT_EQ(weight(50 + fade, 0), 0.0);
  EXPECT_EQ(weight(80, 1), 0.0);
  EXPECT_GT(*weight(84, 1), 0.0);
  for (int frame = 80 + fade; frame <= 130; ++frame) EXPECT_EQ(weight(frame, 1), 1.0) << frame;
  EXPECT_EQ(weight(131, 1), std::nullopt);  // over: content frame 101
}

}  // namespace
}  // namespace contort
