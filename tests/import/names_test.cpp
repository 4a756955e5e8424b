#include "import/names.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace contort {
namespace {

TEST(BoneNames, AreUnderstoodInTheDialectsOfTools) {
  const struct {
    const char* name;
    BoneFamily family;
    Side side;
  } rows[] = {{"mixamorig:LeftForeArm", BoneFamily::forearm, Side::left},
              {"LeftUpLeg", BoneFamily::thigh, Side::left},
              {"calf.r", BoneFamily::shank, Side::right},
              {"upperarm_l", BoneFamily::upper_arm, Side::left},
              {"b_RightHand_08", BoneFamily::hand, Side::right},
              {"Skeleton_arm_joint_L__4_", BoneFamily::arm, Side::left},
              {"r-thigh", BoneFamily::thigh, Side::right},
              {"Bip01 L Toe0", BoneFamily::toe, Side::left},
              {"hip_L", BoneFamily::thigh, Side::left},
              {"hips", BoneFamily::hips, Side::center},
              {"Shoulder.R", BoneFamily::clavicle, Side::right},
              {"Shoulders", BoneFamily::spine, Side::center},
              {"spine_02", BoneFamily::spine, Side::center},
              {"Tail03_014", BoneFamily::tail, Side::center},
              {"ring_01.l", BoneFamily::finger, Side::left},
              {"lfemur", BoneFamily::thigh, Side::left},
              {"rhumerus", BoneFamily::upper_arm, Side::right},
              {"lhipjoint", BoneFamily::unknown, Side::left},
              {"rhino", BoneFamily::unknown, Side::center},
              {"DEF-shin.L.001", BoneFamily::shank, Side::left},
              {"Front_Leg_Upper_R", BoneFamily::thigh, Side::right},
              {"Back_Leg_Pelvis_L", BoneFamily::unknown, Side::left},
              {"Armature", BoneFamily::unknown, Side::center},
              {"spring", BoneFamily::unknown, Side::center},
              {"", BoneFamily::unknown, Side::center}};
  for (const auto& row : rows) {
    EXPECT_EQ(sense_of(row.name).family, row.family) << row.name;
    EXPECT_EQ(sense_of(row.name).side, row.side) << row.name;
  }
  EXPECT_EQ(sense_of_vrm("leftThumbProximal").family, BoneFamily::finger);
  EXPECT_EQ(sense_of_vrm("rightLowerLeg"), (NameSense{BoneFamily::shank, Side::right}));
}

bool is_legal(const std::string& name) {
  return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

RC_GTEST_PROP(BoneNames, AnyBytesBecomeALegalName, (const std::string& bytes)) {
  RC_ASSERT(is_legal(legal_name(bytes, "joint")));
  RC_ASSERT(legal_name(legal_name(bytes, "joint"), "joint") == legal_name(bytes, "joint"));
}

RC_GTEST_PROP(BoneNames, ClaimedNamesAreNeverTaken, (const std::vector<std::uint8_t>& numbers)) {
  std::set<std::string> taken;
  std::size_t count = 0;
  for (const std::uint8_t n : numbers) {
    claim_name("bone_" + std::to_string(n % 4), taken);
    RC_ASSERT(taken.size() == ++count);
  }
}

}  // namespace
}  // namespace contort
