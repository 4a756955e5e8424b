#include "renders/wording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "model/core/math.h"

namespace contort {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::string_view kEllipsis = "\xE2\x80\xA6";

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, pattern, values...);
  return buffer;
}

struct FamiliarUnit {
  std::string_view stored, familiar;
  double factor;
};
constexpr FamiliarUnit kFamiliarUnits[] = {
    {"rad", "\xC2\xB0", kDegPerRad}, {"rad/s", "\xC2\xB0/s", kDegPerRad},
    {"rad/s^2", "\xC2\xB0/s^2", kDegPerRad}, {"m", " mm", 1000.0}};

// Removes zeros after the decimals: "2.30" becomes "2.3", and "5.00" becomes "5".
std::string without_zeros(std::string digits) {
  if (digits.find('.') == std::string::npos) return digits;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.ends_with('.')) digits.pop_back();
  return digits;
}

// The length of the UTF-8 sequence at the front of `text`; 0 if it is broken, overlong, a surrogate or a control
// character.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  std::uint32_t code = lead & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool control = code < 0xa0 || (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return overlong || control || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff) ? 0 : length;
}

}  // namespace

std::string rounded_text(double value) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value < 0.0 ? "-infinite" : "infinite";
  if (value == 0.0) return "0";
  const std::string rounded = format("%.2e", value);  // "-2.34e-02": the exponent is that of the rounded number
  const int exponent = std::atoi(rounded.c_str() + rounded.find('e') + 1);
  if (exponent < -3 || exponent >= 6)
    return without_zeros(rounded.substr(0, rounded.find('e'))) + "e" + std::to_string(exponent);
  const double plain = std::strtod(rounded.c_str(), nullptr);
  if (exponent >= 3) return count_text(std::llround(plain));
  return without_zeros(format("%.*f", 2 - exponent, plain));
}

std::string margin_text(double margin, std::string_view unit) {
  if (std::isnan(margin)) return "not a number";
  std::string text = rounded_text(margin) + " " + std::string(unit);
  for (const FamiliarUnit& u : kFamiliarUnits)
    if (u.stored == unit) text += " (" + rounded_text(margin * u.factor) + std::string(u.familiar) + ")";
  return text;
}

std::string time_text(int frame, double rate_hz) {
  if (!(rate_hz > 0.0) || !std::isfinite(rate_hz)) return "";
  return format("%.3f s", frame / rate_hz);
}

std::string count_text(std::int64_t count) {
  std::string digits = std::to_string(count);
  const std::size_t sign = count < 0 ? 1 : 0;
  for (std::size_t i = digits.size(); i > sign + 3; i -= 3) digits.insert(i - 3, "\xE2\x80\xAF");
  return digits;
}

std::string counted(std::int64_t count, std::string_view one, std::string_view many) {
  return count_text(count) + " " + std::string(count == 1 ? one : many);
}

std::string share_text(std::int64_t part, std::int64_t whole) {
  const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  if (part > 0 && percent < 0.1) return "less than 0.1 %";
  return rounded_text(percent) + " %";
}

std::string clean_share(std::int64_t cases, std::int64_t failing) {
  const std::int64_t per_mille = 1000 * (cases - failing) / cases;
  const std::string tenths = failing == 0 ? "" : "." + std::to_string(per_mille % 10);
  return std::to_string(per_mille / 10) + tenths + " %";
}

std::string one_line(std::string_view text, std::size_t max_chars) {
  std::vector<std::string_view> characters;
  while (!text.empty() && characters.size() <= max_chars) {
    const std::size_t length = sequence_length(text);
    characters.push_back(length == 0 ? kReplacement : text.substr(0, length));
    text.remove_prefix(length == 0 ? 1 : length);
  }
  if (characters.size() > max_chars) {
    characters.resize(max_chars);
    if (!characters.empty()) characters.back() = kEllipsis;
  }
  std::string line;
  for (const std::string_view c : characters) line += c;
  return line;
}

std::string phase_text(std::string_view phase) {
  static constexpr std::pair<std::string_view, std::string_view> kTexts[] = {
      {"impact", "after a blow"},
      {"interrupt", "just after an interrupt"},
      {"clip_switch", "where a clip or sequence begins or ends"},
      {"blend", "while an action comes in or fades out"},
      {"mid_clip", "in the middle of a clip"},
      {"at_rest", "when no action moves"}};
  for (const auto& [name, text] : kTexts)
    if (name == phase) return std::string(text);
  return std::string(phase);
}

}  // namespace contort
