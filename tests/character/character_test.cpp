// Assembly: refusals, bodies, pairs, fixed masses, mirrored sides, the hash.
#include "model/character/character.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <set>

#include "model/character/inertia.h"
#include "model/motion/kinematics.h"
#include "tests/character/stock.h"
#include "tests/core/random_space.h"

namespace contort {
namespace {

using fixtures::built;
using fixtures::human;
using fixtures::joint;
using fixtures::mech_choice;

struct Refused {
  CharacterChoice choice;
  const char* code;
  const char* pointer;
  const char* allowed;
};

void expect_refused(const Refused& r) {
  const Result<Character> character = build_character(r.choice, stock_library());
  ASSERT_FALSE(character.ok()) << r.code;
  EXPECT_EQ(character.issue().code, r.code);
  EXPECT_EQ(character.issue().pointer, r.pointer);
  EXPECT_NE(character.issue().text.find(r.allowed), std::string::npos) << character.issue().text;
}

TEST(Character, ChoicesThatDoNotFitAreRefusedWithWhatDoes) {
  expect_refused({{"robot", {}, {}}, "character.unknown_character", "/name", "human, mech"});
  expect_refused(
      {{"human", {{"tail", "human_arm"}}, {}}, "character.unknown_slot", "/parts/tail", "waist, torso, head"});
  expect_refused({{"mech", {{"arm_left", "mech_leg_human"}}, {}},
                  "character.unknown_part",
                  "/parts/arm_left",
                  "mech_arm_slim, mech_arm_shield, mech_arm_extend"});
  expect_refused({{"human", {{"head", "none"}}, {}}, "character.unknown_part", "/parts/head", "human_head"});
  expect_refused({{"human", {}, {{"sword", "hand_left", "grip"}}},
                  "character.unknown_object",
                  "/attachments/0/object",
                  "rifle, backpack"});
  expect_refused({{"mech", {}, {{"backpack", "torso", "back"}}},
                  "character.unknown_object",
                  "/attachments/0/object",
                  "allowed are rifle"});
  expect_refused({{"human", {}, {{"rifle", "hand_left", "thumb"}}},
                  "character.unknown_socket",
                  "/attachments/0/socket",
                  "hand_left/grip"});
  expect_refused({{"human", {}, {{"rifle", "hand_left", "grip"}, {"rifle", "hand_right", "grip"}}},
                  "character.duplicate_object",
                  "/attachments/1/object",
                  "rifle"});
}

// One change to a copy of the stock library; the fault is then in a file, not in the choice.
struct BadFile {
  const char* name;
  std::function<void(Library&)> change;
  const char* code;
  const char* pointer;
};

CharacterDesc& human_of(Library& library) { return library.characters.at("human"); }

const BadFile kBadFiles[] = {
    {"no slots", [](Library& l) { human_of(l).slots.clear(); }, "character.no_slot", "/name"},
    {"a slot without parts", [](Library& l) { human_of(l).slots[1].parts.clear(); }, "character.no_part", "/name"},
    {"a slot twice", [](Library& l) { human_of(l).slots.push_back(human_of(l).slots[2]); }, "character.duplicate_name",
     "/name"},
    {"two roots", [](Library& l) { human_of(l).slots[1].on_slot = ""; }, "character.bad_root", "/name"},
    {"a root on something", [](Library& l) { human_of(l).slots[0].on_slot = "torso"; }, "character.bad_root", "/name"},
    {"a socket that is not there", [](Library& l) { human_of(l).slots[1].on_socket = "none"; },
     "character.unknown_socket", "/parts/torso"},
    {"a carrier that comes later", [](Library& l) { std::swap(human_of(l).slots[1], human_of(l).slots[2]); },
     "character.unknown_socket", "/parts/head"},
    {"a part that is not there", [](Library& l) { l.parts.erase("human_head"); }, "character.unknown_part",
     "/parts/head"},
    {"a part of another kind", [](Library& l) { l.parts.at("human_head").kind = "leg"; }, "character.wrong_kind",
     "/parts/head"},
    {"a part that breaks a rule", [](Library& l) { l.parts.at("human_head").joints[0].axis = Vec3(0); },
     "part.bad_axis", "/joints/0/axis"},
};

TEST(Character, FaultsOfFilesAreRefused) {
  for (const BadFile& bad : kBadFiles) {
    Library library = stock_library();
    bad.change(library);
    const Result<Character> character = build_character({}, library);
    ASSERT_FALSE(character.ok()) << bad.name;
    EXPECT_EQ(character.issue().code, bad.code) << bad.name;
    EXPECT_EQ(character.issue().pointer, bad.pointer) << bad.name;
  }
}

TEST(Character, ObjectsAreCheckedBeforeTheyAreAttached) {
  Library library = stock_library();
  library.objects.at("rifle").mesh = {{"", TriangleMesh{{Vec3(0)}, {0, 1, 2}}, Vec3(0)}};
  const Result<Character> character = build_character({"human", {}, {{"rifle", "hand_left", "grip"}}}, library);
  ASSERT_FALSE(character.ok());
  EXPECT_EQ(character.issue().code, "object.bad_shape");
}

TEST(Character, ParentsComeFirstAndIndicesAreValid) {
  const Character mech = built({"mech", {}, {{"rifle", "arm_right", "grip"}}});
  for (const Character* c : {&human(), &mech}) {
    for (std::size_t i = 0; i < c->joints().size(); ++i) EXPECT_LT(c->joints()[i].parent, static_cast<int>(i));
    for (const Part& part : c->parts())
      for (int j = part.first_joint; j < part.first_joint + part.joint_count; ++j)
        EXPECT_EQ(&c->parts()[static_cast<std::size_t>(c->joints()[static_cast<std::size_t>(j)].part)], &part);
    EXPECT_EQ(c->rest_coords().size(), static_cast<std::size_t>(c->coord_count()));
  }
}

TEST(Character, NamesAreFound) {
  EXPECT_EQ(human().find_joint("root"), 0);
  const int arm = human().find_part("arm_left");
  EXPECT_EQ(human().find_joint(arm, "elbow"), human().find_joint("arm_left/elbow"));
  EXPECT_EQ(human().find_joint(arm, "knee"), -1);
  EXPECT_EQ(human().find_joint("elbow"), -1);
  EXPECT_EQ(human().find_part("tail"), -1);
  EXPECT_EQ(human().find_socket("hand_left/thumb"), -1);
  EXPECT_GE(human().find_socket("hand_left/grip"), 0);
  EXPECT_GE(human().find_collider("torso/chest"), 0);
}

void expect_pairs_partition(const Character& c) {
  std::set<std::pair<int, int>> pairs;
  for (const AllowedPair& pair : c.allowed_pairs()) {
    EXPECT_LT(pair.a, pair.b);
    EXPECT_TRUE(pairs.insert({pair.a, pair.b}).second);
  }
  for (const ColliderPair& pair : c.judged_colliders()) {
    EXPECT_LT(pair.a, pair.b);
    EXPECT_TRUE(pairs.insert({pair.a, pair.b}).second);
  }
  const std::size_t n = c.colliders().size();
  EXPECT_EQ(pairs.size(), n * (n - 1) / 2);
}

TEST(Character, EveryPairOfCollidersIsEitherAllowedOrJudged) {
  expect_pairs_partition(human());
  expect_pairs_partition(built({"human", {}, {{"rifle", "hand_left", "grip"}, {"backpack", "torso", "back"}}}));
  expect_pairs_partition(built({"mech", {}, {{"rifle", "arm_left", "grip"}}}));
}

TEST(Character, JudgedPairsOfBodiesListTheirColliders) {
  int next = 0;
  for (const JudgedPair& pair : human().judged_pairs()) {
    EXPECT_LT(pair.body_a, pair.body_b);
    EXPECT_EQ(pair.first_pair, next);
    next += pair.pair_count;
    const Body& a = human().bodies()[static_cast<std::size_t>(pair.body_a)];
    for (int i = pair.first_pair; i < next; ++i) {
      const int collider = human().judged_colliders()[static_cast<std::size_t>(i)].a;
      EXPECT_GE(collider, a.first_collider);
      EXPECT_LT(collider, a.first_collider + a.collider_count);
    }
  }
  EXPECT_EQ(next, static_cast<int>(human().judged_colliders().size()));
}

std::string reason_of(const Character& c, const char* a, const char* b) {
  for (const AllowedPair& pair : c.allowed_pairs()) {
    const std::string& first = c.colliders()[static_cast<std::size_t>(pair.a)].name;
    const std::string& second = c.colliders()[static_cast<std::size_t>(pair.b)].name;
    if ((first == a && second == b) || (first == b && second == a)) return pair.reason;
  }
  return "";
}

TEST(Character, NeighboursMayTouchAndOthersMayNot) {
  EXPECT_EQ(reason_of(human(), "arm_left/deltoid", "arm_left/upper_arm"), "same_body");
  EXPECT_EQ(reason_of(human(), "arm_left/upper_arm", "arm_left/forearm"), "adjacent");
  EXPECT_EQ(reason_of(human(), "torso/chest", "arm_left/upper_arm"), "adjacent");
  EXPECT_EQ(reason_of(human(), "leg_left/thigh", "waist/hips"), "adjacent");  // over two massless links
  EXPECT_EQ(reason_of(human(), "torso/belly", "leg_left/thigh").rfind("user: ", 0), 0U);
  EXPECT_EQ(reason_of(human(), "torso/chest", "arm_left/forearm"), "");
  EXPECT_EQ(reason_of(human(), "leg_left/thigh", "leg_right/thigh"), "");
  EXPECT_EQ(reason_of(human(), "arm_left/upper_arm", "arm_right/upper_arm"), "");
}

TEST(Character, WhatACarrierHoldsBelongsToItsBody) {
  const Character armed = built({"human", {}, {{"rifle", "hand_right", "grip"}}});
  EXPECT_NEAR(joint(armed, "hand_right/wrist_dev").mass_kg, 0.445 + 4.5, 1e-12);
  EXPECT_EQ(reason_of(armed, "object:rifle/stock", "object:rifle/barrel"), "same_body");
  EXPECT_EQ(reason_of(armed, "object:rifle/barrel", "torso/chest"), "");
  EXPECT_GE(armed.find_socket("object:rifle/muzzle"), 0);
}

RC_GTEST_PROP(Character, ArmsAreMirrorImagesInEveryPosture, ()) {
  const std::string name =
      *rc::gen::element<std::string>("human", "mech_arm_slim", "mech_arm_shield", "mech_arm_extend");
  const Character c =
      built(name == "human" ? CharacterChoice{} : mech_choice({{"arm_left", name}, {"arm_right", name}}));
  const Part& left = c.parts()[static_cast<std::size_t>(c.find_part("arm_left"))];
  const Part& right = c.parts()[static_cast<std::size_t>(c.find_part("arm_right"))];
  std::vector<double> row(c.rest_coords().begin(), c.rest_coords().end());
  for (int i = 0; i < left.joint_count; ++i) {
    const Joint& l = c.joints()[static_cast<std::size_t>(left.first_joint + i)];
    const auto lc = static_cast<std::size_t>(l.coord);
    const auto rc = static_cast<std::size_t>(c.joints()[static_cast<std::size_t>(right.first_joint + i)].coord);
    const Quat q = fixtures::any_quat();
    const Quat m = mirror_rotation(q);
    if (l.kind == JointKind::ball)
      for (int k = 0; k < 4; ++k) {
        const auto at = static_cast<std::size_t>(k);
        row[lc + at] = std::array{q.w, q.x, q.y, q.z}[at], row[rc + at] = std::array{m.w, m.x, m.y, m.z}[at];
      }
    else
      row[lc] = row[rc] = fixtures::lattice_number(-2, 2);
  }
  std::vector<Rigid> world(c.joints().size());
  forward_kinematics(c, c.rest_root(), row, world);
  for (int i = 0; i < left.joint_count; ++i) {
    const Rigid& l = world[static_cast<std::size_t>(left.first_joint + i)];
    const Rigid& r = world[static_cast<std::size_t>(right.first_joint + i)];
    RC_ASSERT(length(mirror_point(l.p_m) - r.p_m) < 1e-12);
    RC_ASSERT(fixtures::difference(mirror_rotation(l.q), r.q) < 1e-7);
  }
}

RC_GTEST_PROP(Inertia, MergingDoesNotCareForOrderOrPlace, ()) {
  const auto body = [] {
    return principal_inertia(fixtures::lattice_number(0.1, 9), fixtures::any_vec(1),
                             Vec3(fixtures::lattice_number(0.1, 1)));
  };
  const BodyInertia a = body();
  const BodyInertia b = body();
  const Rigid place = fixtures::any_rigid(2);
  const BodyInertia here = moved(place, merged(a, b));
  const BodyInertia there = merged(moved(place, b), moved(place, a));
  RC_ASSERT(std::fabs(here.mass_kg - there.mass_kg) < 1e-12);
  RC_ASSERT(length(here.center_m - there.center_m) < 1e-12);
  for (int i = 0; i < 3; ++i) RC_ASSERT(length(here.inertia_kg_m2[i] - there.inertia_kg_m2[i]) < 1e-11);
}

// Two points of 1 kg, 2 m apart: each is 1 m from the centre, and the inertia about their line is 0.
TEST(Inertia, TwoPointsMakeADumbbell) {
  const BodyInertia pair =
      merged(principal_inertia(1, Vec3(-1, 0, 0), Vec3(0)), principal_inertia(1, Vec3(1, 0, 0), Vec3(0)));
  EXPECT_EQ(pair.center_m, Vec3(0));
  EXPECT_EQ(pair.inertia_kg_m2, Mat3(Vec3(0), Vec3(0, 2, 0), Vec3(0, 0, 2)));
}

std::uint64_t hash_with(const std::function<void(Library&)>& change) {
  Library library = stock_library();
  change(library);
  return built({}, library).hash();
}

TEST(Character, TheHashFollowsEverythingThatAMotionOrFindingSees) {
  const std::function<void(Library&)> changes[] = {
      [](Library& l) { l.parts.at("human_head").joints[0].high_deg += 1; },
      [](Library& l) { l.parts.at("human_head").joints[0].max_speed_deg_s += 1; },
      [](Library& l) { l.parts.at("human_head").joints[0].position_m.x += 1e-9; },
      [](Library& l) { l.parts.at("human_arm").joints[0].swing_deg[1] += 1; },
      [](Library& l) { l.parts.at("human_arm").joints[0].swing_center_deg.x += 1; },
      [](Library& l) { l.parts.at("human_arm").joints[0].strength_high += 1; },
      [](Library& l) { l.parts.at("human_waist").fixed_mass_kg += 1e-6; },
      [](Library& l) { std::get<Capsule>(l.parts.at("human_torso").colliders[0].shape).radius_m += 1e-6; },
      [](Library& l) { l.parts.at("human_head").sockets[0].rotation_deg.y += 1; },
      [](Library& l) { l.parts.at("human_head").facing[0].joints.pop_back(); },
      [](Library& l) { l.parts.at("human_head").facing.clear(); },
      [](Library& l) { l.parts.at("human_arm").reach.clear(); },
      [](Library& l) { l.characters.at("human").allowed_pairs.pop_back(); },
      [](Library& l) { l.characters.at("human").slots[4].side = Side::left; },
  };
  std::set<std::uint64_t> hashes = {human().hash()};
  for (const auto& change : changes) hashes.insert(hash_with(change));
  EXPECT_EQ(hashes.size(), 1 + std::size(changes));
}

TEST(Character, TheHashDoesNotFollowWhatIsOnlySeenByPeople) {
  EXPECT_EQ(
      hash_with([](Library& l) { l.parts.at("human_head").help = "another", l.parts.at("human_head").color.x = 0; }),
      human().hash());
  EXPECT_EQ(hash_with([](Library& l) { l.parts.at("human_head").mesh.clear(); }), human().hash());
}

}  // namespace
}  // namespace contort
