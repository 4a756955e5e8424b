// The limits of a motion capture file. They are checked before memory is allocated. The largest of the files that the
// tests read has 2.1 MB, 142 nodes and 264 000 numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace contort {

inline constexpr std::size_t kMaxMocapBytes = std::size_t{128} << 20;
inline constexpr int kMaxMocapNodes = 16'384;
inline constexpr int kMaxMocapDepth = 1024;  // Joints within joints. Nothing recurses; it only keeps poses affordable.
inline constexpr std::size_t kMaxMocapNameBytes = 1024;
inline constexpr std::int64_t kMaxMocapNumbers = std::int64_t{8} << 20;  // Frames times channels.
// The limit for frames times turned or moved joints. A key and its speed take up to 130 bytes, however few numbers it
// is made from.
inline constexpr std::int64_t kMaxMocapKeys = std::int64_t{3} << 20;
// The limit for angles, in degrees. A joint that turns 10 000 times is a fault of the file, and sines of large angles
// lose their digits.
inline constexpr double kMaxMocapAngle_deg = 3'600'000.0;
// The limit for lengths, in the file's unit: the square of a larger one overflows.
inline constexpr double kMaxMocapLength = 1e100;
inline constexpr double kMaxMocapDirection = 1e6;  // A bone's direction, by which its length is multiplied; mostly 1.

}  // namespace contort
