// The one door to JSON, through the readers that stand behind it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "model/character/library.h"
#include "model/spec/spec.h"

namespace contort {
namespace {

std::string nested(int depth) {
  return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
}

// A spec around one extra member or a changed one.
std::string spec_with(const std::string& member) {
  return R"({"format": "contort.spec/1", "character": {"name": "human"}, )" + member + "}";
}

std::string action_with(const std::string& member) {
  return spec_with(R"("sequences": [{"clips": [{"actions": [{"action": "pose", "slot": "head", )" + member + "}]}]}]");
}

std::string part_with(const std::string& member) {
  return R"({"format": "contort.part/1", "name": "p", "kind": "arm", )" + member + "}";
}

struct Refused {
  std::string json;
  const char* code;
  const char* pointer;
};

void expect_spec_refused(const Refused& r) {
  const Result<Spec> spec = parse_spec(r.json);
  ASSERT_FALSE(spec.ok()) << r.json.substr(0, 200);
  EXPECT_EQ(spec.issue().code, r.code) << r.json.substr(0, 200);
  EXPECT_EQ(spec.issue().pointer, r.pointer) << r.json.substr(0, 200);
  EXPECT_FALSE(spec.issue().text.empty());
}

void expect_part_refused(const Refused& r) {
  const Result<PartDesc> part = parse_part(r.json);
  ASSERT_FALSE(part.ok()) << r.json.substr(0, 200);
  EXPECT_EQ(part.issue().code, r.code) << r.json.substr(0, 200);
  EXPECT_EQ(part.issue().pointer, r.pointer) << r.json.substr(0, 200);
}

TEST(JsonFields, TextThatIsNoJsonIsASyntaxError) {
  for (const char* json : {"", "{", "nul", "{} x", "{'a': 1}", R"({"a": NaN})", R"({"a": Infinity})", R"({"a": 01})",
                           R"({"a": +1})", R"({"a": .5})", R"({"a": 1,})", "// comment\n{}", "\"\xff\"", "\"\x01\"",
                           R"("\ud800")", R"({"a": 1e999})", R"({"a": -1e999})"})
    expect_spec_refused({json, "json.syntax", ""});
}

TEST(JsonFields, NestingIsBounded) {
  expect_spec_refused({nested(64), "spec.wrong_type", ""});
  expect_spec_refused({nested(66), "json.too_deep", ""});
  expect_spec_refused({nested(200000), "json.too_deep", ""});
}

TEST(JsonFields, DuplicateKeysAreRefusedWhereverTheyStand) {
  expect_spec_refused({R"({"a": 1, "a": 1})", "json.duplicate_key", ""});
  expect_spec_refused({R"([{"x": {"a": 1, "b": 2, "a": 3}}])", "json.duplicate_key", ""});
  expect_spec_refused({R"({"a": 1, "\u0061": 2})", "json.duplicate_key", ""});
  expect_spec_refused({R"([{"a": 1}, {"a": 2}])", "spec.wrong_type", ""});  // two objects, one key each
}

TEST(JsonFields, DocumentsAreBounded) {
  const std::string good = R"({"format": "contort.spec/1", "character": {"name": "human"}})";
  const std::size_t most = 16 << 20;
  EXPECT_TRUE(parse_spec(good + std::string(most - good.size(), ' ')).ok());
  expect_spec_refused({good + std::string(most + 1 - good.size(), ' '), "json.too_large", ""});
}

std::string list_of(std::size_t count) {
  std::string text = "[";
  for (std::size_t i = 1; i < count; ++i) text += "1,";
  return text + "1]";
}

// Each costs up to a hundred bytes of memory, and two of the file.
TEST(JsonFields, NumbersOfValuesAreBounded) {
  expect_spec_refused({list_of(1'999'999), "spec.wrong_type", ""});
  expect_spec_refused({list_of(2'000'000), "json.too_large", ""});
  std::string keys = "{\"a\": 1";
  for (int i = 1; i < 100'000; ++i) keys += ", \"" + std::to_string(i) + "\": 1";
  expect_spec_refused({"[" + keys + "}]", "spec.wrong_type", ""});
  expect_spec_refused({"[" + keys + ", \"b\": 1}]", "json.too_large", ""});
}

TEST(JsonFields, UnknownFieldsAreNamedWithWhatIsAllowed) {
  const Result<Spec> spec = parse_spec(spec_with(R"("colour": 1)"));
  ASSERT_FALSE(spec.ok());
  EXPECT_EQ(to_line(spec.issue()),
            "spec.unknown_field at /colour: found \"colour\", allowed are \"format\", \"character\", \"rate_hz\", "
            "\"hold_frames\", \"environment\", \"start\", \"sequences\", \"interrupts\", \"recording\", \"dynamics\", "
            "\"only_slot\", \"only_sequence\", \"only_clip\"");
}

TEST(JsonFields, PointersAreEscaped) {
  expect_spec_refused({spec_with(R"("a/b~c": 1)"), "spec.unknown_field", "/a~1b~0c"});
  expect_spec_refused(
      {action_with(R"("params": {"~1": 1})"), "spec.bad_text", "/sequences/0/clips/0/actions/0/params/~01"});
  expect_spec_refused({spec_with(R"("": 1)"), "spec.unknown_field", "/"});
}

TEST(JsonFields, TypesAreExact) {
  expect_spec_refused({"[]", "spec.wrong_type", ""});
  expect_spec_refused({spec_with(R"("rate_hz": "60")"), "spec.wrong_type", "/rate_hz"});
  expect_spec_refused({spec_with(R"("rate_hz": null)"), "spec.wrong_type", "/rate_hz"});
  expect_spec_refused({spec_with(R"("rate_hz": true)"), "spec.wrong_type", "/rate_hz"});
  expect_spec_refused({spec_with(R"("rate_hz": "nan")"), "spec.wrong_type", "/rate_hz"});
  expect_spec_refused({spec_with(R"("hold_frames": 1.5)"), "spec.wrong_type", "/hold_frames"});
  expect_spec_refused({spec_with(R"("sequences": {})"), "spec.wrong_type", "/sequences"});
  expect_spec_refused({spec_with(R"("sequences": [[]])"), "spec.wrong_type", "/sequences/0"});
  expect_spec_refused({action_with(R"("params": [])"), "spec.wrong_type", "/sequences/0/clips/0/actions/0/params"});
  expect_spec_refused(
      {action_with(R"("params": {"a": true})"), "spec.wrong_type", "/sequences/0/clips/0/actions/0/params/a"});
  expect_spec_refused(
      {action_with(R"("params": {"a": [1, 2]})"), "spec.wrong_type", "/sequences/0/clips/0/actions/0/params/a"});
  expect_spec_refused(
      {action_with(R"("params": {"a": [1, 2, "3"]})"), "spec.wrong_type", "/sequences/0/clips/0/actions/0/params/a/2"});
}

TEST(JsonFields, WholeNumbersMayBeWrittenWithAFraction) {
  const Result<Spec> spec = parse_spec(spec_with(R"("hold_frames": 3.0)"));
  ASSERT_TRUE(spec.ok());
  EXPECT_EQ(spec->hold_frames, 3);
  EXPECT_TRUE(parse_spec(spec_with(R"("hold_frames": 6e3)")).ok());
}

TEST(JsonFields, NumbersOutOfRangeAreRefusedAndTheLimitsAreNot) {
  for (const char* good : {"1", "1000", "59.94"})
    EXPECT_TRUE(parse_spec(spec_with("\"rate_hz\": " + std::string(good))).ok());
  for (const char* bad : {"0.999", "1000.001", "-60", "1e308"})
    expect_spec_refused({spec_with("\"rate_hz\": " + std::string(bad)), "spec.out_of_range", "/rate_hz"});
  for (const char* bad : {"-1", "6001", "1e300", "18446744073709551616"})
    expect_spec_refused({spec_with("\"hold_frames\": " + std::string(bad)), "spec.out_of_range", "/hold_frames"});
  const Result<Spec> spec = parse_spec(spec_with(R"("rate_hz": 1001)"));
  EXPECT_EQ(spec.issue().text, "found 1001, allowed is [1, 1000]");
}

TEST(JsonFields, MissingFieldsAreNamed) {
  expect_spec_refused({R"({"format": "contort.spec/1"})", "spec.missing_field", ""});
  expect_spec_refused({R"({"format": "contort.spec/1", "character": {}})", "spec.missing_field", "/character"});
  EXPECT_EQ(parse_spec(R"({"format": "contort.spec/1"})").issue().text, "\"character\" is required");
}

TEST(JsonFields, AnotherFormatIsRefusedByName) {
  expect_spec_refused({"{}", "spec.wrong_format", ""});
  expect_spec_refused({R"({"format": "contort.spec/2"})", "spec.wrong_format", "/format"});
  expect_spec_refused({R"({"format": 1})", "spec.wrong_format", "/format"});
  expect_part_refused({R"({"format": "contort.spec/1"})", "part.wrong_format", "/format"});
}

TEST(JsonFields, NamesAreShortAndPlain) {
  const auto with_name = [](const std::string& name) {
    return R"({"format": "contort.spec/1", "character": {"name": ")" + name + R"("}})";
  };
  EXPECT_TRUE(parse_spec(with_name(std::string(64, 'a'))).ok());
  for (const std::string& bad : {std::string(65, 'a'), std::string(), std::string("Human"), std::string("a b"),
                                 std::string("../x"), std::string("a\\u0000"), std::string("\xc3\xa9")})
    expect_spec_refused({with_name(bad), "spec.bad_text", "/character/name"});
  expect_spec_refused(
      {R"({"format": "contort.spec/1", "character": {"name": 7}})", "spec.wrong_type", "/character/name"});
}

TEST(JsonFields, LabelsAndProseAreBoundedInBytes) {
  const auto named = [](std::size_t size) {
    return spec_with(R"("sequences": [{"name": ")" + std::string(size, 'x') + R"("}])");
  };
  EXPECT_TRUE(parse_spec(named(200)).ok());
  expect_spec_refused({named(201), "spec.bad_text", "/sequences/0/name"});
  EXPECT_TRUE(parse_part(part_with("\"help\": \"" + std::string(4000, 'x') + "\"")).ok());
  expect_part_refused({part_with("\"help\": \"" + std::string(4001, 'x') + "\""), "part.bad_text", "/help"});
}

TEST(JsonFields, ListsAndMapsAreBounded) {
  const auto list_of = [](int count) {
    std::string list;
    for (int i = 0; i < count; ++i) list += i == 0 ? "{}" : ",{}";
    return spec_with("\"sequences\": [" + list + "]");
  };
  EXPECT_TRUE(parse_spec(list_of(64)).ok());
  expect_spec_refused({list_of(65), "spec.too_many", "/sequences"});
  std::string params;
  for (int i = 0; i < 65; ++i) params += (i == 0 ? "\"p" : ",\"p") + std::to_string(i) + "\": 0";
  expect_spec_refused(
      {action_with("\"params\": {" + params + "}"), "spec.too_many", "/sequences/0/clips/0/actions/0/params"});
}

TEST(JsonFields, ChoicesAreNamedWithWhatIsAllowed) {
  expect_part_refused(
      {part_with(R"("joints": [{"name": "j", "type": "screw"}])"), "part.unknown_name", "/joints/0/type"});
  EXPECT_EQ(parse_part(part_with(R"("joints": [{"name": "j", "type": "screw"}])")).issue().text,
            R"(found "screw", allowed are "hinge", "ball", "prismatic")");
  expect_part_refused({part_with(R"("joints": [{"name": "j", "type": 1}])"), "part.wrong_type", "/joints/0/type"});
}

TEST(JsonFields, VariantsAreToldApartByTheirType) {
  const auto shaped = [](const std::string& shape) {
    return part_with(R"("colliders": [{"name": "c", "shape": )" + shape + "}]");
  };
  EXPECT_TRUE(parse_part(shaped(R"({"type": "sphere", "radius_m": 1})")).ok());
  expect_part_refused({shaped("{}"), "part.missing_field", "/colliders/0/shape"});
  expect_part_refused({shaped("7"), "part.wrong_type", "/colliders/0/shape"});
  expect_part_refused({shaped(R"({"type": "triangles"})"), "part.unknown_name", "/colliders/0/shape/type"});
  expect_part_refused({shaped(R"({"type": "sphere"})"), "part.missing_field", "/colliders/0/shape"});
  expect_part_refused(
      {shaped(R"({"type": "sphere", "radius_m": 0})"), "part.out_of_range", "/colliders/0/shape/radius_m"});
  expect_part_refused({shaped(R"({"type": "sphere", "radius_m": 1, "a_m": [0, 0, 0]})"), "part.unknown_field",
                       "/colliders/0/shape/a_m"});
}

TEST(JsonFields, OnlyTheFirstTroubleIsReported) {
  expect_spec_refused({spec_with(R"("rate_hz": 0, "hold_frames": -1, "zzz": 1)"), "spec.out_of_range", "/rate_hz"});
}

// The message for a user is one line of limited length, whatever the file contains.
TEST(JsonFields, HostileTextNeitherBreaksNorFloodsTheLine) {
  const std::string flood(1 << 20, 'x');
  const std::string bad[] = {
      spec_with(R"("a\nb\r\u001b[2J\u007f": 1)"),
      spec_with("\"" + flood + "\": 1"),
      R"({"a\nb": 1, "a\nb": 1})",
      R"({"format": "x\ny"})",
      R"({"format": ")" + flood + "\"}",
      R"({"format": "contort.spec/1", "character": {"name": "a\nb"}})",
      R"({"format": "contort.spec/1", "character": {"name": ")" + flood + "\"}}",
      "{\"a\nb\": 1}",
      "[\"" + flood,
      "[1" + std::string(1 << 20, '0') + "e9]",
      action_with(R"("params": {"x\ny": 1})"),
  };
  for (const std::string& json : bad) {
    const Result<Spec> spec = parse_spec(json);
    ASSERT_FALSE(spec.ok()) << json.substr(0, 80);
    const std::string line = to_line(spec.issue());
    const auto control = [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f; };
    EXPECT_TRUE(std::none_of(line.begin(), line.end(), control)) << json.substr(0, 80);
    EXPECT_LT(line.size(), 6000U) << json.substr(0, 80);
  }
}

}  // namespace
}  // namespace contort
