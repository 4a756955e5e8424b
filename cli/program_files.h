// Finds the running program and the files that it needs. In a build they are beside the program. An installation may be
// moved as a whole: its programs are in bin, and the other files at fixed relative paths.
#pragma once

#include <string>

namespace contort::cli {

// The path of the running program.
std::string own_path();

// contort-render: in ../libexec/contort, or beside the program.
std::string renderer_path();

// The folder of the report's viewer and of the server's pages: ../share/contort/page, or page beside the program.
std::string pages_path();

// Returns true if this build includes engine.js, with which pages play specs (docs/internals/wasm.md).
bool has_engine();

}  // namespace contort::cli
