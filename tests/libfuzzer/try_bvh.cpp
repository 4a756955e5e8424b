#include "formats/mocap/bvh.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

bool try_bvh(std::string_view bytes) {
  const Result<Asset> asset = parse_bvh(bytes, "take");
  if (!asset) return require_clean(asset.issue()), false;
  look_at(*asset);
  return true;
}

}  // namespace contort::hostile
