#include "fuzz/features.h"

#include "model/core/hash.h"

namespace contort {

bool Features::omits(std::string_view kind, std::string_view name) const {
  if (omitted_ == 0) return false;
  Hash64 hash;
  hash.add(static_cast<std::uint64_t>(omitted_));
  hash.add(kind);
  hash.add(name);
  return (hash.value() >> 40 & 1U) != 0;
}

}  // namespace contort
