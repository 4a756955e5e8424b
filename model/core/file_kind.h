// Recognises common kinds of files, for messages to people who named the wrong one.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// "a PNG image": what the first bytes say, whatever the file is called; "" where they say nothing that is known. Plain
// JSON is not told apart.
std::string_view kind_of_bytes(std::string_view bytes);

// "PATH is a PNG image, expected a spec"; nothing where the bytes are of no known kind.
std::optional<Issue> other_kind(const std::string& path, std::string_view bytes, const std::string& expected);

// The text of a JSON file of at most json_fields::kMaxDocumentBytes; code file.wrong_kind for another kind of file,
// even where it is too large, and the codes of read_file.
Result<std::string> read_json_file(const std::string& path, const std::string& expected);

// The same with read_named_file.
Result<std::string> read_named_json(const std::string& path, const std::string& expected);

}  // namespace contort
