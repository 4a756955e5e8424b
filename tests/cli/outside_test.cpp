// Commands on untrusted folders: files outside are not printed, changed or removed, a message describes the fault, and
// everything else is processed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corpus/lifecycle.h"
#include "tests/cli/program.h"
#include "tests/cli/small_library.h"
#include "tests/corpus/sample_corpus.h"
#include "tests/mocap/asf_text.h"

namespace contort {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr char kSecret[] = "hunter2-of-somebody-else";

bool it_says(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

class StrangersFolder : public testing::Test {
 protected:
  StrangersFolder() {
    fs::create_directories(folder_ / "elsewhere");
    spill(folder_ / "elsewhere/secret.json", kSecret);
    spill(folder_ / "secret.json", kSecret);
  }
  // Runs the command, and checks that everything outside is unchanged.
  Ran run(const std::vector<std::string>& arguments, int code) {
    const Tree before = outside();
    Ran ran = contort_program(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    EXPECT_EQ(ran.code, code) << line << ran.out << ran.err;
    EXPECT_FALSE(it_says(ran.out + ran.err, kSecret)) << line << ran.out << ran.err;
    EXPECT_EQ(first_difference(before, outside()), "") << line;
    return ran;
  }
  Tree outside() const {
    Tree tree = tree_of(folder_.path());
    std::erase_if(
        tree, [](const auto& file) { return !file.first.starts_with("elsewhere/") && file.first != "secret.json"; });
    return tree;
  }
  TempFolder folder_;
};

class StrangersCorpusFolder : public StrangersFolder {
 protected:
  StrangersCorpusFolder() : corpus_(create(folder_)) {
    const Case left = failing_case(bent_elbow(190), "joint_range", kElbow);
    EXPECT_TRUE(corpus_.add({left, left, "seed_1"}));
    hostile_ = only_bucket(corpus_);
    Spec spec = bent_elbow(190);
    spec.sequences[0].clips[0].actions[0].slot = "arm_right";
    const Case right = failing_case(spec, "joint_range", "arm_right/elbow max");
    EXPECT_TRUE(corpus_.add({right, right, "seed_1"}));
    honest_ = bucket_of(right);
  }
  void say(const std::string& field, const std::string& text) {
    Json json = Json::parse(print_bucket(hostile_));
    json[field] = text, json["state"] = "fixed";
    spill(corpus_.folder_of(hostile_) + "/bucket.json", json.dump());
  }
  void link(const std::string& file) {
    fs::remove(corpus_.folder_of(hostile_) + "/" + file);
    fs::create_symlink("../../../elsewhere/secret.json", corpus_.folder_of(hostile_) + "/" + file);
  }
  // All permitted operations on a corpus in which one bucket cannot be trusted.
  void expect_only_the_honest_one_is_served(const std::string& told) {
    const std::string corpus = corpus_.folder();
    const auto expect_told = [&](const Ran& ran) {
      EXPECT_TRUE(it_says(ran.err, told)) << ran.err;
      return ran;
    };
    expect_told(run({"corpus", "prune", corpus}, 2));
    expect_told(run({"corpus", "rekey", corpus}, 2));
    expect_told(run({"corpus", "migrate", corpus}, 2));
    EXPECT_TRUE(it_says(expect_told(run({"corpus", "list", corpus}, 2)).out, honest_.id));
    EXPECT_TRUE(it_says(expect_told(run({"corpus", "show", corpus, honest_.id}, 2)).out, honest_.id));
    EXPECT_TRUE(it_says(expect_told(run({"replay", corpus}, 2)).out, honest_.id));
    EXPECT_TRUE(it_says(expect_told(run({"replay", corpus, "--update", "--build", "b"}, 2)).out, honest_.id));
    expect_told(run({"corpus", "ack", corpus, honest_.id, "--owner", "ana", "--ticket", "1"}, 2));
    EXPECT_EQ(read_own_bucket(corpus_.folder_of(honest_))->state, BucketState::open);
    expect_told(run({"--gl", "none", "report", corpus, "-o", folder_ / "out"}, 2));
    EXPECT_TRUE(it_says(slurp(folder_ / "out/index.html"), honest_.id));
    expect_told(run({"merge", corpus, "-o", folder_ / "into"}, 2));
    EXPECT_TRUE(fs::exists(folder_ / ("into/buckets/" + folder_name(honest_) + "/bucket.json")));
    expect_told(run({"replay", honest_case(), "--baseline", corpus}, 2));
    EXPECT_TRUE(it_says(run({"corpus", "fsck", corpus}, 1).out, "--repair mends them"));
    run({"corpus", "fsck", corpus, "--repair"}, 0);
    run({"corpus", "fsck", corpus}, 0);
    EXPECT_TRUE(it_says(run({"corpus", "list", corpus}, 0).out, hostile_.id));
  }
  std::string honest_case() const {
    return corpus_.folder_of(honest_) + "/" + read_own_bucket(corpus_.folder_of(honest_))->min;
  }

  Corpus corpus_;
  Bucket hostile_, honest_;
};

TEST_F(StrangersCorpusFolder, ANameOfAFileOutsideIsToldAndTheOtherBucketIsServed) {
  say("orig", "../../../secret.json");
  expect_only_the_honest_one_is_served("/orig");
}

TEST_F(StrangersCorpusFolder, AnIdThatIsAPathIsToldAndTheOtherBucketIsServed) {
  say("id", "x/../../../../elsewhere");
  expect_only_the_honest_one_is_served("/id");
}

TEST_F(StrangersCorpusFolder, ACaseThatIsALinkIsToldAndTheOtherBucketIsServed) {
  link(hostile_.worst);
  expect_only_the_honest_one_is_served(hostile_.worst);
}

TEST_F(StrangersCorpusFolder, ABucketFileThatIsALinkIsToldAndTheOtherBucketIsServed) {
  link("bucket.json");
  expect_only_the_honest_one_is_served("bucket.json");
}

// ---- folders of reports

TEST_F(StrangersCorpusFolder, AReportIsNotWrittenIntoAFolderThatIsALink) {
  for (const char* own : {"strips", "cases", "rows", "viewer"}) {
    const std::string out = folder_ / ("out_" + std::string(own));
    fs::create_directories(out);
    spill(folder_ / "elsewhere/part-1.js", "contortRows([]);");  // looks like a file of an old report
    spill(folder_ / "elsewhere/joint_range-0123456789ab.js", kSecret);
    fs::create_directory_symlink(folder_ / "elsewhere", out + "/" + own);
    spill(out + "/report.json", R"({"format":"contort.report/1"})");
    const Ran ran = run({"--gl", "none", "report", corpus_.folder(), "-o", out}, 2);
    EXPECT_TRUE(it_says(ran.err, "file.outside") && it_says(ran.err, own)) << ran.err;
  }
}

// ---- folders of libraries and animations

class StrangersLibrary : public StrangersFolder {
 protected:
  StrangersLibrary() { fs::create_directories(library()); }
  std::string library() const { return folder_ / "library"; }
  void link(const std::string& to, const std::string& name) {
    fs::create_symlink(folder_ / to, library() + "/" + name);
  }
};

TEST_F(StrangersLibrary, AFileThatIsALinkToElsewhereIsNotRead) {
  for (const char* name : {"part.json", "clip.bvh", "clip.gltf"}) {
    link("elsewhere/secret.json", name);
    const Ran ran = run({"--library", library(), "list", "parts"}, 2);
    EXPECT_TRUE(it_says(ran.err, "file.outside") && it_says(ran.err, name)) << ran.err;
    fs::remove(library() + "/" + name);
  }
}

TEST_F(StrangersLibrary, TablesAreNeitherReadNorRemovedThroughALink) {
  spill(folder_ / "elsewhere/0123456789abcdef.aim", "of another library");
  link("elsewhere", "aim");
  EXPECT_TRUE(it_says(run({"tables", library()}, 2).err, "file.outside"));
  EXPECT_TRUE(it_says(run({"--library", library(), "list", "parts"}, 2).err, "file.outside"));
}

TEST_F(StrangersLibrary, AMapThatIsALinkIsNotRead) {
  fs::create_directories(library() + "/maps");
  link("elsewhere/secret.json", "maps/human.json");
  spill(folder_ / "take.asf", small_asf());
  spill(folder_ / "take.amc", small_amc());
  const Ran ran = run({"--library", library(), "check", folder_ / "take.amc", "--character", "human"}, 2);
  EXPECT_TRUE(it_says(ran.err, "file.outside")) << ran.err;
}

TEST_F(StrangersLibrary, TheSkeletonBesideATakeIsNotReadThroughALink) {
  spill(library() + "/take.amc", small_amc());
  link("elsewhere/secret.json", "take.asf");
  EXPECT_TRUE(it_says(run({"check", library() + "/take.amc"}, 2).err, "file.outside"));
}

TEST_F(StrangersLibrary, SeedsAreNotReadThroughALink) {
  link("elsewhere/secret.json", "seed.json");
  const Ran ran = run({"fuzz", "--seeds", library(), "--cases", "1", "--corpus", folder_ / "corpus"}, 2);
  EXPECT_TRUE(it_says(ran.err, "file.outside")) << ran.err;
}

}  // namespace

}  // namespace contort
