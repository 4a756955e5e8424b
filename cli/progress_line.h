// Shows how far something has come: one line on standard error, rewritten in place; only on a terminal.
#pragma once

#include <string>

namespace contort::cli {

class ProgressLine {
 public:
  ProgressLine();
  // Progress in [0, 1], with what there is to say of it. Whoever has much to add up asks `wanted` first.
  bool wanted() const { return shown_; }
  void show(double share, const std::string& text) const;
  void clear() const;

 private:
  bool shown_;
};

}  // namespace contort::cli
