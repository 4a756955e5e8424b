// Generators that are programs of their own: requests, promises, and every way to break the protocol.
#include "guest/guest_generator.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "checks/judge.h"
#include "fuzz/draw.h"
#include "process/ended.h"

namespace contort {
namespace {

std::string broken(const std::string& name) { return "/usr/bin/python3 " CONTORT_SOURCE_DIR "/tests/guest/broken/" + name + ".py"; }

std::unique_ptr<GuestGenerator> started(const std::string& command) {
  Result<std::unique_ptr<GuestGenerator>> generator = GuestGenerator::start(command, {30.0, 2.0});
  if (!generator) ADD_FAILURE() << to_line(generator.issue());
  return generator ? std::move(generator).value() : nullptr;
}

// One use, or several one after another.
Spec swings(std::vector<std::pair<int, double>> starts_and_angles) {
  Spec spec;
  spec.character.name = "hero";
  ClipDesc clip;
  for (const auto& [start, angle_deg] : starts_and_angles) {
    ActionUse use;
    use.action = "swing", use.slot = "body", use.start_frame = start, use.duration_frames = 60;
    use.params["angle_deg"] = angle_deg;
    clip.actions.push_back(use);
  }
  spec.sequences.push_back({"", 0, {clip}});
  return spec;
}

TEST(Guests, MakeTheMotionThatIsAskedFor) {
  const auto guest = started(broken("good"));
  ASSERT_NE(guest, nullptr);
  const Result<Execution> made = execute(*guest, swings({{0, 60.0}}));
  ASSERT_TRUE(made) << to_line(made.issue());
  EXPECT_EQ(made->motion.frame_count, 61);
  EXPECT_NEAR(rotation_angle(made->motion.root[30].q), 60.0 * kRadPerDeg, 1e-9);
  EXPECT_TRUE(Judge().evaluate(*made).findings.empty());
}

TEST(Guests, RefuseSpecsThatTheyCannotPlay) {
  const auto guest = started(broken("good"));
  ASSERT_NE(guest, nullptr);
  const auto refusal = [&](const Spec& spec) {
    const Result<Admission> admitted = guest->admit(spec);
    return admitted ? "" : admitted.issue().code + " at " + admitted.issue().pointer;
  };
  Spec spec = swings({{0, 60.0}});
  EXPECT_EQ(refusal(spec), "");
  spec.sequences[0].clips[0].actions[0].params["angle_deg"] = 61.0;
  EXPECT_EQ(refusal(spec), "guest.bad_param at /sequences/0/clips/0/actions/0/params/angle_deg");
  spec = swings({{0, 60.0}}), spec.sequences[0].clips[0].actions[0].params["speed"] = 1.0;
  EXPECT_EQ(refusal(spec), "guest.unknown_param at /sequences/0/clips/0/actions/0/params/speed");
  spec = swings({{0, 60.0}}), spec.sequences[0].clips[0].actions[0].duration_frames = 500;
  EXPECT_EQ(refusal(spec), "guest.bad_duration at /sequences/0/clips/0/actions/0/duration_frames");
  spec = swings({{0, 60.0}}), spec.sequences[0].clips[0].actions[0].action = "jump";
  EXPECT_EQ(refusal(spec), "guest.unknown_action at /sequences/0/clips/0/actions/0/action");
  spec = swings({{0, 60.0}}), spec.sequences[0].clips[0].speed = 2.0;
  EXPECT_EQ(refusal(spec), "guest.unsupported at /sequences/0/clips/0/speed");
  spec = swings({{0, 60.0}}), spec.character.name = "villain";
  EXPECT_EQ(refusal(spec), "character.unknown_character at /character/name");
  spec = swings({{0, 60.0}}), spec.start.heading_deg = 90.0;
  EXPECT_EQ(refusal(spec), "guest.unsupported at /start");
}

TEST(Guests, BuildAllSpecsThatAreDrawnForThem) {
  const auto guest = started(broken("good"));
  ASSERT_NE(guest, nullptr);
  for (int index = 0; index < 200; ++index) {
    const Spec spec = draw_spec({{"hero"}}, *guest, 3, index);
    const Result<Admission> admitted = guest->admit(spec);
    ASSERT_TRUE(admitted) << to_line(admitted.issue()) << "\n" << print_spec(spec);
  }
}

// The ending of a broken program, as findings describe it.
std::string ending_of(const std::string& name) {
  const auto guest = started(broken(name));
  if (guest == nullptr) return "";
  try {
    for (int i = 0; i < 20; ++i) (void)execute(*guest, swings({{0, 55.0}, {70, -55.0}}));
    for (int i = 0; i < 60; ++i) (void)execute(*guest, draw_spec({{"hero"}}, *guest, 5, i));
  } catch (const ProgramEnded& ended) {
    return ended.ending().kind == Ending::Kind::timeout ? "timeout" : ended.ending().signal;
  }
  return "";
}

TEST(Guests, ThatBreakTheProtocolEndTheCase) {
  EXPECT_EQ(ending_of("good"), "");
  EXPECT_EQ(ending_of("banner"), "no JSON");
  EXPECT_EQ(ending_of("frame_count"), "wrong length");
  EXPECT_EQ(ending_of("crash"), "exit 1");
  EXPECT_EQ(ending_of("hang"), "timeout");
}

TEST(Guests, ThatDoNotStartSayWhy) {
  const auto refusal = [](const std::string& command) {
    return to_line(GuestGenerator::start(command, {5.0, 2.0}).issue());
  };
  EXPECT_EQ(refusal("exec /no/such/program").find("generator.ended: the generator ended before its manifest: exit 127"), 0U);
  EXPECT_NE(refusal("echo oops >&2; exit 3").find("exit 3; it printed: oops"), std::string::npos);
  EXPECT_EQ(refusal("echo '{\"contort\":1}'; cat").find("generator.missing_field: \"name\" is required"), 0U);
}

TEST(Guests, MayLogBeforeTheirManifest) {
  EXPECT_NE(started("(echo Engine 3.2; exec " + broken("good") + ")"), nullptr);
}

}  // namespace
}  // namespace contort
