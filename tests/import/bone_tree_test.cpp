// Trees of bones that files have, made one by hand.
#include "import/bone_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace contort {
namespace {

struct DrawnBone {
  std::string label;
  int parent;
  int points;
  BoneFamily family = BoneFamily::unknown;
  Side side = Side::center;
  double x_m = 0.0;
};

RiggedFigure drawn(const std::vector<DrawnBone>& bones) {
  RiggedFigure figure;
  for (const DrawnBone& drawn_bone : bones) {
    Bone bone;
    bone.label = drawn_bone.label, bone.parent = drawn_bone.parent;
    bone.family = drawn_bone.family, bone.side = drawn_bone.side, bone.position_m.x = drawn_bone.x_m;
    bone.points_m.resize(static_cast<std::size_t>(drawn_bone.points));
    figure.bones.push_back(bone);
  }
  return figure;
}

// "hips thigh<hips foot<thigh"
std::string tree_of_bones(const RiggedFigure& figure) {
  std::string text;
  for (const Bone& bone : figure.bones)
    text += (text.empty() ? "" : " ") + bone.label +
            (bone.parent < 0 ? "" : "<" + figure.bones[static_cast<std::size_t>(bone.parent)].label);
  return text;
}

std::string one_tree(const std::vector<DrawnBone>& bones) {
  RiggedFigure figure = drawn(bones);
  make_one_tree(figure);
  return tree_of_bones(figure);
}

TEST(BoneTree, HangsOtherTreesOnTheRootOfTheMostPoints) {
  EXPECT_EQ(one_tree({{"hat", -1, 3}, {"hips", -1, 1}, {"spine", 1, 5}}), "hips hat<hips spine<hips");
}

TEST(BoneTree, OfEqualTreesTheFirstIsTheRoot) { EXPECT_EQ(one_tree({{"a", -1, 2}, {"b", -1, 2}}), "a b<a"); }

TEST(BoneTree, TakesHandlesOut) {
  EXPECT_EQ(one_tree({{"armature", -1, 0}, {"root", 0, 0}, {"hips", 1, 4}, {"leg", 2, 4}}), "hips leg<hips");
  EXPECT_EQ(one_tree({{"root", -1, 0}, {"hips", 0, 4}, {"prop", 0, 4}}), "root hips<root prop<root") << "carries two";
}

TEST(BoneTree, ParentsComeFirstAndBranchesStayTogether) {
  EXPECT_EQ(one_tree({{"hips", -1, 4}, {"left", 0, 1}, {"right", 0, 1}, {"toe", 1, 1}}),
            "hips left<hips toe<left right<hips");
}

TEST(BoneTree, HangsALooseFootOnTheNearestLegOfItsSide) {
  const BoneFamily thigh = BoneFamily::thigh, shank = BoneFamily::shank, foot = BoneFamily::foot;
  EXPECT_EQ(one_tree({{"hips", -1, 9},
                      {"thigh_l", 0, 1, thigh, Side::left, 1.0},
                      {"shank_l", 1, 1, shank, Side::left, 1.0},
                      {"shank_r", 0, 1, shank, Side::right, -1.0},
                      {"foot_l", 0, 1, foot, Side::left, -1.0}}),
            "hips thigh_l<hips shank_l<thigh_l foot_l<shank_l shank_r<hips");
}

TEST(BoneTree, ALegWithoutAFootGoesBeforeANearerOne) {
  const BoneFamily leg = BoneFamily::leg, foot = BoneFamily::foot;
  EXPECT_EQ(one_tree({{"hips", -1, 9},
                      {"front", 0, 1, leg, Side::left, 0.1},
                      {"front_foot", 1, 1, foot, Side::left, 0.1},
                      {"hind", 0, 1, leg, Side::left, 5.0},
                      {"loose_foot", -1, 1, foot, Side::left, 0.0}}),
            "hips front<hips front_foot<front hind<hips loose_foot<hind");
}

TEST(BoneTree, NotesEachGuess) {
  RiggedFigure figure = drawn({{"hips", -1, 9}, {"hat", -1, 1}});
  make_one_tree(figure);
  ASSERT_EQ(figure.notes.size(), 1u);
  EXPECT_EQ(figure.notes[0], "\"hat\" has no parent in the file; here it is attached to the root.");
}

}  // namespace
}  // namespace contort
