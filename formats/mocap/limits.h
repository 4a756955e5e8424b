// The limits of a motion capture file. They are checked before memory is allocated. They allow a take of an hour at
// 120 Hz with 60 joints: 26 million keys of 79 million numbers, in 300 to 800 MB of text.
#pragma once

#include <cstddef>
#include <cstdint>

namespace contort {

inline constexpr std::size_t kMaxMocapBytes = std::size_t{1} << 30;
inline constexpr int kMaxMocapNodes = 16'384;
inline constexpr int kMaxMocapDepth = 1024;  // Joints within joints. Nothing recurses; it only keeps poses affordable.
inline constexpr std::size_t kMaxMocapNameBytes = 1024;
inline constexpr std::int64_t kMaxMocapNumbers = std::int64_t{96} << 20;  // Frames times channels.
// The limit for frames times joints that turn or move. A key takes 40 bytes, whatever the number of its channels.
inline constexpr std::int64_t kMaxMocapKeys = std::int64_t{32} << 20;
// The limit for angles, in degrees. A joint that turns 10 000 times is a fault of the file, and sines of large angles
// lose their digits.
inline constexpr double kMaxMocapAngle_deg = 3'600'000.0;
// The limit for lengths, in the file's unit: the square of a larger one overflows.
inline constexpr double kMaxMocapLength = 1e100;
inline constexpr double kMaxMocapDirection = 1e6;  // A bone's direction, by which its length is multiplied; mostly 1.

}  // namespace contort
