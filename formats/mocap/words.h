// Reads the words, numbers and lines of the text formats of motion capture. It does not depend on the locale, and never
// reads beyond the text.
//
// After the first fault there are no more words, so that loops end and callers call ok() once.
#pragma once

#include <string>
#include <string_view>

#include "model/core/math.h"
#include "model/core/result.h"

namespace contort {

struct MocapSyntax {
  std::string_view area;   // The prefix of issue codes: "bvh".
  std::string_view alone;  // Characters that are words of their own: "{}".
  std::string_view blank;  // Skipped like white space: "()".
  char comment = '\0';     // begins a comment up to the end of the line; '\0': no comments
};

class MocapWords {
 public:
  // Skips a byte order mark at the beginning.
  MocapWords(const MocapSyntax& syntax, std::string_view text);

  std::string_view peek();  // Returns the next word without taking it; "" at the end of the text and after a fault.
  std::string_view next();          // Returns the next word and takes it.
  bool line_ends();                 // Returns true if the present line has no more words.
  std::string_view rest_of_line();  // Trimmed; a character that stands alone at its end is left for next().
  void skip_line();

  // The next word, which must match the request; otherwise there is a fault, and the result is 0.
  double number(double magnitude);                      // Finite, with at most this absolute value.
  int count(std::string_view what, std::int64_t high);  // In [0, high].
  Vec3 vector(double magnitude);
  void expect(std::string_view word);  // Ignores the case of letters.
  void expect_label(std::string_view label);  // The same; a value may follow without a blank: "Frames:20".

  bool ok() const { return issue_.code.empty(); }
  void fail(std::string_view code, std::string text);  // Reports a fault at the line of the last word that was taken.
  const Issue& issue() const { return issue_; }

  // Returns true if the text ends with the next word, without the end of a line.
  bool breaks_off() { return at_ + peek().size() == text_.size(); }

  // Returns true if there was no fault and the next word is not the end of the text; for loops.
  bool has_more() { return !peek().empty(); }
  std::size_t bytes_left() const { return text_.size() - at_; }
  std::size_t lines_left() const;  // An upper bound.

 private:
  bool is_blank(char c) const;
  void skip_blanks(bool and_line_ends);

  MocapSyntax syntax_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;       // Line of at_.
  int word_line_ = 1;  // Line of the last word that was taken.
  Issue issue_;
};

// Returns true if two words are equal, ignoring the case of ASCII letters.
bool is_same_word(std::string_view a, std::string_view b);

// Returns a word for messages: in quotes, with limited length, without control characters.
std::string quoted_word(std::string_view word);

// Reads the file's text, within the limits of limits.h. Codes <area>.unreadable, <area>.too_large, <area>.wrong_kind.
Result<std::string> read_mocap_text(const std::string& path, const std::string& area);

}  // namespace contort
