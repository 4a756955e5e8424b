// Help, and everything that a user can get wrong: exit code 2 or 3 and one line that says why.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/corpus/sample_cases.h"

namespace contort {

namespace {

const char* const kCommands[] = {"fuzz",   "replay", "generate", "check",  "shrink",   "render", "report",
                                 "corpus", "list",   "schema",   "import", "contacts", "merge",  "version"};

// One line for people, and no motion found to be clean.
void expect_refused(const std::vector<std::string>& arguments, int code, const std::string& needle = "") {
  const Ran ran = contort_program(arguments);
  std::string call;
  for (const std::string& argument : arguments) call += argument + " ";
  EXPECT_EQ(ran.code, code) << call << "\n" << ran.err;
  EXPECT_EQ(lines_of(ran.err).size(), 1U) << call << "\n" << ran.err;
  EXPECT_EQ(ran.err.rfind("contort: ", 0), 0U) << call << "\n" << ran.err;
  EXPECT_NE(ran.err.find(needle), std::string::npos) << call << "\n" << ran.err;
  EXPECT_EQ(ran.out.find("OK"), std::string::npos) << call;
}

class Usage : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) {
    spill(folder_ / name, bytes);
    return folder_ / name;
  }
  std::string good_spec() { return file("spec.json", pretty_spec(bent_elbow(190))); }
  TempFolder folder_;
};

TEST_F(Usage, EveryCommandHasHelpWithAnExample) {
  const Ran all = contort_program({"--help"});
  EXPECT_EQ(all.code, 0);
  for (const std::string command : kCommands) {
    EXPECT_NE(all.out.find("\n  " + command + " "), std::string::npos) << command;
    const Ran help = contort_program({command, "--help"});
    EXPECT_EQ(help.code, 0) << command;
    EXPECT_NE(help.out.find("Example: contort " + command), std::string::npos) << command;
    EXPECT_EQ(help.err, "") << command;
  }
}

TEST_F(Usage, NoCommandAnUnknownOneAndUnknownOptionsAreRefused) {
  expect_refused({}, 2);
  expect_refused({"frobnicate"}, 2);
  expect_refused({"check"}, 2);
  expect_refused({"check", good_spec(), "--frobnicate"}, 2);
  expect_refused({"check", good_spec(), "--max-speed-deg-s", "fast"}, 2);
  expect_refused({"check", good_spec(), "--max-speed-deg-s", "nan"}, 2);
  expect_refused({"list", "frogs"}, 2);
  expect_refused({"schema", "frog"}, 2);
  expect_refused({"fuzz", "--jobs", "0"}, 2);
  expect_refused({"fuzz", "--cases", "-1"}, 2);
  expect_refused({"shrink", good_spec(), "--depth-floor", "2"}, 2);
  expect_refused({"shrink", good_spec(), "--depth-floor", "nan"}, 2, "nan");
  expect_refused({"shrink", good_spec(), "--time", "soon"}, 2, "usage.bad_time");
  const std::string profile = file("p.json", R"({"format":"contort.profile/1","name":"p","about":"","time":"soon"})");
  expect_refused({"fuzz", "--profile", profile, "--cases", "1"}, 2, "profile.bad_time at /time: " + profile);
  expect_refused({"shrink", good_spec(), "--shrink-time", "soon"}, 2, "usage.bad_time");
  expect_refused({"fuzz", "--cases", "0", "--shrink-time", "soon", "--corpus", folder_ / "corpus"}, 2, "--shrink-time");
}

TEST_F(Usage, ABadTimeIsRefused) {
  for (const std::string time : {"", "0", "0s", "-5s", "10x", "m", "5 m", "nan", "inf", "1e999", "1e9h", "10ms"}) {
    SCOPED_TRACE(time);
    const Ran ran = contort_program({"fuzz", "--time=" + time, "--corpus", folder_ / "corpus", "--cases", "0"});
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_EQ(ran.err.rfind("contort: ", 0), 0U) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "corpus"));
  }
}

TEST_F(Usage, SeedsThatWouldTestNothingAreRefused) {
  const std::string seeds = folder_ / "seeds", corpus = folder_ / "corpus";
  expect_refused({"fuzz", "--seeds", seeds, "--corpus", corpus}, 2, "seeds.none");
  std::filesystem::create_directories(seeds);
  expect_refused({"fuzz", "--seeds", seeds, "--corpus", corpus}, 2, "seeds.none");
  Spec nobody = bent_elbow(190);
  nobody.character.name = "nobody";
  spill(seeds + "/a.json", pretty_spec(bent_elbow(190)));
  spill(seeds + "/b.json", pretty_spec(nobody));
  expect_refused({"fuzz", "--seeds", seeds, "--corpus", corpus}, 2, "seeds.refused");
  spill(seeds + "/b.json", "{");
  expect_refused({"fuzz", "--seeds", seeds, "--corpus", corpus}, 2, "b.json");
  EXPECT_FALSE(std::filesystem::exists(corpus));
}

TEST_F(Usage, AnUnknownCharacterIsRefused) {
  expect_refused({"fuzz", "--character", "nobody", "--corpus", folder_ / "corpus"}, 2, "nobody");
  expect_refused({"check", file("a.glb", "x"), "--character", "nobody"}, 2, "nobody");
}

TEST_F(Usage, AMissingFileIsRefusedByName) {
  const std::string missing = folder_ / "missing";
  for (const char* command : {"check", "replay", "shrink"}) {
    expect_refused({command, missing + ".json"}, 2, "missing.json");
    expect_refused({command, folder_.path()}, 2);
  }
  expect_refused({"check", missing + ".glb"}, 2, "missing.glb");
  expect_refused({"check", missing + ".gltf"}, 2, "missing.gltf");
  expect_refused({"generate", missing + ".json", "-o", folder_ / "out.glb"}, 2, "missing.json");
  expect_refused({"report", missing, "-o", folder_ / "report"}, 2, "missing");
  expect_refused({"check", good_spec(), "--library", missing}, 2, "missing");
}

TEST_F(Usage, AMalformedSpecIsRefusedByEveryCommandThatReadsOne) {
  const std::string good = pretty_spec(bent_elbow(190));
  const std::map<std::string, std::string> bad = {
      {"empty", ""},
      {"half", good.substr(0, good.size() / 2)},
      {"binary", std::string("\0\1\xff\xfe", 4)},
      {"format", "{\"format\":\"contort.spec/2\"}"},
      {"slot",
       "{\"format\":\"contort.spec/1\",\"character\":{\"name\":\"human\"},\"sequences\":[{\"clips\":[{\"actions"
       "\":[{\"action\":\"pose\",\"slot\":\"tail\"}]}]}]}"},
      {"character", "{\"format\":\"contort.spec/1\",\"character\":{\"name\":\"no\\nbody\"}}"},
      {"deep", std::string(100000, '[')}};
  for (const auto& [name, text] : bad) {
    const std::string path = file(name + ".json", text);
    expect_refused({"check", path}, 2);
    expect_refused({"generate", path, "-o", folder_ / "out.glb"}, 2);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.glb"));
  }
}

TEST_F(Usage, AMalformedCaseIsRefused) {
  std::string text = print_case(elbow_case());
  const std::string half = file("half.json", text.substr(0, text.size() / 2));
  text.replace(text.find("\"worst_margin\": -"), 17, "\"worst_margin\": ");
  const std::string positive = file("positive.json", text);
  for (const std::string& path : {half, positive})
    for (const char* command : {"replay", "shrink"}) expect_refused({command, path}, 2, path);
  expect_refused({"shrink", good_spec()}, 2, "case");
}

TEST_F(Usage, AUserLibraryThatIsBrokenIsRefused) {
  std::filesystem::create_directories(folder_ / "library");
  spill(folder_ / "library/part.json", "{\"format\":\"contort.part/1\"}");
  expect_refused({"list", "parts", "--library", folder_ / "library"}, 2, "part.json");
}

// Root may write everywhere but below a file.
TEST_F(Usage, WhatCannotBeWrittenIsAnInternalError) {
  const std::string below = file("file", "x") + "/corpus";
  expect_refused({"fuzz", "--cases", "1", "--corpus", below}, 3, "file.unwritable");
  expect_refused({"fuzz", "--cases", "1", "--corpus", "/proc/contort"}, 3, "file.unwritable");
  expect_refused({"generate", good_spec(), "-o", below + ".glb"}, 3);
  expect_refused({"generate", good_spec(), "-o", below + ".json"}, 3, "file.unwritable");
  const std::string stored = file("case.json", print_case(elbow_case()));
  expect_refused({"shrink", stored, "-o", below, "--evaluations", "0"}, 3, "file.unwritable");
}

TEST_F(Usage, AnOutputOfUnknownKindIsRefused) {
  expect_refused({"generate", good_spec(), "-o", folder_ / "out.fbx"}, 2, "usage.bad_output");
}

TEST_F(Usage, NamesWithOddBytesDoNotBreakTheOneLine) {
  expect_refused({"check", folder_ / "two\nlines.json"}, 2);
  expect_refused({"check", folder_ / "\xff\xfe.glb"}, 2);
  const std::string odd = file("\xff.json", pretty_spec(bent_elbow(190)));
  const Ran ran = contort_program({"check", odd, "--json"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_FALSE(nlohmann::json::parse(ran.out, nullptr, false).is_discarded()) << ran.out;
  expect_refused({"generate", odd, "-o", folder_ / "out.glb"}, 3, "gltf.bad_text");  // a .glb cannot hold the name
  const Ran replayed = contort_program({"replay", file("\xfe.json", print_case(elbow_case())), "--json"});
  EXPECT_EQ(replayed.code, 1) << replayed.err;
  EXPECT_FALSE(nlohmann::json::parse(replayed.out, nullptr, false).is_discarded()) << replayed.out;
}

TEST_F(Usage, TheActionsPageIsWhatTheRegistrySays) {
  const Ran ran = contort_program({"list", "actions", "--markdown"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.out, slurp(std::string(CONTORT_SOURCE_DIR) + "/docs/actions.md"))
      << "contort list actions --markdown > docs/actions.md";
  EXPECT_EQ(contort_program({"list", "checks", "--markdown"}).code, 2);
}

TEST_F(Usage, ListsSchemasAndTheVersionArePrinted) {
  for (const char* what : {"characters", "parts", "actions", "checks"}) {
    EXPECT_EQ(contort_program({"list", what}).code, 0);
    const Ran ran = contort_program({"list", what, "--json"});
    const nlohmann::json list = nlohmann::json::parse(ran.out, nullptr, false);
    ASSERT_TRUE(list.is_array()) << what;
    EXPECT_FALSE(list.empty()) << what;
  }
  for (const char* format : {"spec", "case", "part", "object", "character"}) {
    const nlohmann::json schema = nlohmann::json::parse(contort_program({"schema", format}).out, nullptr, false);
    ASSERT_TRUE(schema.is_object()) << format;
    EXPECT_TRUE(schema.contains("$schema")) << format;
  }
  EXPECT_EQ(contort_program({"version"}).out.rfind("contort ", 0), 0U);
}

}  // namespace

}  // namespace contort
