// Shows progress as one line on standard error that is rewritten in place; only on a terminal.
#pragma once

#include <string>

namespace contort::cli {

class ProgressLine {
 public:
  ProgressLine();
  // Shows progress in [0, 1] with a text. Callers whose text is expensive ask `wanted` first.
  bool wanted() const { return shown_; }
  void show(double share, const std::string& text) const;
  void clear() const;

 private:
  bool shown_;
};

}  // namespace contort::cli
