// The JSON form of a spec: round trips, canonical text, identity.
#include "model/spec/spec.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "fuzz/draw.h"
#include "generator/stage.h"
#include "model/character/library.h"
#include "tests/core/random_space.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using Json = nlohmann::json;
using fixtures::elbow;
using fixtures::sequence;

std::string any_name() {
  return *rc::gen::resize(10, rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::element('a', 'z', '0', '_'))));
}

// Any finite double, by its bits.
double any_double() {
  const double value = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
  return std::isfinite(value) ? value + 0.0 : 1.0 / 3.0;
}

ParamValue any_param() {
  switch (*rc::gen::inRange(0, 3)) {
    case 0: return any_double();
    case 1: return Vec3(any_double(), any_double(), any_double());
    default: return any_name();
  }
}

ActionUse any_action() {
  ActionUse use;
  use.action = any_name(), use.slot = any_name();
  use.start_frame = *rc::gen::inRange(0, 36001);
  use.duration_frames = *rc::gen::inRange(1, 36001);
  use.speed = fixtures::lattice_number(0.1, 10);
  for (int i = *rc::gen::inRange(0, 4); i > 0; --i) use.params[any_name()] = any_param();
  return use;
}

std::string any_label() {  // bytes of UTF-8, quotes, control characters
  return *rc::gen::element<std::string>("", "x", "\"quoted\" \\ / ~", "line\nbreak\t\x01\x7f",
                                        "M\xc3\xbc ller \xf0\x9f\x98\x80");
}

ClipDesc any_clip() {
  ClipDesc clip;
  clip.name = any_label();
  clip.start_frame = *rc::gen::inRange(0, 36001);
  clip.duration_frames = *rc::gen::inRange(0, 36001);
  clip.speed = fixtures::lattice_number(0.1, 10);
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) clip.actions.push_back(any_action());
  return clip;
}

Spec any_spec() {
  Spec spec;
  spec.character.name = any_name();
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) spec.character.parts[any_name()] = any_name();
  if (*rc::gen::arbitrary<bool>()) spec.character.attachments.push_back({any_name(), any_name(), any_name()});
  spec.rate_hz = fixtures::lattice_number(1, 1000);
  spec.hold_frames = *rc::gen::inRange(0, 6001);
  for (int i = *rc::gen::inRange(0, 3); i > 0; --i) {
    SequenceDesc made;
    made.name = any_label();
    made.duration_frames = *rc::gen::inRange(0, 36001);
    for (int k = *rc::gen::inRange(0, 3); k > 0; --k) made.clips.push_back(any_clip());
    spec.sequences.push_back(made);
  }
  return spec;
}

RC_GTEST_PROP(Spec, PrintedSpecsReadBackTheSame, ()) {
  const Spec spec = any_spec();
  const Result<Spec> back = parse_spec(print_spec(spec));
  if (!back) RC_FAIL(to_line(back.issue()));
  RC_ASSERT(*back == spec);
  RC_ASSERT(print_spec(*back) == print_spec(spec));
  const Result<Spec> pretty = parse_spec(pretty_spec(spec));
  RC_ASSERT(pretty.ok());
  RC_ASSERT(*pretty == spec);
}

TEST(Spec, DrawnSpecsReadBackTheSameAndBuild) {
  for (std::int64_t i = 0; i < 200; ++i) {
    const Spec spec = draw_spec({{"human", "mech", "quadruped"}}, stock_generator(), 7, i);
    const Result<Spec> back = parse_spec(print_spec(spec));
    ASSERT_TRUE(back.ok()) << i << to_line(back.issue());
    ASSERT_EQ(*back, spec) << i;
    const Result<Stage> stage = build_stage(*back, stock_library());
    ASSERT_TRUE(stage.ok()) << i << to_line(stage.issue());
  }
}

// The same members in reverse order, with other white space and other spellings of numbers.
std::string reversed(const Json& value) {
  if (value.is_array()) {
    std::string text;
    for (const Json& entry : value) text += (text.empty() ? "" : " ,\t") + reversed(entry);
    return "[\n" + text + "]";
  }
  if (!value.is_object()) return value.is_number_integer() ? value.dump() + ".0e0" : value.dump(-1, ' ', true);
  std::string text;
  for (const auto& member : value.items())
    text = " " + Json(member.key()).dump() + " : " + reversed(member.value()) + (text.empty() ? "" : "\n,") + text;
  return "{" + text + " }\r\n";
}

RC_GTEST_PROP(Spec, CanonicalTextDoesNotCareHowTheFileWasWritten, ()) {
  const Spec spec = any_spec();
  const std::string text = print_spec(spec);
  const Result<Spec> back = parse_spec(reversed(Json::parse(text)));
  if (!back) RC_FAIL(to_line(back.issue()));
  RC_ASSERT(print_spec(*back) == text);
  RC_ASSERT(spec_id(*back) == spec_id(spec));
}

TEST(Spec, CanonicalTextIsSortedAndLeavesDefaultsOut) {
  Spec spec;
  EXPECT_EQ(print_spec(spec), R"({"character":{"name":"human"},"format":"contort.spec/1"})");
  spec.sequences = {sequence({elbow(0, 30, 0.1)})};
  spec.sequences[0].clips[0].actions[0].blend_in_frames = -1;
  EXPECT_EQ(print_spec(spec),
            R"({"character":{"name":"human"},"format":"contort.spec/1","sequences":[{"clips":[{"actions":[)"
            R"({"action":"pose","params":{"elbow_deg":0.1},"slot":"arm_left"}]}]}]})");
}

TEST(Spec, MinusZeroIsReadAsZero) {
  const std::string with_zero = R"({"format": "contort.spec/1", "character": {"name": "human"}, "sequences": [{"clips":
      [{"actions": [{"action": "pose", "slot": "arm_left",
                     "params": {"elbow_deg": ZERO, "shoulder_deg": [0, ZERO, 0]}}]}]}]})";
  const auto with = [&](const std::string& zero) {
    std::string text = with_zero;
    for (std::size_t at = text.find("ZERO"); at != std::string::npos; at = text.find("ZERO")) text.replace(at, 4, zero);
    const Result<Spec> spec = parse_spec(text);
    return spec ? spec_id(*spec) : to_line(spec.issue());
  };
  EXPECT_EQ(with("-0.0"), with("0"));
  EXPECT_EQ(with("-0"), with("0"));
}

Spec rich_spec() {
  Spec spec;
  spec.character = {"human", {{"head", "human_head"}}, {{"rifle", "hand_left", "grip"}}};
  spec.sequences = {sequence({elbow(1, 30, 50)})};
  return spec;
}

ActionUse& first_action(Spec& spec) { return spec.sequences[0].clips[0].actions[0]; }

TEST(Spec, TheIdChangesWithEveryField) {
  const std::function<void(Spec&)> changes[] = {
      [](Spec& s) { s.character.name = "mech"; },
      [](Spec& s) { s.character.parts["head"] = "x"; },
      [](Spec& s) { s.character.attachments[0].object = "x"; },
      [](Spec& s) { s.character.attachments[0].slot = "x"; },
      [](Spec& s) { s.character.attachments[0].socket = "x"; },
      [](Spec& s) { s.rate_hz = std::nextafter(60.0, 61.0); },
      [](Spec& s) { s.hold_frames = 1; },
      [](Spec& s) { s.sequences[0].name = "x"; },
      [](Spec& s) { s.sequences[0].duration_frames = 1; },
      [](Spec& s) { s.sequences.push_back({}); },
      [](Spec& s) { s.sequences[0].clips[0].name = "x"; },
      [](Spec& s) { s.sequences[0].clips[0].start_frame = 1; },
      [](Spec& s) { s.sequences[0].clips[0].duration_frames = 1; },
      [](Spec& s) { s.sequences[0].clips[0].speed = 2; },
      [](Spec& s) { s.sequences[0].clips.push_back({}); },
      [](Spec& s) { first_action(s).action = "x"; },
      [](Spec& s) { first_action(s).slot = "x"; },
      [](Spec& s) { first_action(s).start_frame = 2; },
      [](Spec& s) { first_action(s).duration_frames = 2; },
      [](Spec& s) { first_action(s).speed = 2; },
      [](Spec& s) { first_action(s).params["elbow_deg"] = std::nextafter(50.0, 51.0); },
      [](Spec& s) { first_action(s).params["elbow_deg"] = Vec3(50); },
      [](Spec& s) { first_action(s).params["x"] = 50.0; },
  };
  std::set<std::string> ids = {spec_id(rich_spec())};
  for (const auto& change : changes) {
    Spec spec = rich_spec();
    change(spec);
    ids.insert(spec_id(spec));
  }
  EXPECT_EQ(ids.size(), 1 + std::size(changes));
  EXPECT_EQ(spec_id(rich_spec()).size(), 32U);
}

}  // namespace
}  // namespace contort
