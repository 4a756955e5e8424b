#include "generator/core/result.h"

namespace contort {

namespace {

// Pointers and texts quote the input, which may hold control characters, or be a megabyte of one key.
std::string one_line(const std::string& text, std::size_t most) {
  std::string line;
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  return text.size() > most ? line + "…" : line;
}

}  // namespace

std::string to_line(const Issue& issue) {
  const std::string text = one_line(issue.text, 1000);
  if (issue.pointer.empty()) return issue.code + ": " + text;
  return issue.code + " at " + one_line(issue.pointer, 500) + ": " + text;
}

}  // namespace contort
