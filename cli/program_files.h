// Where the running program and the files that it needs lie. In a build they are beside the program. An installation may
// be moved as a whole: there, its programs are in bin and the others at fixed ways from bin.
#pragma once

#include <string>

namespace contort::cli {

// The running program itself.
std::string own_path();

// contort-render: beside the program, or in ../libexec/contort.
std::string renderer_path();

// The folder of the report's viewer and of the server's pages: page beside the program, or ../share/contort/page.
std::string pages_path();

}  // namespace contort::cli
