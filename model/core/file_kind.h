// Recognises common kinds of files, for messages to people who named the wrong one.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// Returns the kind of a file by its first bytes, whatever its name, such as "a PNG image"; "" if it is unknown. Plain
// JSON is not recognised.
std::string_view kind_of_bytes(std::string_view bytes);

// Returns an issue such as "PATH is a PNG image, expected a spec"; nothing if the bytes are of no known kind.
std::optional<Issue> other_kind(const std::string& path, std::string_view bytes, const std::string& expected);

// Reads a JSON file of at most json_fields::kMaxDocumentBytes. Code file.wrong_kind for another kind of file, even if
// it is too large, and the codes of read_file.
Result<std::string> read_json_file(const std::string& path, const std::string& expected);

// Reads the file with read_named_file instead of read_file.
Result<std::string> read_named_json(const std::string& path, const std::string& expected);

}  // namespace contort
