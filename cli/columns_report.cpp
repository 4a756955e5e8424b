#include "cli/columns_report.h"

#include <algorithm>
#include <cstdio>

#include "cli/print.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

constexpr std::size_t kMostColumnNames = 5;

void print_names(const char* what, const std::vector<std::string>& names) {
  if (!names.empty()) std::printf("  %s: %s\n", what, some_names(names).c_str());
}

}  // namespace

std::string some_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostColumnNames); ++i)
    text += (i > 0 ? ", " : "") + printable(names[i]);
  const std::size_t more = names.size() - std::min(names.size(), kMostColumnNames);
  return more == 0 ? text : text + " and " + std::to_string(more) + " more";
}

void print_columns(const ClipMotion& motion) {
  std::printf("  %d of %d columns are joints of the character\n", motion.columns, motion.column_count);
  if (!motion.root_columns.empty())
    std::printf("  %zu columns say where the root is\n", motion.root_columns.size());
  print_names("not judged: columns that name no joint", motion.stray_nodes);
  print_names("not judged: columns of joints that do not move in the character", motion.fixed_columns);
  print_names("computed: joints without a column that follow another joint", motion.computed);
  print_names("at rest: joints without a column", motion.joints_at_rest);
}

std::string columns_text(const ClipMotion& motion) {
  return "; " + std::to_string(motion.columns) + " of " + std::to_string(motion.column_count) + " columns are joints";
}

std::string columns_json(const ClipMotion& motion) {
  const json_fields::Json out = {{"columns", motion.columns},
                                 {"column_count", motion.column_count},
                                 {"root_columns", motion.root_columns},
                                 {"columns_without_joint", motion.stray_nodes},
                                 {"columns_of_fixed_joints", motion.fixed_columns},
                                 {"computed", motion.computed},
                                 {"joints_at_rest", motion.joints_at_rest},
                                 {"rate_hz", motion.rate_hz},
                                 {"is_even", motion.times_s.empty()},
                                 {"frames", motion.frames},
                                 {"joints", motion.joints},
                                 {"joint_count", motion.joint_count}};
  return json_fields::compact_text(out);
}

}  // namespace contort::cli
