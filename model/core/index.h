// Indices are int in this code, because they are subtracted and compared with -1; containers take std::size_t.
#pragma once

#include <cstddef>

namespace contort {

// The container index of a non-negative int: values[at(i)].
constexpr std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace contort
