// Generating again with the same scratch memory must not allocate, neither in the frame loop nor in its preparation. It
// is a program of its own, because it replaces operator new.
#include <cstdio>
#include <cstdlib>
#include <new>

#include "fuzz/draw.h"
#include "generator/generate.h"
#include "tests/stage_evaluator.h"

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

namespace {

// Allocations of generating a spec once more, after memory has been used for it.
long again(const contort::Stage& stage, contort::GenerateScratch& scratch, contort::Motion& motion) {
  contort::generate(stage, scratch, motion);
  const long before = allocations;
  contort::generate(stage, scratch, motion);
  return allocations - before;
}

int failures = 0;

void expect_none(int index, const contort::Stage& stage, contort::GenerateScratch& scratch, contort::Motion& motion) {
  const long count = again(stage, scratch, motion);
  if (count == 0) return;
  ++failures;
  std::printf("spec %d: %ld allocations in the second run\n", index, count);
}

// A simulation lays its target out anew for every motion; its ticks must not allocate. Four times as many ticks of the
// same frames: as many allocations.
void expect_none_in_ticks(int index, contort::Spec spec, const contort::Library& library,
                          contort::GenerateScratch& scratch, contort::Motion& motion) {
  long counts[2];
  for (const int k : {0, 1}) {
    spec.dynamics.ticks_per_frame = k == 0 ? 2 : 8;
    counts[k] = again(*contort::build_stage(spec, library), scratch, motion);
  }
  if (counts[1] == counts[0]) return;
  ++failures;
  std::printf("spec %d: %ld allocations with 2 ticks a frame, %ld with 8\n", index, counts[0], counts[1]);
}

}  // namespace

int main() {
  const contort::Library library = contort::stock_library();
  contort::BuiltInGenerator generator(library);
  contort::GenerateScratch scratch;
  contort::Motion motion;
  int simulated = 0;
  const long before = allocations;
  for (int i = 0; i < 200; ++i) {
    contort::Spec spec = contort::draw_spec({{"human", "mech", "quadruped"}}, generator, 3, i);
    if (!contort::build_stage(spec, library)) return 1;
    simulated += spec.dynamics.mode != contort::Mode::kinematic;
    if (spec.dynamics.mode != contort::Mode::kinematic) expect_none_in_ticks(i, spec, library, scratch, motion);
    spec.dynamics = {};
    expect_none(i, *contort::build_stage(spec, library), scratch, motion);
  }
  if (allocations == before || simulated == 0) return std::puts("nothing was counted at all"), 1;
  std::printf("%d of 200 specs allocated; %d were simulated too\n", failures, simulated);
  return failures == 0 ? 0 : 1;
}
