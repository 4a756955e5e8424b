// Pictures of motions that dynamics moved, and several of them in rows.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "generator/dynamics/multibody.h"
#include "model/character/library.h"
#include "renders/image.h"
#include "renders/raster/picture.h"
#include "renders/raster/strip.h"

namespace contort {
namespace {

const std::string kCommand = "contort render a.json b.json --rows";

const Character& human() {
  static const Character character = build_character(CharacterChoice{}, stock_library()).value();
  return character;
}

// A figure at rest whose target bends the left elbow by this fraction of its range.
Motion resting(double share, int frames = 4) {
  Motion motion;
  motion.frame_count = frames;
  motion.coord_count = human().coord_count();
  for (int f = 0; f < frames; ++f)
    motion.coords.insert(motion.coords.end(), human().rest_coords().begin(), human().rest_coords().end());
  motion.root.assign(static_cast<std::size_t>(frames), human().rest_root());
  Response& response = motion.response;
  response.dof_count = Multibody::of(human()).dof_count();
  response.target_coords = motion.coords;
  response.target_root = motion.root;
  response.control.assign(static_cast<std::size_t>(frames * response.dof_count), 0.0);
  response.stances.assign(static_cast<std::size_t>(frames), {.footing = Footing::airborne});
  const Joint& elbow = human().joints()[static_cast<std::size_t>(human().find_joint("arm_left/elbow"))];
  for (int f = 0; f < frames; ++f)
    response.target_coords[static_cast<std::size_t>(f * motion.coord_count + elbow.coord)] = share * elbow.high;
  return motion;
}

class Rows : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / "contort_rows" /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  Image read(const std::string& name) const {
    const auto file = OIIO::ImageInput::open(path(name));
    if (!file) throw std::runtime_error(OIIO::geterror());
    EXPECT_EQ(file->spec().get_string_attribute("Comment"), kCommand);
    Image image(file->spec().width, file->spec().height);
    file->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, image.rgb.data());
    return image;
  }

  Image strip(const Motion& motion) const {
    StripInput input{human(), motion};
    input.frames = {0, 3};
    input.azimuth_rad = 1.0;
    input.replay_command = kCommand;
    EXPECT_TRUE(render_strip(input, path("strip.png")).ok());
    return read("strip.png");
  }

  RowsInput rows(const std::vector<const Motion*>& motions) const {
    RowsInput input;
    for (const Motion* motion : motions)
      input.rows.push_back({{.character = human(), .motion = *motion}, "(" + std::to_string(input.rows.size()) + ")"});
    input.frames = {0, 1, 3};
    input.azimuth_rad = 1.0;
    input.replay_command = kCommand;
    input.tile_width = input.tile_height = 120;
    return input;
  }

  static Result<StripDone> render(const RowsInput& input, const std::string& to) {
    Result<StripRenderer> renderer = StripRenderer::create();
    return renderer ? std::move(renderer).value().render_rows(input, to) : renderer.issue();
  }

  std::filesystem::path folder_;
};

// The number of pixels that differ visibly.
int differing_pixels(const Image& a, const Image& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    count += std::abs(a.rgb[i] - b.rgb[i]) + std::abs(a.rgb[i + 1] - b.rgb[i + 1]) > 20 ? 1 : 0;
  return count;
}

// A tile of a picture made of rows(…).
Image tile(const Image& image, int row, int column) {
  Image piece(120, 120);
  const int x = 2 + column * 122, y = 26 + row * 146;
  for (int line = 0; line < 120; ++line) std::copy_n(image.pixel(x, y + line), 3 * 120, piece.pixel(0, line));
  return piece;
}

TEST_F(Rows, AStripShowsTheGhostOfATargetThatDiffers) {
  const Image same = strip(resting(0.0)), bent = strip(resting(0.6));
  EXPECT_GT(differing_pixels(same, bent), 200);
}

TEST_F(Rows, AStripShowsArrows) {
  Motion swings = resting(0.0);
  const Image still = strip(swings);
  std::ranges::fill(swings.response.control, 20.0);
  EXPECT_GT(differing_pixels(still, strip(swings)), 200);
}

TEST_F(Rows, AStripHasTheFramesAndTheViewThatWereAskedFor) {
  const Motion motion = resting(0.6, 9);
  StripInput input{human(), motion};
  input.frames = {7, 2};
  input.azimuth_rad = 0.5;
  input.replay_command = kCommand;
  const Result<StripDone> done = render_strip(input, path("a.png"));
  ASSERT_TRUE(done.ok());
  EXPECT_EQ(done->frames, input.frames);
  input.azimuth_rad = 2.0;
  ASSERT_TRUE(render_strip(input, path("b.png")).ok());
  EXPECT_GT(differing_pixels(read("a.png"), read("b.png")), 1000);
}

TEST_F(Rows, AreBelowOneAnotherWithOneCamera) {
  const Motion still = resting(0.0), bent = resting(0.6);
  const Result<StripDone> done = render(rows({&still, &bent, &still}), path("rows.png"));
  ASSERT_TRUE(done.ok()) << to_line(done.issue());
  EXPECT_EQ(done->frames, (std::vector<int>{0, 1, 3}));
  const Image image = read("rows.png");
  ASSERT_EQ(image.width, 3 * 122 + 2);
  ASSERT_EQ(image.height, 3 * 146 + 2);
  EXPECT_EQ(tile(image, 0, 2), tile(image, 2, 2));
  EXPECT_GT(differing_pixels(tile(image, 0, 2), tile(image, 1, 2)), 50);
  EXPECT_GT(differing_pixels(tile(image, 0, 0), tile(image, 0, 2)), 3);  // the frame's number alone
  EXPECT_LT(differing_pixels(tile(image, 0, 0), tile(image, 0, 2)), 60);
}

TEST_F(Rows, AreWrittenTheSameAgain) {
  const Motion bent = resting(0.6);
  ASSERT_TRUE(render(rows({&bent}), path("a.png")).ok());
  ASSERT_TRUE(render(rows({&bent}), path("b.png")).ok());
  EXPECT_EQ(read("a.png"), read("b.png"));
}

TEST_F(Rows, HaveAViewOfTheirOwnWhereNoneIsGiven) {
  const Motion bent = resting(0.6);
  RowsInput input = rows({&bent});
  input.azimuth_rad.reset();
  ASSERT_TRUE(render(input, path("a.png")).ok());
}

TEST_F(Rows, AreWrittenWithoutTextWhereThereIsNoFont) {
  const Motion bent = resting(0.6);
  RowsInput input = rows({&bent, &bent});
  input.font = path("none.ttf");
  const Result<StripDone> done = render(input, path("a.png"));
  ASSERT_TRUE(done.ok());
  ASSERT_EQ(done->warnings.size(), 1U);
  EXPECT_EQ(done->warnings[0].code, "render.no_font");
}

TEST_F(Rows, SayWhyThereAreNone) {
  const Motion motion = resting(0.0);
  const auto code = [&](auto&& change) {
    RowsInput input = rows({&motion, &motion});
    change(input);
    const Result<StripDone> done = render(input, path("a.png"));
    return done ? std::string("none") : done.issue().code;
  };
  EXPECT_EQ(code([](RowsInput& input) { input.rows.clear(); }), "render.bad_size");
  EXPECT_EQ(code([](RowsInput& input) { input.frames.clear(); }), "render.bad_size");
  EXPECT_EQ(code([](RowsInput& input) { input.frames.assign(17, 0); }), "render.bad_size");
  EXPECT_EQ(code([](RowsInput& input) {
              while (input.rows.size() < 17) input.rows.push_back(input.rows[0]);
            }),
            "render.bad_size");
  EXPECT_EQ(code([](RowsInput& input) { input.tile_width = 10; }), "render.bad_size");
  EXPECT_EQ(code([](RowsInput& input) { input.frames.push_back(4); }), "render.bad_frame");
  EXPECT_EQ(code([](RowsInput& input) { input.frames[0] = -1; }), "render.bad_frame");
  Motion broken = motion;
  broken.response.target_root.pop_back();
  EXPECT_EQ(code([&](RowsInput& input) { input.rows = rows({&broken}).rows; }), "render.wrong_motion");
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
}

}  // namespace
}  // namespace contort
