// Help, and all mistakes of users: exit code 2 or 3 and one line with the reason.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/corpus/sample_cases.h"

namespace contort {

namespace {

const char* const kCommands[] = {"fuzz", "replay", "generate", "check",    "shrink", "render",  "report", "corpus",
                                 "list", "schema", "import",   "contacts", "merge",  "version", "help",   "man",
                                 "completion"};

// Expects one line for people, and no verdict that a motion is clean.
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

TEST_F(Usage, ATimeIsANumberOfSecondsOrHasAUnit) {
  for (const std::string time : {"45", "45s", "1.5m", "0.5h", "1e1s"}) {
    const Ran ran = contort_program({"fuzz", "--time", time, "--corpus", folder_ / "corpus", "--cases", "0"});
    EXPECT_EQ(ran.code, 0) << time << ran.err;
  }
  expect_refused({"fuzz", "--time", "45x", "--cases", "0"}, 2, "--time: found \"45x\"");
  expect_refused({"fuzz", "--case-timeout", "nan", "--cases", "0"}, 2, "nan");
}

TEST_F(Usage, AMisspelledNameIsToldTheNearest) {
  expect_refused({"chek", good_spec()}, 2, "did you mean \"check\"?");
  expect_refused({"corpus", "lst", folder_.path()}, 2, "did you mean \"list\"?");
  expect_refused({"check", good_spec(), "--charcter", "human"}, 2, "did you mean \"--character\"?");
  expect_refused({"--libary", "x", "check", good_spec()}, 2, "did you mean \"--library\"?");
  expect_refused({"list", "actoins"}, 2, "did you mean \"actions\"?");
  expect_refused({"schema", "settngs"}, 2, "did you mean \"settings\"?");
  expect_refused({"fuzz", "--character", "mehc", "--corpus", folder_ / "corpus"}, 2, "did you mean \"mech\"?");
  expect_refused({"fuzz", "--profile", "nightyl", "--corpus", folder_ / "corpus"}, 2, "did you mean \"nightly\"?");
  expect_refused({"contacts", "humna"}, 2, "did you mean \"human\"?");
  expect_refused({"contacts", "fox"}, 2, "; characters of your own need --library FOLDER");
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string text = pretty_spec(bent_elbow(190));
    text.replace(text.find(what), what.size(), instead);
    return file("misspelled.json", text);
  };
  expect_refused({"check", with("\"pose\"", "\"psoe\"")}, 2, "did you mean \"pose\"?");
  expect_refused({"check", with("\"arm_left\"", "\"arm_letf\"")}, 2, "did you mean \"arm_left\"?");
  expect_refused({"check", with("\"elbow_deg\"", "\"elbw_deg\"")}, 2, "did you mean \"elbow_deg\"?");
  expect_refused({"check", with("\"duration_frames\"", "\"duration_frame\"")}, 2, "did you mean \"duration_frames\"?");
  const std::string settings = file(
      "s.json", R"({"format":"contort.settings/1","limits":[{"check":"joint_rnage","use":"ignore","reason":"x"}]})");
  expect_refused({"--settings", settings, "check", good_spec()}, 2, "did you mean \"joint_range\"?");
}

TEST_F(Usage, HelpAndTheVersionAreThereInEveryCustomaryWay) {
  EXPECT_EQ(contort_program({"help"}).out, contort_program({"--help"}).out);
  EXPECT_EQ(contort_program({"help", "fuzz"}).out, contort_program({"fuzz", "--help"}).out);
  EXPECT_EQ(contort_program({"help", "corpus", "list"}).out, contort_program({"corpus", "list", "--help"}).out);
  EXPECT_EQ(contort_program({"--version"}).out, contort_program({"version"}).out);
  for (const std::vector<std::string>& call : {std::vector<std::string>{"help"}, {"help", "fuzz"}, {"--version"}})
    EXPECT_EQ(contort_program(call).code, 0) << call.front();
  expect_refused({"help", "fuz"}, 2, "did you mean \"fuzz\"?");
}

TEST_F(Usage, AFileOfAnotherKindIsCalledThat) {
  const std::string png = file("a.json", "\x89PNG\r\n\x1a\n"), zip = file("a.glb", "PK\x03\x04");
  for (const char* command : {"check", "replay", "shrink"})
    expect_refused({command, png}, 2, "file.wrong_kind: " + png + " is a PNG image, expected a ");
  expect_refused({"--settings", png, "check", good_spec()}, 2, png + " is a PNG image, expected a settings file");
  expect_refused({"fuzz", "--profile", png, "--cases", "0"}, 2, png + " is a PNG image, expected a fuzzing profile");
  expect_refused({"check", zip}, 2, "gltf.wrong_kind: " + zip + " is a ZIP archive");
  expect_refused({"import", zip, "-o", folder_ / "figures"}, 2, zip + " is a ZIP archive");
  expect_refused({"check", file("a.bvh", "Kaydara FBX Binary")}, 2, "a.bvh is an FBX model");
  const std::string bvh = file("b.json", "HIERARCHY\nROOT a");
  expect_refused({"replay", bvh}, 2, "b.json is a BVH animation");
  expect_refused({"render", bvh, "-o", folder_ / "x.png"}, 2, "; for pictures of clips: contort check " + bvh + " --report DIR");
  expect_refused({"check", file("b.json", "HIERARCHY\nROOT a")}, 2, "bvh.truncated");  // what it holds counts
  expect_refused({"check", file("c.json", R"({"asset": {"version": "2.0"}})")}, 2, "c.json holds no animation");
  expect_refused({"check", file("d.urdf", "<robot name=\"a\"/>")}, 2, "d.urdf is a robot in URDF");
  expect_refused({"check", file("e.npz", "import numpy")}, 2, "e.npz is named like NumPy arrays (NPZ)");
  expect_refused({"check", file("f.csv", "t,x\n0,1\n")}, 2, "f.csv has values of joints without a skeleton; --character");
  expect_refused({"replay", file("f.csv", "t,x\n0,1\n")}, 2, "f.csv is a table of numbers (CSV)");
  const std::string lfs = "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n";
  for (const char* name : {"g.bvh", "g.glb", "g.vrm", "g.amc", "g.fbx"})
    expect_refused({"check", file(name, lfs)}, 2, "run git lfs pull");
  expect_refused({"check", file("d.json", R"({"format": "contort.bucket/1"})")}, 2, "found \"contort.bucket/1\"");
  const std::string library = folder_ / "library";
  std::filesystem::create_directories(library);
  spill(library + "/part.json", "version https://git-lfs.github.com/spec/v1\n");
  expect_refused({"--library", library, "list", "parts"}, 2, "part.json is a Git LFS pointer");
}

TEST_F(Usage, WhatIsWrongWithAFileIsSaidWithItsName) {
  Spec nobody = bent_elbow(190);
  nobody.character.name = "nobody";
  const std::string spec = file("spec.json", pretty_spec(nobody));
  expect_refused({"check", spec}, 2, spec);
  expect_refused({"generate", spec, "-o", folder_ / "a.glb"}, 2, spec);
  expect_refused({"contacts", spec}, 2, spec);
  expect_refused({"render", spec, "-o", folder_ / "a.png"}, 2, spec);
  Case stored = elbow_case();
  stored.spec.character.name = "nobody";
  const std::string lost = file("case.json", print_case(stored));
  expect_refused({"shrink", lost}, 2, lost);
  const std::string broken = file("a.glb", "glTF"), folder = folder_ / "library";
  expect_refused({"check", broken}, 2, broken);
  expect_refused({"import", broken, "-o", folder_ / "figures"}, 2, broken);
  std::filesystem::create_directories(folder);
  std::filesystem::copy(broken, folder + "/a.glb");
  expect_refused({"--library", folder, "list", "parts"}, 2, folder + "/a.glb");
}

TEST_F(Usage, NumbersThatAreHugeAreShownInShort) {
  std::string text = pretty_spec(bent_elbow(190));
  text.replace(text.find("190.0"), 5, "1e308");
  const Ran ran = contort_program({"check", file("huge.json", text)});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("found 1e+308, allowed is ["), std::string::npos) << ran.err;
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
  EXPECT_EQ(ran.out, slurp(std::string(CONTORT_SOURCE_DIR) + "/docs/reference/actions.md"))
      << "contort list actions --markdown > docs/reference/actions.md";
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
