#include "model/core/assert.h"

#ifdef CONTORT_ASSERTS
#include <cstdio>
#include <cstdlib>

namespace contort {
void assertion_failed(const char* expression, const char* file, int line) {
  std::fprintf(stderr, "contort: internal error: %s does not hold (%s:%d)\n", expression, file, line);
  std::abort();
}
}  // namespace contort
#endif
