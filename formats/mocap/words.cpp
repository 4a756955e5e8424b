#include "formats/mocap/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "formats/mocap/limits.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

MocapWords::MocapWords(const MocapSyntax& syntax, std::string_view text)
    : syntax_(syntax), text_(text), at_(text.starts_with("\xef\xbb\xbf") ? 3 : 0) {}

bool MocapWords::is_blank(char c) const {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || syntax_.blank.find(c) != std::string_view::npos;
}

void MocapWords::skip_blanks(bool and_line_ends) {
  for (bool in_comment = false; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (is_line_end(c)) {
      if (!and_line_ends) return;
      in_comment = false;
      if (c == '\n') ++line_;
    } else if (syntax_.comment != '\0' && c == syntax_.comment) {
      in_comment = true;
    } else if (!in_comment && !is_blank(c)) {
      return;
    }
  }
}

std::string_view MocapWords::peek() {
  if (!ok()) return {};
  skip_blanks(true);
  std::size_t end = at_;
  while (end < text_.size() && !is_blank(text_[end]) && !is_line_end(text_[end])) {
    const bool stands_alone = syntax_.alone.find(text_[end]) != std::string_view::npos;
    if (stands_alone && end > at_) break;
    ++end;
    if (stands_alone) break;
  }
  return text_.substr(at_, end - at_);
}

std::string_view MocapWords::next() {
  const std::string_view word = peek();
  at_ += word.size();
  word_line_ = line_;
  return word;
}

bool MocapWords::line_ends() {
  if (!ok()) return true;
  skip_blanks(false);
  return at_ == text_.size() || is_line_end(text_[at_]);
}

std::string_view MocapWords::rest_of_line() {
  if (line_ends()) return {};
  std::size_t end = at_;
  while (end < text_.size() && !is_line_end(text_[end])) ++end;
  const auto trim = [&] {
    while (end > at_ && is_blank(text_[end - 1])) --end;
  };
  trim();
  if (end > at_ && syntax_.alone.find(text_[end - 1]) != std::string_view::npos) --end;
  trim();
  const std::string_view rest = text_.substr(at_, end - at_);
  at_ = end;
  if (rest.size() <= kMaxMocapNameBytes) return rest;
  fail("too_large",
       "found a name of " + std::to_string(rest.size()) + " bytes, allowed are " + std::to_string(kMaxMocapNameBytes));
  return {};
}

void MocapWords::skip_line() {
  while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
}

std::size_t MocapWords::lines_left() const {
  return static_cast<std::size_t>(std::ranges::count_if(text_.substr(at_), is_line_end)) + 1;
}

double MocapWords::number(double magnitude) {
  std::string_view word = next();
  if (!ok()) return 0.0;
  const std::string_view shown = word;
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);  // from_chars accepts no plus sign
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size())
    return fail("bad_number", shown.empty() ? "the text ends where a number is expected"
                                            : "found " + quoted_word(shown) + ", expected a number"),
           0.0;
  if (error == std::errc{} && std::fabs(value) <= magnitude) return value + 0.0;  // -0 becomes 0
  fail("out_of_range", "found " + quoted_word(shown) + ", allowed are numbers up to " +
                           json_fields::shortest(magnitude) + " either way");
  return 0.0;
}

int MocapWords::count(std::string_view what, std::int64_t high) {
  const std::string_view word = next();
  if (!ok()) return 0;
  std::int64_t value = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool is_whole = error == std::errc{} && end == word.data() + word.size();
  if (is_whole && value >= 0 && value <= high) return static_cast<int>(value);
  fail(is_whole && value > high ? "too_large" : "bad_number",
       "found " + quoted_word(word) + " as the number of " + std::string(what) +
           ", allowed is a whole number from 0 to " + std::to_string(high));
  return 0;
}

Vec3 MocapWords::vector(double magnitude) {
  Vec3 out(0.0);
  for (int i = 0; i < 3; ++i) out[i] = number(magnitude);
  return out;
}

void MocapWords::expect(std::string_view word) {
  const std::string_view found = next();
  if (ok() && !is_same_word(found, word))
    fail(found.empty() ? "truncated" : "bad_syntax",
         found.empty() ? "the text ends before " + quoted_word(word)
                       : "found " + quoted_word(found) + ", expected " + quoted_word(word));
}

void MocapWords::expect_label(std::string_view label) {
  const std::string_view word = peek();
  if (!is_same_word(word.substr(0, label.size()), label)) return expect(label);
  at_ += label.size();
  word_line_ = line_;
}

void MocapWords::fail(std::string_view code, std::string text) {
  if (!ok()) return;
  issue_ = {std::string(syntax_.area) + "." + std::string(code), "line " + std::to_string(word_line_), std::move(text)};
}

bool is_same_word(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (lower(a[i]) != lower(b[i])) return false;
  return true;
}

std::string quoted_word(std::string_view word) { return json_fields::quoted(std::string(word.substr(0, 100))); }

Result<std::string> read_mocap_text(const std::string& path, const std::string& area) {
  const Result<std::string> text = read_file(path, kMaxMocapBytes);
  if (text) {
    const std::string_view mark = area == "bvh" ? "HIERARCHY" : "#!OML:ASF";  // first word of the expected kind
    const std::string expected = "an animation file of the kind " + area;
    const std::optional<Issue> other = text->starts_with(mark) ? std::nullopt : other_kind(path, *text, expected);
    return other ? Issue{area + ".wrong_kind", "", other->text} : text;
  }
  const bool is_large = text.issue().code == "file.too_large";
  return Issue{area + (is_large ? ".too_large" : ".unreadable"), "", text.issue().text};
}

}  // namespace contort
