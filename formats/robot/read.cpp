#include "formats/robot/read.h"

#include <filesystem>

#include "formats/robot/meshes.h"
#include "formats/robot/mjcf.h"
#include "formats/robot/urdf.h"
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

}  // namespace

bool is_robot_text(std::string_view text) {
  const std::string_view tag = outermost_tag(text);
  return tag == "robot" || tag == "mujoco";
}

Result<RobotModel> read_robot(const std::string& file, const std::string& srdf_file) {
  const Result<std::string> text = read_xml(file);
  if (!text) return about_file(file, text.issue());
  Result<RobotModel> robot = parse_any(file, *text);
  if (!robot) return about_file(file, robot.issue());
  RobotModel out = std::move(robot).value();
  if (!srdf_file.empty()) {
    const Result<std::string> srdf = read_xml(srdf_file);
    if (!srdf) return about_file(srdf_file, srdf.issue());
    if (const Result<Done> added = add_srdf(*srdf, out); !added) return about_file(srdf_file, added.issue());
  }
  load_meshes(file, out);
  return out;
}

}  // namespace contort
