#include "cli/left_out_report.h"

#include <algorithm>
#include <cstdio>
#include <functional>

#include "cli/columns_report.h"
#include "cli/print.h"
#include "model/core/math.h"

namespace contort::cli {

namespace {

constexpr double kPlainTurn_rad = 1.0 * kRadPerDeg;  // left out: more than this is worth a line
constexpr double kPlainOffset_m = 0.01;
constexpr std::size_t kMostLines = 5;

// A turn that is so large makes another motion of the clip, so that it is named before the findings.
constexpr double kLargeTurn_rad = 20.0 * kRadPerDeg;

}  // namespace

void print_large_turns(const ClipMotion& motion) {
  for (const LeftOut& l : motion.left_out)
    if (l.turn_rad > kLargeTurn_rad)
      std::printf("  WARNING: %s turns by up to %s deg about an axis that %s does not have (%s s): the motion that was "
                  "judged is not the file's there\n",
                  printable(l.node).c_str(), decimal(l.turn_rad * kDegPerRad, 1).c_str(), printable(l.joint).c_str(),
                  decimal(l.turn_s, 3).c_str());
}

namespace {

// Prints what left out more than is plain, the greatest first; at most kMostLines lines, and how many are left.
void print_left_out(std::vector<LeftOut> left_out, double LeftOut::*amount, double plain,
                    const std::function<std::string(const LeftOut&)>& text) {
  std::erase_if(left_out, [&](const LeftOut& l) { return !(l.*amount > plain); });
  std::ranges::stable_sort(left_out, [&](const LeftOut& a, const LeftOut& b) { return a.*amount > b.*amount; });
  for (std::size_t i = 0; i < std::min(left_out.size(), kMostLines); ++i)
    std::printf("  left out: %s\n", text(left_out[i]).c_str());
  if (left_out.size() > kMostLines)
    std::printf("  left out: less of that at %zu more joints (--json lists them)\n", left_out.size() - kMostLines);
}

}  // namespace

void print_conversion(const ClipMotion& motion) {
  if (motion.columns > 0) return print_columns(motion);
  std::vector<LeftOut> small_turns = motion.left_out;  // the large ones are printed first
  std::erase_if(small_turns, [](const LeftOut& l) { return l.turn_rad > kLargeTurn_rad; });
  print_left_out(small_turns, &LeftOut::turn_rad, kPlainTurn_rad, [](const LeftOut& l) {
    return decimal(l.turn_rad * kDegPerRad, 1) + " deg of the turn of " + printable(l.node) + ", for which " +
           printable(l.joint) + " has no axis (" + decimal(l.turn_s, 3) + " s)";
  });
  print_left_out(motion.left_out, &LeftOut::offset_m, kPlainOffset_m, [](const LeftOut& l) {
    return decimal(l.offset_m, 3) + " m by which " + printable(l.node) + " leaves its place (" +
           decimal(l.offset_s, 3) + " s)";
  });
  if (!motion.stray_nodes.empty())
    std::printf("  left out: nodes that move and are no joint: %s\n", some_names(motion.stray_nodes).c_str());
  if (!motion.joints_at_rest.empty())
    std::printf("  at rest: joints without a node: %s\n", some_names(motion.joints_at_rest).c_str());
}

std::string left_out_text(const ClipMotion& motion) {
  if (motion.columns > 0) return columns_text(motion);
  double turn_rad = 0.0, offset_m = 0.0;
  for (const LeftOut& l : motion.left_out)
    turn_rad = std::max(turn_rad, l.turn_rad), offset_m = std::max(offset_m, l.offset_m);
  std::string text;
  if (turn_rad > kPlainTurn_rad) text += ", turns of up to " + decimal(turn_rad * kDegPerRad, 1) + " deg";
  if (offset_m > kPlainOffset_m) text += ", offsets of up to " + decimal(offset_m, 3) + " m";
  if (!motion.stray_nodes.empty()) text += ", " + std::to_string(motion.stray_nodes.size()) + " nodes that move";
  return text.empty() ? "" : "; left out" + text.substr(1);
}

}  // namespace contort::cli
