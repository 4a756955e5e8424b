// contort fuzz --against and contort measure, as processes.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "corpus/case.h"
#include "corpus/measurement.h"
#include "tests/cli/program.h"
#include "tests/cli/small_library.h"
#include "tests/corpus/sample_cases.h"

namespace contort {
namespace {

const std::string kProgram = CONTORT_BINARY_DIR "/contort";

class AgainstCommand : public testing::Test {
 protected:
  AgainstCommand() { small::write_library(folder_ / "library"); }

  Ran fuzz(const std::string& base, const std::string& corpus, const std::vector<std::string>& more = {},
           const std::string& cases = "40") {
    std::vector<std::string> arguments = {"--library",
                                          folder_ / "library",
                                          "fuzz",
                                          "--character",
                                          "small",
                                          "--cases",
                                          cases,
                                          "--jobs",
                                          "2",
                                          "--seed",
                                          "4",
                                          "--shrink-evaluations",
                                          "20",
                                          "--corpus",
                                          folder_ / corpus};
    if (!base.empty()) arguments.insert(arguments.end(), {"--against", base});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return contort_program(arguments);
  }

  std::string script(const std::string& name, const std::string& text) {
    spill(folder_ / name, "#!/bin/sh\n" + text);
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
    return folder_ / name;
  }

  // A base without failures, with other motions.
  std::string flawless() {
    return script("flawless", "echo '" + print_line(own_hello("0.0.7")) +
                                  "'\nwhile read -r line; do\n"
                                  "  id=${line#*\\\"id\\\":}\n  id=${id%%[!0-9]*}\n"
                                  "  echo \"{\\\"id\\\":$id,\\\"motion_hash\\\":\\\"0123456789abcdef\\\"}\"\ndone\n");
  }

  TempFolder folder_;
};

TEST_F(AgainstCommand, FindsNothingBetweenEqualBuilds) {
  const Ran ran = fuzz(kProgram, "corpus");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(last_line(ran.out).find("broke=0 worse=0 mended=0 moved=0 refused=0 same=40"), std::string::npos)
      << ran.out;
  EXPECT_EQ(ran.out.find("BROKE"), std::string::npos);
  EXPECT_EQ(fuzz(kProgram, "again", {"--moved"}).code, 0);
}

TEST_F(AgainstCommand, FindsABaseByItsNameInThePath) {
  script("old_contort", "exec " + kProgram + " \"$@\"\n");
  const char* path = std::getenv("PATH");
  ASSERT_NE(path, nullptr);
  const std::string before = path;
  ::setenv("PATH", (std::string(folder_ / "") + ":" + before).c_str(), 1);
  const Ran ran = fuzz("old_contort", "c", {}, "2");
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_EQ(fuzz("no_such_contort", "d", {}, "2").code, 2);
}

TEST_F(AgainstCommand, ListsWhatBrokeWithACommandForEach) {
  const Ran ran = fuzz(flawless(), "corpus");
  EXPECT_EQ(ran.code, 1) << ran.err;
  const std::vector<std::string> lines = lines_of(ran.out);
  ASSERT_GE(lines.size(), 3U);
  ASSERT_TRUE(lines.front().starts_with("BROKE  ")) << lines.front();
  EXPECT_NE(lines.front().find("new since the base; the base passes this case"), std::string::npos);
  const std::size_t at = lines.front().find("contort ");
  ASSERT_NE(at, std::string::npos);
  const std::string rest = lines.front().substr(lines.front().find(folder_ / "corpus"));
  const std::string path = rest.substr(0, rest.find(' '));
  const Result<Case> stored = read_case(path);
  ASSERT_TRUE(stored) << path;
  EXPECT_TRUE(stored->provenance.base.starts_with("0.0.7 ")) << stored->provenance.base;
  EXPECT_EQ(stored->provenance.base_shows, "passes_check");
}

TEST_F(AgainstCommand, WritesTheSameAsJson) {
  const Ran ran = fuzz(flawless(), "corpus", {"--json"});
  EXPECT_EQ(ran.code, 1);
  const auto out = nlohmann::json::parse(ran.out);
  const auto& against = out.at("against");
  EXPECT_TRUE(against.at("base").get<std::string>().starts_with("0.0.7 "));
  EXPECT_GT(against.at("broke").get<int>(), 0);
  EXPECT_EQ(against.at("refused"), 0);
  ASSERT_FALSE(against.at("rows").empty());
  double last = std::numeric_limits<double>::infinity();
  for (const auto& row : against.at("rows")) {
    EXPECT_EQ(row.at("change"), "broke");
    const double depth = row.at("depth").is_null() ? last : row.at("depth").get<double>();
    EXPECT_LE(depth, last) << "the deepest come first";
    last = depth;
    EXPECT_TRUE(std::filesystem::exists(row.at("case").get<std::string>()));
  }
}

TEST_F(AgainstCommand, LetsMotionsGateOnlyWhenAsked) {
  const Ran quiet = fuzz(flawless(), "one", {"--tolerance", "1000000"}, "5");
  EXPECT_NE(last_line(quiet.out).find(" moved=5 "), std::string::npos) << quiet.out;
  const auto only_moved = [](const Ran& ran) { return ran.out.find(" broke=0 worse=0") != std::string::npos; };
  EXPECT_TRUE(only_moved(quiet)) << quiet.out;
  EXPECT_EQ(quiet.code, 0) << quiet.out;
  EXPECT_EQ(fuzz(flawless(), "two", {"--tolerance", "1000000", "--moved"}, "5").code, 1);
}

TEST_F(AgainstCommand, RefusesABaseThatDoesNotKnowTheProtocol) {
  const Ran old = fuzz(script("old", "echo 'contort: usage: there is no command \"measure\"' >&2; exit 2\n"), "corpus");
  EXPECT_EQ(old.code, 2);
  EXPECT_NE(old.err.find("against.no_protocol"), std::string::npos) << old.err;
  EXPECT_EQ(fuzz(folder_ / "nothing", "corpus").code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "corpus")) << "nothing was begun";
}

TEST_F(AgainstCommand, GoesOnAfterABaseThatCrashesAndSaysThatNothingWasCompared) {
  const Ran ran =
      fuzz(script("fragile", "echo '" + print_line(own_hello("0.0.7")) + "'\nread -r line\nkill -SEGV $$\n"), "corpus",
           {}, "3");
  EXPECT_EQ(ran.code, 4) << ran.err;
  EXPECT_NE(ran.out.find("refused=3"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("SIGSEGV"), std::string::npos) << "with the reason of the first";
}

TEST_F(AgainstCommand, KeepsTheCorporaOfPairsApart) {
  EXPECT_EQ(fuzz(flawless(), "pair").code, 1);
  const Ran other = fuzz(kProgram, "pair");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("against.other_corpus"), std::string::npos) << other.err;
  EXPECT_EQ(fuzz("", "pair").code, 2) << "a run without a base";
  EXPECT_EQ(fuzz(flawless(), "pair").code, 1) << "the same pair again";
  EXPECT_EQ(fuzz("", "plain").code, 1);
  EXPECT_EQ(fuzz(kProgram, "plain").code, 2);
}

TEST_F(AgainstCommand, MergesOnlyTheCorporaOfOnePair) {
  const auto merge = [&](const std::vector<std::string>& corpora, const std::string& into) {
    std::vector<std::string> arguments = {"merge", "-o", folder_ / into};
    for (const std::string& corpus : corpora) arguments.push_back(folder_ / corpus);
    return contort_program(arguments);
  };
  fuzz(kProgram, "equal", {}, "2"), fuzz(kProgram, "equal_too", {}, "2");
  fuzz(flawless(), "other", {}, "2"), fuzz("", "plain", {}, "2");
  EXPECT_EQ(merge({"equal", "equal_too"}, "good").code, 0);
  for (const char* other : {"other", "plain"}) {
    const Ran refused = merge({"equal", other}, "bad");
    EXPECT_EQ(refused.code, 2) << other;
    EXPECT_NE(refused.err.find("against.other_corpus"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "bad")) << other;
    EXPECT_EQ(merge({other}, "good").code, 2) << "what is there already counts, too: " << other;
  }
}

TEST_F(AgainstCommand, MeasuresALineForEachLine) {
  const std::string spec = print_spec(bent_elbow(170));
  spill(folder_ / "requests", spec + "\nnonsense\n\n{\"id\":5,\"spec\":" + spec + ",\"check\":\"joint_range\"}");
  const std::string command =
      "'" + kProgram + "' measure < '" + (folder_ / "requests") + "' > '" + (folder_ / "out") + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::vector<std::string> lines = lines_of(slurp(folder_ / "out"));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_TRUE(parse_hello(lines[0]));
  EXPECT_FALSE(parse_measurement(lines[1])->findings.empty());
  EXPECT_EQ(parse_measurement(lines[2])->refusal->code, "json.syntax");
  EXPECT_EQ(parse_measurement(lines[3])->refusal->code, "json.syntax");
  EXPECT_EQ(parse_measurement(lines[4])->id, 5);
  EXPECT_EQ(parse_measurement(lines[4])->motion_hash, parse_measurement(lines[1])->motion_hash);
}

}  // namespace
}  // namespace contort
