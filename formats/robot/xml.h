// Reads untrusted XML within limits, and numbers that do not depend on the locale.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/math.h"
#include "model/core/result.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace contort {

using XmlElement = tinyxml2::XMLElement;

// A parsed document. `area` is the prefix of issue codes, "urdf". Codes <area>.too_large, .bad_xml, .entities.
class XmlText {
 public:
  static Result<XmlText> parse(std::string_view text, const std::string& area);
  XmlElement& root() const;

 private:
  std::shared_ptr<tinyxml2::XMLDocument> document_;
};

// The first fault of a reader: everything after it is ignored.
class XmlFaults {
 public:
  explicit XmlFaults(std::string area) : area_(std::move(area)) {}
  bool ok() const { return issue_.code.empty(); }
  const Issue& issue() const { return issue_; }
  void fail(std::string_view code, const XmlElement& at, const std::string& text);

 private:
  std::string area_;
  Issue issue_;
};

// Returns the children with that tag; all of them if it is "".
std::vector<const XmlElement*> elements_of(const XmlElement& element, const char* tag = "");
const XmlElement* element_of(const XmlElement& element, const char* tag);

// Returns the attribute's text without blanks around it; "" if there is none.
std::string attribute_of(const XmlElement& element, const char* attribute);
bool has_attribute(const XmlElement& element, const char* attribute);
std::map<std::string, std::string> attributes_of(const XmlElement& element);
std::string tag_of(const XmlElement& element);

// Reads numbers that blanks or commas separate. Returns nothing if one is not finite or larger than 1e12.
std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t most);

// Makes untrusted names safe for messages: in quotes, of limited length, without control characters.
std::string quoted_name(std::string_view name);

}  // namespace contort
