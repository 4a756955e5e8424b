// Two programs share one declaration of options: the second one parses the options that the first one passes on.
#include "cli/render_options.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace contort::cli {
namespace {

struct PictureProgram {
  CLI::App app{"draws"};
  PictureOptions options;
  std::vector<std::string> files;

  explicit PictureProgram(std::vector<std::string> arguments) {
    app.add_option("FILE", files);
    add_picture_options(app, options);
    std::ranges::reverse(arguments);  // CLI11 expects reverse order
    app.parse(std::move(arguments));
  }
};

TEST(RenderOptions, AnotherProgramReadsWhatThisOneWasGiven) {
  const PictureProgram first({"a.json", "-o", "p.png", "--frames", "0,4,8", "--azimuth", "-90.50", "--rows", "--label",
                              "--rows, (a) 'x'", "--label", "", "--tolerance", "2.5", "--compare", "b.json"});
  const PictureProgram second(given_options(first.app));
  EXPECT_EQ(second.options, first.options);
  EXPECT_EQ(second.options.frames, (std::vector<int>{0, 4, 8}));
  EXPECT_EQ(second.options.labels, (std::vector<std::string>{"--rows, (a) 'x'", ""}));
  EXPECT_EQ(second.options.azimuth_deg, "-90.50");
  EXPECT_TRUE(second.options.rows);
  EXPECT_TRUE(second.files.empty());
}

TEST(RenderOptions, NothingIsPassedOnThatWasNotGiven) {
  EXPECT_EQ(given_options(PictureProgram({"a.json"}).app), std::vector<std::string>{});
}

TEST(RenderOptions, RefusesNumbersThatAreNone) {
  EXPECT_THROW(PictureProgram({"--azimuth", "nan"}), CLI::ValidationError);
  EXPECT_THROW(PictureProgram({"--azimuth", "361"}), CLI::ValidationError);
  EXPECT_THROW(PictureProgram({"--frames", ""}), CLI::ValidationError);
  EXPECT_THROW(PictureProgram({"--tolerance", "-1"}), CLI::ValidationError);
  EXPECT_THROW(PictureProgram({"--tiles", "65"}), CLI::ValidationError);
}

TEST(RenderOptions, SaysWhichDoNotFitTogether) {
  const auto why = [](auto change) {
    RenderOptions options;
    options.files = {"a.json"}, options.output = "p.png";
    change(options);
    return misfit(options);
  };
  EXPECT_EQ(why([](RenderOptions&) {}), "");
  EXPECT_NE(why([](RenderOptions& o) { o.rows = o.sheet = true; }), "");
  EXPECT_NE(why([](RenderOptions& o) { o.labels = {"one", "two"}; }), "");
  EXPECT_EQ(why([](RenderOptions& o) { o.labels = {"one", "two"}, o.compared = "b.json"; }), "");
  EXPECT_NE(why([](RenderOptions& o) { o.views = true; }), "");
}

}  // namespace
}  // namespace contort::cli
