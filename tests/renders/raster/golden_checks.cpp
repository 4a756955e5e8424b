// Compares thumbnails of scenes with stored ones, which people have examined, with a tolerance for other drivers and
// releases of Mesa. CONTORT_DRAW_GOLDEN=1 draws them anew: look at each before it is committed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "generator/generate.h"
#include "generator/stage.h"
#include "model/core/files.h"
#include "renders/raster/strip.h"
#include "tests/corpus/temp_folder.h"
#include "tests/renders/raster/png.h"
#include "tests/scenes.h"

namespace contort {
namespace {

const std::string kFolder = CONTORT_SOURCE_DIR "/tests/renders/raster/golden/";

struct Thumbnail {
  std::string name;
  Spec spec;
};

std::vector<Thumbnail> thumbnails() {
  std::vector<Thumbnail> all;
  for (const NamedScene& scene : all_scenes()) all.push_back({std::string(scene.name), parse_spec(scene.spec_json).value()});
  for (const char* name : {"walk_stairs", "walk_touch_wall"}) {
    const std::string path = CONTORT_SOURCE_DIR "/docs/examples/" + std::string(name) + ".json";
    all.push_back({name, parse_spec(read_file(path).value()).value()});
  }
  return all;
}

struct Pose {
  Stage stage;
  Motion motion;
  int frame = 0;
};

Pose pose_of(const Spec& spec) {
  Pose pose{build_stage(spec, stock_library()).value(), {}, 0};
  pose.motion = generate(pose.stage);
  pose.frame = pose.motion.frame_count / 2;
  return pose;
}

// Draws without text, as fonts are not tested, and from a fixed side, as a moved limb could move the camera.
Image draw(const Pose& pose, const DynamicsDesc& dynamics, const std::string& path) {
  static StripRenderer renderer = StripRenderer::create().value();
  StripInput input{*pose.stage.character, pose.motion};
  input.frames = {pose.frame};
  input.tile_width = 192, input.tile_height = 184;
  input.environment = &pose.stage.environment, input.dynamics = &dynamics;
  input.azimuth_rad = 50 * kRadPerDeg;
  input.font = "";
  EXPECT_TRUE(renderer.render(input, path).ok());
  return read_png(path).image;
}

// The fraction of pixels in which some colour differs by more than a visible shade.
double share_differing(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) return 1.0;
  constexpr int kShade = 24;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    bool differs = false;
    for (std::size_t c = i; c < i + 3; ++c) differs = differs || std::abs(a.rgb[c] - b.rgb[c]) > kShade;
    differing += differs;
  }
  return 3.0 * static_cast<double>(differing) / static_cast<double>(a.rgb.size());
}

// Rasterizers differ along edges: softpipe from llvmpipe in up to one pixel of these; other releases may in some more.
constexpr double kTolerance = 0.001;

class Golden : public testing::Test {
 protected:
  std::string drawn(const std::string& name) const { return folder_ / (name + ".png"); }
  TempFolder folder_;  // each run's own: two drivers are tried at the same time
};

TEST_F(Golden, ScenesLookAsTheyDid) {
  const bool anew = std::getenv("CONTORT_DRAW_GOLDEN") != nullptr;
  for (const Thumbnail& one : thumbnails()) {
    const Image image = draw(pose_of(one.spec), one.spec.dynamics, drawn(one.name));
    const std::string path = kFolder + one.name + ".png";
    if (anew) std::filesystem::copy_file(drawn(one.name), path, std::filesystem::copy_options::overwrite_existing);
    const double share = share_differing(image, read_png(path).image);
    EXPECT_LE(share, kTolerance) << one.name;
    RecordProperty(one.name, std::to_string(share));
  }
}

// The tolerance must not hide a shoulder or foreleg that is turned by 25 degrees.
TEST_F(Golden, AMovedArmIsSeen) {
  int tried = 0;
  for (const Thumbnail& one : thumbnails()) {
    Pose pose = pose_of(one.spec);
    const Character& character = *pose.stage.character;
    int moved = -1;
    for (const char* joint : {"arm_left/shoulder", "arm_left/swing", "leg_fore_left/shoulder_flex"})
      if (moved < 0) moved = character.find_joint(joint);
    if (moved < 0) continue;
    const Joint& joint = character.joints()[static_cast<std::size_t>(moved)];
    const std::span<double> row = pose.motion.row(pose.frame);
    double* coords = row.data() + joint.coord;
    const Quat turn = axis_angle(Vec3(1, 0, 0), 25 * kRadPerDeg);
    if (joint.kind == JointKind::ball) {
      const Quat now = turn * Quat(coords[0], coords[1], coords[2], coords[3]);
      coords[0] = now.w, coords[1] = now.x, coords[2] = now.y, coords[3] = now.z;
    } else {
      coords[0] += 25 * kRadPerDeg;
    }
    const Image image = draw(pose, one.spec.dynamics, drawn(one.name));
    EXPECT_GT(share_differing(image, read_png(kFolder + one.name + ".png").image), kTolerance) << one.name;
    ++tried;
  }
  EXPECT_GE(tried, 6);
}

}  // namespace
}  // namespace contort
