// Writes the report about an imported robot.
#include "import/robot.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

// Makes untrusted names safe as text between backquotes of a table.
std::string safe_cell(const std::string& text, std::size_t most) {
  std::string out;
  for (const char c : text.substr(0, most))
    out += c == '|' || c == '`' || c == '<' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return out;
}

std::string kind_name(RobotJointKind kind) {
  switch (kind) {
    case RobotJointKind::hinge: return "hinge, rad";
    case RobotJointKind::travel: return "travel, m";
    case RobotJointKind::ball: return "ball, rad";
  }
  return "";
}

std::string limit_text(double limit) {
  if (limit == kNoLimit || limit == -kNoLimit) return "none";
  return number_text(limit);
}

std::string declared(double value) { return value > 0.0 ? number_text(value) : "-"; }

std::string row_of(const RobotJointReport& report) {
  const RobotJoint& joint = report.in_file;
  const bool is_ball = joint.kind == RobotJointKind::ball;
  return "| `" + safe_cell(report.file_name, 80) + "` | " + (report.joint.empty() ? "(fixed)" : report.joint) + " | " +
         kind_name(joint.kind) + " | " + (is_ball ? "" : limit_text(joint.low) + " to ") + limit_text(joint.high) +
         " | " + declared(joint.greatest_speed) + " | " + declared(joint.greatest_effort) + " | " +
         safe_cell(report.remark, 400) + " |\n";
}

}  // namespace

std::string write_robot_report(const ImportedRobot& robot) {
  std::string out = "# " + robot.character.name + ": what was read and what was guessed\n\n";
  out += robot.is_skeleton ? "A skeleton of " : "A robot of ";
  out += number_text(robot.mass_kg) + " kg and " + number_text(robot.height_m) + " m, with " +
         std::to_string(robot.joints.size()) + " joints in " + std::to_string(robot.parts.size()) + " parts.\n\n";
  for (const std::string& text : robot.notes) out += "* " + safe_cell(text, 600) + "\n";
  out +=
      "\n## Joints\n\nRanges, speeds and efforts are those of the file. Where it declares no speed, 3000 deg/s or "
      "10 m/s hold. Where it declares no effort, a quarter of the robot's weight times its reach holds.\n\n"
      "| in the file | joint | kind | range | speed | effort | remark |\n|---|---|---|---|---|---|---|\n";
  for (const RobotJointReport& report : robot.joints) out += row_of(report);
  out += "\n## Contacts that are allowed\n\n" + std::to_string(robot.pairs_of_file) +
         " pairs because the file says so, " + std::to_string(robot.pairs_at_rest) +
         " because no motion can avoid them.\n\n";
  for (const AllowedPairDesc& pair : robot.character.allowed_pairs)
    out += "* " + pair.a + " ~ " + pair.b + ": " + safe_cell(pair.reason, 200) + "\n";
  return out;
}

}  // namespace contort
