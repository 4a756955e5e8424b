// Aim tables against brute force, and against the bounds that their header states.
#include "generator/motion/aim_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <thread>

#include "generator/motion/aim_table_file.h"
#include "generator/motion/aim_tables.h"
#include "tests/motion/aim_scenes.h"

namespace contort {
namespace {

using fixtures::aim_scene;
using fixtures::AimScene;
using fixtures::kAimScenes;

AimGeometry geometry_of(const AimScene& scene) { return aim_geometry(scene.character, scene.chain); }

AimGeometry geometry_of(const char* name) {
  const auto row = std::ranges::find_if(kAimScenes, [&](const auto& r) { return std::string(r.name) == name; });
  return geometry_of(aim_scene(*row));
}

Vec3 any_direction(std::mt19937_64& random) {
  for (;;) {
    const Vec3 v(fixtures::uniform(random, -1, 1), fixtures::uniform(random, -1, 1), fixtures::uniform(random, -1, 1));
    if (glm::dot(v, v) <= 1.0 && glm::dot(v, v) > 1e-3) return unit_or(v, v);
  }
}

double squared(const Vec3& v) { return glm::dot(v, v); }

TEST(AimChain, WalksFromTheSocketToThePart) {
  const AimScene scene = aim_scene(kAimScenes[2]);
  ASSERT_EQ(scene.chain.joints.size(), 4U) << scene.name;
  const char* names[] = {"arm_right/shoulder", "arm_right/elbow", "hand_right/wrist_flex", "hand_right/wrist_dev"};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(scene.character.joints()[static_cast<std::size_t>(scene.chain.joints[i])].name, names[i]);
  const int left = scene.character.find_part("arm_left");
  EXPECT_TRUE(aim_chain_for(scene.character, left, scene.chain.socket).joints.empty());
}

TEST(AimChain, GeometryPlacesTheSocketAsTheCharacterDoes) {
  for (const auto& row : kAimScenes) {
    const AimScene scene = aim_scene(row);
    ASSERT_FALSE(scene.chain.joints.empty()) << scene.name;
    const AimGeometry geometry = geometry_of(scene);
    std::mt19937_64 random(8);
    const std::vector<double> coords = fixtures::draw_posture(geometry, random);
    fixtures::AimPose pose(scene.character);
    std::size_t local = 0;
    for (const int j : scene.chain.joints) {
      const Joint& joint = scene.character.joints()[static_cast<std::size_t>(j)];
      for (int i = 0; i < coord_size(joint.kind); ++i)
        pose.row[static_cast<std::size_t>(joint.coord + i)] = coords[local++];
    }
    forward_kinematics(scene.character, scene.character.rest_root(), pose.row, pose.world);
    const Rigid expected = world_from_socket(scene.character, pose.world, scene.chain.socket);
    const Rigid got = fixtures::world_from_base(scene, pose) * base_from_socket(geometry, coords);
    EXPECT_LT(squared(got.p_m - expected.p_m), 1e-24) << scene.name;
    EXPECT_LT(squared(got.q * Vec3(0, 0, 1) - expected.q * Vec3(0, 0, 1)), 1e-24) << scene.name;
  }
}

// Every stored posture is in range and points in the table's direction; cells have no more entries than allowed.
TEST(AimTable, KeepsItsBounds) {
  for (const auto& row : kAimScenes) {
    const AimScene scene = aim_scene(row);
    const AimTable table = AimTable::build(geometry_of(scene));
    const AimSteps steps = aim_steps(table.geometry(), table.options());
    EXPECT_LE(steps.state_count, table.options().max_states);
    std::map<int, int> cells;
    for (int i = 0; i < table.posture_count(); ++i) {
      const Rigid at = base_from_socket(table.geometry(), table.coords(i));
      EXPECT_EQ(at.q * Vec3(0, 0, 1), table.direction(i));
      EXPECT_EQ(at.p_m, table.point_m(i));
      ++cells[aim_cell(table.direction(i))];
      for (const Joint& joint : table.geometry().joints)
        EXPECT_GE(normalised_margin(joint, table.coords(i).data() + joint.coord), 0.0);
    }
    for (const auto& [cell, count] : cells) EXPECT_LE(count, table.options().per_cell) << cell;
    std::printf("%-24s step %5.1f deg  states %6d  postures %5d in %4zu cells\n", scene.name.c_str(),
                steps.step_rad * kDegPerRad, steps.state_count, table.posture_count(), cells.size());
  }
}

TEST(AimTable, FewStatesAndLongChainsAreBounded) {
  for (const int most : {1, 2, 50, 1000, 200000}) {
    const AimSteps steps = aim_steps(geometry_of("human_muzzle"), {5.0, most, 4});
    EXPECT_LE(steps.state_count, most);
    EXPECT_GE(steps.state_count, 1);
  }
  AimGeometry geometry = geometry_of("human_head");
  while (geometry.joints.size() < 16) {
    geometry.joints.push_back(geometry.joints[geometry.joints.size() % 3]);
    geometry.joints.back().coord = geometry.coord_count++;
  }
  EXPECT_LE(aim_steps(geometry, {}).state_count, 40000);
  EXPECT_GE(AimTable::build(geometry).posture_count(), 100);
}

TEST(AimTable, NearestAgreesWithBruteForce) {
  std::mt19937_64 random(9);
  for (const char* name : {"human_muzzle", "mech_shield_grip", "human_head"}) {
    const AimTable table = AimTable::build(geometry_of(name));
    for (int i = 0; i < 1000; ++i) {
      const Vec3 wanted = any_direction(random);
      std::vector<AimHit> all;
      for (int p = 0; p < table.posture_count(); ++p) all.push_back({p, squared(table.direction(p) - wanted)});
      std::ranges::sort(all, [](const AimHit& a, const AimHit& b) {
        return a.chord != b.chord ? a.chord < b.chord : a.posture < b.posture;
      });
      std::array<AimHit, 5> hits;
      ASSERT_EQ(table.nearest(wanted, hits), 5);
      for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(hits[k].posture, all[k].posture) << name;
        EXPECT_EQ(hits[k].chord, all[k].chord);
      }
    }
  }
}

TEST(AimTable, AnswersFewerHitsThanAskedWhenThereAreFewerPostures) {
  const AimTable table = AimTable::build(geometry_of("human_head"), {5.0, 2, 1});
  std::array<AimHit, 64> hits;
  EXPECT_EQ(table.nearest(Vec3(0, 0, -1), hits), table.posture_count());
  EXPECT_EQ(table.nearest(Vec3(0, 0, -1), {}), 0);
}

// The interpolated posture is in range, and never worse than the nearest one.
TEST(AimTable, InterpolationIsNoWorseThanTheNearest) {
  std::mt19937_64 random(10);
  double sum_nearest = 0.0, sum_between = 0.0;
  for (const char* name : {"human_muzzle", "mech_slim_grip", "human_head"}) {
    const AimTable table = AimTable::build(geometry_of(name));
    std::vector<double> coords(static_cast<std::size_t>(table.geometry().coord_count));
    for (const Rigid& at : fixtures::reachable_aims(table.geometry(), 1000, 2)) {
      const Vec3 wanted = at.q * Vec3(0, 0, 1);
      std::array<AimHit, 1> best;
      table.nearest(wanted, best);
      table.interpolated(wanted, coords);
      const double chord = squared(base_from_socket(table.geometry(), coords).q * Vec3(0, 0, 1) - wanted);
      EXPECT_LE(chord, best[0].chord);
      sum_nearest += std::sqrt(best[0].chord);
      sum_between += std::sqrt(chord);
      for (const Joint& joint : table.geometry().joints)
        EXPECT_GE(normalised_margin(joint, coords.data() + joint.coord), 0.0) << name;
    }
  }
  std::printf("mean distance: nearest %.2f deg, interpolated %.2f deg\n", sum_nearest / 3000 * kDegPerRad,
              sum_between / 3000 * kDegPerRad);
}

TEST(AimTable, TheOrderOfPosturesDoesNotShow) {
  const AimTable table = AimTable::build(geometry_of("human_muzzle"));
  std::vector<double> backward;
  for (int i = table.posture_count(); i-- > 0;)
    backward.insert(backward.end(), table.coords(i).begin(), table.coords(i).end());
  const AimTable again = AimTable::of_postures(table.geometry(), table.options(), backward);
  EXPECT_EQ(aim_table_bytes(table), aim_table_bytes(again));
}

TEST(AimTables, ShareTablesOfEqualGeometry) {
  const AimScene one = aim_scene(kAimScenes[5]);
  CharacterChoice other_legs = fixtures::aim_choice(kAimScenes[5]);
  other_legs.parts["leg_left"] = "mech_leg_reverse";
  const Character other = build_character(other_legs, stock_library()).value();
  AimTables tables;
  const AimChain chain = aim_chain_for(other, other.find_part("arm_right"), other.find_socket("object:rifle/muzzle"));
  EXPECT_EQ(tables.get(one.character, one.chain), tables.get(other, chain));
  const AimChain grip = aim_chain_for(other, other.find_part("arm_right"), other.find_socket("arm_right/grip"));
  EXPECT_NE(tables.get(one.character, one.chain), tables.get(other, grip));
}

TEST(AimTables, AnyThreadMayAskFirst) {
  const AimScene scene = aim_scene(kAimScenes[6]);
  AimTables tables;
  std::vector<std::shared_ptr<const AimTable>> got(4);
  std::vector<std::thread> threads;
  for (auto& slot : got) threads.emplace_back([&] { slot = tables.get(scene.character, scene.chain); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& table : got) EXPECT_EQ(table, got[0]);
  EXPECT_EQ(aim_table_bytes(*got[0]), aim_table_bytes(AimTable::build(geometry_of(scene))));
}

}  // namespace
}  // namespace contort
