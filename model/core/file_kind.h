// Recognises common kinds of files, for messages to people who named the wrong one.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// The first bytes of a file that are enough to tell its kind: licences stand before the root of robots' descriptions.
inline constexpr std::size_t kKindBytes = 8192;

// Returns the kind of a file by its first bytes, whatever its name, such as "a PNG image"; "" if it is unknown. Plain
// JSON is not recognised.
std::string_view kind_of_bytes(std::string_view bytes);

// Whether there is something to do about files of this kind where an animation is expected; people take them for one.
bool has_advice(std::string_view bytes);

// Returns an issue such as "PATH is an FBX model, expected a spec; export it as glTF"; nothing if the bytes are of no
// known kind.
std::optional<Issue> other_kind(const std::string& path, std::string_view bytes, const std::string& expected);

// Returns such an issue for a file that is not what is expected, even if its kind is unknown: by the ending of its name
// and what it begins with.
Issue unknown_kind(const std::string& path, std::string_view bytes, const std::string& expected);

// Reads a JSON file of at most json_fields::kMaxDocumentBytes. Code file.wrong_kind for another kind of file, even if
// it is too large, and the codes of read_file.
Result<std::string> read_json_file(const std::string& path, const std::string& expected);

// Reads the file with read_named_file instead of read_file.
Result<std::string> read_named_json(const std::string& path, const std::string& expected);

}  // namespace contort
