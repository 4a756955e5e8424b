// Keeps untrusted names and links inside of a folder. All code that joins a folder and a name from a file, or follows
// a possible link in a folder with untrusted contents, uses these functions.
//
// Links are checked when a function is called. Someone who can write to the folder at the same moment could replace a
// link right after the check; these functions do not defend against that.
#pragma once

#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// Returns true if the text can only be the name of an entry of a folder: 1 to 255 bytes, neither "." nor "..", without
// "/", "\", zero bytes and other control characters.
bool is_file_name(std::string_view text);

// Refuses a path below the folder if it, or a folder on its way, is a symbolic link that leads out of the folder or
// nowhere. The path begins with the folder, as in "DIR/runs". A path that does not exist is accepted. Code
// file.outside.
Result<Done> check_inside(const std::string& folder, const std::string& path);

// Returns FOLDER/NAME, to be written, renamed or removed. NAME is a file name, or several with "/" between them. The
// last entry may be any link, because these three operations do not follow it. Codes file.bad_name, file.outside.
Result<std::string> place_inside(const std::string& folder, const std::string& name);

// Reads FOLDER/NAME, which must be a regular file; here the last entry must stay in the folder, too. Codes
// file.bad_name, file.outside and those of read_file.
Result<std::string> read_inside(const std::string& folder, const std::string& name, std::size_t max_bytes);

// Does the same for the file at `path`, which was found by listing its folder.
Result<std::string> read_beside(const std::string& path, std::size_t max_bytes);

// Calls write_file for FOLDER/NAME. Codes file.bad_name, file.outside, file.unwritable.
Result<Done> write_inside(const std::string& folder, const std::string& name, std::string_view bytes);

// Returns true if one of the functions above refused the name or path.
bool is_outside(const Issue& issue);

}  // namespace contort
