// Actions from files: key poses, variants of built-in rules, and parts' own versions.
#include <gtest/gtest.h>

#include <cmath>

#include "fuzz/draw.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::coord;
using fixtures::use;

Library with(const std::vector<std::string>& files) {
  Library library = fixtures::tireless_library();
  for (const std::string& file : files) {
    const Result<ActionDesc> action = parse_action(file);
    EXPECT_TRUE(action.ok()) << (action.ok() ? "" : to_line(action.issue()));
    if (action) library.actions.push_back(*action);
  }
  return library;
}

std::shared_ptr<const Character> human_of(const Library& library) {
  return std::make_shared<const Character>(fixtures::built({}, library));
}

// The code that loading gives for one action.
std::string refusal_of_library(const std::string& file) {
  const Result<Done> done = check_actions(with({file}));
  return done ? "" : done.issue().code + " " + done.issue().pointer;
}

const std::string kNod = R"({"format": "contort.action/1", "name": "nod", "kinds": ["arm"], "keys": [
  {"at": 0.25, "pose": {"elbow_deg": 40}}, {"at": 0.5, "ease": "linear", "pose": {"elbow_deg": 80, "shoulder_deg": [0, 0, 50]}},
  {"at": 1.0, "ease": "step", "pose": {"elbow_deg": 20}}]})";

double elbow_deg(const Motion& motion, int frame, const Character& character) {
  return coord(motion, frame, character, "arm_left/elbow") / kRadPerDeg;
}

TEST(OwnActions, KeyPosesAreReachedOneAfterAnother) {
  const auto human = human_of(with({kNod}));
  const Stage stage = fixtures::stage_of({fixtures::sequence({use("nod", "arm_left", 0, 40, {})})}, 5, human);
  const Motion motion = generate(stage);
  EXPECT_NEAR(elbow_deg(motion, 10, *human), 40.0, 1e-9);
  EXPECT_NEAR(elbow_deg(motion, 15, *human), 60.0, 1e-9);  // linear, half of the way
  EXPECT_NEAR(elbow_deg(motion, 20, *human), 80.0, 1e-9);
  EXPECT_NEAR(elbow_deg(motion, 39, *human), 80.0, 1e-9);  // steps at the end
  EXPECT_NEAR(elbow_deg(motion, 40, *human), 20.0, 1e-9);
  EXPECT_NEAR(elbow_deg(motion, 45, *human), 20.0, 1e-9);
  // Smooth: slow at both ends of the first way.
  EXPECT_NEAR(elbow_deg(motion, 5, *human), 20.0, 1e-9);
  EXPECT_LT(elbow_deg(motion, 1, *human), 1.0);
}

TEST(OwnActions, AJointThatAKeyDoesNotNameGoesOnToTheNextOneThatDoes) {
  const auto human = human_of(with({kNod}));
  const Motion motion =
      generate(fixtures::stage_of({fixtures::sequence({use("nod", "arm_left", 0, 40, {})})}, 0, human));
  const auto shoulder_deg = [&](int frame) {
    const double* q = motion.row(frame).data() + fixtures::joint(*human, "arm_left/shoulder").coord;
    return rotation_angle(Quat(q[0], q[1], q[2], q[3])) / kRadPerDeg;
  };
  EXPECT_NEAR(shoulder_deg(10), 25.0, 1e-9);  // linear from rest to the second key
  EXPECT_NEAR(shoulder_deg(20), 50.0, 1e-9);
  EXPECT_NEAR(shoulder_deg(40), 50.0, 1e-9);
}

TEST(OwnActions, KeyPosesStartFromWhereTheyFindThePart) {
  const auto human = human_of(with({kNod}));
  const Motion motion = generate(fixtures::stage_of(
      {fixtures::sequence({fixtures::elbow(0, 20, 100.0), use("nod", "arm_left", 20, 40, {})})}, 0, human));
  EXPECT_NEAR(elbow_deg(motion, 20, *human), 100.0, 1e-9);
  EXPECT_NEAR(elbow_deg(motion, 25, *human), 70.0, 1e-9);
  EXPECT_NEAR(elbow_deg(motion, 30, *human), 40.0, 1e-9);
}

// The action is cut in the middle of its second key, and the arm is moved elsewhere meanwhile: it continues from there,
// without a jump.
TEST(OwnActions, KeyPosesThatWereCutGoOnFromWhereTheArmIs) {
  const auto human = human_of(with({kNod}));
  Spec spec;
  spec.sequences = {fixtures::sequence({use("nod", "arm_left", 0, 80, {})})};
  InterruptDesc interrupt;
  interrupt.when.event = Event::frame, interrupt.when.frame = 30;
  interrupt.enter = Enter::front;
  interrupt.sequence = fixtures::sequence({fixtures::elbow(0, 30, 5.0)});
  spec.interrupts = {interrupt};
  const Result<Stage> stage = build_stage(spec, human);
  ASSERT_TRUE(stage.ok()) << to_line(stage.issue());
  const Motion motion = generate(*stage);
  double fastest = 0.0;
  for (int f = 1; f < 100; ++f)
    fastest = std::max(fastest, std::fabs(elbow_deg(motion, f, *human) - elbow_deg(motion, f - 1, *human)));
  EXPECT_NEAR(elbow_deg(motion, 60, *human), 5.0, 0.5);
  EXPECT_NEAR(elbow_deg(motion, 70, *human), 80.0, 1e-6);  // the second key, ten frames of content later
  EXPECT_LT(fastest, 8.0);                                 // 75 degrees in 10 frames, linear: 7.5 a frame
  EXPECT_NEAR(elbow_deg(motion, 110, *human), 20.0, 1e-9);
}

TEST(OwnActions, WithoutLengthTheLastKeyIsThereAtOnce) {
  const auto human = human_of(with({kNod}));
  const Motion motion =
      generate(fixtures::stage_of({fixtures::sequence({use("nod", "arm_left", 5, 0, {})})}, 3, human));
  EXPECT_NEAR(elbow_deg(motion, 5, *human), 20.0, 60.0);
  EXPECT_NEAR(elbow_deg(motion, motion.frame_count - 1, *human), 20.0, 1e-9);
}

const std::string kPoint = R"({"format": "contort.action/1", "name": "point", "kinds": ["arm"], "of": "reach",
  "params": {"target_m": [0.3, 1.4, 0.5], "swivel_deg": 15}})";

TEST(OwnActions, AVariantIsItsRuleWithOtherValues) {
  const auto human = human_of(with({kPoint}));
  const auto play = [&](const ActionUse& action) {
    return generate(fixtures::stage_of({fixtures::sequence({action})}, 0, human));
  };
  const Vec3 target(0.3, 1.4, 0.5);
  EXPECT_EQ(motion_hash(play(use("point", "arm_left", 0, 30, {}))),
            motion_hash(play(use("reach", "arm_left", 0, 30, {{"target_m", target}, {"swivel_deg", 15.0}}))));
  // A spec may change the values of a variant.
  EXPECT_EQ(motion_hash(play(use("point", "arm_left", 0, 30, {{"swivel_deg", -20.0}}))),
            motion_hash(play(use("reach", "arm_left", 0, 30, {{"target_m", target}, {"swivel_deg", -20.0}}))));
}

const std::string kShieldNod = R"({"format": "contort.action/1", "name": "nod", "parts": ["mech_arm_shield"],
  "keys": [{"at": 1.0, "pose": {"elbow_deg": 33}}]})";

// Swapping the part swaps its animation, with the same spec.
TEST(OwnActions, APartBringsItsOwnVersion) {
  const Library library = with({kNod, kShieldNod});
  const auto end_deg = [&](const std::string& part) {
    const auto mech =
        std::make_shared<const Character>(fixtures::built(fixtures::mech_choice({{"arm_left", part}}), library));
    const Motion motion =
        generate(fixtures::stage_of({fixtures::sequence({use("nod", "arm_left", 0, 40, {})})}, 0, mech));
    return elbow_deg(motion, 40, *mech);
  };
  EXPECT_NEAR(end_deg("mech_arm_slim"), 20.0, 1e-9);
  EXPECT_NEAR(end_deg("mech_arm_shield"), 33.0, 1e-9);
}

TEST(OwnActions, TheRightSideMirrorsTheLeft) {
  const auto human = human_of(with({kNod}));
  const Motion motion = generate(fixtures::stage_of(
      {fixtures::sequence({use("nod", "arm_left", 0, 40, {}), use("nod", "arm_right", 0, 40, {})})}, 0, human));
  for (int f = 0; f <= 40; ++f) {
    EXPECT_EQ(coord(motion, f, *human, "arm_left/elbow"), coord(motion, f, *human, "arm_right/elbow"));
    const double* l = motion.row(f).data() + fixtures::joint(*human, "arm_left/shoulder").coord;
    const double* r = motion.row(f).data() + fixtures::joint(*human, "arm_right/shoulder").coord;
    EXPECT_NEAR(l[0], r[0], 1e-12);
    EXPECT_NEAR(l[3], -r[3], 1e-12) << f;
  }
}

TEST(OwnActions, AVariantOnTheRightMirrorsItsPoints) {
  const auto human = human_of(with({kPoint}));
  const auto play = [&](const ActionUse& action) {
    return motion_hash(generate(fixtures::stage_of({fixtures::sequence({action})}, 0, human)));
  };
  EXPECT_EQ(play(use("point", "arm_right", 0, 30, {})),
            play(use("reach", "arm_right", 0, 30, {{"target_m", Vec3(-0.3, 1.4, 0.5)}, {"swivel_deg", -15.0}})));
  // A parameter that a spec gives itself is meant as it stands.
  EXPECT_EQ(play(use("point", "arm_right", 0, 30, {{"swivel_deg", 15.0}})),
            play(use("reach", "arm_right", 0, 30, {{"target_m", Vec3(-0.3, 1.4, 0.5)}, {"swivel_deg", 15.0}})));
}

TEST(OwnActions, AreRefusedWithACodeAndAPlace) {
  const auto file = [](const std::string& rest) {
    return R"({"format": "contort.action/1", "name": "x", )" + rest + "}";
  };
  EXPECT_EQ(refusal_of_library(file(R"("kinds": ["arm"], "of": "fly")")), "action.unknown_action /of");
  EXPECT_EQ(refusal_of_library(file(R"("kinds": ["arm"], "of": "walk")")), "action.unsupported /of");
  EXPECT_EQ(refusal_of_library(file(R"("kinds": ["wing"], "of": "pose")")), "action.fits_nothing /kinds");
  EXPECT_EQ(refusal_of_library(file(R"("parts": ["human_wing"], "of": "pose")")), "action.unknown_part /parts/0");
  EXPECT_EQ(refusal_of_library(file(R"("parts": ["human_arm"], "of": "reach", "params": {"speed_m_s": 1})")),
            "action.unknown_param /params/speed_m_s");
  EXPECT_EQ(refusal_of_library(file(R"("parts": ["human_arm"], "of": "reach", "params": {"swivel_deg": 1000})")),
            "action.out_of_range /params/swivel_deg");
  EXPECT_EQ(refusal_of_library(file(R"("parts": ["human_arm"], "keys": [{"at": 1, "pose": {"knee_deg": 3}}])")),
            "action.unknown_param /keys/0/pose/knee_deg");
  EXPECT_EQ(
      refusal_of_library(file(R"("parts": ["human_arm"], "keys": [{"at": 1, "pose": {"elbow_deg": [1, 2, 3]}}])")),
      "action.wrong_type /keys/0/pose/elbow_deg");
  EXPECT_EQ(refusal_of_library(R"({"format": "contort.action/1", "name": "recoil", "kinds": ["arm"], "of": "recoil"})"),
            "action.duplicate_name /name");
  EXPECT_EQ(
      refusal_of_library(R"({"format": "contort.action/1", "name": "recoil", "parts": ["human_arm"], "of": "recoil"})"),
      "action.stock_part /parts/0");
}

// Actions by kind: parts that lack the joint cannot perform them, and a spec that uses them is refused with the reason.
TEST(OwnActions, PartsOfAKindThatLackAJointCannotDoIt) {
  const Library library = with({R"({"format": "contort.action/1", "name": "twist", "kinds": ["arm"],
    "keys": [{"at": 1, "pose": {"wrist_rot_deg": 30}}]})"});
  ASSERT_TRUE(check_actions(library).ok());
  Spec spec;
  spec.character = fixtures::mech_choice({{"arm_left", "mech_arm_shield"}});
  spec.sequences = {fixtures::sequence({use("twist", "arm_left", 0, 10, {})})};
  EXPECT_EQ(build_stage(spec, library).issue().code, "spec.unsupported_action");
  spec.character = fixtures::mech_choice({{"arm_left", "mech_arm_slim"}});
  EXPECT_TRUE(build_stage(spec, library).ok());
}

// A case is judged against the actions that it was found with.
TEST(OwnActions, CountAsAPartOfTheCharacter) {
  const Character plain = fixtures::built({}, fixtures::tireless_library());
  EXPECT_NE(fixtures::built({}, with({kNod})).hash(), plain.hash());
  EXPECT_NE(fixtures::built({}, with({kNod})).hash(), fixtures::built({}, with({kPoint})).hash());
  EXPECT_EQ(fixtures::built({}, with({kShieldNod})).hash(), plain.hash());  // for a part that a human does not have
}

TEST(OwnActions, TheFuzzerDrawsThem) {
  const Library library = with({kNod, kPoint});
  BuiltInGenerator generator(library);
  int nods = 0, points = 0, plain_points = 0;
  for (int i = 0; i < 300; ++i)
    for (const SequenceDesc& sequence : draw_spec({{"human"}}, generator, 1, i).sequences)
      for (const ClipDesc& clip : sequence.clips)
        for (const ActionUse& action : clip.actions) {
          nods += action.action == "nod", points += action.action == "point";
          plain_points += action.action == "point" && action.params.empty();
        }
  EXPECT_GT(nods, 5);
  EXPECT_GT(points, 5);
  EXPECT_GT(plain_points, 0);
  EXPECT_LT(plain_points, points);
}

}  // namespace
}  // namespace contort
