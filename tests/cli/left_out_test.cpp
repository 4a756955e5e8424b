// A large turn that a character cannot make is named before all findings.
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/import/rigged_model.h"

namespace contort {
namespace {

TEST(LeftOut, LargeTurnsAreWarnedOfBeforeTheFindings) {
  constexpr int kLeftFoot = 10;  // its node; an ankle has no axis for a turn about the vertical
  fixtures::GlbBuilder b = fixtures::rigged(fixtures::person());
  b.root["animations"] = {{{"name", "turn"}}};
  const std::vector<float> values = {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.5F, 0.0F, 0.8660254F};
  b.add_channel(0, kLeftFoot, "rotation", b.add_scalars({0.0F, 1.0F}), b.add_vec4(values), "LINEAR");
  const TempFolder folder;
  const auto bytes = b.glb();
  spill(folder / "someone.glb", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  ASSERT_EQ(contort_program({"import", folder / "someone.glb", "-o", folder / "lib"}).code, 0);
  const Ran ran = contort_program({"--library", folder / "lib", "check", folder / "someone.glb", "--character", "someone"});
  const std::size_t clip = ran.out.find("clip turn: ");
  ASSERT_NE(clip, std::string::npos) << ran.out << ran.err;
  EXPECT_TRUE(ran.out.substr(ran.out.find('\n', clip)).starts_with("\n  WARNING: LeftFoot turns by up to 60.0 deg about an axis "))
      << ran.out;
  EXPECT_EQ(ran.out.find("left out: 60.0 deg"), std::string::npos) << ran.out;
}

}  // namespace
}  // namespace contort
