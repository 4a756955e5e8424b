// The commands at work: generate and check, fuzz and replay, as a user runs them.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "corpus/ending_case.h"
#include "process/isolate.h"
#include "fuzz/profile.h"
#include "tests/cli/program.h"
#include "tests/cli/small_library.h"
#include "tests/corpus/sample_cases.h"

namespace contort {

namespace {

using Json = nlohmann::json;

class Commands : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) {
    spill(folder_ / name, bytes);
    return folder_ / name;
  }
  std::string spec_file(double elbow_deg) {
    return file("spec_" + std::to_string(static_cast<int>(elbow_deg)) + ".json", pretty_spec(bent_elbow(elbow_deg)));
  }
  std::string glb(double elbow_deg) {
    const std::string path = folder_ / "motion.glb";
    const Ran ran = contort_program({"generate", spec_file(elbow_deg), "-o", path});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return path;
  }
  // A folder with the small character, which is a hundred times as fast to fuzz as the stock ones.
  std::string small_library() {
    const std::string path = folder_ / "library";
    small::write_library(path);
    return path;
  }
  Ran with_library(std::vector<std::string> arguments) {
    for (const std::string& more : {std::string("--library"), small_library()}) arguments.push_back(more);
    return contort_program(arguments);
  }
  Ran fuzz(const std::string& corpus, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "fuzz", "--corpus", corpus, "--character", "small", "--cases", "40", "--shrink-evaluations", "20"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return with_library(arguments);
  }
  TempFolder folder_;
};

bool has_result(const Ran& ran, const std::string& beginning) {
  return last_line(ran.out).rfind("RESULT " + beginning, 0) == 0;
}

TEST_F(Commands, CheckOfASpecSaysWhatIsWrongAndExitsWithOne) {
  const Ran clean = contort_program({"check", spec_file(100)});
  EXPECT_EQ(clean.code, 0) << clean.out << clean.err;
  EXPECT_EQ(last_line(clean.out), "RESULT findings=0");
  const Ran failed = contort_program({"check", spec_file(190)});
  EXPECT_EQ(failed.code, 1);
  EXPECT_TRUE(has_result(failed, "findings=")) << failed.out;
  EXPECT_NE(failed.out.find("joint_range  arm_left/elbow max"), std::string::npos) << failed.out;
  EXPECT_EQ(failed.err, "");
}

std::set<std::string> families_of_check(const Ran& checked) {
  std::set<std::string> families;
  const Json out = Json::parse(checked.out);
  for (const Json& finding : out["findings"])
    families.insert(finding["check"].get<std::string>() + "|small|" + finding["subject"].get<std::string>());
  return families;
}

TEST_F(Commands, FuzzLogsEveryFailingCaseForAnyNumberOfWorkers) {
  const std::string one = folder_ / "one.jsonl", two = folder_ / "two.jsonl";
  const Ran ran = fuzz(folder_ / "corpus_1", {"--jobs", "1", "--log", one, "--json"});
  ASSERT_EQ(ran.code, 1) << ran.err;
  ASSERT_EQ(fuzz(folder_ / "corpus_2", {"--jobs", "2", "--log", two}).code, 1);
  EXPECT_EQ(slurp(one), slurp(two));
  const std::vector<std::string> lines = lines_of(slurp(one));
  EXPECT_EQ(lines.size(), Json::parse(ran.out)["failing"].get<std::size_t>());
  std::int64_t last = -1;
  for (const std::string& text : lines) {
    const Json line = Json::parse(text);
    EXPECT_LT(last, line["index"].get<std::int64_t>());
    last = line["index"];
    EXPECT_NE(line["arm"], "");
    const std::set<std::string> families = line["families"];
    EXPECT_EQ(families_of_check(with_library({"check", file("spec.json", line["spec"].dump()), "--json"})), families);
  }
}

TEST_F(Commands, FuzzDoesNotBeginWhereItsLogCannotBeWritten) {
  const Ran ran = fuzz(folder_ / "corpus", {"--log", folder_ / "no/such/folder.jsonl"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_EQ(ran.err, "contort: file.unwritable: cannot write " + (folder_ / "no/such/folder.jsonl") + ": " +
                         (folder_ / "no/such") + ": No such file or directory\n");
  EXPECT_EQ(ran.out, "");
}

TEST_F(Commands, FuzzBeginsWithSpecsAndCasesOfAFolder) {
  const std::string seeds = folder_ / "seeds";
  std::filesystem::create_directories(seeds);
  spill(seeds + "/case.json", print_case(elbow_case()));
  spill(seeds + "/spec.json", pretty_spec(bent_elbow(100)));
  spill(seeds + "/read.me", "not a seed");
  const Ran ran = contort_program({"fuzz", "--seeds", seeds, "--corpus", folder_ / "corpus", "--cases", "0",
                                   "--shrink-evaluations", "0", "--jobs", "1", "--json"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  const Json out = Json::parse(ran.out, nullptr, false);
  ASSERT_TRUE(out.is_object()) << ran.out;
  EXPECT_EQ(out["cases"], 2);
  EXPECT_EQ(out["arms"]["seed"]["failing"], 1);
  EXPECT_TRUE(out["families"].contains(std::string("joint_range|human|") + kElbow)) << out["families"];
}

TEST_F(Commands, CheckOfASpecRefusesWhatOnlyAnimationsHave) {
  const std::vector<std::vector<std::string>> options = {
      {"--max-gap-m", "0.01"}, {"--loops", "*"},      {"--max-speed-deg-s", "3000"},
      {"--clip", "walk"},      {"--rate-hz", "60"},   {"--character", "human"},
      {"--skeleton", "a.asf"}, {"--all-clips=false"}, {"--character", "human", "--map", "a.json"}};
  for (const std::vector<std::string>& given : options) {
    std::vector<std::string> words = {"check", spec_file(100)};
    words.insert(words.end(), given.begin(), given.end());
    const Ran ran = contort_program(words);
    EXPECT_EQ(ran.code, 2) << given.front();
    EXPECT_NE(ran.err.find("usage.for_animations"), std::string::npos) << given.front() << ran.err;
  }
  EXPECT_EQ(contort_program({"check", spec_file(100), "--json"}).code, 0);
  EXPECT_EQ(contort_program({"check", glb(100), "--max-gap-m", "0.01"}).code, 0);
}

TEST_F(Commands, CheckPrintsJson) {
  const Ran ran = contort_program({"check", spec_file(190), "--json"});
  EXPECT_EQ(ran.code, 1);
  const Json out = Json::parse(ran.out, nullptr, false);
  ASSERT_TRUE(out.is_object()) << ran.out;
  EXPECT_EQ(out["frames"], 61);
  EXPECT_EQ(out["findings"][0]["subject"], kElbow);
  EXPECT_NEAR(out["findings"][0]["worst_margin"].get<double>(), -40 * kRadPerDeg, 1e-6);
}

TEST_F(Commands, GenerateAndCheckAgreeOnTheSpeedOfAJoint) {
  // A minimum-jerk turn of 120 degrees within a second is at its fastest 1.875 times as fast as on the mean.
  const Ran ran = contort_program({"check", glb(120), "--character", "human", "--json"});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  const Json out = Json::parse(ran.out, nullptr, false);
  ASSERT_TRUE(out.is_object()) << ran.out;
  const Json& clip = out["clips"][0];
  EXPECT_EQ(clip["peak_joint"], "arm_left/elbow");
  EXPECT_NEAR(clip["peak_deg_s"].get<double>(), 225.0, 1.0);
}

TEST_F(Commands, ACharactersOwnLimitsAreTakenWhereNamesMatch) {
  const std::string path = glb(120);
  EXPECT_EQ(contort_program({"check", path, "--max-speed-deg-s", "230"}).code, 0);
  const Ran failed = contort_program({"check", path, "--max-speed-deg-s", "220"});
  EXPECT_EQ(failed.code, 1);
  EXPECT_EQ(last_line(failed.out), "RESULT findings=1 clips=1");
  EXPECT_EQ(contort_program({"check", path, "--character", "human", "--max-speed-deg-s", "1"}).code, 0);
}

TEST_F(Commands, AClipThatIsNotThereIsRefused) {
  const Ran ran = contort_program({"check", glb(120), "--clip", "walk"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("check.no_clip"), std::string::npos) << ran.err;
}

TEST_F(Commands, ATruncatedFileIsRefusedAtAnyLength) {
  const std::string whole = slurp(glb(120));
  ASSERT_GT(whole.size(), 2000U);
  const std::size_t json_size = static_cast<unsigned char>(whole[12]) + 256U * static_cast<unsigned char>(whole[13]);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{3}, std::size_t{11}, std::size_t{12}, std::size_t{19}, std::size_t{20},
        json_size / 2, json_size + 20, json_size + 27, whole.size() / 2, whole.size() - 4, whole.size() - 1}) {
    const Ran ran = contort_program({"check", file("cut.glb", whole.substr(0, size))});
    EXPECT_EQ(ran.code, 2) << size << " of " << whole.size() << "\n" << ran.err;
    EXPECT_EQ(lines_of(ran.err).size(), 1U) << size << "\n" << ran.err;
    EXPECT_EQ(ran.err.rfind("contort: ", 0), 0U) << size << "\n" << ran.err;
  }
}

TEST_F(Commands, BuiltInProfilesArePrintedAsFilesOfThem) {
  const Json list = Json::parse(contort_program({"list", "profiles", "--json"}).out, nullptr, false);
  ASSERT_EQ(list.size(), built_in_profiles().size());
  for (const Json& entry : list) {
    const Result<Profile> read = parse_profile(entry["profile"].dump());
    ASSERT_TRUE(read) << to_line(read.issue());
    EXPECT_EQ(*read, *load_profile(entry["name"].get<std::string>()));
  }
}

TEST_F(Commands, FuzzFindsAndReplayConfirms) {
  const std::string corpus = folder_ / "corpus";
  const Ran found = fuzz(corpus);
  EXPECT_EQ(found.code, 1) << found.err;
  EXPECT_EQ(found.err, "");
  EXPECT_TRUE(has_result(found, "findings=")) << found.out;
  EXPECT_NE(found.out.find("contort replay "), std::string::npos) << "no command to see a failure again";
  const Ran replayed = with_library({"replay", corpus});
  EXPECT_EQ(replayed.code, 1) << replayed.err;
  EXPECT_TRUE(has_result(replayed, "cases=")) << replayed.out;
  EXPECT_NE(last_line(replayed.out).find("same_family=0 different=0 passes=0 refused=0"), std::string::npos);
  const Json list = Json::parse(with_library({"replay", corpus, "--json"}).out, nullptr, false);
  ASSERT_TRUE(list.is_array());
  EXPECT_EQ(list.size() + 2, lines_of(replayed.out).size()) << "a line for each, what became of all, and the result";
  for (const Json& one : list) EXPECT_EQ(one["verdict"], "same");
}

TEST_F(Commands, ACommandToReplayNamesTheLibraryThatTheCaseNeeds) {
  const Ran found = fuzz(folder_ / "corpus");
  const std::string command = "contort replay ";
  const std::size_t first = found.out.find(command) + command.size();
  ASSERT_GT(first, command.size()) << found.out;
  const std::string rest = found.out.substr(first, found.out.find('\n', first) - first);
  const std::size_t space = rest.find(' ');
  ASSERT_NE(space, std::string::npos) << rest;
  EXPECT_EQ(rest.substr(space), " --library " + small_library());
  EXPECT_EQ(contort_program({"replay", rest.substr(0, space), "--library", small_library()}).code, 1);
}

TEST_F(Commands, JsonIsAllThatIsPrintedWithAReportToo) {
  const std::string report = folder_ / "report";
  const Ran ran =
      contort_program({"fuzz", "--cases", "0", "--json", "--corpus", folder_ / "corpus", "--report", report});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const Json out = Json::parse(ran.out, nullptr, false);
  ASSERT_TRUE(out.is_object()) << ran.out;
  EXPECT_EQ(out["report"], report + "/index.html");
}

TEST_F(Commands, FuzzTakesTheStockCharactersAndPrintsCommandsThatWork) {
  const std::string corpus = folder_ / "corpus";
  const Ran found = contort_program(
      {"fuzz", "--profile", "stress", "--corpus", corpus, "--cases", "3", "--shrink-evaluations", "0",
       "--shrinks-per-family", "1"});
  EXPECT_EQ(found.code, 1) << found.err;
  EXPECT_TRUE(has_result(found, "findings=")) << found.out;
  const std::string command = "contort replay ";
  const std::size_t at = found.out.find(command);
  ASSERT_NE(at, std::string::npos) << found.out;
  const std::size_t first = at + command.size();
  const std::string path = found.out.substr(first, found.out.find('\n', first) - first);
  const Ran replayed = contort_program({"replay", path});
  EXPECT_EQ(replayed.code, 1) << path << replayed.err;
  EXPECT_EQ(last_line(replayed.out), "RESULT cases=1 same=1 same_family=0 different=0 passes=0 refused=0");
}

TEST_F(Commands, FuzzingAgainFindsTheSameFailuresKnown) {
  const std::string corpus = folder_ / "corpus";
  const Json first = Json::parse(fuzz(corpus, {"--json", "--jobs", "1"}).out, nullptr, false);
  const Ran again = fuzz(corpus, {"--json", "--jobs", "3"});
  const Json second = Json::parse(again.out, nullptr, false);
  ASSERT_TRUE(first.is_object() && second.is_object());
  EXPECT_FALSE(first["new_buckets"].empty());
  EXPECT_TRUE(second["new_buckets"].empty());
  EXPECT_EQ(second["known_buckets"], first["new_buckets"]);
  EXPECT_EQ(second["families"], first["families"]);
}

TEST_F(Commands, FuzzOfNoCasesIsCleanAndReplayOfItsCorpusToo) {
  const std::string corpus = folder_ / "corpus";
  const Ran ran = contort_program({"fuzz", "--cases", "0", "--corpus", corpus});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(has_result(ran, "findings=0 new=0")) << ran.out;
  const Ran replayed = contort_program({"replay", corpus});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_TRUE(has_result(replayed, "cases=0")) << replayed.out;
}

TEST_F(Commands, TheResultIsTheLastLineWithAReportToo) {
  const Ran ran =
      contort_program({"fuzz", "--cases", "0", "--corpus", folder_ / "corpus", "--report", folder_ / "report"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(has_result(ran, "findings=0")) << ran.out;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "report/index.html"));
}

TEST_F(Commands, ReplayOfACaseThatPassesExitsWithZeroAndOneThatIsRefusedWithTwo) {
  Case passes = elbow_case();
  passes.spec = bent_elbow(100);
  const Ran passed = contort_program({"replay", file("passes.json", print_case(passes))});
  EXPECT_EQ(passed.code, 0) << passed.err;
  EXPECT_NE(last_line(passed.out).find("passes=1"), std::string::npos);
  Case refused = elbow_case();
  refused.spec.character.name = "nobody";
  const std::string bad = file("refused.json", print_case(refused));
  const Ran mixed =
      contort_program({"replay", folder_ / "passes.json", bad, file("same.json", print_case(elbow_case()))});
  EXPECT_EQ(mixed.code, 2) << mixed.err;
  EXPECT_EQ(last_line(mixed.out), "RESULT cases=3 same=1 same_family=0 different=0 passes=1 refused=1");
}

TEST_F(Commands, ReplayOfALevelPlaysOnlyThat) {
  const std::string path = file("elbow.json", print_case(elbow_case()));
  EXPECT_EQ(contort_program({"replay", path, "--level", "clip:1/1"}).code, 1);
  const Ran other = contort_program({"replay", path, "--level", "part:head"});
  EXPECT_EQ(other.code, 0) << "the head has nothing to do with it: " << other.out;
  const Ran bad = contort_program({"replay", path, "--level", "limb:arm"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("level.bad_name"), std::string::npos) << bad.err;
}

TEST_F(Commands, ADamagedBucketIsAnErrorOfReplay) {
  const std::string corpus = folder_ / "corpus";
  ASSERT_EQ(fuzz(corpus).code, 1);
  for (const auto& bucket : std::filesystem::directory_iterator(corpus + "/buckets")) {
    spill(bucket.path().string() + "/bucket.json", "{");
    break;
  }
  const Ran ran = with_library({"replay", corpus});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("bucket.json"), std::string::npos) << ran.err;
}

TEST_F(Commands, ACaseThatCrashedAndDoesNotAnyMorePasses) {
  const Case crashed = ending_case(bent_elbow(100), {Ending::Kind::crash, "SIGSEGV", ""});
  const std::string path = file("crashed.json", print_case(crashed));
  const Ran replayed = contort_program({"replay", path});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  EXPECT_EQ(last_line(replayed.out), "RESULT cases=1 same=0 same_family=0 different=0 passes=1 refused=0");
  const Ran shrunk = contort_program({"shrink", path});
  EXPECT_EQ(shrunk.code, 2);
  EXPECT_NE(shrunk.err.find("shrink.no_failure"), std::string::npos) << shrunk.err;
}

TEST_F(Commands, AnInterruptKeepsWhatWasFoundAndExitsWith75) {
  const std::string library = small_library();
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string corpus = folder_ / ("corpus_" + std::to_string(signal));
    const Program program(
        {"fuzz", "--cases", "100000000", "--corpus", corpus, "--character", "small", "--library", library},
        folder_.path());
    for (int i = 0; i < 600 && !std::filesystem::exists(corpus + "/leads"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    program.send(signal);
    const Ran ran = program.wait();
    EXPECT_EQ(ran.code, 75) << ran.err;
    EXPECT_TRUE(has_result(ran, "findings=")) << ran.out;
    const Ran replayed = with_library({"replay", corpus});
    EXPECT_NE(replayed.code, 2) << replayed.err;
    EXPECT_NE(last_line(replayed.out).find("different=0 passes=0 refused=0"), std::string::npos) << replayed.out;
  }
}

// Damage, a stranger's file and a character that changed cost a table's building time, never another motion.
TEST_F(Commands, TablesAreKeptBesideTheLibraryAndBuiltAnewWhereTheyDoNotFit) {
  const std::string library = folder_ / "tables_library";
  std::filesystem::create_directories(library);
  const auto tables = [&] { return contort_program({"--library", library, "tables", library}).out; };
  const std::string first = tables();
  EXPECT_NE(first.find(" 0 kept"), std::string::npos) << first;
  EXPECT_NE(tables().find(": 0 built"), std::string::npos);
  const auto motion = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"generate", CONTORT_SOURCE_DIR "/docs/examples/aim_while_walking.json", "-o",
                                       folder_ / "motion.json"});
    const Ran ran = contort_program(arguments);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out.substr(ran.out.rfind("motion "));
  };
  const std::string expected = motion({});
  EXPECT_EQ(motion({"--library", library}), expected);
  std::size_t damaged = 0;
  for (const auto& [name, bytes] : tree_of(library)) {
    spill(library + "/" + name, bytes.substr(0, bytes.size() / 2));
    ++damaged;
  }
  EXPECT_GT(damaged, 10U);
  EXPECT_EQ(motion({"--library", library}), expected);
  spill(library + "/aim/stranger.aim", "not a table");
  const std::string again = tables();
  EXPECT_NE(again.find(std::to_string(damaged) + " built, 0 kept, 1 removed"), std::string::npos) << again;
}

TEST_F(Commands, TablesThatCannotBeWrittenAreAnError) {
  spill(folder_ / "file", "");
  const Ran ran = contort_program({"tables", folder_ / "file"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("file.unwritable"), std::string::npos) << ran.err;
}

}  // namespace

}  // namespace contort
