#include "formats/robot/read.h"

#include <algorithm>
#include <filesystem>

#include "formats/robot/meshes.h"
#include "formats/robot/mjcf.h"
#include "formats/robot/srdf_beside.h"
#include "formats/robot/urdf.h"
#include "formats/robot/xml.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"

namespace contort {

namespace {

// The tag of the first element, after declarations and comments; "" if there is none.
std::string_view outermost_tag(std::string_view text) {
  while (true) {
    const std::size_t open = text.find('<');
    if (open == std::string_view::npos || open + 1 >= text.size()) return "";
    text.remove_prefix(open);
    const bool is_comment = text.starts_with("<!--");
    if (!is_comment && text[1] != '?' && text[1] != '!') break;
    const std::size_t close = text.find(is_comment ? "-->" : ">");
    if (close == std::string_view::npos) return "";
    text.remove_prefix(close + 1);
  }
  const std::size_t end = text.find_first_of(" \t\r\n/>", 1);
  return text.substr(1, end == std::string_view::npos ? end : end - 1);
}

Result<std::string> read_xml(const std::string& file) {
  Result<std::string> text = read_file(file, kMaxRobotBytes);
  if (!text || is_robot_text(*text)) return text;
  if (const std::optional<Issue> other = other_kind(file, *text, "a robot (.urdf, or MuJoCo's .xml)");
      other && !text->starts_with('<'))
    return *other;
  return Issue{"robot.wrong_kind", "", "its outermost element is neither <robot> (URDF, SRDF) nor <mujoco> (MJCF)"};
}

Result<RobotModel> parse_any(const std::string& file, const std::string& text) {
  if (outermost_tag(text) == "robot") return parse_urdf(text);
  const std::string folder = std::filesystem::path(file).parent_path().string();
  return parse_mjcf(
      text, [&](const std::string& name) { return read_inside(folder.empty() ? "." : folder, name, kMaxRobotBytes); });
}

std::string seen_from(const std::string& robot_file, const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(robot_file).parent_path();
  const std::filesystem::path normal = std::filesystem::path(path).lexically_normal();
  return normal.lexically_relative(folder.empty() ? "." : folder.lexically_normal()).string();
}

// This note comes first, because it affects what self_collision judges.
Result<Done> add_srdf_file(const std::string& robot_file, const std::string& srdf_file, RobotModel& robot) {
  const Result<std::string> text = read_xml(srdf_file);
  if (!text) return about_file(srdf_file, text.issue());
  const std::size_t before = robot.may_touch.size();
  if (const Result<Done> added = add_srdf(*text, robot); !added) return about_file(srdf_file, added.issue());
  robot.srdf = srdf_file;
  const std::string name = seen_from(robot_file, srdf_file);
  robot.notes.insert(robot.notes.begin(), std::to_string(robot.may_touch.size() - before) + " disabled pairs from " +
                                              (name.empty() ? srdf_file : name) + ": these links may touch.");
  const std::string about = *robot_of_srdf(*text);
  if (about != robot.name)
    note(robot, "The SRDF is about a robot " + quoted_name(about) + ", and the robot's own file says " +
                    quoted_name(robot.name) + ".");
  return Done{};
}

Issue several_fit(const std::string& robot_file, const std::vector<std::string>& fitting,
                  std::string_view how_to_choose) {
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(fitting.size(), 5); ++i) names += (i > 0 ? ", " : "") + fitting[i];
  if (fitting.size() > 5) names += " and " + std::to_string(fitting.size() - 5) + " more";
  return {"srdf.several", "",
          std::to_string(fitting.size()) + " SRDF files lie beside " + robot_file + " and have its robot's name: " +
              names + "; " + std::string(how_to_choose)};
}

void note_unfit(const std::string& robot_file, const SrdfsBeside& found, RobotModel& robot) {
  std::vector<std::string> others;
  for (const std::string& file : found.of_others) others.push_back(seen_from(robot_file, file));
  if (found.fitting.empty())
    note_all(robot, "SRDF files that lie beside the file but are about robots of other names were not used", others);
  for (const auto& [file, issue] : found.unreadable)
    note(robot, seen_from(robot_file, file) + " lies beside the file and was not used: " + issue.text + ".");
}

}  // namespace

bool is_robot_text(std::string_view text) {
  const std::string_view tag = outermost_tag(text);
  return tag == "robot" || tag == "mujoco";
}

bool is_robot_file(const std::string& path) {
  constexpr std::size_t kBeginning = 65536;  // bytes: a file may begin with a long licence
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const char* robot : {".urdf", ".xacro", ".srdf", ".mjcf", ".xml"})
    if (ending == robot) return true;
  return is_robot_text(beginning_of(path, kBeginning));
}

Result<RobotModel> read_robot(const std::string& file, const std::string& srdf_file) {
  const Result<std::string> text = read_xml(file);
  if (!text) return about_file(file, text.issue());
  Result<RobotModel> robot = parse_any(file, *text);
  if (!robot) return about_file(file, robot.issue());
  RobotModel out = std::move(robot).value();
  if (!srdf_file.empty())
    if (const Result<Done> added = add_srdf_file(file, srdf_file, out); !added) return added.issue();
  load_meshes(file, out);
  return out;
}

Result<RobotModel> read_robot_with_srdf_beside(const std::string& file, std::string_view how_to_choose) {
  Result<RobotModel> robot = read_robot(file, "");
  if (!robot || outermost_tag(*read_xml(file)) != "robot") return robot;
  RobotModel out = std::move(robot).value();
  const SrdfsBeside found = srdfs_beside(file, out.name);
  if (found.fitting.size() > 1) return several_fit(file, found.fitting, how_to_choose);
  note_unfit(file, found, out);
  if (found.fitting.empty()) return out;
  if (const Result<Done> added = add_srdf_file(file, found.fitting.front(), out); !added) return added.issue();
  return out;
}

}  // namespace contort
