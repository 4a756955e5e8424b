// Skins of imported figures: the places of their triangles, and faults of skins.
#include "renders/skin.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "model/core/files.h"
#include "model/motion/kinematics.h"
#include "renders/shots.h"
#include "tests/import/rigged_model.h"

namespace contort {
namespace {

namespace fs = std::filesystem;
using fixtures::person;
using fixtures::RigOptions;

// A person of boxes, imported into a folder, as `contort import` does it.
class SkinTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / "contort_skins" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "skins");
    import_person({});
  }
  void TearDown() override { fs::remove_all(folder_); }

  void import_person(const RigOptions& rig) {
    const fixtures::GlbBuilder model = fixtures::rigged(person(), rig);
    const std::vector<std::byte> bytes = model.glb();
    asset_ = parse_skinned_glb(bytes).value();
    ImportOptions options;
    options.name = "figure", options.wears_model = true;
    const Imported imported = import_model(asset_, options).value();
    character_ = std::make_shared<Character>(fixtures::character_of(imported).value());
    for (const ImportFile& file : imported.files)
      if (file.name == "skins/figure.json") skin_json_ = file.text;
    desc_ = parse_skin(skin_json_).value();
    write("figure.json", skin_json_);
    write("figure.glb", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  void write(const std::string& name, const std::string& text) {
    ASSERT_TRUE(write_file((folder_ / "skins" / name).string(), text).ok());
  }
  Result<std::shared_ptr<const Skin>> worn() { return Wardrobe({"nowhere", folder_.string()}).skin_of(*character_); }
  std::string refusal() {
    const auto skin = worn();
    return skin ? "none" : skin.issue().code;
  }

  std::vector<Rigid> world(const std::string& bent_joint = "", double by_rad = 0.0) const {
    std::vector<double> row(character_->rest_coords().begin(), character_->rest_coords().end());
    if (const int joint = character_->find_joint(bent_joint); joint >= 0)
      row[static_cast<std::size_t>(character_->joints()[static_cast<std::size_t>(joint)].coord)] += by_rad;
    std::vector<Rigid> places(character_->joints().size());
    forward_kinematics(*character_, character_->rest_root(), row, places);
    return places;
  }
  std::vector<Vec3> corners(const std::vector<Rigid>& places) {
    const PosedSkin posed = pose_skin(**worn(), places, std::vector<int>(places.size(), 0));
    EXPECT_TRUE(posed.complete);
    std::vector<Vec3> points;
    for (const SkinPiece& piece : posed.pieces)
      for (const Vec3& p : piece.triangles.positions_m) points.push_back(posed.origin_m + p);
    return points;
  }

  fs::path folder_;
  SkinnedAsset asset_;
  std::shared_ptr<const Character> character_;
  SkinDesc desc_;
  std::string skin_json_;
};

// Every box of the model, 12 triangles of its corners, each where the model has it.
TEST_F(SkinTest, LiesAtRestWhereTheModelHasIt) {
  for (const RigOptions& rig :
       {RigOptions{}, RigOptions{100.0, kNoRotation}, RigOptions{1.0, axis_angle({0, 1, 0}, kPi)}}) {
    import_person(rig);
    const std::vector<Vec3> is = corners(world());
    ASSERT_EQ(is.size(), person().size() * 36);
    for (std::size_t b = 0; b < person().size(); ++b) {
      const auto bone = person()[b];
      Vec3 low(1e9), high(-1e9);
      for (std::size_t i = 36 * b; i < 36 * (b + 1); ++i) low = glm::min(low, is[i]), high = glm::max(high, is[i]);
      EXPECT_LT(glm::length(low - (bone.place + bone.low)), 0.002) << bone.name;
      EXPECT_LT(glm::length(high - (bone.place + bone.high)), 0.002) << bone.name;
    }
  }
}

TEST_F(SkinTest, MovesWithItsJoints) {
  const std::vector<Vec3> rest = corners(world()), bent = corners(world("arm_left/elbow", 1.0));
  for (std::size_t b = 0; b < person().size(); ++b) {
    const std::string name = person()[b].name;
    const bool moves = name == "LeftForeArm" || name == "LeftHand";
    double most = 0.0;
    for (std::size_t i = 36 * b; i < 36 * (b + 1); ++i) most = std::max(most, glm::length(bent[i] - rest[i]));
    EXPECT_EQ(most > 0.01, moves) << name;
  }
}

// Ankles are two hinges: the foot moves with the second one.
TEST_F(SkinTest, HangsOnTheLastOfSeveralJointsInOnePlace) {
  EXPECT_EQ(desc_.joints.at("LeftFoot"), "foot_left/ankle_inv");
  EXPECT_EQ(desc_.joints.at("Hips"), "root");
}

TEST_F(SkinTest, IsRedWhereItIsHighlighted) {
  Motion motion;
  motion.frame_count = 1, motion.coord_count = character_->coord_count();
  motion.root = {character_->rest_root()};
  motion.coords.assign(character_->rest_coords().begin(), character_->rest_coords().end());
  const Finding finding{"joint_range", "arm_left/elbow max", "rad", 0, 0, 0, -0.1, 1.0};
  const std::shared_ptr<const Skin> skin = *worn();
  const Story story{.character = *character_, .motion = motion, .finding = &finding, .skin = skin.get()};
  const Shots shots = take_shots(story, std::vector<int>{0});
  std::size_t red = 0, other = 0;
  for (const DrawInstance& instance : shots.lists.front().instances) {
    const std::size_t corners = shots.meshes[static_cast<std::size_t>(instance.mesh)].positions_m.size();
    if (instance.mark || corners % 36 != 0) continue;
    (instance.highlight > 0 ? red : other) += corners;
  }
  EXPECT_EQ(red, 36U) << "the forearm's box";
  EXPECT_EQ(other, 36 * (person().size() - 1));
}

TEST_F(SkinTest, LeavesOutWhatHasNoPlace) {
  std::vector<Rigid> places = world();
  const int hand = character_->find_joint(desc_.joints.at("LeftHand"));
  ASSERT_GE(hand, 0);
  places[static_cast<std::size_t>(hand)].p_m.y = std::numeric_limits<double>::quiet_NaN();
  const PosedSkin posed = pose_skin(**worn(), places, std::vector<int>(places.size(), 0));
  EXPECT_FALSE(posed.complete);
  ASSERT_EQ(posed.pieces.size(), 1U);
  EXPECT_EQ(posed.pieces.front().triangles.positions_m.size(), 36 * (person().size() - 1));
}

TEST_F(SkinTest, IsNotThereWhereNoFolderHasOne) {
  fs::remove(folder_ / "skins" / "figure.json");
  ASSERT_TRUE(worn().ok());
  EXPECT_EQ(*worn(), nullptr);
}

TEST_F(SkinTest, StaysInItsFolder) {
  const auto with_model = [&](const std::string& model) {
    SkinDesc other = desc_;
    other.model = model;
    write("figure.json", print_skin(other));
    return refusal();
  };
  EXPECT_EQ(with_model("figure.glb"), "none");
  for (const char* outside :
       {"../figure.glb", "/etc/figure.glb", "a/figure.glb", "..\\figure.glb", "c:figure.glb", ".glb"})
    EXPECT_EQ(with_model(outside), "skin.outside") << outside;
  for (const std::string& outside : {std::string("a\nb.glb"), std::string("figure.glb\0/../x.glb", 19)})
    EXPECT_EQ(with_model(outside), "skin.outside") << outside;
  EXPECT_EQ(with_model("missing.glb"), "skin.no_model");
  fs::create_directories(folder_ / "elsewhere");
  fs::rename(folder_ / "skins" / "figure.glb", folder_ / "elsewhere" / "figure.glb");
  fs::create_symlink("../elsewhere/figure.glb", folder_ / "skins" / "figure.glb");
  EXPECT_EQ(with_model("figure.glb"), "skin.outside");
}

TEST_F(SkinTest, IsNotReadThroughALinkThatLeadsOut) {
  fs::rename(folder_ / "skins", folder_ / "library");
  fs::create_directories(folder_ / "linked");
  fs::create_symlink("../library", folder_ / "linked" / "skins");
  const auto skin = Wardrobe({(folder_ / "linked").string()}).skin_of(*character_);
  ASSERT_FALSE(skin.ok());
  EXPECT_EQ(skin.issue().code, "file.outside");
}

TEST_F(SkinTest, SaysWhyItCannotBeWorn) {
  const auto with_joints = [&](std::map<std::string, std::string> joints) {
    SkinDesc other = desc_;
    other.joints = std::move(joints);
    write("figure.json", print_skin(other));
    return refusal();
  };
  EXPECT_EQ(with_joints({{"Hips", "nothing/such"}}), "skin.no_root");
  EXPECT_EQ(with_joints({{"Pelvis", "root"}}), "skin.other_model");
  EXPECT_EQ(with_joints({{"Hips", "root"}}), "none") << "all of it hangs on the root";
  write("figure.json", "{");
  EXPECT_EQ(refusal().rfind("json.", 0), 0U) << refusal();
  write("figure.json", skin_json_);
  write("figure.glb", "glTF, but not really");
  EXPECT_EQ(refusal().rfind("gltf.", 0), 0U) << refusal();
}

}  // namespace
}  // namespace contort
