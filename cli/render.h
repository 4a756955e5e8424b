// Starts the renderer.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "model/core/result.h"

namespace contort::cli {

// A spec or case file, and the strip that is drawn of it.
struct StripFile {
  std::string file;
  std::string png;
};

// Draws strips in several processes, because Mesa draws with one thread per process (renders/raster/renderer.h). `more`
// has options of contort-render; `progress` is called from time to time. Returns the worst exit code.
int draw_strips(const std::vector<StripFile>& strips, const std::vector<std::string>& more, const Context& context,
                const std::function<void()>& progress);

// The beginning of every call of the renderer: its path, --gl, --library and --settings.
std::vector<std::string> renderer_call(const Context& context);

}  // namespace contort::cli
