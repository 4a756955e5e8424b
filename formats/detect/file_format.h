// Chooses the reader of an animation file by its contents, not by its name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contort {

enum class FileFormat : std::uint8_t { none, gltf, bvh, amc, asf, joint_table };

// Decides by the first bytes (kKindBytes of them are enough). A glTF model as text is not recognised.
FileFormat format_of_bytes(std::string_view bytes);

// Decides by the ending of the name. It is for files with other contents, whose reader then reports the fault.
FileFormat format_of_ending(const std::string& path);

// Decides by the contents of the file, else by its ending. It never waits: anything but a plain file is decided by its
// ending.
FileFormat format_of_file(const std::string& path);

}  // namespace contort
