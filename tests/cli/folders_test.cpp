// Output folders that contain something else, and folders that cannot be read completely.
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/cli/small_library.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

class Folders : public testing::Test {
 protected:
  Folders() {
    fs::create_directories(sources());
    spill(sources() + "/corpus.cpp", "int main() {}");
  }
  std::string sources() const { return folder_ / "sources"; }
  std::string stored_corpus() {
    const Corpus corpus = create(folder_);
    const Case stored = failing_case(bent_elbow(190), "joint_range", kElbow);
    EXPECT_TRUE(corpus.add({stored, stored, "seed_1"}).ok());
    return corpus.folder();
  }
  void expect_refused(const std::vector<std::string>& call) {
    const Ran ran = contort_program(call);
    EXPECT_EQ(ran.code, 2) << call.front() << ran.err;
    EXPECT_NE(ran.err.find("folder.other_files: " + sources()), std::string::npos) << call.front() << ran.err;
    EXPECT_NE(ran.err.find("corpus.cpp"), std::string::npos) << ran.err;
    EXPECT_EQ(tree_of(sources()).size(), 1U) << call.front();
    EXPECT_EQ(std::distance(fs::directory_iterator(sources()), {}), 1) << call.front();
  }
  TempFolder folder_;
};

TEST_F(Folders, NothingIsMixedIntoOtherPeoplesFiles) {
  const std::string corpus = stored_corpus();
  expect_refused({"fuzz", "--cases", "0", "--corpus", sources()});
  expect_refused({"fuzz", "--cases", "0", "--corpus", folder_ / "new", "--report", sources()});
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  expect_refused({"merge", corpus, "-o", sources()});
  expect_refused({"--gl", "none", "report", corpus, "-o", sources()});
  expect_refused({"tables", sources()});
}

TEST_F(Folders, NewEmptyAndOwnOnesAreFilled) {
  const std::string corpus = stored_corpus();
  fs::create_directories(folder_ / "empty");
  for (const std::string name : {"new", "empty", "new"})
    EXPECT_EQ(contort_program({"merge", corpus, "-o", folder_ / name}).code, 0) << name;
  fs::create_directories(folder_ / "empty_report");
  for (const std::string name : {"report", "empty_report", "report"})
    EXPECT_EQ(contort_program({"--gl", "none", "report", corpus, "-o", folder_ / name}).code, 0) << name;
  spill(folder_ / "report/notes.txt", "mine");
  EXPECT_EQ(contort_program({"--gl", "none", "report", corpus, "-o", folder_ / "report"}).code, 0);
  EXPECT_EQ(slurp(folder_ / "report/notes.txt"), "mine");
}

TEST_F(Folders, ASheetWithoutAllItsTilesIsNoSuccess) {
  spill(folder_ / "good.json", pretty_spec(bent_elbow(190)));
  spill(folder_ / "bad.json", "{");
  std::vector<std::string> call = {"render", folder_ / "good.json", folder_ / "bad.json", "--sheet",
                                   "-o",     folder_ / "sheet.png"};
  const Ran ran = contort_program(call);
  EXPECT_EQ(ran.code, 2) << ran.err;
  EXPECT_NE(ran.err.find("bad.json"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("not on the sheet: 1 of 2"), std::string::npos) << ran.err;
  call.push_back("--allow-unreadable");
  EXPECT_EQ(contort_program(call).code, 0);
  EXPECT_TRUE(slurp(folder_ / "sheet.png").starts_with("\x89PNG"));
}

}  // namespace

}  // namespace contort
