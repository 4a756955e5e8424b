// Values that a program under test gives in addition to the pose.
#include <gtest/gtest.h>

#include "checks/judge.h"
#include "guest/guest_generator.h"
#include "process/ended.h"

namespace contort {
namespace {

constexpr char kTelling[] = "/usr/bin/python3 " CONTORT_SOURCE_DIR "/tests/guest/broken/channels.py";

Spec stand_and_break(const std::string& broken) {
  Spec spec;
  spec.character.name = "hero";
  ActionUse use;
  use.action = "stand", use.slot = "body", use.duration_frames = 20, use.params["breaks"] = broken;
  spec.sequences.push_back({"", 0, {{}}});
  spec.sequences[0].clips[0].actions = {use};
  return spec;
}

class GuestChannels : public ::testing::Test {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<GuestGenerator>> started = GuestGenerator::start(kTelling);
    ASSERT_TRUE(started) << to_line(started.issue());
    guest = std::move(started).value();
  }
  std::unique_ptr<GuestGenerator> guest;
};

TEST_F(GuestChannels, AreRunsOfWordsAndFlagsAndListsOfNumbers) {
  const Result<Execution> made = execute(*guest, stand_and_break("nothing"));
  ASSERT_TRUE(made) << to_line(made.issue());
  const int last = made->motion.frame_count - 1;
  const std::vector<ChannelRun> runs = {{"state", "wait", 0, 2}, {"state", "stand", 3, last}, {"stands", "", 3, 8}};
  EXPECT_EQ(made->foreign->runs, runs);
  ASSERT_EQ(made->foreign->numbers.size(), 1U);
  EXPECT_EQ(made->foreign->numbers[0].values, std::vector<double>(static_cast<std::size_t>(last) + 1, 0.5));
  EXPECT_EQ(made->foreign->contacts, (std::vector<ContactRun>{{0, 3, 8}}));
  EXPECT_TRUE(Judge().evaluate(*made).findings.empty());
}

TEST_F(GuestChannels, SayWhichJointMustNotSlide) {
  const Evaluation evaluation = Judge().evaluate(*execute(*guest, stand_and_break("contact")));
  ASSERT_EQ(evaluation.findings.size(), 1U);
  EXPECT_EQ(evaluation.findings[0].check, "contact_slide");
  EXPECT_NEAR(evaluation.findings[0].worst_margin, 0.02 - 0.05, 1e-9) << "from frame 3 to 8, 1 cm each";
}

TEST_F(GuestChannels, ThatAreNotAsDeclaredEndTheCase) {
  const std::pair<const char*, const char*> faults[] = {
      {"presence", "/channels/speed: the manifest declares the channel, and the reply does not have it"},
      {"count", "/channels/state: expected a list of 21 values, one for each frame"},
      {"type", "/channels/stands: found a value of another type than declared"}};
  for (const auto& [broken, text] : faults) try {
      (void)execute(*guest, stand_and_break(broken));
      ADD_FAILURE() << broken;
    } catch (const ProgramEnded& ended) {
      EXPECT_EQ(ended.ending().signal, kWrongChannels);
      EXPECT_NE(ended.ending().printed.find(text), std::string::npos) << ended.ending().printed;
    }
}

}  // namespace
}  // namespace contort
