// Files, read whole and written so that nobody ever sees half of one.
#pragma once

#include <string>
#include <string_view>

#include "generator/core/result.h"

namespace contort {

// The file's bytes; code file.unreadable or file.too_large (over max_bytes).
Result<std::string> read_file(const std::string& path, std::size_t max_bytes = std::size_t{256} << 20);

// The same for what strangers name: a pipe would make us wait for ever and a device would never end, so both are
// refused, and so is a file that is too large, before it is opened.
Result<std::string> read_regular_file(const std::string& path, std::size_t max_bytes);

// Writes to a temporary name in the same folder and renames it; on failure the old file stays. Code file.unwritable.
Result<Done> write_file(const std::string& path, std::string_view bytes);

// Makes the folder and those above it; code file.unwritable.
Result<Done> make_folder(const std::string& path);

}  // namespace contort
