#include "generator/core/result.h"

namespace contort {

std::string to_line(const Issue& issue) {
  if (issue.pointer.empty()) return issue.code + ": " + issue.text;
  return issue.code + " at " + issue.pointer + ": " + issue.text;
}

}  // namespace contort
