// Writes files that a user names. The way depends on the kind of an existing file: a plain file is replaced at once by
// the complete new one and keeps its permissions; a symbolic link stays, and its target is written; a pipe, a terminal,
// /dev/null, /dev/stdout and /dev/fd/N receive the bytes. Folders, sockets and disks are refused. All codes are
// file.unwritable.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

Result<Done> write_output(const std::string& path, std::string_view bytes);

// Appends to a plain file.
Result<Done> append_output(const std::string& path, std::string_view bytes);

// For output that is written piece by piece. A plain file is written in place, so that others can follow it.
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OutputFile = std::unique_ptr<std::FILE, CloseFile>;
enum class Start { anew, at_the_end };
Result<OutputFile> open_output(const std::string& path, Start start);

// Checks as far as possible without writing that write_output will work. Call it before long work.
Result<Done> check_output(const std::string& path);

}  // namespace contort
