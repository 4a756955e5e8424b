// Names and links that strangers wrote must not lead out of a folder. Everything that joins a folder and a name out of
// a file, or follows what may be a link in a folder that others filled, does it by these functions.
//
// Links are looked at when a function is called. Somebody who may write into the folder at the same moment can exchange
// one right afterwards: such a person is not kept out.
#pragma once

#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

// Whether the text can be the name of one entry of a folder and nothing else: 1 to 255 bytes, neither "." nor "..", no
// "/" and no "\", no zero byte and no other control character.
bool is_file_name(std::string_view text);

// Refuses a path below the folder where it, or a folder on its way, is a symbolic link that leads out of the folder or
// nowhere. The path begins with the folder, as in "DIR/runs". What is not there leads nowhere else and is fine. Code
// file.outside.
Result<Done> check_inside(const std::string& folder, const std::string& path);

// FOLDER/NAME, to be written, renamed or removed. NAME is a file name, or several with "/" between them. The last entry
// may be any link, because none of these three follows it. Codes file.bad_name, file.outside.
Result<std::string> place_inside(const std::string& folder, const std::string& name);

// The bytes of FOLDER/NAME, of a regular file; here the last entry must stay in the folder, too. Codes file.bad_name,
// file.outside and those of read_file.
Result<std::string> read_inside(const std::string& folder, const std::string& name, std::size_t max_bytes);

// The same for the file at `path`, which was found by looking into its folder.
Result<std::string> read_beside(const std::string& path, std::size_t max_bytes);

// write_file to FOLDER/NAME. Codes file.bad_name, file.outside, file.unwritable.
Result<Done> write_inside(const std::string& folder, const std::string& name, std::string_view bytes);

// Whether one of the functions above refused it.
bool is_outside(const Issue& issue);

}  // namespace contort
