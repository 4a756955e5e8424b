// One libFuzzer program: the target that CONTORT_TARGET names.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "tests/libfuzzer/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contort::hostile;
  static const auto target = std::ranges::find(all_targets(), std::string_view(CONTORT_TARGET), &Target::name);
  target->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
