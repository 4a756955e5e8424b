#include "cli/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace contort::cli {

ProgressLine::ProgressLine() : shown_(::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(double share, const std::string& text) const {
  if (!shown_) return;
  const int filled = static_cast<int>(24 * std::clamp(share, 0.0, 1.0));
  std::fprintf(stderr, "\r[%.*s%*s] %s ", filled, "########################", 24 - filled, "", text.c_str());
  std::fflush(stderr);
}

void ProgressLine::clear() const {
  if (shown_) std::fprintf(stderr, "\r%100s\r", "");
}

}  // namespace contort::cli
