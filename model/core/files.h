// Reads whole files, and writes them so that other programs see either the old or the complete new file.
#pragma once

#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// Reads a plain file. Code file.unreadable or file.too_large (over max_bytes). A pipe would make the program wait
// forever and a device would never end, so both are refused at once, and so are folders and sockets.
Result<std::string> read_file(const std::string& path, std::size_t max_bytes = std::size_t{256} << 20);

// Reads a file that a user names on the command line, which may be a pipe such as <(command) or /dev/stdin. A pipe is
// read to its end. It is refused if no program opens it for writing within a second, or if it gives nothing for ten
// seconds.
Result<std::string> read_named_file(const std::string& path, std::size_t max_bytes);

// Returns at most this many first bytes of a plain file; "" if it cannot be read.
std::string beginning_of(const std::string& path, std::size_t bytes);

// Writes a file in one of the program's own folders; write_output (output.h) is for files that a user names. It
// writes to a temporary name in the same folder and renames it; on failure the old file stays. A replaced plain file
// keeps its permissions, a symbolic link is replaced and never followed, and a pipe or a device is left alone: code
// file.unwritable.
Result<Done> write_file(const std::string& path, std::string_view bytes);

// Makes an issue with the code file.unwritable, the reason and the file's name.
Issue unwritable(const std::string& path, const std::string& why);

// Makes the folder and its parents; code file.unwritable.
Result<Done> make_folder(const std::string& path);

// Returns the kind of a file by stat's st_mode: "a folder", "a named pipe (FIFO)", …
std::string_view kind_of_mode(unsigned mode);

// Returns the issue with the file's name in front of its text, unless the text contains it already.
Issue about_file(const std::string& path, Issue issue);

}  // namespace contort
