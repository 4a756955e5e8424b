// Splits the lines of a table into cells (RFC 4180, with other separators), and reads their numbers. It does not depend
// on the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contort {

// Returns the lines of a text one after another, without their ends: LF, CR LF, or CR.
class TableLines {
 public:
  explicit TableLines(std::string_view text);  // a byte order mark at the beginning is skipped
  bool next(std::string_view& line);           // false at the end of the text
  int number() const { return number_; }       // number of the last line, from 1

 private:
  std::string_view rest_;
  int number_ = 0;
};

// The most frequent separator outside of quotes in a line of names: a comma, a semicolon or a tab; if it has none of
// them, a blank.
char separator_of(std::string_view line);

// The cells of a line, trimmed, at most `most` + 1. Returns nothing if a quote has no end.
std::optional<std::vector<std::string>> cells_of(std::string_view line, char separator, std::size_t most);

// A finite or infinite number, or NaN; nothing if the text is anything else.
std::optional<double> number_in(std::string_view cell, bool may_have_comma);

// Returns the number of decimals of a number that is written without an exponent; -1 if it has an exponent.
int digits_behind_point(std::string_view cell);

std::string in_lower_case(std::string_view text);  // ASCII letters only

}  // namespace contort
