// contort corpus, replay and report on a stored corpus: states, gates, baselines, and files that cannot be written.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "corpus/lifecycle.h"
#include "model/core/files.h"
#include "tests/cli/program.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {
namespace {

using Json = nlohmann::json;

bool says(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

// A corpus of two real failures: the left elbow and the right one.
class StoredCorpus : public testing::Test {
 protected:
  StoredCorpus() : corpus_(create(folder_)) {
    add(kElbow, bent_elbow(190));
    Spec right = bent_elbow(190);
    right.sequences[0].clips[0].actions[0].slot = "arm_right";
    add("arm_right/elbow max", right);
  }
  void add(const std::string& subject, const Spec& spec) {
    const Case stored = failing_case(spec, "joint_range", subject);
    EXPECT_TRUE(corpus_.add({stored, stored, "seed_1"}));
  }
  // Settings under which these cases are no failures, as if they were fixed.
  std::string fixed_settings() {
    const std::string path = folder_ / "fixed.json";
    std::string limits;
    for (const char* check : {"joint_range", "self_collision", "angular_velocity", "angular_acceleration", "pop"})
      limits += std::string(limits.empty() ? "" : ", ") + R"({"check": ")" + check +
                R"(", "use": "ignore", "reason": "as if it was fixed"})";
    spill(path, R"({"format": "contort.settings/1", "limits": [)" + limits + "]}");
    return path;
  }
  Ran run(std::vector<std::string> arguments, const std::string& today = "2027-02-10") {
    arguments.insert(arguments.end(), {"--today", today});
    return contort_program(arguments);
  }
  Ran corpus(const std::string& command, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"corpus", command, corpus_.folder()});
    return run(more);
  }
  std::vector<Bucket> buckets() {
    std::vector<Issue> damaged;
    const std::vector<Bucket> all = corpus_.buckets(damaged);
    EXPECT_TRUE(damaged.empty());
    return all;
  }
  Bucket left() {
    for (const Bucket& bucket : buckets())
      if (says(bucket.family.subject, kElbow)) return bucket;
    ADD_FAILURE() << "the left elbow is gone";
    return {};
  }
  std::string right_id() { return buckets()[buckets()[0].id == left().id ? 1 : 0].id; }
  void expect_unchanged(const Tree& before) { EXPECT_EQ(first_difference(before, tree_of(corpus_.folder())), ""); }

  TempFolder folder_;
  Corpus corpus_;
};

// ---- contort corpus

TEST_F(StoredCorpus, EveryCommandHasHelpWithAnExample) {
  for (const std::string command : {"list", "show", "ack", "quarantine", "note", "fsck", "rekey", "prune", "migrate"}) {
    const Ran help = contort_program({"corpus", command, "--help"});
    EXPECT_EQ(help.code, 0) << command;
    EXPECT_TRUE(says(help.out, "Example: contort corpus " + command + " ")) << help.out;
  }
  EXPECT_EQ(contort_program({"corpus"}).code, 2);
}

TEST_F(StoredCorpus, ListShowsWhatIsAskedFor) {
  ASSERT_EQ(corpus("ack", {left().id, "--owner", "ana", "--ticket", "12"}).code, 0);
  const auto shown = [&](const std::vector<std::string>& filters) { return last_line(corpus("list", filters).out); };
  const char* both = "2 failures of 1 cause, 1 fails the build";
  EXPECT_EQ(shown({}), both);
  EXPECT_EQ(shown({"--state", "open"}), "1 failure of 1 cause, 0 fail the build");
  EXPECT_EQ(shown({"--state", "open", "--state", "new"}), both);
  EXPECT_EQ(shown({"--state", "fixed"}), "0 failures of 0 causes, 0 fail the build");
  EXPECT_EQ(shown({"--check", "joint_range", "--character", "human"}), both);
  EXPECT_EQ(shown({"--check", "pop"}), "0 failures of 0 causes, 0 fail the build");
  EXPECT_EQ(shown({"--character", "mech"}), "0 failures of 0 causes, 0 fail the build");
  EXPECT_EQ(corpus("list", {"--state", "odd"}).code, 2);
  const Json list = Json::parse(corpus("list", {"--json"}).out, nullptr, false);
  ASSERT_EQ(list.size(), 2U);
  for (const Json& entry : list) EXPECT_EQ(entry["gating"], entry["id"] != left().id);
}

TEST_F(StoredCorpus, ListNamesTheCauseOfEachFailure) {
  const std::string text = corpus("list").out;
  const std::string cause = Json::parse(corpus("list", {"--json"}).out).at(0).at("cause").get<std::string>();
  EXPECT_TRUE(text.starts_with("1. ") && says(text, "elbow leave their range") && says(text, "\n    cause " + cause + "\n"));
  EXPECT_TRUE(says(text, left().id + "  joint_range of " + kElbow + ", human, fails the build\n")) << text;
  EXPECT_TRUE(says(corpus("show", {left().id}).out, cause + ": "));
}

TEST_F(StoredCorpus, ListTellsFixedFailuresAndUnreadableOnesApart) {
  const Bucket unread = left(), right = buckets()[buckets()[0].id == unread.id ? 1 : 0];
  spill(corpus_.folder_of(unread) + "/" + unread.min, "not a case");
  ASSERT_TRUE(corpus_.change(right, [](Bucket old) { return old.state = BucketState::fixed, Result(old); }));
  const std::string text = corpus("list").out;
  EXPECT_TRUE(says(text, "Failures whose smallest case cannot be read:\n    new ")) << text;
  EXPECT_TRUE(says(text, "Fixed failures:\n    fixed        " + right.id)) << text;
  EXPECT_EQ(last_line(text), "1 failure of 0 causes, 1 fails the build; 1 other is fixed");
}

TEST_F(StoredCorpus, SidesCanBeFolded) {
  const Ran folded = corpus("list", {"--fold-sides"});
  const std::vector<std::string> lines = lines_of(folded.out);
  ASSERT_EQ(lines.size(), 4U) << folded.out;
  const std::string first = buckets()[0].id, second = buckets()[1].id;
  EXPECT_TRUE(says(lines[2], "new          " + first)) << lines[2];
  EXPECT_TRUE(lines[2].ends_with("  other side: " + second + ", fails the build")) << lines[2];
  EXPECT_EQ(lines[3], "2 failures of 1 cause, 2 fail the build");
  EXPECT_EQ(lines_of(corpus("list").out).size(), 5U);
  EXPECT_EQ(corpus("list", {"--fold-sides", "--json"}).code, 2);
}

TEST_F(StoredCorpus, ABucketIsNamedByTheBeginningOfItsId) {
  const Ran shown = corpus("show", {left().id.substr(0, 6)});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_TRUE(says(shown.out, print_family(left().family)) && says(shown.out, "contort replay ")) << shown.out;
  const Ran many = corpus("show", {"joint_range-"});
  EXPECT_EQ(many.code, 2);
  EXPECT_TRUE(says(many.err, "corpus.many_buckets") && says(many.err, right_id())) << many.err;
  EXPECT_TRUE(says(corpus("show", {"zzz"}).err, "corpus.no_bucket"));
  EXPECT_EQ(corpus("show", {""}).code, 2);
}

TEST_F(StoredCorpus, AcknowledgingChangesAllOrNone) {
  const Tree before = tree_of(corpus_.folder());
  EXPECT_EQ(corpus("ack", {left().id, "zzz", "--owner", "ana", "--ticket", "12"}).code, 2);
  EXPECT_EQ(corpus("ack", {left().id, "--owner", "ana"}).code, 2);
  EXPECT_EQ(corpus("quarantine", {left().id, "--owner", "ana", "--reason", "r", "--expires", "2027-03-13"}).code, 2);
  EXPECT_EQ(corpus("ack", {left().id, "--owner", std::string(300, 'x'), "--ticket", "12"}).code, 2)
      << "nobody could read it";
  EXPECT_EQ(corpus("note", {left().id, "--text", std::string(5000, 'x')}).code, 2);
  expect_unchanged(before);
  EXPECT_EQ(corpus("ack", {left().id, right_id(), "--owner", "ana", "--ticket", "12"}).code, 0);
  for (const Bucket& bucket : buckets()) EXPECT_EQ(bucket.state, BucketState::open);
}

TEST_F(StoredCorpus, ANoteIsShownUntilItIsTakenAway) {
  ASSERT_EQ(corpus("note", {left().id, "--text", "only with a load"}).code, 0);
  EXPECT_TRUE(says(corpus("show", {left().id}).out, "only with a load"));
  EXPECT_EQ(left().changes, 1);
  ASSERT_EQ(corpus("note", {left().id, "--text", ""}).code, 0);
  EXPECT_EQ(left().note, "");
}

TEST_F(StoredCorpus, FsckTellsWithOneAndMendsWithZero) {
  EXPECT_EQ(corpus("fsck").code, 0);
  spill(corpus_.folder_of(left()) + "/notes.txt", "x");
  const Ran told = corpus("fsck");
  EXPECT_EQ(told.code, 1);
  EXPECT_TRUE(says(told.out, "unknown_file") && says(told.out, "notes.txt")) << told.out;
  const Json list = Json::parse(corpus("fsck", {"--json"}).out, nullptr, false);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["code"], "unknown_file");
  EXPECT_EQ(corpus("fsck", {"--repair"}).code, 0);
  EXPECT_EQ(last_line(corpus("fsck").out), "0 faults");
}

TEST_F(StoredCorpus, UpkeepOfAFreshCorpusChangesNothing) {
  const Tree before = tree_of(corpus_.folder());
  for (const std::string command : {"rekey", "prune", "migrate"}) {
    const Ran ran = corpus(command);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(last_line(ran.out), "0 changes") << command;
  }
  expect_unchanged(before);
}

TEST_F(StoredCorpus, BucketsNamedByOtherRulesAreToldUntilTheyAreRekeyed) {
  const Bucket old = left();
  std::string text = read_file(corpus_.folder_of(old) + "/bucket.json").value();
  const std::size_t at = text.find("\"signature\": 2");
  ASSERT_NE(at, std::string::npos) << text;
  text[at + 13] = '1';
  spill(corpus_.folder_of(old) + "/bucket.json", text);
  const std::vector<std::string> commands[] = {
      {"fuzz", "--cases", "0", "--corpus", corpus_.folder()},
      {"merge", corpus_.folder(), "-o", folder_ / "merged"},
  };
  for (const auto& command : commands) EXPECT_TRUE(says(run(command).err, "1 buckets are named by")) << command[0];
  EXPECT_EQ(last_line(corpus("rekey").out), "1 changes");
  EXPECT_EQ(run(commands[0]).err, "");
  EXPECT_EQ(left(), old);
}

TEST_F(StoredCorpus, AFolderWithoutACorpusIsRefused) {
  for (const std::string command : {"list", "fsck", "rekey", "prune", "migrate"}) {
    const Ran ran = contort_program({"corpus", command, folder_.path()});
    EXPECT_EQ(ran.code, 2) << command;
    EXPECT_TRUE(says(ran.err, "corpus.not_found")) << ran.err;
  }
}

// A file may not grow beyond 300 bytes: less than a bucket.json has, more than the message needs.
TEST_F(StoredCorpus, ADiskThatIsFullIsAnInternalErrorThatKeepsWhatWasThere) {
  const Tree before = tree_of(corpus_.folder());
  rlimit was{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &was), 0);
  rlimit small = was;
  small.rlim_cur = 300;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Program program({"corpus", "ack", corpus_.folder(), left().id, "--owner", "ana", "--ticket", "12"},
                        folder_.path());
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &was), 0);
  const Ran ran = program.wait();
  EXPECT_EQ(ran.code, 3) << ran.err;
  EXPECT_TRUE(says(ran.err, "file.unwritable") && says(ran.err, "File too large")) << ran.err;
  expect_unchanged(before);
}

// ---- contort replay

TEST_F(StoredCorpus, ReplayWithoutUpdateWritesNothing) {
  const Tree before = tree_of(corpus_.folder());
  const Ran failing = run({"replay", corpus_.folder()});
  EXPECT_EQ(failing.code, 1) << failing.out;
  EXPECT_TRUE(says(last_line(failing.out),
                   "RESULT cases=6 same=6 same_family=0 different=0 passes=0 refused=0 "
                   "buckets=2 gating=2 "))
      << failing.out;
  EXPECT_EQ(run({"replay", corpus_.folder(), "--settings", fixed_settings()}).code, 0);
  expect_unchanged(before);
}

TEST_F(StoredCorpus, ReplayOfACorpusThatCannotBeUpdatedSaysSoOnceAndTellsWhatItSaw) {
  const std::string lock = corpus_.folder() + "/.lock";  // a folder cannot be locked
  std::filesystem::remove(lock);
  std::filesystem::create_directory(lock);
  const TempFolder other;
  const Corpus writable = create(other);
  const Case stored = failing_case(bent_elbow(190), "joint_range", kElbow);
  ASSERT_TRUE(writable.add({stored, stored, "seed_1"}));
  const Tree before = tree_of(writable.folder());
  const Ran ran = run({"replay", corpus_.folder(), writable.folder(), "--update", "--settings", fixed_settings()});
  EXPECT_EQ(ran.code, 3);
  ASSERT_EQ(lines_of(ran.err).size(), 2U) << ran.err;
  EXPECT_TRUE(says(ran.err, "file.unwritable")) << ran.err;
  EXPECT_EQ(last_line(ran.err), "contort: 1 more failures could not be updated");
  EXPECT_TRUE(says(last_line(ran.out), "buckets=3 gating=0 ")) << ran.out;
  EXPECT_NE(first_difference(before, tree_of(writable.folder())), "") << "the other one is updated";
}

TEST_F(StoredCorpus, WhatPassesInTwoBuildsIsFixedAndRegressesWhenItFails) {
  const auto replay = [&](const std::string& build, bool fixed) {
    std::vector<std::string> call = {"replay", corpus_.folder(), "--update", "--build", build};
    if (fixed) call.insert(call.end(), {"--settings", fixed_settings()});
    return run(call);
  };
  EXPECT_EQ(replay("a", true).code, 0);
  EXPECT_EQ(replay("a", true).code, 0);
  EXPECT_EQ(left().state, BucketState::fresh) << "one build is not enough";
  EXPECT_TRUE(says(replay("b", true).out, "was new, now fixed"));
  const std::string version = last_line(contort_program({"version"}).out);
  EXPECT_EQ(left().passed_in, (std::vector<std::string>{version + " a", version + " b"}));
  EXPECT_TRUE(says(last_line(run({"replay", corpus_.folder(), "--settings", fixed_settings()}).out), "fixed=2"));
  const Ran failing = replay("c", false);
  EXPECT_EQ(failing.code, 1);
  EXPECT_TRUE(says(failing.out, "was fixed, now regressed, fails the build")) << failing.out;
  EXPECT_TRUE(says(last_line(failing.out), "regressed=2"));
  EXPECT_EQ(left().state, BucketState::regressed);
}

// A motion whose failure is gone may still fail in another way, and then a person must look at it.
TEST_F(StoredCorpus, WhatFailsInAnotherWayGatesUntilItIsFixed) {
  spill(folder_ / "other.json", R"({"format": "contort.settings/1", "limits": [{"check": "joint_range", "use": "ignore",
      "reason": "as if it was fixed"}, {"check": "angular_velocity", "tolerance": -100, "reason": "fails instead"}]})");
  const std::vector<std::string> call = {"replay",   corpus_.folder(), "--settings", folder_ / "other.json",
                                         "--update", "--build"};
  const auto replay = [&](const std::string& build) {
    std::vector<std::string> with_build = call;
    with_build.push_back(build);
    return run(with_build);
  };
  const Ran first = replay("a");
  EXPECT_EQ(first.code, 1) << first.out;
  EXPECT_TRUE(says(last_line(first.out), "different=6") && says(last_line(first.out), "gating=2")) << first.out;
  EXPECT_EQ(replay("b").code, 0);
  EXPECT_EQ(left().state, BucketState::fixed);
}

TEST_F(StoredCorpus, AKnownFailureDoesNotGate) {
  ASSERT_EQ(corpus("ack", {left().id, right_id(), "--owner", "ana", "--ticket", "12"}).code, 0);
  const Ran ran = run({"replay", corpus_.folder()});
  EXPECT_EQ(ran.code, 0) << ran.out;
  EXPECT_TRUE(says(last_line(ran.out), "same=6") && says(last_line(ran.out), "gating=0")) << ran.out;
}

TEST_F(StoredCorpus, AQuarantineRunsAlwaysAndGatesFromTheDayAfterItsLast) {
  ASSERT_EQ(corpus("ack", {right_id(), "--owner", "ana", "--ticket", "12"}).code, 0);
  ASSERT_EQ(corpus("quarantine", {left().id, "--owner", "ana", "--reason", "r", "--expires", "2027-03-01"}).code, 0);
  const Ran during = run({"replay", corpus_.folder(), "--time", "0.000001s"}, "2027-03-01");
  EXPECT_EQ(during.code, 0) << during.out;
  EXPECT_TRUE(says(last_line(during.out), "cases=3 same=3") && says(last_line(during.out), "skipped=1")) << during.out;
  const Ran after = run({"replay", corpus_.folder()}, "2027-03-02");
  EXPECT_EQ(after.code, 1) << after.out;
  EXPECT_TRUE(says(after.out, "the quarantine is over")) << after.out;
  const std::vector<std::string> report = {"report", corpus_.folder(), "--gate"};
  EXPECT_EQ(run(report, "2027-03-01").code, 0);
  EXPECT_EQ(run(report, "2027-03-02").code, 1);
}

TEST_F(StoredCorpus, ASpecThatNoLongerBuildsIsToldOnceAndComesBackAsItWas) {
  ASSERT_EQ(corpus("ack", {left().id, right_id(), "--owner", "ana", "--ticket", "12"}).code, 0);
  const Tree before = tree_of(corpus_.folder());
  for (const std::string& file : {left().min, left().worst, left().orig})
    if (std::string text = slurp(corpus_.folder_of(left()) + "/" + file); !text.empty()) {
      text.replace(text.find("\"pose\""), 6, "\"gone\"");
      spill(corpus_.folder_of(left()) + "/" + file, text);
    }
  const Ran first = run({"replay", corpus_.folder(), "--update"});
  EXPECT_EQ(first.code, 2) << first.out;
  EXPECT_TRUE(says(first.out, "was open, now invalid") && says(first.out, "gone")) << first.out;
  EXPECT_EQ(run({"replay", corpus_.folder(), "--update"}).code, 0) << "it is known now";
  for (const auto& [path, bytes] : before)
    if (!path.ends_with("bucket.json")) spill(corpus_.folder() + "/" + path, bytes);
  EXPECT_TRUE(says(run({"replay", corpus_.folder(), "--update"}).out, "was invalid, now open"));
}

TEST_F(StoredCorpus, ReplayOfACorpusPrintsJsonByBucket) {
  const Json list = Json::parse(run({"replay", corpus_.folder(), "--json"}).out, nullptr, false);
  ASSERT_EQ(list.size(), 2U);
  for (const Json& entry : list) {
    EXPECT_EQ(entry["verdict"], "same");
    EXPECT_EQ(entry["state"], "new");
    EXPECT_EQ(entry["gating"], true);
    EXPECT_EQ(entry["cases"].size(), 3U);
  }
}

TEST_F(StoredCorpus, ALevelIsForCaseFiles) {
  EXPECT_EQ(run({"replay", corpus_.folder(), "--level", "clip:1/1"}).code, 2);
  EXPECT_EQ(run({"replay", corpus_.folder_of(left()) + "/" + left().min, "--level", "clip:1/1"}).code, 1);
}

// ---- files for CI

TEST_F(StoredCorpus, ReportWritesWhatCiReads) {
  const Ran ran = run({"report", corpus_.folder(), "--junit", folder_ / "j.xml", "--sarif", folder_ / "s.sarif",
                       "--markdown", folder_ / "m.md", "--github"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(lines_of(ran.out).size(), 2U) << ran.out;
  for (const std::string& line : lines_of(ran.out)) EXPECT_TRUE(line.starts_with("::error file=buckets/")) << line;
  EXPECT_TRUE(says(slurp(folder_ / "j.xml"), "failures=\"2\""));
  EXPECT_EQ(Json::parse(slurp(folder_ / "s.sarif"), nullptr, false)["runs"][0]["results"].size(), 2U);
  EXPECT_TRUE(slurp(folder_ / "m.md").starts_with("## Contort report: 2 failures fail the build"));
  EXPECT_TRUE(says(slurp(folder_ / "m.md"), "Known: none. 0 cases"));
}

TEST_F(StoredCorpus, TheSummaryIsAppended) {
  spill(folder_ / "m.md", "# Earlier step\n");
  ASSERT_EQ(run({"report", corpus_.folder(), "--markdown", folder_ / "m.md"}).code, 0);
  EXPECT_TRUE(slurp(folder_ / "m.md").starts_with("# Earlier step\n## Contort report"));
}

TEST_F(StoredCorpus, WhatTheBaselineHasDoesNotGateAndIsStillWritten) {
  const Ran listed = corpus("list", {"--check", "joint_range", "--json"});
  Json list = Json::parse(listed.out, nullptr, false);
  const std::vector<std::string> call = {"report",     corpus_.folder(),     "--gate", "--junit", folder_ / "j.xml",
                                         "--baseline", folder_ / "base.json"};
  spill(folder_ / "base.json", list.dump());
  EXPECT_EQ(run(call).code, 0);
  EXPECT_TRUE(says(slurp(folder_ / "j.xml"), "tests=\"2\" failures=\"0\""));
  EXPECT_EQ(run({"replay", corpus_.folder(), "--baseline", folder_ / "base.json"}).code, 0);
  EXPECT_EQ(run({"replay", corpus_.folder(), "--baseline", corpus_.folder()}).code, 0);
  list.erase(0);
  spill(folder_ / "base.json", list.dump());
  EXPECT_EQ(run(call).code, 1);
  EXPECT_TRUE(says(slurp(folder_ / "j.xml"), "tests=\"2\" failures=\"1\""));
  EXPECT_EQ(run({"replay", corpus_.folder(), "--baseline", folder_ / "base.json"}).code, 1);
}

TEST_F(StoredCorpus, CiGetsItsFilesEvenWhereThePageCannotBeWritten) {
  spill(folder_ / "file", "x");
  const Ran ran = run({"report", corpus_.folder(), "-o", folder_ / "file/report", "--junit", folder_ / "j.xml"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_TRUE(says(slurp(folder_ / "j.xml"), "failures=\"2\""));
  EXPECT_EQ(run({"report", corpus_.folder(), "--sarif", folder_ / "file/s.sarif"}).code, 3);
}

TEST_F(StoredCorpus, AReportOfNothingIsRefused) {
  EXPECT_EQ(run({"report", corpus_.folder()}).code, 2);
  EXPECT_EQ(run({"report", corpus_.folder(), "--gate", "--baseline", folder_ / "missing"}).code, 2);
}

}  // namespace

}  // namespace contort
