// The limits of a glTF file. They are checked before memory is allocated for what they count. The largest of the 227
// files that the tests read has 3.7 MB, 924 nodes and 160 000 JSON values.
#pragma once

#include <cstddef>
#include <cstdint>

namespace contort {

inline constexpr std::size_t kMaxGltfBytes = std::size_t{192} << 20;  // Size of the file, or of its buffers together.
inline constexpr int kMaxGltfDepth = 64;  // Brackets within brackets. tinygltf dies at 14 500.
inline constexpr std::uint64_t kMaxGltfValues =
    1'000'000;  // JSON values; the worst cost 0.3 GB and 3 s in two parsers.
inline constexpr std::int64_t kMaxGltfNodes = 65'536;
inline constexpr std::int64_t kMaxGltfNameBytes = 1024;
// The limit for keys, tangents, matrices and vertices, counted once for every channel or skin that uses them: a
// thousand channels may share one accessor, and a small file would expand to gigabytes. If all are splines, they take
// 0.4 GB with their speeds.
inline constexpr std::uint64_t kMaxGltfNumbers = std::uint64_t{16} << 20;
// No number of a node's translation, scale or matrix may be larger: its square would overflow. Accessors hold 32-bit
// floats.
inline constexpr double kMaxGltfLength = 1e100;
inline constexpr double kUnitTolerance = 0.01;  // Error of a quaternion's length; a byte one is off by up to 0.008.

}  // namespace contort
