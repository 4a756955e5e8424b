// Models made for tests, and the characters that result from them.
#include "import/import.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/stage_evaluator.h"
#include "generator/actions/action.h"
#include "model/motion/legs.h"
#include "model/motion/kinematics.h"
#include "tests/import/rigged_model.h"

namespace contort {
namespace {

using fixtures::character_of;
using fixtures::imported;
using fixtures::part_in;
using fixtures::person;
using fixtures::rigged;

Imported must(const Result<Imported>& result) {
  EXPECT_TRUE(result.ok()) << to_line(result.issue());
  return *result;
}

std::string code_of(const Result<Imported>& result) { return result.ok() ? "" : result.issue().code; }

std::set<std::string> slots_of(const Imported& in) {
  std::set<std::string> slots;
  for (const SlotDesc& slot : in.cut.character.slots) slots.insert(slot.name);
  return slots;
}

TEST(Import, CutsAPersonAtTheUsualPlaces) {
  const Imported in = must(imported(rigged(person())));
  EXPECT_TRUE(in.figure.is_humanoid);
  EXPECT_EQ(slots_of(in), (std::set<std::string>{"waist", "torso", "head", "arm_left", "arm_right", "hand_left",
                                                 "hand_right", "leg_left", "leg_right", "foot_left", "foot_right"}));
  EXPECT_EQ(in.cut.joint_of_node.at("LeftForeArm"), "arm_left/elbow");
  EXPECT_EQ(in.cut.joint_of_node.at("RightLeg"), "leg_right/knee");
  EXPECT_EQ(in.cut.joint_of_node.at("LeftFoot"), "foot_left/ankle_flex");
  EXPECT_FALSE(in.cut.joint_of_node.contains("Hips"));  // the root does not turn against anything
  const auto map = std::ranges::find(in.files, "maps/figure.json", &ImportFile::name);
  ASSERT_NE(map, in.files.end());
  EXPECT_NE(map->text.find("\"Hips\": \"root\""), std::string::npos) << "but clips say where it goes: " << map->text;
}

TEST(Import, StockActionsPlayOnAPerson) {
  const Imported in = must(imported(rigged(person())));
  const Result<Character> character = character_of(in);
  ASSERT_TRUE(character.ok()) << to_line(character.issue());
  EXPECT_EQ(find_legs(*character).size(), 2U);
  const auto can = [&](const char* slot, const char* action) {
    return find_action(*character, character->parts()[static_cast<std::size_t>(character->find_part(slot))], action)
        .has_value();
  };
  EXPECT_TRUE(can("waist", "walk"));
  EXPECT_TRUE(can("arm_right", "reach"));
  EXPECT_TRUE(can("arm_left", "touch"));
  EXPECT_TRUE(can("head", "look_at"));
  EXPECT_TRUE(can("torso", "pose"));
}

TEST(Import, JointsStandWhereTheModelHasThem) {
  const Imported in = must(imported(rigged(person())));
  const Result<Character> character = character_of(in);
  ASSERT_TRUE(character.ok());
  std::vector<Rigid> world(character->joints().size());
  forward_kinematics(*character, character->rest_root(), character->rest_coords(), world);
  for (const fixtures::RiggedBone& bone : person()) {
    if (bone.parent < 0) continue;
    const int joint = character->find_joint(in.cut.joint_of_node.at(bone.name));
    ASSERT_GE(joint, 0) << bone.name;
    const Vec3 apart = world[static_cast<std::size_t>(joint)].p_m - bone.place;
    EXPECT_LT(std::sqrt(glm::dot(apart, apart)), 1e-3) << bone.name;  // the ground is that of rounded colliders
  }
}

TEST(Import, RestPoseViolatesNothing) {
  for (const auto& bones : {person(), fixtures::worm(6)}) {
    const Imported in = must(imported(rigged(bones)));
    Spec spec;
    spec.character.name = "figure";
    spec.hold_frames = 5;
    const Result<Stage> stage = build_stage(spec, fixtures::library_of(in));
    ASSERT_TRUE(stage.ok()) << to_line(stage.issue());
    StageEvaluator evaluator;
    EXPECT_EQ(evaluator.run(*stage).findings, std::vector<Finding>{});
  }
}

TEST(Import, APersonWeighsWhatDeLevaSays) {
  const Imported in = must(imported(rigged(person())));
  EXPECT_NEAR(in.figure.height_m, 1.8, 1e-6);
  EXPECT_NEAR(in.mass_kg, 24.1 * 1.8 * 1.8, 1e-4);
  EXPECT_NEAR(part_in(in, "leg_left")->joints[0].mass_kg, 0.1416 * in.mass_kg,
              1e-6);  // a thigh, also where it is drawn thin
}

TEST(Import, AnythingElseWeighsWhatItsCollidersHold) {
  const Imported in = must(imported(rigged(fixtures::worm(3))));
  const auto& shape = std::get<Capsule>(part_in(in, "body")->colliders.front().shape);
  EXPECT_NEAR(shape.radius_m, 0.1, 0.01);
  const double half = 0.15;  // half of the straight part of a box of 0.5 m
  EXPECT_NEAR(in.mass_kg, 3 * 1000.0 * kPi * 0.01 * (2 * half + 4.0 / 3.0 * 0.1), 0.1 * in.mass_kg);
}

TEST(Import, CentimetresAndMetresGiveTheSameFigure) {
  const Imported metres = must(imported(rigged(person())));
  const Imported centimetres = must(imported(rigged(person(), {100.0, kNoRotation})));
  EXPECT_DOUBLE_EQ(centimetres.figure.metres_per_unit, 0.01);
  ASSERT_EQ(metres.figure.bones.size(), centimetres.figure.bones.size());
  for (std::size_t b = 0; b < metres.figure.bones.size(); ++b) {
    const Vec3 apart = metres.figure.bones[b].position_m - centimetres.figure.bones[b].position_m;
    EXPECT_LT(std::sqrt(glm::dot(apart, apart)), 2e-5) << metres.figure.bones[b].label;
  }
  ImportOptions tall;
  tall.height_m = 3.6;
  EXPECT_NEAR(must(imported(rigged(person()), tall)).figure.bones[1].position_m.y, 0.2, 1e-4);
}

TEST(Import, ModelsAreTurnedToFaceForward) {
  const Imported forward = must(imported(rigged(person())));
  for (const double turn : {0.5, 1.0, 1.5}) {
    const Imported turned = must(imported(rigged(person(), {1.0, axis_angle(Vec3(0, 1, 0), turn * kPi)})));
    for (std::size_t b = 0; b < forward.figure.bones.size(); ++b) {
      const Vec3 apart = forward.figure.bones[b].position_m - turned.figure.bones[b].position_m;
      EXPECT_LT(std::sqrt(glm::dot(apart, apart)), 2e-5) << turn << " " << forward.figure.bones[b].label;
    }
  }
}

// Left and right of a model that is its own mirror image are one part, seen from two sides.
TEST(Import, RightPartsAreMirroredLeftOnes) {
  const Imported in = must(imported(rigged(person())));
  for (const char* kind : {"arm", "hand", "leg", "foot"}) {
    const PartDesc* left = part_in(in, std::string(kind) + "_left");
    const PartDesc* right = part_in(in, std::string(kind) + "_right");
    ASSERT_TRUE(left != nullptr && right != nullptr);
    ASSERT_EQ(left->joints.size(), right->joints.size());
    // Triangles do not lie mirrored, so that points on them do not either: axes are apart by 0.07 degrees.
    for (std::size_t j = 0; j < left->joints.size(); ++j) {
      EXPECT_EQ(left->joints[j].position_m, right->joints[j].position_m);
      EXPECT_NEAR(left->joints[j].low_deg, right->joints[j].low_deg, 1e-9);
      EXPECT_NEAR(left->joints[j].high_deg, right->joints[j].high_deg, 1e-9);
      EXPECT_NEAR(glm::dot(left->joints[j].axis, right->joints[j].axis), 1.0, 1e-5);
      EXPECT_NEAR(left->joints[j].mass_kg, right->joints[j].mass_kg, 0.02 * left->joints[j].mass_kg);
    }
  }
}

TEST(Import, ForearmsBendForwardAndShanksBackward) {
  const Imported in = must(imported(rigged(person())));
  const JointDesc& elbow = part_in(in, "arm_left")->joints[1];
  EXPECT_EQ(elbow.type, JointType::hinge);
  EXPECT_GT((axis_angle(elbow.axis, 0.5) * Vec3(1, 0, 0)).z, 0.4);
  EXPECT_EQ(elbow.high_deg, 150.0);
  const JointDesc& knee = part_in(in, "leg_left")->joints[1];
  EXPECT_LT((axis_angle(knee.axis, 0.5) * Vec3(0, -1, 0)).z, -0.4);
}

TEST(Import, HeavyCustomersAreRefusedByName) {
  ImportOptions options;
  options.skin = 1;
  EXPECT_EQ(code_of(imported(rigged(person()), options)), "import.unknown_skin");
  options.skin = -1;
  for (const char* name : {"RiggedFigure", "a-b", "mech", "a_name_that_is_longer_than_26", "_x", "a__b"}) {
    options.name = name;
    EXPECT_EQ(code_of(imported(rigged(person()), options)), "import.bad_name") << name;
  }
  EXPECT_EQ(code_of(imported(fixtures::small_arm())), "import.no_vertices");
  fixtures::GlbBuilder bare;
  bare.root["nodes"] = {{{"name", "a"}}};
  EXPECT_EQ(code_of(imported(bare)), "import.no_skin");
  EXPECT_EQ(code_of(imported(rigged({{"dot", -1, Vec3(0.0), Vec3(0.0), Vec3(0.0)}}))), "import.flat");
  EXPECT_EQ(code_of(imported(rigged(fixtures::worm(3), {1e7, kNoRotation}))), "import.too_large");
}

TEST(Import, JointsAreCounted) {
  EXPECT_EQ(code_of(imported(rigged(fixtures::worm(60)))), "");
  std::vector<fixtures::RiggedBone> star = {{"hub", -1, Vec3(0.0), Vec3(-0.1), Vec3(0.1)}};
  for (int i = 0; i < 130; ++i) {  // a hub of 260 joints in 130 branches
    const Vec3 place(0.0, 0.01 * i, 0.0);
    star.push_back({"in", 0, place, Vec3(-0.1), Vec3(0.1)});
    star.push_back({"out", static_cast<int>(star.size()) - 1, place, Vec3(-0.1), Vec3(0.1)});
    if (i == 70) {
      EXPECT_EQ(code_of(imported(rigged(star))), "import.too_many_parts");
    }
  }
  for (std::size_t i = 0; i < star.size(); ++i) star[i].name += std::to_string(i);
  star.resize(255);
  EXPECT_EQ(code_of(imported(rigged(star))), "import.too_many_parts");
}

TEST(Import, VrmBonesGoBeforeNames) {
  std::vector<fixtures::RiggedBone> bones = person();
  fixtures::Json version_1, version_0 = fixtures::Json::array();
  const char* names[] = {"hips",      "spine",         "neck",          "head",     "leftUpperArm",  "leftLowerArm",
                         "leftHand",  "leftUpperLeg",  "leftLowerLeg",  "leftFoot", "rightUpperArm", "rightLowerArm",
                         "rightHand", "rightUpperLeg", "rightLowerLeg", "rightFoot"};
  for (std::size_t i = 0; i < bones.size(); ++i) {
    bones[i].name = "tail_" + std::to_string(i);
    version_1[names[i]] = {{"node", i + 1}};
    version_0.push_back({{"bone", names[i]}, {"node", i + 1}});
  }
  fixtures::GlbBuilder b = rigged(bones);
  EXPECT_FALSE(must(imported(b)).figure.is_humanoid);
  b.root["extensions"] = {{"VRMC_vrm", {{"humanoid", {{"humanBones", version_1}}}}}};
  EXPECT_TRUE(must(imported(b)).figure.is_humanoid);
  b.root["extensions"] = {{"VRM", {{"humanoid", {{"humanBones", version_0}}}}}};
  const Imported in = must(imported(b));
  EXPECT_TRUE(in.figure.is_humanoid);
  EXPECT_EQ(in.cut.joint_of_node.at("tail_5"), "arm_left/elbow");
  b.root["extensions"]["VRM"]["humanoid"]["humanBones"][3]["node"] = 99;
  EXPECT_EQ(code_of(imported(b)), "gltf.bad_index");
}

// Rigs move feet by handles without a parent; here these feet are attached to a leg.
TEST(Import, LooseFeetGoToTheNearestLegOfTheirSide) {
  std::vector<fixtures::RiggedBone> bones = person();
  for (fixtures::RiggedBone& bone : bones)
    if (bone.name.ends_with("Foot")) bone.parent = 0;
  const Imported in = must(imported(rigged(bones)));
  EXPECT_EQ(in.cut.joint_of_node.at("LeftFoot"), "foot_left/ankle_flex");
  for (const SlotDesc& slot : in.cut.character.slots)
    if (slot.name == "foot_left") {
      EXPECT_EQ(slot.on_slot, "leg_left");
    }
}

TEST(Import, JointsThatMoveNoSkinAreLeftOut) {
  fixtures::GlbBuilder b = rigged(person());
  b.root["nodes"].push_back({{"name", "kneePole.l"}});
  const std::size_t pole = b.root["nodes"].size() - 1;
  b.root["nodes"][0]["children"].push_back(pole);
  b.root["skins"][0]["joints"].push_back(pole);
  b.root["skins"][0].erase(
      "inverseBindMatrices");  // vertices then stay where their joints are, which does not matter here
  EXPECT_FALSE(must(imported(b)).cut.joint_of_node.contains("kneePole.l"));
}

TEST(Import, EqualFilesGiveEqualBytes) {
  const Imported first = must(imported(rigged(person()))), second = must(imported(rigged(person())));
  ASSERT_EQ(first.files.size(), second.files.size());
  for (std::size_t i = 0; i < first.files.size(); ++i) {
    EXPECT_EQ(first.files[i].name, second.files[i].name);
    EXPECT_EQ(first.files[i].text, second.files[i].text);
  }
}

TEST(Import, NamesOfStrangersStayOutOfTheReportsMarkup) {
  std::vector<fixtures::RiggedBone> bones = fixtures::worm(3);
  bones[1].name = "a|b`<script>\n../..";
  const Imported in = must(imported(rigged(bones)));
  const std::string& report = in.files.back().text;
  EXPECT_EQ(report.find("<script"), std::string::npos);
  EXPECT_EQ(report.find("a|b"), std::string::npos);
  EXPECT_EQ(part_in(in, "body")->joints[0].name, "a_b_script");
}

TEST(Import, ContactsOfTheRestPoseAreAllowedAndSaidSo) {
  std::vector<fixtures::RiggedBone> bones = person();
  bones[6].low.x = -0.6, bones[6].high.x = -0.4;  // the left hand's skin lies in the chest
  const Imported in = must(imported(rigged(bones)));
  ASSERT_FALSE(in.contacts.pairs.empty());
  EXPECT_GT(in.contacts.at_rest, 0);
  for (const AllowedPairDesc& pair : in.contacts.pairs)
    EXPECT_TRUE(pair.reason.starts_with("rest_pose: ")) << pair.reason;
}

// Found groups of control have eight handles at most, however many limbs a model has.
TEST(Import, ManyArmedFiguresCanBeSimulated) {
  std::vector<fixtures::RiggedBone> bones = person();
  for (int pair = 1; pair < 4; ++pair)
    for (const int arm : {4, 10}) {
      const int first = static_cast<int>(bones.size());
      for (int k = 0; k < 2; ++k) {
        fixtures::RiggedBone bone = bones[static_cast<std::size_t>(arm + k)];
        bone.name += std::to_string(pair);
        bone.parent = k == 0 ? 1 : first;
        bone.place.y -= 0.12 * pair;
        bones.push_back(bone);
      }
    }
  const Imported in = must(imported(rigged(bones)));
  EXPECT_TRUE(slots_of(in).contains("arm_left_4"));
  Spec spec;
  spec.character.name = "figure";
  spec.hold_frames = 60;
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.impacts = {{5, "torso", "", Vec3(0.0), Vec3(0.0, 0.0, 40.0)}};
  const Result<Stage> stage = build_stage(spec, fixtures::library_of(in));
  ASSERT_TRUE(stage.ok()) << to_line(stage.issue());
  ASSERT_NE(stage->dynamics, nullptr);
  for (const ControlGroup& group : stage->dynamics->figure.groups) EXPECT_LE(group.handles.size(), 8U) << group.name;
  StageEvaluator evaluator;
  EXPECT_EQ(evaluator.run(*stage).frame_count, 61);
}

TEST(Import, ExactlyWhatMovesTheMeshIsDrawnOnRequest) {
  ImportOptions options;
  options.draw_mesh = true;
  const Imported in = must(imported(rigged(person()), options));
  ASSERT_EQ(part_in(in, "arm_right")->mesh.size(), 2U);
  const auto& triangles = std::get<TriangleMesh>(part_in(in, "arm_right")->mesh[0].shape);
  EXPECT_EQ(triangles.indices.size(), 36U);
  // Seen from outside, also in the mirror: the volume by the divergence theorem is that of the box.
  double volume = 0.0;
  for (std::size_t i = 0; i + 2 < triangles.indices.size(); i += 3)
    volume +=
        glm::dot(triangles.positions_m[i], glm::cross(triangles.positions_m[i + 1], triangles.positions_m[i + 2])) /
        6.0;
  EXPECT_NEAR(volume, 0.28 * 0.1 * 0.1, 1e-5);
}

}  // namespace
}  // namespace contort
