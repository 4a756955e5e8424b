// The page of many animations: the worst clips first, each with its worst moment.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renders/stick_figure.h"

namespace contort {

// A row of the page. Its texts are untrusted.
struct ClipsPageRow {
  std::string file;
  std::string clip;
  std::string check;     // check of the worst finding
  std::string subject;
  std::string measured;  // "turns 3 600 °/s, limit 733 °/s"
  std::string when;      // "1.583 s"; "" if the finding has no time
  std::string counts;    // "joint_range 15, pop 3"
  StickFigure figure{};  // figure at that time; without points: it cannot be drawn
  std::string command;   // command that judges the clip again
};

struct ClipsPage {
  std::string command;  // command that makes the page again
  std::string tool;     // version of Contort
  std::string character;  // name of the character; "" for none
  std::size_t clips = 0;
  std::size_t failing = 0;
  std::size_t findings = 0;
  std::vector<ClipsPageRow> rows;       // the worst first
  std::vector<std::string> clean;       // names of clips without a finding
  std::vector<std::string> unreadable;  // files, each with its reason
};

// The limits of a page; further rows are only counted.
inline constexpr std::size_t kMostClipRows = 1000, kMostClipFigures = 200, kMostClipNames = 1000;

// Returns a page without scripts, in one file.
std::string clips_html(const ClipsPage& page);

}  // namespace contort
