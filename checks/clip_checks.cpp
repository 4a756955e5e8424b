#include "checks/clip_checks.h"

#include "checks/loop_seam.h"
#include "checks/part_gap.h"

namespace contort {

std::span<const ClipCheckDef> clip_checks() {
  static constexpr ClipCheckDef kChecks[] = {
      {"loop_seam", kSeamScale_rad, "Clips: a loop does not end as it begins (contort check --loops)."},
      {"part_gap", kGapScale_m, "Clips: a joint is out of its place (contort check --max-gap-m)."}};
  return kChecks;
}

}  // namespace contort
