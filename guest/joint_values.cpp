#include "guest/joint_values.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "guest/root_path.h"
#include "model/core/index.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

constexpr std::size_t kMostRows = 100'000;
constexpr std::size_t kMostNamesShown = 12;
constexpr double kEvenShare = 0.02;      // greatest deviation of clocks, as a fraction of a step
constexpr double kLeastDigits = 4.0;     // digits in a step: with fewer of them, rounding hides how even the steps are
constexpr double kSinglePose_hz = 30.0;  // rate of a table with one row

struct NamedUnit {
  std::string_view name;
  double factor;
  bool is_angle;
};
constexpr NamedUnit kValueUnits[] = {
    {"rad", 1.0, true},        {"radian", 1.0, true},        {"radians", 1.0, true},
    {"deg", kRadPerDeg, true}, {"degree", kRadPerDeg, true}, {"degrees", kRadPerDeg, true},
    {"m", 1.0, false},         {"cm", 0.01, false},          {"mm", 0.001, false}};

// A column and the joint that it moves: coordinate = factor * value - at_rest.
struct MovedJoint {
  std::size_t column = 0;
  int joint = 0;
  double factor = 1.0;
  double at_rest = 0.0;
};

bool has_one_coordinate(const Joint& joint) {
  return joint.kind == JointKind::hinge || joint.kind == JointKind::prismatic;
}

// The joints' names that a column may refer to, the likeliest first.
std::vector<std::string> meanings_of(std::string_view column) {
  std::vector<std::string> out = {std::string(column)};
  for (const std::string_view ending : {"/position", ".position", "_position", "/pos", ".pos", "_pos"})
    if (column.size() > ending.size() && column.ends_with(ending)) {
      column.remove_suffix(ending.size());
      out.emplace_back(column);
      break;
    }
  if (const std::size_t slash = column.rfind('/'); slash != column.npos) out.emplace_back(column.substr(slash + 1));
  return out;
}

std::string names_text(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamesShown); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > kMostNamesShown) text += " and " + std::to_string(names.size() - kMostNamesShown) + " more";
  return text.empty() ? "none" : text;
}

// Returns true if the rows are evenly spaced in time, up to the rounding of the written digits.
bool stand_evenly(const JointTable& table) {
  const std::vector<double>& t = table.times_s;
  if (t.size() < 2) return true;
  const double step_s = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  double least = 0.0, most = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double off = t[i] - (t.front() + static_cast<double>(i) * step_s);
    least = std::min(least, off), most = std::max(most, off);
  }
  const bool has_digits = step_s >= kLeastDigits * table.time_digit_s;
  return most - least <= std::max(kEvenShare * step_s, has_digits ? 1.01 * table.time_digit_s : 0.0);
}

class ValuesReader {
 public:
  explicit ValuesReader(const JointValues& in) : in_(in), character_(*in.character) {}

  Result<ValuesMotion> read() {
    if (in_.table.row_count() > kMostRows)
      return Issue{"check.too_long", "", "the table has more than 100,000 rows; judge it in pieces"};
    for (std::size_t column = 0; column < in_.table.columns.size(); ++column)
      if (const Result<Done> added = add_column(column); !added) return added.issue();
    if (moved_.empty()) return nothing_matches();
    out_.columns = static_cast<int>(moved_.size());
    out_.execution.character = in_.character;
    out_.execution.path = RootPath::unknown;
    set_times();
    if (const Result<Done> placed = place_root(); !placed) return placed.issue();
    for (const MovedJoint& moved : moved_) play(moved);
    follow();
    list_others();
    return std::move(out_);
  }

 private:
  // The joint of the file or of the character that the column names, with the file's value at rest; nothing if there is
  // none.
  std::optional<FileJoint> joint_meant(const std::string& column) const {
    for (const std::string& name : meanings_of(column)) {
      if (const auto found = in_.file_joints.find(name); found != in_.file_joints.end()) return found->second;
      const int joint = character_.find_joint(name);
      if (joint > 0 && has_one_coordinate(character_.joint(joint))) return FileJoint{.joint = name};
    }
    return std::nullopt;
  }

  Result<Done> add_column(std::size_t index) {
    const TableColumn& column = in_.table.columns[index];
    const std::optional<FileJoint> meant = joint_meant(column.name);
    if (!meant) return free_.push_back(index), Done{};
    if (column.fault) return *column.fault;
    const int joint = character_.find_joint(meant->joint);
    if (joint <= 0 || !has_one_coordinate(character_.joint(joint)))
      return out_.fixed_columns.push_back(column.name), Done{};
    for (const MovedJoint& other : moved_)
      if (other.joint == joint)
        return Issue{"table.duplicate_joint", "",
                     "the columns " + json_fields::quoted(in_.table.columns[other.column].name) + " and " +
                         json_fields::quoted(column.name) + " are both of the joint " + meant->joint};
    const Result<double> factor = factor_of(column, character_.joint(joint));
    if (!factor) return factor.issue();
    moved_.push_back({index, joint, *factor, meant->at_rest});
    return Done{};
  }

  Result<double> factor_of(const TableColumn& column, const Joint& joint) const {
    const bool is_angle = joint.kind == JointKind::hinge;
    if (column.unit.empty()) return is_angle && in_.in_degrees ? kRadPerDeg : 1.0;
    const auto unit = std::ranges::find(kValueUnits, column.unit, &NamedUnit::name);
    if (unit != std::end(kValueUnits) && unit->is_angle == is_angle) return unit->factor;
    return Issue{"table.wrong_unit", "",
                 "column " + json_fields::quoted(column.name) + ": found the unit " +
                     json_fields::quoted(column.unit) + ", allowed are " + (is_angle ? "rad and deg for a joint that turns" : "m, cm and mm for a travel")};
  }

  Issue nothing_matches() const {
    std::vector<std::string> joints;
    for (const auto& [name, joint] : in_.file_joints)
      if (!joint.joint.empty()) joints.push_back(name);
    if (joints.empty())
      for (const Joint& joint : character_.joints().subspan(1))
        if (has_one_coordinate(joint)) joints.push_back(joint.name);
    std::vector<std::string> columns;
    for (const TableColumn& column : in_.table.columns) columns.push_back(column.name);
    return {"check.nothing_matches", "",
            "no column has the name of a joint of " + character_.name() + " that can move: columns are " +
                names_text(columns) + "; joints are " + names_text(joints)};
  }

  void set_times() {
    const std::vector<double>& t = in_.table.times_s;
    Motion& motion = out_.execution.motion;
    motion.frame_count = static_cast<int>(t.size());
    motion.rate_hz = t.size() < 2 ? kSinglePose_hz : static_cast<double>(t.size() - 1) / (t.back() - t.front());
    if (!stand_evenly(in_.table)) motion.times_s = t;
    motion.coord_count = character_.coord_count();
    motion.root.assign(t.size(), character_.rest_root());
    for (std::size_t row = 0; row < t.size(); ++row)
      motion.coords.insert(motion.coords.end(), character_.rest_coords().begin(), character_.rest_coords().end());
  }

  // Reads the root's columns. All other columns without a joint are listed as strange.
  Result<Done> place_root() {
    const Result<std::optional<RootColumns>> root = find_root_columns(in_.table, free_);
    if (!root) return root.issue();
    for (const std::size_t column : free_) {
      const bool is_of_root = *root && std::ranges::find((*root)->columns, column) != (*root)->columns.end();
      (is_of_root ? out_.root_columns : out_.strange_columns).push_back(in_.table.columns[column].name);
    }
    if (!*root) return Done{};
    Result<std::vector<Rigid>> path = read_root_path(in_.table, **root, in_.is_y_up, in_.file_root);
    if (!path) return path.issue();
    out_.execution.motion.root = std::move(path).value();
    out_.execution.path = RootPath::told;
    return Done{};
  }

  double& coord(int frame, int joint) { return out_.execution.motion.row(frame)[at(character_.joint(joint).coord)]; }

  void play(const MovedJoint& moved) {
    for (std::size_t row = 0; row < in_.table.row_count(); ++row)
      coord(static_cast<int>(row), moved.joint) = moved.factor * in_.table.value(row, moved.column) - moved.at_rest;
  }

  bool has_column(int joint) const { return std::ranges::find(moved_, joint, &MovedJoint::joint) != moved_.end(); }

  // The coupling of two joints, in coordinates of the character; nothing if one of them is fixed there.
  std::optional<Coupling> coupling_of(const FileJoint& own) const {
    const auto leader = in_.file_joints.find(own.follows);
    if (own.follows.empty() || leader == in_.file_joints.end()) return std::nullopt;
    const int joint = character_.find_joint(own.joint), other = character_.find_joint(leader->second.joint);
    if (joint <= 0 || other <= 0 || joint == other) return std::nullopt;
    if (!has_one_coordinate(character_.joint(joint)) || !has_one_coordinate(character_.joint(other)))
      return std::nullopt;
    return Coupling{joint, other, own.multiplier,
                    own.multiplier * leader->second.at_rest + own.offset - own.at_rest};
  }

  // Computes the joints that follow others, or checks them if they have a column. A leader may follow another joint, so
  // this repeats until no further joint has a known leader.
  void follow() {
    std::vector<Coupling> open;
    for (const auto& [name, joint] : in_.file_joints)
      if (const std::optional<Coupling> coupling = coupling_of(joint)) open.push_back(*coupling);
    std::vector<int> known;
    for (const MovedJoint& moved : moved_) known.push_back(moved.joint);
    const auto is_known = [&](int joint) { return std::ranges::find(known, joint) != known.end(); };
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (const Coupling& coupling : std::vector<Coupling>(open)) {
        if (!is_known(coupling.leader)) continue;
        goes_on = true;
        std::erase(open, coupling);
        if (has_column(coupling.joint)) {
          out_.execution.couplings.push_back(coupling);
        } else {
          compute(coupling);
          known.push_back(coupling.joint);
        }
      }
    }
  }

  void compute(const Coupling& coupling) {
    for (int frame = 0; frame < out_.execution.motion.frame_count; ++frame)
      coord(frame, coupling.joint) = coupling.multiplier * coord(frame, coupling.leader) + coupling.offset;
    out_.computed.push_back(character_.joint(coupling.joint).name);
  }

  void list_others() {
    for (int j = 1; j < static_cast<int>(character_.joints().size()); ++j) {
      const std::string& name = character_.joint(j).name;
      if (!has_column(j) && std::ranges::find(out_.computed, name) == out_.computed.end())
        out_.joints_at_rest.push_back(name);
    }
  }

  const JointValues& in_;
  const Character& character_;
  std::vector<MovedJoint> moved_;
  std::vector<std::size_t> free_;  // columns without a joint
  ValuesMotion out_;
};

}  // namespace

Result<ValuesMotion> motion_of_values(const JointValues& values) { return ValuesReader(values).read(); }

}  // namespace contort
