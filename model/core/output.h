// Files that a user names for a program to write. What is there already is written in the way that its kind allows: a
// plain file is replaced at once by the whole of the new one and keeps its permissions; a symbolic link stays, and what
// it leads to is written; a pipe, a terminal, /dev/null, /dev/stdout and /dev/fd/N take the bytes and stay what they
// are. Folders, sockets and disks are refused. All codes are file.unwritable.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

Result<Done> write_output(const std::string& path, std::string_view bytes);

// Behind what a plain file has already.
Result<Done> append_output(const std::string& path, std::string_view bytes);

// For output that comes bit by bit. A plain file is written in place, so that others can follow it.
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OutputFile = std::unique_ptr<std::FILE, CloseFile>;
enum class Start { anew, at_the_end };
Result<OutputFile> open_output(const std::string& path, Start start);

// Whether write_output could work, as far as that can be seen without writing: for whoever has an hour of work to do
// first.
Result<Done> check_output(const std::string& path);

}  // namespace contort
