#include "checks/dof_limits.h"
#include "formats/mocap/amc.h"
#include "formats/mocap/asf.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

bool try_asf_amc(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find("#!"), bytes.size());
  const Result<AsfSkeleton> skeleton = parse_asf(bytes.substr(0, end));
  if (!skeleton) return require_clean(skeleton.issue()), false;
  const Result<AmcMotion> motion = parse_amc(bytes.substr(end), *skeleton);
  if (!motion) return require_clean(motion.issue()), false;
  check_dof_limits(*skeleton, *motion);
  look_at(to_asset(*skeleton, *motion, 120.0, "take"));
  return true;
}

}  // namespace contort::hostile
