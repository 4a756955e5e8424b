// The lines of the golden program, for every platform that runs it.
#pragma once

#include <cstdint>
#include <span>

#include "corpus/evaluator.h"
#include "model/spec/spec.h"

namespace contort::golden {

inline constexpr int kDrawnCases = 200;

// Prints the lines that need no drawn cases: mathematics, kernels and scenes.
void print_fixed();

// The hash of a spec with its motion and findings; 0 if the generator refuses it.
std::uint64_t hash_of(const Spec& spec, Evaluator& evaluator);

// Prints the line of the drawn cases from their hashes in order.
void print_drawn(int jobs, std::span<const std::uint64_t> hashes);

}  // namespace contort::golden
