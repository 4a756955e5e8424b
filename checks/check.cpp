#include "checks/check.h"

#include <algorithm>

#include "model/core/assert.h"

namespace contort {

#define X(name, scale, resolution, needs_world, help) \
  int name##_subject_count(const Character&);         \
  Subject name##_subject(const Character&, int);      \
  void name##_measure(const CheckInput&, MarginFold&);
#include "checks/check_list.inc"
#undef X

std::span<const CheckDef> all_checks() {
  static const CheckDef checks[] = {
#define X(name, scale, resolution, needs_world, help) \
  {#name, scale, resolution, needs_world, help, name##_subject_count, name##_subject, name##_measure},
#include "checks/check_list.inc"
#undef X
  };
  return checks;
}

const CheckDef& find_check(std::string_view name) {
  const std::span<const CheckDef> checks = all_checks();
  const auto found = std::find_if(checks.begin(), checks.end(), [name](const CheckDef& c) { return c.name == name; });
  CONTORT_ASSERT(found != checks.end());
  return *found;
}

}  // namespace contort
