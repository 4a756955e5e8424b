#include "renders/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace contort {
namespace {

constexpr GroundRegion kAround{-3.0, -2.0, 4.0, 6.0};

// Off the origin and turned, so that frames that are mixed up show.
Environment environment_of(const Ground& ground) {
  return build_environment({.position_m = {0.4, 0.3, -0.7}, .heading_deg = 33.0, .ground = ground, .obstacles = {}})
      .value();
}

HeightGround hills(int columns, int rows, double spacing_m) {
  HeightGround ground{columns, rows, spacing_m, {}};
  for (int i = 0; i < columns * rows; ++i) ground.heights_m.push_back(0.1 * ((i * 7) % 5));
  return ground;
}

StepsGround stairs() { return {.heading_deg = 20.0, .start_m = 0.8, .depth_m = 0.4, .height_m = 0.14, .count = 6}; }

Triangles whole(const GroundMesh& mesh) {
  Triangles all = mesh.surface;
  all.positions_m.insert(all.positions_m.end(), mesh.nosings.positions_m.begin(), mesh.nosings.positions_m.end());
  all.normals.insert(all.normals.end(), mesh.nosings.normals.begin(), mesh.nosings.normals.end());
  return all;
}

Vec3 face_normal(const Triangles& mesh, std::size_t first) {
  const Vec3* p = &mesh.positions_m[first];
  return unit_or(glm::cross(p[1] - p[0], p[2] - p[0]), Vec3(0.0));
}

bool covers(const Triangles& mesh, double x_m, double z_m) {
  for (std::size_t i = 0; i < mesh.positions_m.size(); i += 3) {
    bool inside = face_normal(mesh, i).y > 0.5;
    for (std::size_t k = 0; k < 3 && inside; ++k) {
      const Vec3 &a = mesh.positions_m[i + k], &b = mesh.positions_m[i + (k + 1) % 3];
      inside = (b.z - a.z) * (x_m - a.x) - (b.x - a.x) * (z_m - a.z) >= -1e-9;
    }
    if (inside) return true;
  }
  return false;
}

std::size_t triangle_count(const GroundMesh& mesh) {
  return (mesh.surface.positions_m.size() + mesh.nosings.positions_m.size()) / 3;
}

class GroundMeshOf : public testing::TestWithParam<Ground> {
 protected:
  Environment environment_ = environment_of(GetParam());
  Triangles mesh_ = whole(ground_mesh(environment_, kAround));
};

INSTANTIATE_TEST_SUITE_P(All, GroundMeshOf,
                         testing::Values(PlaneGround{0.5}, SlopeGround{20.0, 70.0}, stairs(), hills(9, 5, 0.6),
                                         hills(1, 1, 1.0), hills(2, 1, 30.0)));

// A point on an edge of a step belongs to two heights; just inside its triangle there is one.
TEST_P(GroundMeshOf, LiesOnTheGround) {
  ASSERT_FALSE(mesh_.positions_m.empty());
  for (std::size_t i = 0; i < mesh_.positions_m.size(); i += 3) {
    if (face_normal(mesh_, i).y < 0.5) continue;
    const Vec3* p = &mesh_.positions_m[i];
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 inside = glm::mix(p[k], middle, 1e-6);
      EXPECT_NEAR(environment_.height_at(inside.x, inside.z), inside.y, 1e-5);
    }
  }
}

TEST_P(GroundMeshOf, FacesUpOrAgainstTheClimb) {
  ASSERT_EQ(mesh_.positions_m.size(), mesh_.normals.size());
  for (std::size_t i = 0; i < mesh_.positions_m.size(); i += 3) {
    const Vec3 face = face_normal(mesh_, i);
    EXPECT_GT(face.y, -1e-9);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(glm::length(mesh_.normals[i + k]), 1.0, 1e-9);
      EXPECT_GT(glm::dot(mesh_.normals[i + k], face), 0.5);
    }
  }
}

TEST_P(GroundMeshOf, CoversTheRegion) {
  for (double x = kAround.low_x_m; x <= kAround.high_x_m; x += 0.5)
    for (double z = kAround.low_z_m; z <= kAround.high_z_m; z += 0.5) EXPECT_TRUE(covers(mesh_, x, z)) << x << ' ' << z;
}

TEST(GroundMesh, HasVerticalRisersAsHighAsItsSteps) {
  const StepsGround ground = stairs();
  const Environment environment = environment_of(ground);
  const Triangles mesh = whole(ground_mesh(environment, {-20.0, -20.0, 20.0, 20.0}));
  int risers = 0;
  for (std::size_t i = 0; i < mesh.positions_m.size(); i += 3) {
    const Vec3 face = face_normal(mesh, i);
    if (face.y > 0.5) continue;
    ++risers;
    EXPECT_NEAR(face.y, 0.0, 1e-12);
    const Vec3* p = &mesh.positions_m[i];
    EXPECT_NEAR(std::max({p[0].y, p[1].y, p[2].y}) - std::min({p[0].y, p[1].y, p[2].y}), ground.height_m, 1e-9);
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3.0;
    const Vec3 before = middle + 1e-3 * face, behind = middle - 1e-3 * face;
    EXPECT_NEAR(environment.height_at(behind.x, behind.z) - environment.height_at(before.x, before.z), ground.height_m,
                1e-9);
  }
  EXPECT_EQ(risers, 2 * ground.count);
}

TEST(GroundMesh, MarksEveryStepOnce) {
  const StepsGround ground = stairs();
  const GroundMesh mesh = ground_mesh(environment_of(ground), {-20.0, -20.0, 20.0, 20.0});
  EXPECT_EQ(mesh.nosings.positions_m.size(), 6u * static_cast<std::size_t>(ground.count));
  EXPECT_TRUE(ground_mesh(environment_of(SlopeGround{}), kAround).nosings.positions_m.empty());
}

TEST(GroundMesh, FollowsATwistedCellClosely) {
  const Environment environment = environment_of(HeightGround{2, 2, 2.0, {0.0, 0.0, 0.0, 1.0}});
  const GroundMesh mesh = ground_mesh(environment, kAround);
  for (std::size_t i = 0; i < mesh.surface.positions_m.size(); i += 3) {
    const Vec3* p = &mesh.surface.positions_m[i];
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3.0;
    EXPECT_NEAR(environment.height_at(middle.x, middle.z), middle.y, 0.003);  // measured: 0.0017; as one cell 0.11
  }
}

TEST(GroundMesh, IsBoundedWhateverTheSpecSays) {
  for (const Ground& ground :
       {Ground(hills(256, 256, 0.01)), Ground(hills(256, 256, 0.3)), Ground(hills(256, 256, 100)),
        Ground(hills(256, 1, 0.2)), Ground(StepsGround{0.0, -10.0, 0.05, 0.1, 1000})})
    for (const double reach_m : {0.5, 10.0, 300.0, 1e4}) {
      const GroundMesh mesh = ground_mesh(environment_of(ground), {-reach_m, -reach_m, reach_m, reach_m});
      EXPECT_LE(triangle_count(mesh), static_cast<std::size_t>(kMostGroundTriangles)) << ground.index() << reach_m;
      EXPECT_GT(triangle_count(mesh), 0u);
    }
}

}  // namespace
}  // namespace contort
