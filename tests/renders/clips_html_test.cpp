// The page of many clips, and the drawings in it.
#include "renders/clips_html.h"

#include <gtest/gtest.h>

#include <limits>

namespace contort {
namespace {

std::size_t count_in(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++count;
  return count;
}

StickFigure bent_leg() { return {{{0, 1, 0}, {0, 0.5, 0.1}, {0, 0, 0}}, {-1, 0, 1}, {0, 1, 0}}; }

TEST(StickFigures, ShowBonesAndMarkThoseThatAreMeant) {
  const std::string svg = stick_figure_svg(bent_leg(), "a <leg>");
  EXPECT_EQ(count_in(svg, "<line"), 2U) << svg;
  EXPECT_EQ(count_in(svg, "<line class='marked'"), 1U) << "the shank begins at the knee";
  EXPECT_EQ(count_in(svg, "<circle class='marked'"), 1U);
  EXPECT_EQ(count_in(svg, "a &lt;leg&gt;"), 1U);
}

TEST(StickFigures, LeaveOutWhatIsNoPlace) {
  StickFigure figure = bent_leg();
  figure.points[2].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(count_in(stick_figure_svg(figure, ""), "<line"), 1U);
  figure.points[1].y = 1e300;
  EXPECT_EQ(stick_figure_svg(figure, ""), "") << "one point is no figure";
  EXPECT_EQ(stick_figure_svg({}, ""), "");
}

ClipsPageRow failing_row(std::size_t number) {
  return {"walk" + std::to_string(number) + ".bvh", "<b>", "pop", "knee", "90 deg in one step", "1.5 s", "pop 1",
          bent_leg(), "contort check walk.bvh"};
}

TEST(ClipsPages, SayTheWorstFindingOfEachClip) {
  ClipsPage page;
  page.clips = 2, page.failing = 1, page.findings = 3, page.rows = {failing_row(1)}, page.clean = {"idle.bvh: idle"};
  const std::string html = clips_html(page);
  for (const char* part : {"1 of 2 clips have findings", "walk1.bvh: &lt;b&gt;", "idle.bvh: idle", "<svg",
                           "Sudden jump: knee, 90 deg in one step, at 1.5 s", "contort check walk.bvh"})
    EXPECT_EQ(count_in(html, part), 1U + (std::string(part) == "Sudden jump: knee, 90 deg in one step, at 1.5 s"))
        << part;
  EXPECT_EQ(html.find("<script"), html.npos);
}

TEST(ClipsPages, AreBounded) {
  ClipsPage page;
  for (std::size_t i = 0; i < 3000; ++i) page.rows.push_back(failing_row(i)), page.clean.push_back("clean.bvh");
  page.clips = 6000, page.failing = 3000;
  const std::string html = clips_html(page);
  EXPECT_EQ(count_in(html, "<section class='clip'>"), kMostClipRows);
  EXPECT_EQ(count_in(html, "<svg"), kMostClipFigures);
  EXPECT_EQ(count_in(html, "clean.bvh"), kMostClipNames);
  EXPECT_LT(html.size(), 2'000'000U);
}

}  // namespace
}  // namespace contort
