// The published schemas are made from the same field lists as the readers, and the readers accept the same documents.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "checks/joint_map.h"
#include "corpus/bucket.h"
#include "corpus/case.h"
#include "corpus/condition.h"
#include "fuzz/profile.h"
#include "model/character/library.h"
#include "model/character/skin_desc.h"
#include "model/core/files.h"
#include "guest/manifest.h"
#include "model/spec/spec.h"

namespace contort {
namespace {

using Json = nlohmann::json;

std::string published(const std::string& name) {
  const std::string path = std::string(CONTORT_SOURCE_DIR) + "/docs/schema/" + name + ".schema.json";
  const Result<std::string> text = read_file(path);
  return text ? *text : to_line(text.issue());
}

TEST(Schema, PublishedFilesAreWhatTheReadersSay) {
  EXPECT_EQ(published("spec"), spec_schema());
  EXPECT_EQ(published("case"), case_schema());
  EXPECT_EQ(published("part"), part_schema());
  EXPECT_EQ(published("object"), object_schema());
  EXPECT_EQ(published("character"), character_schema());
  EXPECT_EQ(published("action"), action_schema());
  EXPECT_EQ(published("map"), joint_map_schema());
  EXPECT_EQ(published("skin"), skin_schema());
  EXPECT_EQ(published("bucket"), bucket_schema());
  EXPECT_EQ(published("profile"), profile_schema());
  EXPECT_EQ(published("rules"), conditions_schema());
  EXPECT_EQ(published("generator"), manifest_schema());
}

// The smallest value that the schema of a property allows: made of its default, its limits, its first choice.
Json sample(const Json& schema) {
  if (schema.contains("const")) return schema["const"];
  if (schema.contains("enum")) return schema["enum"][0];
  if (schema.contains("oneOf")) return sample(schema["oneOf"][0]);
  if (schema.contains("anyOf")) return sample(schema["anyOf"][0]);
  const std::string type = schema["type"];
  if (type == "object") {
    Json object = Json::object();
    for (const Json& name : schema.value("required", Json::array())) object[name] = sample(schema["properties"][name]);
    return object;
  }
  if (type == "array") return Json(schema.value("minItems", std::size_t{0}), sample(schema["items"]));
  if (type == "string") return "a0";
  if (type == "boolean") return true;
  return schema.contains("minimum") ? schema["minimum"] : Json(0);
}

// Places of objects with known fields in a schema, by the path of property names that leads there.
using Visit = std::function<void(const Json& object_schema, const std::function<Json(const Json&)>& wrap)>;

// Calls visit with every object schema, and with a function that puts a value for it into a whole document.
void walk(const Json& schema, const std::function<Json(const Json&)>& wrap, const Visit& visit) {
  for (const char* choice : {"oneOf", "anyOf"})
    for (const Json& alternative : schema.value(choice, Json::array())) walk(alternative, wrap, visit);
  if (schema.contains("items"))
    walk(
        schema["items"], [&](const Json& v) { return wrap(Json(schema.value("minItems", std::size_t{1}), v)); }, visit);
  if (!schema.contains("properties")) return;
  visit(schema, wrap);
  for (const auto& property : schema["properties"].items()) {
    const auto inside = [&](const Json& v) {
      Json object = sample(schema);
      object[property.key()] = v;
      return wrap(object);
    };
    walk(property.value(), inside, visit);
  }
}

using Accepts = std::function<std::string(const std::string&)>;  // "", or the code of the refusal

int objects_checked = 0;

void expect_schema_and_reader_agree(const std::string& schema_text, const Accepts& code_of) {
  const Json schema = Json::parse(schema_text);
  const Visit visit = [&](const Json& object, const std::function<Json(const Json&)>& wrap) {
    ++objects_checked;
    for (const auto& property : object["properties"].items()) {
      Json value = sample(object);
      value[property.key()] = sample(property.value());
      EXPECT_EQ(code_of(wrap(value).dump()), "") << property.key() << " in " << wrap(value).dump();
      if (property.value().contains("default")) value[property.key()] = property.value()["default"];
      EXPECT_EQ(code_of(wrap(value).dump()), "") << "default of " << property.key();
    }
    for (const Json& name : object["required"]) {
      Json value = sample(object);
      value.erase(name.get<std::string>());
      EXPECT_NE(code_of(wrap(value).dump()), "") << "without " << name;
    }
    Json value = sample(object);
    value["no_such_field"] = 1;
    EXPECT_TRUE(code_of(wrap(value).dump()).ends_with(".unknown_field")) << wrap(value).dump();
  };
  walk(
      schema, [](const Json& v) { return v; }, visit);
}

template <class T>
Accepts reader(Result<T> (*parse)(std::string_view)) {
  return [parse](const std::string& json) {
    const Result<T> value = parse(json);
    return value ? std::string() : value.issue().code;
  };
}

TEST(Schema, ReadersTakeEveryNamedFieldAndNoOther) {
  objects_checked = 0;
  expect_schema_and_reader_agree(spec_schema(), reader(parse_spec));
  expect_schema_and_reader_agree(part_schema(), reader(parse_part));
  expect_schema_and_reader_agree(object_schema(), reader(parse_object));
  expect_schema_and_reader_agree(character_schema(), reader(parse_character));
  EXPECT_GE(objects_checked, 25);
}

TEST(Schema, NumbersAreRefusedJustBeyondTheirLimits) {
  int limits = 0;
  const Json schema = Json::parse(part_schema());
  const auto code_of = reader(parse_part);
  const Visit visit = [&](const Json& object, const std::function<Json(const Json&)>& wrap) {
    for (const auto& property : object["properties"].items())
      for (const char* end : {"minimum", "maximum"}) {
        if (!property.value().contains(end)) continue;
        const double limit = property.value()[end];
        const double beyond = limit + (std::string(end) == "minimum" ? -1.0 : 1.0) * std::max(1e-6, 1e-9 * limit);
        Json value = sample(object);
        value[property.key()] = limit;
        EXPECT_EQ(code_of(wrap(value).dump()), "") << property.key();
        value[property.key()] = beyond;
        EXPECT_EQ(code_of(wrap(value).dump()), "part.out_of_range") << property.key();
        ++limits;
      }
  };
  walk(
      schema, [](const Json& v) { return v; }, visit);
  EXPECT_GE(limits, 20);
}

}  // namespace
}  // namespace contort
