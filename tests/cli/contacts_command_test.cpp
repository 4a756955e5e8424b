// contort contacts, as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/cli/small_library.h"

namespace contort {
namespace {

using Json = nlohmann::json;

class ContactsCommand : public testing::Test {
 protected:
  // The two boxes overlap by 2 cm at rest.
  std::string library() {
    Library own = small::library();
    own.parts["small_arm"].colliders[0].shape = Box{{-0.21, 0, 0}, {0.1, 0.1, 0.1}, {}};
    small::write_library(folder_ / "own", own);
    return folder_ / "own";
  }
  TempFolder folder_;
};

TEST_F(ContactsCommand, SaysWhatIsAllowedAndWhy) {
  const Ran ran = contort_program({"contacts", "human", "--poses", "20"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out.rfind("human: ", 0), 0U) << ran.out;
  EXPECT_NE(ran.out.find(" of them: adjacent\n"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("proposed, by the rest pose and 20 poses within all ranges: 0\n"), std::string::npos)
      << ran.out;
}

TEST_F(ContactsCommand, EveryPairOfCollidersIsEitherJudgedOrAllowedWithAReason) {
  const Ran ran = contort_program({"contacts", "human", "--poses", "0", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json out = Json::parse(ran.out);
  Result<Character> human = build_character({"human", {}, {}}, stock_library());
  const std::size_t colliders = human->colliders().size();
  EXPECT_EQ(out["judged"].get<std::size_t>() + out["allowed"].size(), colliders * (colliders - 1) / 2);
  for (const Json& pair : out["allowed"]) EXPECT_NE(pair["reason"], "");
}

TEST_F(ContactsCommand, WhatItProposesCanBePutIntoTheCharactersFile) {
  const std::string own = library(), proposed = folder_ / "allowed.json";
  const std::vector<std::string> command = {"--library", own, "contacts", "small", "-o", proposed};
  const Ran before = contort_program(command);
  ASSERT_EQ(before.code, 0) << before.err;
  EXPECT_NE(before.out.find("all ranges: 1\n  arm_left/box ~ arm_right/box: rest_pose: they overlap by 0.0200 m\n"),
            std::string::npos)
      << before.out;
  Json character = Json::parse(slurp(own + "/small.json"));
  character["allowed_pairs"] = Json::parse(slurp(proposed))["allowed_pairs"];
  spill(own + "/small.json", character.dump());
  const Ran after = contort_program(command);
  EXPECT_NE(after.out.find("all ranges: 0\n"), std::string::npos) << after.out << after.err;
  EXPECT_EQ(Json::parse(slurp(proposed))["allowed_pairs"], character["allowed_pairs"]);  // present pairs are kept
}

TEST_F(ContactsCommand, TakesPartsAndObjectsFromASpec) {
  const std::string own = library(), spec = folder_ / "spec.json";
  spill(spec, R"({"format":"contort.spec/1","character":{"name":"small",
                  "attachments":[{"object":"peg","slot":"arm_left","socket":"inside"}]},"hold_frames":1})");
  const Ran ran = contort_program({"--library", own, "contacts", spec, "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("object:peg/tip"), std::string::npos) << ran.out;
}

TEST_F(ContactsCommand, RefusesWhatIsNeitherACharacterNorAFile) {
  const Ran ran = contort_program({"contacts", "nobody"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_EQ(ran.err,
            "contort: character.unknown_character: \"nobody\" is no character (contort list characters) and no file; "
            "characters of your own need --library FOLDER\n");
  EXPECT_EQ(contort_program({"contacts", "human", "--poses", "-1"}).code, 2);
  EXPECT_EQ(contort_program({"contacts", "human", "-o", (folder_ / "no") + "/x.json"}).code, 3);
}

}  // namespace
}  // namespace contort
