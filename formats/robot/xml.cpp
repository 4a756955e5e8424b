#include "formats/robot/xml.h"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "formats/robot/robot.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

constexpr double kGreatestNumber = 1e12;

bool is_separator(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ','; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_separator(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_separator(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> number_in(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);  // from_chars accepts no plus sign
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return {};
  if (!(std::fabs(value) <= kGreatestNumber)) return {};
  return value;
}

std::string fault_of(const tinyxml2::XMLDocument& document) {
  const std::string line = "line " + std::to_string(document.ErrorLineNum()) + ": ";
  if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
    return line + "elements are nested deeper than the allowed " + std::to_string(TINYXML2_MAX_ELEMENT_DEPTH);
  if (document.ErrorID() == tinyxml2::XML_ERROR_EMPTY_DOCUMENT) return "the file has no XML element";
  return line + "the XML is not well-formed (" + tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID()) + ")";
}

// The number of bytes of the UTF-8 character at the front of the text; 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  std::uint32_t code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool is_longer_than_needed = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  return is_longer_than_needed || is_surrogate || code > 0x10ffff ? 0 : length;
}

// Converts text to valid UTF-8, which JSON needs: files that declare UTF-8 may be Latin-1, and character numbers may be
// invalid.
std::string in_utf8(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    out += length == 0 ? std::string_view("?") : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace

Result<XmlText> XmlText::parse(std::string_view text, const std::string& area) {
  if (text.size() > kMaxRobotBytes)
    return Issue{area + ".too_large", "", "larger than the allowed " + std::to_string(kMaxRobotBytes >> 20) + " MB"};
  // Refuses a document's own entities: they would not be replaced, and elsewhere they are a way to exhaust memory.
  if (text.find("<!ENTITY") != std::string_view::npos)
    return Issue{area + ".entities", "", "the file declares entities of its own (<!ENTITY), which are not read"};
  XmlText out;
  out.document_ = std::make_shared<tinyxml2::XMLDocument>();
  if (out.document_->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
    return Issue{area + ".bad_xml", "", fault_of(*out.document_)};
  if (out.document_->RootElement() == nullptr) return Issue{area + ".bad_xml", "", "the file has no XML element"};
  return out;
}

XmlElement& XmlText::root() const { return *document_->RootElement(); }

void XmlFaults::fail(std::string_view code, const XmlElement& at, const std::string& text) {
  if (!ok()) return;
  const std::string where = "<" + tag_of(at) + "> in line " + std::to_string(at.GetLineNum());
  issue_ = {area_ + "." + std::string(code), "", where + ": " + text};
}

std::vector<const XmlElement*> elements_of(const XmlElement& element, const char* tag) {
  std::vector<const XmlElement*> out;
  const char* wanted = *tag == '\0' ? nullptr : tag;
  for (const XmlElement* e = element.FirstChildElement(wanted); e != nullptr; e = e->NextSiblingElement(wanted))
    out.push_back(e);
  return out;
}

const XmlElement* element_of(const XmlElement& element, const char* tag) { return element.FirstChildElement(tag); }

std::string attribute_of(const XmlElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  return text == nullptr ? "" : in_utf8(trimmed(text));
}

bool has_attribute(const XmlElement& element, const char* attribute) {
  return element.FindAttribute(attribute) != nullptr;
}

std::map<std::string, std::string> attributes_of(const XmlElement& element) {
  std::map<std::string, std::string> out;
  for (const tinyxml2::XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next())
    out[in_utf8(a->Name())] = in_utf8(trimmed(a->Value()));
  return out;
}

std::string tag_of(const XmlElement& element) { return in_utf8(std::string_view(element.Name()).substr(0, 60)); }

std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t most) {
  std::vector<double> out;
  text = trimmed(text);
  while (!text.empty()) {
    std::size_t end = 0;
    while (end < text.size() && !is_separator(text[end])) ++end;
    const std::optional<double> value = number_in(text.substr(0, end));
    if (!value || out.size() == most) return {};
    out.push_back(*value);
    text = trimmed(text.substr(end));
  }
  return out;
}

std::string quoted_name(std::string_view name) { return json_fields::quoted(std::string(name.substr(0, 100))); }

int find_body(const RobotModel& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.bodies.size(); ++i)
    if (robot.bodies[i].name == name) return static_cast<int>(i);
  return -1;
}

void note(RobotModel& robot, std::string text) {
  if (robot.notes.size() < kMaxRobotNotes) robot.notes.push_back(std::move(text));
}

void note_all(RobotModel& robot, const std::string& text, const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i)
    list += (i == 0 ? "" : ", ") + names[i].substr(0, 60);
  if (names.size() > kShown) list += " and " + std::to_string(names.size() - kShown) + " more";
  if (!names.empty()) note(robot, text + ": " + list + ".");
}

}  // namespace contort
