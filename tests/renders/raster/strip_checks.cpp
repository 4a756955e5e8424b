// Film strips of stock characters, from the finding to the file.
#include <gtest/gtest.h>
#include <webp/demux.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <set>

#include "model/character/library.h"
#include "model/core/files.h"
#include "renders/frames.h"
#include "renders/image.h"
#include "renders/raster/picture.h"
#include "renders/raster/strip.h"
#include "tests/renders/raster/png.h"

namespace contort {
namespace {

const Character& human() {
  static const Character character = build_character(CharacterChoice{}, stock_library()).value();
  return character;
}

// The left elbow bends more and more, at rest otherwise.
Motion bending(int frames) {
  Motion motion;
  motion.frame_count = frames;
  motion.coord_count = human().coord_count();
  const Joint& elbow = human().joints()[static_cast<std::size_t>(human().find_joint("arm_left/elbow"))];
  for (int f = 0; f < frames; ++f) {
    motion.root.push_back(human().rest_root());
    motion.coords.insert(motion.coords.end(), human().rest_coords().begin(), human().rest_coords().end());
    const double share = frames > 1 ? static_cast<double>(f) / (frames - 1) : 0.0;
    motion.row(f)[static_cast<std::size_t>(elbow.coord)] = elbow.low + share * (elbow.high - elbow.low);
  }
  return motion;
}

Finding collision() { return {"self_collision", "arm_left/forearm ~ torso/chest", "m", 40, 55, 80, -0.0234, 1.2}; }

class Strip : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / "contort_strips" /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string bytes(const std::string& name) const { return read_file(path(name)).value(); }
  StripInput input() const { return StripInput{human(), motion_, &finding_}; }

  std::filesystem::path folder_;
  Motion motion_ = bending(120);
  Finding finding_ = collision();
};

// Saturated red between the header and the captions, which are red themselves.
int red_pixels(const Image& image, const StripInput& input) {
  int count = 0;
  for (int y = 60; y < 60 + input.tile_height - 30; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      count += p[0] > 120 && p[1] < 80 && p[2] < 80 ? 1 : 0;
    }
  return count;
}

TEST_F(Strip, IsAPngOfTheSizeOfItsTiles) {
  const Result<StripDone> done = render_strip(input(), path("a.png"));
  ASSERT_TRUE(done.ok()) << to_line(done.issue());
  EXPECT_EQ(done->frames.size(), 8u);
  EXPECT_TRUE(done->warnings.empty());
  EXPECT_GT(done->visible_pixels, 0);
  const Image image = read_png(path("a.png")).image;
  EXPECT_GE(image.width, 4 * 320);
  EXPECT_GE(image.height, 2 * 240);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);  // no temporary file stays
}

// A viewer uses this to look from the same place.
TEST_F(Strip, TellsFromWhereEachTileIsSeenAndWhereItIs) {
  const Result<StripDone> done = render_strip(input(), path("a.png"));
  ASSERT_TRUE(done.ok()) << to_line(done.issue());
  const Image image = read_png(path("a.png")).image;
  ASSERT_EQ(done->tiles.size(), done->frames.size());
  std::set<std::pair<int, int>> corners;
  for (std::size_t i = 0; i < done->tiles.size(); ++i) {
    const StripTile& tile = done->tiles[i];
    EXPECT_EQ(tile.frame, done->frames[i]);
    EXPECT_EQ(tile.width, input().tile_width);
    EXPECT_LT(tile.height, input().tile_height) << "without its caption";
    EXPECT_LE(tile.x + tile.width, image.width);
    EXPECT_LE(tile.y + tile.height, image.height);
    corners.emplace(tile.x, tile.y);
    const Vec3 to_eye = tile.camera.eye_m - tile.camera.center_m;
    EXPECT_NEAR(glm::dot(glm::normalize(to_eye), tile.camera.back), 1.0, 1e-12) << "it looks at its centre";
  }
  EXPECT_EQ(corners.size(), done->tiles.size());
}

// Two loops of it, as any reader of WebP sees it.
TEST_F(Strip, MovesInAClip) {
  StripRenderer renderer = StripRenderer::create().value();
  for (const char* name : {"a.webp", "b.webp"})
    ASSERT_TRUE(renderer.render(input(), path("a.png"), path(name)).ok());
  EXPECT_EQ(bytes("a.webp"), bytes("b.webp"));
  const std::string webp = bytes("a.webp");
  WebPData data{reinterpret_cast<const std::uint8_t*>(webp.data()), webp.size()};
  const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(
      WebPAnimDecoderNew(&data, nullptr), &WebPAnimDecoderDelete);
  ASSERT_NE(decoder, nullptr);
  WebPAnimInfo info;
  ASSERT_TRUE(WebPAnimDecoderGetInfo(decoder.get(), &info));
  const Clip clip = choose_clip(input().finding->worst_frame, input().motion.frame_count, input().motion.rate_hz);
  EXPECT_EQ(info.loop_count, 0u) << "for ever";
  EXPECT_GE(info.canvas_width, 320u);
  std::set<std::string> pictures;
  int frames = 0, time_ms = 0;
  for (std::uint8_t* pixels = nullptr; WebPAnimDecoderGetNext(decoder.get(), &pixels, &time_ms); ++frames)
    pictures.emplace(reinterpret_cast<char*>(pixels), std::size_t{4} * info.canvas_width * info.canvas_height);
  EXPECT_EQ(static_cast<std::size_t>(frames), clip.frames.size());
  EXPECT_EQ(pictures.size(), clip.frames.size()) << "each frame has its number";
  EXPECT_EQ(time_ms, frames * clip.milliseconds_per_frame);
}

TEST_F(Strip, HasTheSameBytesAgain) {
  StripRenderer renderer = StripRenderer::create().value();
  ASSERT_TRUE(render_strip(input(), path("a.png")).ok());
  ASSERT_TRUE(renderer.render(input(), path("b.png")).ok());
  StripInput other = input();
  other.finding = nullptr;
  ASSERT_TRUE(renderer.render(other, path("c.png")).ok());
  ASSERT_TRUE(renderer.render(input(), path("d.png")).ok());
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
  EXPECT_EQ(bytes("a.png"), bytes("d.png"));
  EXPECT_NE(bytes("a.png"), bytes("c.png"));
}

TEST_F(Strip, ShowsTheEnvironment) {
  const auto draw = [&](const EnvironmentDesc& desc, const std::string& name) {
    const Environment environment = build_environment(desc).value();
    StripInput strip = input();
    strip.environment = &environment;
    EXPECT_TRUE(render_strip(strip, path(name)).ok());
    return bytes(name);
  };
  ASSERT_TRUE(render_strip(input(), path("none.png")).ok());
  const std::string level = draw({}, "level.png");
  EXPECT_EQ(level, bytes("none.png"));
  EXPECT_NE(level, draw({.ground = StepsGround{.start_m = 0.3}, .obstacles = {}}, "steps.png"));
  EXPECT_NE(level, draw({.ground = PlaneGround{-0.2}, .obstacles = {}}, "low.png"));
  EXPECT_NE(level,
            draw({.ground = PlaneGround{}, .obstacles = {{"ball", Sphere{Vec3(0.6, 0.4, 0.0), 0.4}}}}, "ball.png"));
}

TEST_F(Strip, IsRedWhereTheFindingIs) {
  ASSERT_TRUE(render_strip(input(), path("with.png")).ok());
  EXPECT_GT(red_pixels(read_png(path("with.png")).image, input()), 500);
  StripInput without = input();
  without.finding = nullptr;
  const Result<StripDone> done = render_strip(without, path("without.png"));
  ASSERT_TRUE(done.ok());
  EXPECT_EQ(done->frames.back(), 119);
  EXPECT_EQ(red_pixels(read_png(path("without.png")).image, without), 0);
}

// Also in the worst frame, in which the other one hides the deepest points.
TEST_F(Strip, JoinsThePairWhereItIsNearest) {
  const auto yellow_pixels = [&](const StripInput& strip) {
    EXPECT_TRUE(render_strip(strip, path("a.png")).ok());
    const Image image = read_png(path("a.png")).image;
    int count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
      count += image.rgb[i] > 240 && image.rgb[i + 1] > 220 && image.rgb[i + 2] < 60 ? 1 : 0;
    return count;
  };
  finding_.subject = "arm_left/forearm ~ torso/trunk";
  EXPECT_GT(yellow_pixels(input()), 8 * 20);
  finding_.subject = "arm_left/forearm";
  EXPECT_EQ(yellow_pixels(input()), 0);
}

TEST_F(Strip, HasWiresAroundEveryCollider) {
  StripInput with = input();
  with.colliders = true;
  const Result<StripDone> done = render_strip(with, path("a.png"));
  ASSERT_TRUE(done.ok());
  const Image image = read_png(path("a.png")).image;
  int blue = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) blue += image.rgb[i + 2] > image.rgb[i] + 60 ? 1 : 0;
  EXPECT_GT(blue, 8 * 100);
}

TEST_F(Strip, HighlightsJoints) {
  finding_.check = "joint_range";
  finding_.subject = "arm_left/elbow max";
  ASSERT_TRUE(render_strip(input(), path("a.png")).ok());
  EXPECT_GT(red_pixels(read_png(path("a.png")).image, input()), 200);
}

TEST_F(Strip, CarriesTheReplayCommand) {
  StripInput with = input();
  with.replay_command = "contort replay corpus/x/min.json --note 'a \"b\" <c>'";
  ASSERT_TRUE(render_strip(with, path("a.png")).ok());
  EXPECT_EQ(read_png(path("a.png")).comment, with.replay_command);
}

TEST_F(Strip, ShowsUnknownSubjectsAndHostileNamesToo) {
  finding_.subject = std::string("\"><script>\xff\0\n\x1b[31m", 16) + std::string(10000, 'x');
  finding_.worst_margin = std::nan("");
  finding_.first_frame = -5;
  finding_.worst_frame = 1 << 30;
  const Result<StripDone> done = render_strip(input(), path("a.png"));
  ASSERT_TRUE(done.ok());
  EXPECT_EQ(done->visible_pixels, 0);
}

TEST_F(Strip, ShowsMotionsThatAreNotFinite) {
  for (std::size_t f = 50; f < 60; ++f) motion_.root[f].p_m.x = std::numeric_limits<double>::quiet_NaN();
  motion_.coords[motion_.coords.size() / 2] = std::numeric_limits<double>::infinity();
  motion_.root[80].p_m.z = 1e300;
  EXPECT_TRUE(render_strip(input(), path("some.png")).ok());
  for (Rigid& root : motion_.root) root.p_m.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(render_strip(input(), path("all.png")).ok());
}

TEST_F(Strip, FollowsAFigureThatTravels) {
  for (int f = 0; f < motion_.frame_count; ++f) motion_.root[static_cast<std::size_t>(f)].p_m.z += 0.2 * f;
  ASSERT_TRUE(render_strip(input(), path("a.png")).ok());
  const Image image = read_png(path("a.png")).image;
  for (int tile = 0; tile < 4; ++tile) {
    Image column(320, image.height);
    for (int y = 0; y < image.height; ++y) std::copy_n(image.pixel(2 + tile * 322, y), 3 * 320, column.pixel(0, y));
    EXPECT_GT(red_pixels(column, input()), 100) << tile;
  }
}

TEST_F(Strip, DrawsAGhostBehindTheMotion) {
  const Motion target = bending(60);
  StripInput with = input();
  with.ghost = &target;
  ASSERT_TRUE(render_strip(with, path("with.png")).ok());
  ASSERT_TRUE(render_strip(input(), path("without.png")).ok());
  EXPECT_NE(bytes("with.png"), bytes("without.png"));
}

TEST_F(Strip, IsWrittenWithoutTextWhereThereIsNoFont) {
  StripInput no_font = input();
  no_font.font = path("none.ttf");
  const Result<StripDone> done = render_strip(no_font, path("a.png"));
  ASSERT_TRUE(done.ok());
  ASSERT_EQ(done->warnings.size(), 1u);
  EXPECT_EQ(done->warnings[0].code, "render.no_font");
  EXPECT_NE(done->warnings[0].text.find("fonts-dejavu-core"), std::string::npos);
  EXPECT_GT(red_pixels(read_png(path("a.png")).image, no_font), 500);
}

TEST_F(Strip, HasFewerTilesForAShortMotion) {
  motion_ = bending(1);
  finding_.first_frame = finding_.worst_frame = finding_.last_frame = 0;
  const Result<StripDone> done = render_strip(input(), path("a.png"));
  ASSERT_TRUE(done.ok());
  EXPECT_EQ(done->frames, std::vector<int>{0});
  EXPECT_LT(read_png(path("a.png")).image.width, 2 * 320);
}

TEST_F(Strip, SaysWhyThereIsNone) {
  const auto code = [&](const StripInput& bad, const std::string& to) {
    const Result<StripDone> done = render_strip(bad, to);
    return done ? std::string("none") : done.issue().code;
  };
  std::ofstream(path("file")) << "x";
  EXPECT_EQ(code(input(), path("file/below.png")), "file.unwritable");
  EXPECT_EQ(code(input(), path("no/such/folder/a.png")), "file.unwritable");
  StripInput narrow = input();
  narrow.tile_width = 10;
  EXPECT_EQ(code(narrow, path("a.png")), "render.bad_size");
  StripInput none = input();
  none.tiles = 0;
  EXPECT_EQ(code(none, path("a.png")), "render.bad_size");
  const Motion empty = bending(0);
  EXPECT_EQ(code(StripInput{human(), empty, &finding_}, path("a.png")), "render.no_frames");
  Motion other = motion_;
  other.coord_count += 1;
  EXPECT_EQ(code(StripInput{human(), other, &finding_}, path("a.png")), "render.wrong_motion");
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

TEST(DrawableText, IsAsciiThatFits) {
  EXPECT_EQ(drawable_text("-12.0\u00B0 40\u201380 caf\u00E9 a\nb", 60), "-12.0 deg 40-80 caf? a?b");
  EXPECT_EQ(drawable_text("abcdefghij", 8), "abcde...");
  EXPECT_EQ(drawable_text("abcdefghij", 2), "ab");
  EXPECT_EQ(drawable_text("abc", -1), "");
}

}  // namespace
}  // namespace contort
