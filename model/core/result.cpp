#include "model/core/result.h"

namespace contort {

namespace {

// Makes text safe for one line: pointers and texts quote the input, which may contain control characters or a key of a
// megabyte.
std::string one_line(const std::string& text, std::size_t most) {
  std::size_t end = text.size();
  if (end > most)
    for (end = most; end > 0 && (text[end] & 0xc0) == 0x80;) --end;  // does not cut a character
  std::string line = text.substr(0, end);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return end < text.size() ? line + "…" : line;
}

}  // namespace

std::string to_line(const Issue& issue) {
  const std::string text = one_line(issue.text, 4000);
  if (issue.pointer.empty()) return issue.code + ": " + text;
  return issue.code + " at " + one_line(issue.pointer, 1000) + ": " + text;
}

}  // namespace contort
