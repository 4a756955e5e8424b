// The built-in generator behind the protocol makes the motions that it makes in the process.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "checks/judge.h"
#include "fuzz/draw.h"
#include "generator/built_in.h"
#include "guest/described.h"
#include "guest/guest_generator.h"

namespace contort {
namespace {

constexpr char kBuiltIn[] = CONTORT_BINARY_DIR "/contort guest-builtin --character ";
constexpr double kSame = 1e-9;  // angles are converted to quaternions and back

class BuiltInGuest : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<GuestGenerator>> started = GuestGenerator::start(kBuiltIn + std::string(GetParam()));
    ASSERT_TRUE(started) << to_line(started.issue());
    guest = std::move(started).value();
  }

  // Specs with one clip, because the protocol has one time line without clips or sequences.
  std::vector<Spec> drawn(std::size_t count) {
    std::vector<Spec> specs;
    for (int i = 0; i < 4000 && specs.size() < count; ++i) {
      const Spec spec = draw_spec({{GetParam()}}, *guest, 11, i);
      if (spec.sequences.size() == 1 && spec.sequences[0].clips.size() == 1) specs.push_back(spec);
    }
    return specs;
  }

  std::unique_ptr<GuestGenerator> guest;
  BuiltInGenerator here{stock_library()};
};

// The coordinates of a ball are a quaternion, whose sign does not matter.
double difference(const Joint& joint, const double* a, const double* b) {
  if (joint.kind != JointKind::ball) return std::fabs(a[0] - b[0]);
  return rotation_angle(glm::conjugate(quat_at(a)) * quat_at(b));
}

std::set<std::string> found_in(const Execution& made, const std::set<std::string>& checks) {
  std::set<std::string> found;
  for (const Finding& finding : Judge().evaluate(made).findings)
    if (checks.contains(finding.check)) found.insert(finding.check + " " + finding.subject);
  return found;
}

std::set<std::string> judged_in(const Execution& made) {
  std::set<std::string> checks;
  for (const JudgedCheck& judged : Judge().evaluate(made).judged) checks.insert(std::string(judged.check));
  return checks;
}

TEST_P(BuiltInGuest, MakesTheSameMotionsAndFindingsAsInTheProcess) {
  const std::vector<Spec> specs = drawn(40);
  ASSERT_EQ(specs.size(), 40U);
  std::size_t moving = 0;
  for (const Spec& spec : specs) {
    const Result<Execution> there = execute(*guest, spec), same = execute(here, spec);
    ASSERT_TRUE(there) << to_line(there.issue());
    ASSERT_TRUE(same) << to_line(same.issue());
    ASSERT_EQ(there->motion.frame_count, same->motion.frame_count);
    const std::span<const Joint> joints = there->character->joints();
    ASSERT_EQ(joints.size(), same->character->joints().size());
    double greatest = 0.0;
    for (int frame = 0; frame < there->motion.frame_count; ++frame)
      for (std::size_t j = 1; j < joints.size(); ++j) {
        ASSERT_EQ(joints[j].name, same->character->joints()[j].name);
        const double* one = there->motion.row(frame).data() + joints[j].coord;
        const double* other = same->motion.row(frame).data() + joints[j].coord;
        greatest = std::max(greatest, difference(joints[j], one, other));
      }
    EXPECT_LT(greatest, kSame);
    moving += there->motion.row(0)[0] != there->motion.row(there->motion.frame_count / 2)[0] ? 1 : 0;
    std::set<std::string> both = judged_in(*there);
    const std::set<std::string> ours = judged_in(*same);
    std::erase_if(both, [&](const std::string& check) { return !ours.contains(check); });
    EXPECT_GE(both.size(), 8U);
    EXPECT_EQ(found_in(*there, both), found_in(*same, both));
  }
  EXPECT_GT(moving, 5U);
}

TEST_P(BuiltInGuest, DescribesItselfInAManifestThatIsRead) {
  const Result<GuestManifest> described = describe(here, std::vector<std::string>{GetParam()});
  ASSERT_TRUE(described) << to_line(described.issue());
  const Result<GuestManifest> read = parse_manifest(print_manifest(*described));
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_EQ(*read, *described);
}

INSTANTIATE_TEST_SUITE_P(Stock, BuiltInGuest, ::testing::Values("human", "quadruped"));

}  // namespace
}  // namespace contort
