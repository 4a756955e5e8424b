// Tells which reader a file of animation is for: by what it holds, whatever its name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contort {

enum class FileFormat : std::uint8_t { none, gltf, bvh, amc, asf };

// By the first bytes (kKindBytes of them are enough). A glTF model as text is not recognised.
FileFormat format_of_bytes(std::string_view bytes);

// By the ending of the name; for files that hold something else, so that their reader says what.
FileFormat format_of_ending(const std::string& path);

// By what the file holds, else by its ending. It never waits: what is no plain file goes by its ending.
FileFormat format_of_file(const std::string& path);

}  // namespace contort
