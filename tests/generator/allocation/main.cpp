// Generating again with the same scratch memory must not allocate: neither the frame loop nor what prepares it. A program
// of its own, because it replaces operator new.
#include <cstdio>
#include <cstdlib>
#include <new>

#include "fuzz/draw.h"
#include "generator/generate.h"

namespace {
long allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

int main() {
  const contort::Library library = contort::stock_library();
  contort::GenerateScratch scratch;
  contort::Motion motion;
  int failures = 0;
  long first_runs = 0;
  for (int i = 0; i < 200; ++i) {
    contort::Spec spec = contort::draw_spec({{"human", "mech", "quadruped"}}, library, 3, i);
    spec.dynamics = {};  // a simulation lays its target out anew for every motion
    const auto stage = contort::build_stage(spec, library);
    if (!stage) return 1;
    const long before = allocations;
    contort::generate(*stage, scratch, motion);
    const long between = allocations;
    contort::generate(*stage, scratch, motion);
    first_runs += between - before;
    if (allocations == between) continue;
    ++failures;
    std::printf("spec %d: %ld allocations in the second run\n", i, allocations - between);
  }
  if (first_runs == 0) return std::puts("nothing was counted at all"), 1;
  std::printf("%d of 200 specs allocated\n", failures);
  return failures == 0 ? 0 : 1;
}
