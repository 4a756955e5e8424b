// Files, read whole and written so that nobody ever sees half of one.
#pragma once

#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// The bytes of a plain file; code file.unreadable or file.too_large (over max_bytes). A pipe would make the program
// wait for ever and a device would never end, so both are refused at once, and so are folders and sockets.
Result<std::string> read_file(const std::string& path, std::size_t max_bytes = std::size_t{256} << 20);

// The same for a file that a user names on the command line, where a pipe such as <(command) or /dev/stdin is meant: a
// pipe is read to its end, too. A pipe that no program writes into is refused after a second, and one that is silent
// for ten seconds is given up.
Result<std::string> read_named_file(const std::string& path, std::size_t max_bytes);

// The first bytes of a plain file, as far as there are so many; "" where it cannot be read.
std::string beginning_of(const std::string& path, std::size_t bytes);

// For files in folders that the program itself keeps; what a user names is for write_output (output.h). Writes to a
// temporary name in the same folder and renames it; on failure the old file stays. A plain file that is replaced keeps
// its permissions, a symbolic link is replaced and never followed, and a pipe or a device is left alone: code
// file.unwritable.
Result<Done> write_file(const std::string& path, std::string_view bytes);

// Code file.unwritable: what went wrong, with the file's name.
Issue unwritable(const std::string& path, const std::string& why);

// Makes the folder and those above it; code file.unwritable.
Result<Done> make_folder(const std::string& path);

// "a folder", "a named pipe (FIFO)", …: what stat's st_mode says that something is.
std::string_view kind_of_mode(unsigned mode);

// The issue with the file's name in front of its text, unless the text names it already.
Issue about_file(const std::string& path, Issue issue);

}  // namespace contort
