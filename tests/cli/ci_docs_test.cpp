// docs/ci and docs/scale: files that people copy must parse, and each command in them must exist with all of its
// options.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "tests/cli/program.h"

namespace contort {

namespace {

const std::string kDocs = std::string(CONTORT_SOURCE_DIR) + "/docs";
const std::string kFolder = kDocs + "/ci";

// The files of both folders, by their paths below docs.
Tree files() {
  Tree all;
  for (const std::string folder : {"ci", "scale"})
    for (const auto& [name, text] : tree_of(kDocs + "/" + folder)) all[folder + "/" + name] = text;
  return all;
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"), pclose);
  std::string output;
  char block[4096];
  for (std::size_t n = 0; pipe != nullptr && (n = fread(block, 1, sizeof block, pipe.get())) > 0;)
    output.append(block, n);
  return output;
}

// The words of each call of contort in a text, up to the end of the command. In folded YAML and after a backslash, the
// next line belongs to the command.
std::vector<std::vector<std::string>> calls_in(const std::string& text) {
  static const std::set<std::string> kEnds = {"||", "&&", "|", ";", "\\", "-", "#", ">", "[", "git"};
  std::vector<std::vector<std::string>> calls;
  std::istringstream words(text);
  bool inside = false;
  for (std::string word; words >> word;) {
    if (word == "contort") {
      calls.emplace_back();
      inside = true;
    } else if (kEnds.contains(word)) {
      inside = word == "\\" && inside;
    } else if (inside) {
      calls.back().push_back(word);
    }
  }
  return calls;
}

std::string without_comments(const std::string& text) {
  std::string out;
  for (const std::string& line : lines_of(text))
    if (line.find_first_not_of(' ') != line.find('#')) out += line + "\n";
  return out;
}

// The command's own words: "corpus prune", "replay".
std::vector<std::string> command_of(const std::vector<std::string>& call) {
  if (call.empty()) return {};
  return call.front() == "corpus" && call.size() > 1 ? std::vector<std::string>{call[0], call[1]}
                                                     : std::vector<std::string>{call[0]};
}

TEST(CiFiles, CommandsExistWithTheirOptions) {
  int calls = 0, options = 0;
  for (const auto& [name, text] : files())
    for (const std::vector<std::string>& call : calls_in(without_comments(text))) {
      std::vector<std::string> arguments = command_of(call);
      arguments.push_back("--help");
      const Ran help = contort_program(arguments);
      ASSERT_EQ(help.code, 0) << name << ": contort " << call.front();
      ++calls;
      for (const std::string& word : call) {
        if (!word.starts_with("-")) continue;
        ++options;
        EXPECT_NE(help.out.find(word), std::string::npos) << name << ": contort " << call.front() << " " << word;
      }
    }
  EXPECT_GE(calls, 24);
  EXPECT_GE(options, 40);
}

// The words of the call of this command that has the option; empty where no call has.
std::vector<std::string> call_with(const std::string& text, const std::string& command, const std::string& option) {
  for (const std::vector<std::string>& call : calls_in(without_comments(text)))
    if (!call.empty() && call.front() == command && std::ranges::find(call, option) != call.end()) return call;
  return {};
}

TEST(CiFiles, ChangesAreComparedWithTheBuildOfTheirBase) {
  for (const char* name : {"/github.yml", "/gitlab.yml"}) {
    const std::string text = slurp(kFolder + name);
    const std::vector<std::string> fuzz = call_with(text, "fuzz", "--against");
    const auto against = std::ranges::find(fuzz, "--against"), corpus = std::ranges::find(fuzz, "--corpus");
    ASSERT_TRUE(against != fuzz.end() && corpus != fuzz.end()) << name;
    ASSERT_TRUE(against + 1 != fuzz.end() && corpus + 1 != fuzz.end()) << name;
    EXPECT_EQ(*(against + 1), "base/build/release/contort") << "which " << name << " builds with:";
    EXPECT_LT(text.find("base/run version"), text.find("--against")) << name;
    const std::vector<std::string> report = call_with(text, "report", "--gate");
    ASSERT_GE(report.size(), 2U) << name;
    EXPECT_EQ(report[1], *(corpus + 1)) << "what was found gates: " << name;
    EXPECT_EQ(std::ranges::find(report, "--baseline"), report.end()) << "every failure there is new: " << name;
  }
}

TEST(CiFiles, CallsAreFoundInYamlAndInScripts) {
  const std::string text =
      "      - run: >-\n          contort report x --gate\n          --github\n      - uses: y\nfound contort replay "
      "\"$c\" "
      "--update || [ $? -eq 1 ]\n";
  const std::vector<std::vector<std::string>> expected = {{"report", "x", "--gate", "--github"},
                                                          {"replay", "\"$c\"", "--update"}};
  EXPECT_EQ(calls_in(text), expected);
}

TEST(CiFiles, YamlParses) {
  static const std::map<std::string, std::string> kKeys = {
      {"ci/gitlab.yml", "contort:night"}, {"ci/gitlab_package.yml", "contort:judge"}, {"ci/action.yml", "runs"}};
  if (output_of("python3 -c 'import yaml' && echo there") != "there\n") GTEST_SKIP() << "no python3 with yaml";
  int count = 0;
  for (const auto& [name, text] : files()) {
    if (!name.ends_with(".yml")) continue;
    ++count;
    const std::string keys = output_of("python3 -c 'import sys, yaml; print(*yaml.safe_load(open(sys.argv[1])))' '" +
                                       kDocs + "/" + name + "'");
    const auto expected = kKeys.find(name);
    EXPECT_NE(keys.find(expected == kKeys.end() ? "jobs" : expected->second), std::string::npos) << name << keys;
  }
  EXPECT_EQ(count, 5);
}

// A fake contort that only returns a given exit code for each command.
class NightScript : public testing::Test {
 protected:
  NightScript() {
    spill(folder_ / "contort",
          "#!/bin/sh\necho $1 >> '" + (folder_ / "calls") +
              "'\ncase $1 in fuzz) exit $FUZZ ;; replay) exit $REPLAY ;; report) exit $REPORT ;; esac\n");
    std::filesystem::permissions(folder_ / "contort", std::filesystem::perms::owner_all);
  }

  // "4: fuzz replay corpus explain report"
  std::string night(int fuzz, int replay, int report) {
    std::filesystem::remove(folder_ / "calls");
    const std::string codes =
        "FUZZ=" + std::to_string(fuzz) + " REPLAY=" + std::to_string(replay) + " REPORT=" + std::to_string(report);
    const int status = std::system(("PATH='" + folder_.path() + "':$PATH " + codes + " bash '" + kFolder +
                                    "/night.sh' '" + (folder_ / "night") + "' 2>/dev/null")
                                       .c_str());
    std::string said = std::to_string(WEXITSTATUS(status)) + ":";
    for (const std::string& call : lines_of(slurp(folder_ / "calls"))) said += " " + call;
    return said;
  }

  TempFolder folder_;
};

TEST_F(NightScript, ReportsWhateverItsPartsSay) {
  EXPECT_EQ(night(0, 0, 0), "0: fuzz replay corpus explain report");
  EXPECT_EQ(night(1, 1, 0), "0: fuzz replay corpus explain report") << "the report says what gates";
  EXPECT_EQ(night(1, 1, 1), "1: fuzz replay corpus explain report");
  EXPECT_EQ(night(4, 0, 0), "4: fuzz replay corpus explain report") << "something was not the same twice";
  EXPECT_EQ(night(1, 2, 0), "2: fuzz replay corpus explain report") << "something does not build any more";
  EXPECT_EQ(night(4, 0, 1), "1: fuzz replay corpus explain report");
}

TEST_F(NightScript, EndsWhereItCannotGoOn) {
  EXPECT_EQ(night(3, 0, 0), "3: fuzz");
  EXPECT_EQ(night(75, 0, 0), "75: fuzz");
  EXPECT_EQ(night(1, 3, 0), "3: fuzz replay");
}

TEST(CiFiles, TheCrontabHasTimesAndOneLineForTheNight) {
  int jobs = 0;
  for (const std::string& line : lines_of(slurp(kFolder + "/crontab"))) {
    if (line.starts_with("#") || line.find("* * *") == std::string::npos) continue;
    ++jobs;
    EXPECT_NE(line.find("night.sh"), std::string::npos) << line;
    EXPECT_EQ(line.find('%'), std::string::npos) << "cron ends a command at a percent sign: " << line;
  }
  EXPECT_EQ(jobs, 1);
}

}  // namespace

}  // namespace contort
