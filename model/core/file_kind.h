// Recognises common kinds of files, for messages to people who named the wrong one.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// As many first bytes of a file as are needed to recognise its kind: a robot's description may begin with a long
// licence.
inline constexpr std::size_t kKindBytes = 8192;

// The kind of a text of numbers with a separator.
inline constexpr std::string_view kTableKind = "a table of numbers (CSV)";

// Returns the kind of a file by its first bytes, whatever its name, such as "a PNG image"; "" if it is unknown. Plain
// JSON is not recognised.
std::string_view kind_of_bytes(std::string_view bytes);

// Returns true if people take files of this kind for animations, so that a message with a remedy helps.
bool has_advice(std::string_view bytes);

// Returns an issue such as "PATH is an FBX model, expected a spec; export it as glTF"; nothing if their kind is
// unknown.
std::optional<Issue> other_kind(const std::string& path, std::string_view bytes, const std::string& expected);

// Returns such an issue for a file of another kind than expected. If the kind is unknown, the text quotes the ending of
// the file's name and its first bytes.
Issue unknown_kind(const std::string& path, std::string_view bytes, const std::string& expected);

// Reads a JSON file of at most json_fields::kMaxDocumentBytes. Code file.wrong_kind for another kind of file, even if
// it is too large, and the codes of read_file.
Result<std::string> read_json_file(const std::string& path, const std::string& expected);

// Reads the file with read_named_file instead of read_file.
Result<std::string> read_named_json(const std::string& path, const std::string& expected);

}  // namespace contort
