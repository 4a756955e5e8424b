#include "renders/scenery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace contort {
namespace {

const std::vector<std::vector<Vec3>> kWalk = {{{-0.3, 0.0, -0.2}, {0.3, 1.8, 0.2}},
                                              {{-0.3, 0.5, 6.8}, {0.3, 2.3, 7.2}}};

EnvironmentDesc cluttered() {
  return {.position_m = {0.4, 0.3, -0.7},
          .heading_deg = 33.0,
          .ground = SlopeGround{},
          .obstacles = {{"wall", Box{Vec3(0.5, 1.0, 4.0), Vec3(0.1, 1.0, 3.0), Vec3(0.0, 20.0, 10.0)}},
                        {"post", Capsule{Vec3(1.0, 0.0, 0.0), Vec3(1.0, 1.5, 0.2), 0.1}},
                        {"ball", Sphere{Vec3(-1.0, 0.5, 0.0), 0.5}}}};
}

TEST(Scenery, HasObstaclesWhereTheyAre) {
  const Environment environment = build_environment(cluttered()).value();
  std::vector<Triangles> meshes(3);  // a figure's
  const Scenery scenery = make_scenery(environment, region_around(kWalk), meshes);
  ASSERT_EQ(scenery.obstacles.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const DrawInstance& instance = scenery.obstacles[i];
    EXPECT_TRUE(instance.ghost);
    const Triangles& mesh = meshes.at(static_cast<std::size_t>(instance.mesh));
    ASSERT_FALSE(mesh.positions_m.empty());
    for (const Vec3& p : mesh.positions_m) {
      const Surface surface = environment.nearest_obstacle(instance.world_from_mesh * p);
      EXPECT_EQ(surface.obstacle, static_cast<int>(i));
      EXPECT_NEAR(surface.distance_m, 0.0, 1e-9);
    }
  }
}

TEST(Scenery, NeedsNoTrianglesForALevelPlane) {
  EnvironmentDesc level{
      .position_m = {1.0, 0.25, 0.0}, .heading_deg = 0.0, .ground = PlaneGround{0.5}, .obstacles = {}};
  std::vector<Triangles> meshes;
  const Scenery scenery = make_scenery(build_environment(level).value(), region_around(kWalk), meshes);
  EXPECT_TRUE(scenery.ground.empty());
  EXPECT_TRUE(meshes.empty());
  EXPECT_EQ(scenery.level_m, 0.75);
}

TEST(Scenery, DoesNotCountForFraming) {
  std::vector<Triangles> meshes;
  DrawList list;
  list.scenery = make_scenery(build_environment(cluttered()).value(), region_around(kWalk), meshes);
  ASSERT_FALSE(list.scenery.ground.empty());
  EXPECT_TRUE(outline(list, meshes).empty());
}

// The ground has faded out before its region ends, whichever way the strip is framed.
TEST(RegionAround, HoldsAllThatACameraShows) {
  const std::vector<Vec3> anchors = {Vec3(0.0), Vec3(0.0, 0.5, 7.0)};
  const GroundRegion region = region_around(kWalk);
  for (const View& view : probe_views())
    for (const double aspect : {1.0, 1.5}) {
      const StripCamera strip = frame_strip(kWalk, anchors, view, aspect);
      for (const Vec3& anchor : anchors) {
        const Camera camera = strip.follows ? moved(strip.camera, anchor) : strip.camera;
        const double faded_m = 0.75 * glm::distance(camera.eye_m, camera.center_m);
        EXPECT_LT(camera.center_m.x + faded_m, region.high_x_m);
        EXPECT_GT(camera.center_m.x - faded_m, region.low_x_m);
        EXPECT_LT(camera.center_m.z + faded_m, region.high_z_m);
        EXPECT_GT(camera.center_m.z - faded_m, region.low_z_m);
      }
    }
}

TEST(RegionAround, ExistsWithoutAFigure) {
  const GroundRegion region = region_around({});
  EXPECT_LT(region.low_x_m, -1.0);
  EXPECT_GT(region.high_z_m, 1.0);
  EXPECT_LT(region.high_z_m, 20.0);
}

View first_view(const Ground& ground, const Vec3& at_m) {
  const Environment environment = build_environment({.ground = ground, .obstacles = {}}).value();
  return views_of(environment, at_m, 1.0).front();
}

TEST(ViewsOf, LookAtStepsFromBelow) {
  const StepsGround up{.heading_deg = 0.0}, down{.heading_deg = 180.0, .start_m = -3.0};
  EXPECT_GT(std::fabs(first_view(up, Vec3(0.0, 0.0, 1.5)).azimuth_rad), 91.0 * kRadPerDeg);
  EXPECT_LT(std::fabs(first_view(down, Vec3(0.0, 0.0, 2.0)).azimuth_rad), 89.0 * kRadPerDeg);
}

TEST(ViewsOf, LookAtASlopeFromBeside) {
  EXPECT_NEAR(std::fabs(first_view(SlopeGround{20.0, 0.0}, Vec3(0.0)).azimuth_rad), 90.0 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(first_view(SlopeGround{20.0, 90.0}, Vec3(0.0)).azimuth_rad, 0.0, 1e-9);
}

TEST(ViewsOf, KeepTheirOrderOnLevelGround) {
  for (const Ground& ground : {Ground(PlaneGround{}), Ground(SlopeGround{3.0, 0.0})})
    EXPECT_EQ(first_view(ground, Vec3(0.0)).azimuth_rad, probe_views().front().azimuth_rad);
  const Environment steps = build_environment({.ground = StepsGround{.heading_deg = 0.0}, .obstacles = {}}).value();
  EXPECT_EQ(views_of(steps, Vec3(0.0, 0.0, 1.0), 1.0).size(), probe_views().size());
}

}  // namespace
}  // namespace contort
