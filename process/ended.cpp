#include "process/ended.h"

#include <algorithm>
#include <utility>

namespace contort {

std::string describe(const Ending& ending, std::size_t most_printed) {
  std::string text = ending.kind == Ending::Kind::timeout  ? "the program did not answer in time"
                     : ending.kind == Ending::Kind::memory ? "the program used too much memory"
                                                           : "the program ended: " + ending.signal;
  if (ending.printed.empty()) return text;
  const std::size_t left_out = ending.printed.size() - std::min(ending.printed.size(), most_printed);
  return text + "; it printed: " + (left_out > 0 ? "..." : "") + ending.printed.substr(left_out);
}

std::string print_ending(const Ending& ending) {
  return std::to_string(static_cast<int>(ending.kind)) + "\n" + ending.signal + "\n" + ending.printed;
}

Ending parse_ending(const std::string& text) {
  Ending ending{Ending::Kind::crash, {}, {}, {}};
  const std::size_t kind = text.find('\n');
  const std::size_t signal = kind == std::string::npos ? kind : text.find('\n', kind + 1);
  if (signal == std::string::npos) return ending;
  if (text[0] == '2') ending.kind = Ending::Kind::timeout;
  if (text[0] == '3') ending.kind = Ending::Kind::memory;
  ending.signal = text.substr(kind + 1, signal - kind - 1);
  ending.printed = text.substr(signal + 1);
  return ending;
}

}  // namespace contort
