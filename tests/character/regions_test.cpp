// Regions that a character's file declares for its points, and the check bone_position.
#include <gtest/gtest.h>

#include "tests/checks/small_character.h"

namespace contort {
namespace {

Library with(const RegionDesc& region) {
  Library library = small::library();
  library.characters["small"].regions = {region};
  return library;
}

std::string code_of(const Library& library) {
  const Result<Character> character = build_character({"small", {}, {}}, library);
  return character ? "" : character.issue().code + " " + character.issue().pointer;
}

TEST(Regions, NameASocketOrAJointOfASlot) {
  EXPECT_EQ(code_of(with({"r", "arm_left/grip", Sphere{}, false})), "");
  EXPECT_EQ(code_of(with({"r", "arm_left/lift", Sphere{}, false})), "");
  EXPECT_EQ(code_of(with({"r", "arm_left/gripp", Sphere{}, false})), "character.unknown_point /regions/0/point");
  EXPECT_EQ(code_of(with({"r", "arm/grip", Sphere{}, false})), "character.unknown_point /regions/0/point");
  Library twice = small::library();
  twice.characters["small"].regions.assign(2, {"r", "arm_left/grip", Sphere{}, false});
  EXPECT_EQ(code_of(twice), "character.duplicate_name /regions/1/name");
}

TEST(Regions, OfAPartThatIsSwappedOutWait) {
  Library library = with({"r", "arm_left/grip", Sphere{}, false});
  PartDesc stump = small::arm_part();
  stump.name = "stump";
  stump.sockets.clear();
  library.parts["stump"] = stump;
  library.characters["small"].slots[1].parts.push_back("stump");
  EXPECT_EQ(small::build(library).regions().size(), 1U);
  EXPECT_EQ(small::build(library, {"small", {{"arm_left", "stump"}}, {}}).regions().size(), 0U);
}

TEST(Regions, ChangeTheCharactersHash) {
  const Character plain = small::build(with({"r", "arm_left/grip", Sphere{}, false}));
  EXPECT_NE(small::build(with({"r", "arm_left/grip", Sphere{}, true})).hash(), plain.hash());
  EXPECT_NE(small::build(with({"r", "arm_left/grip", Sphere{{0, 0, 1}, 0.05}, false})).hash(), plain.hash());
  EXPECT_NE(small::build(with({"r", "arm_left/lift", Sphere{}, false})).hash(), plain.hash());
}

// The grip is 0.3 m left of the middle and 0.1 m above the ground.
double margin_of(const RegionDesc& region, const Rigid& root, double slide_m = 0.0) {
  const Character character = small::build(with(region));
  Motion motion = small::at_rest(character);
  motion.root[0] = root * character.rest_root();
  small::set(motion, 0, small::joint_of(character, "arm_left/slide"), slide_m);
  return small::margin_of("bone_position", character, motion, region.name);
}

TEST(BonePosition, IsMeasuredFromTheRegionsSurface) {
  const RegionDesc in{"in", "arm_left/grip", Sphere{{0.3, 0.1, 0}, 0.08}, false};
  EXPECT_NEAR(margin_of(in, {}), 0.08, 1e-12);
  EXPECT_NEAR(margin_of(in, {}, 0.03), 0.05, 1e-12);
  EXPECT_NEAR(margin_of(in, {}, -0.1), -0.02, 1e-12);
  RegionDesc out = in;
  out.keep_out = true;
  EXPECT_NEAR(margin_of(out, {}), -0.08, 1e-12);
  EXPECT_NEAR(margin_of(out, {}, -0.2), 0.12, 1e-12);
}

TEST(BonePosition, MovesWithTheCharacter) {
  const RegionDesc in{"in", "arm_left/grip", Box{{0.3, 0.1, 0}, {0.05, 0.02, 0.03}, {}}, false};
  const double at_home = margin_of(in, {}, 0.01);
  const Rigid elsewhere{from_rotation_vector(Vec3(0.3, -1.2, 0.4)), Vec3(3, 1, -2)};
  EXPECT_NEAR(margin_of(in, elsewhere, 0.01), at_home, 1e-12);
}

}  // namespace
}  // namespace contort
