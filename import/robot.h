// Makes a character from a robot: its limits, speeds, efforts, masses, shapes and allowed contacts are those of the
// file (docs/reference/import.md).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/robot/robot.h"
#include "import/import.h"
#include "model/character/desc.h"
#include "model/core/result.h"

namespace contort {

// A joint of the character with the data of the robot's file, for the report.
struct RobotJointReport {
  std::string file_name;
  std::string joint;  // "arm/elbow"; "" if it is not a joint of the character
  RobotJoint in_file;
  double rest = 0.0;  // the file's value in the character's rest pose, rad or m
  std::string remark;
};

struct ImportedRobot {
  std::vector<PartDesc> parts;
  CharacterDesc character;
  std::vector<RobotJointReport> joints;
  std::map<std::string, std::string> joint_of_body;  // by body of the file; "root" for the root's body
  std::vector<std::string> notes;
  bool is_skeleton = false;  // the file is a skeleton of motion capture
  int pairs_of_file = 0;  // pairs that the file allows
  int pairs_at_rest = 0;  // pairs that are allowed because no motion can avoid them
  double mass_kg = 0.0;
  double height_m = 0.0;          // height of the colliders at rest
  std::vector<ImportFile> files;  // the report is the last one
};

// Code import.bad_name, .too_many_parts, .too_many_pairs, and those of build_character.
Result<ImportedRobot> import_robot(const RobotModel& robot, const std::string& name);

// Returns the text of the report, NAME.import.md.
std::string write_robot_report(const ImportedRobot& imported);

}  // namespace contort
