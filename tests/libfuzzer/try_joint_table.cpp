#include "checks/joint_map.h"
#include "checks/judge.h"
#include "formats/table/joint_table.h"
#include "guest/joint_values.h"
#include "model/character/library.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

constexpr std::size_t kMostJudgedRows = 32;

const std::shared_ptr<const Character>& judged_dog() {
  static const auto dog =
      std::make_shared<const Character>(*build_character({"quadruped", {}, {}}, stock_library()));
  return dog;
}

// Two joints of the dog with short names; one follows the other.
FileJoints two_joints() {
  std::vector<std::string> hinges;
  for (const Joint& joint : judged_dog()->joints())
    if (joint.kind == JointKind::hinge) hinges.push_back(joint.name);
  return {{"a", {hinges[0], 0.1}}, {"b", {hinges[1], 0.0, "a", 2.0, 0.1}}};
}

}  // namespace

bool try_joint_table(std::string_view bytes) {
  if (const Result<JointTable> at_rate = parse_joint_table(bytes, 30.0); !at_rate) require_clean(at_rate.issue());
  const Result<JointTable> table = parse_joint_table(bytes);
  if (!table) return require_clean(table.issue()), false;
  require(table->values.size() == table->row_count() * table->columns.size(), "a table is whole");
  const FileJoints joints = two_joints();
  const Result<ValuesMotion> made = motion_of_values({*table, judged_dog(), joints, false});
  if (!made) return require_clean(made.issue()), false;
  if (table->row_count() <= kMostJudgedRows) Judge().evaluate(made->execution);
  return true;
}

}  // namespace contort::hostile
