// Pictures from the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

const std::string kRoot = CONTORT_SOURCE_DIR;
const std::string kSquat = kRoot + "/docs/experiments/squat/";

class Render : public testing::Test {
 protected:
  // Returns "" if the strip was drawn, otherwise the line with the reason.
  std::string refusal(std::vector<std::string> arguments) {
    std::filesystem::remove(picture());
    arguments.insert(arguments.begin(), {"--library", kSquat + "actions", "render"});
    arguments.insert(arguments.end(), {"-o", picture()});
    const Ran ran = contort_program(arguments);
    EXPECT_EQ(ran.code == 0, std::filesystem::exists(picture()));
    EXPECT_TRUE(ran.code == 0 || ran.code == 2) << ran.code;
    EXPECT_EQ(lines_of(ran.err).size(), ran.code == 0 ? 0U : 1U) << ran.err;
    return ran.err;
  }
  std::string picture() const { return folder_ / "picture.png"; }

  // Width and height, from the header.
  std::pair<int, int> size() const {
    const std::string bytes = slurp(picture());
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t i = at; i < at + 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes.at(i));
      return value;
    };
    return {number(16), number(20)};
  }

  const std::string a_ = kSquat + "a_nothing_added.json", c_ = kSquat + "c_8_kg.json";
  TempFolder folder_;
};

TEST_F(Render, DrawsARowForEachFile) {
  EXPECT_EQ(refusal({a_, c_, "--rows", "--frames", "0,20,32"}), "");
  EXPECT_EQ(size(), std::make_pair(3 * 178 + 2, 2 * 234 + 2));
  const std::string plain = slurp(picture());
  EXPECT_EQ(refusal({"--rows", a_, c_, "--frames", "0,20,32", "--label", "(a)", "--label", "(c)"}), "");
  EXPECT_NE(slurp(picture()), plain);
  EXPECT_EQ(refusal({a_, "--rows", "--tiles", "5"}), "");
  EXPECT_EQ(size(), std::make_pair(5 * 178 + 2, 234 + 2));
}

TEST_F(Render, DrawsTheFramesThatAreAskedFor) {
  EXPECT_EQ(refusal({c_, "--frames", "4,8", "--azimuth", "-90", "--label", "carries 8 kg"}), "");
  EXPECT_EQ(size().first, 2 * 322 + 2);
}

// A corpus may be older than the generator; its stored values then do not belong to the picture.
TEST_F(Render, SaysWhereItIsNotTheStoredMotion) {
  Case stored = failing_case(bent_elbow(160), "joint_range", kElbow);
  const std::string file = folder_ / "case.json";
  const auto drawn = [&] {
    spill(file, print_case(stored));
    EXPECT_EQ(refusal({file}), "");
    return slurp(picture());
  };
  const std::string as_stored = drawn();
  stored.expect.trace = "";
  EXPECT_EQ(drawn(), as_stored);
  stored.expect.motion_hash = "0123456789abcdef";
  EXPECT_NE(drawn(), as_stored);
}

// A tile is as large as a strip of one frame.
TEST_F(Render, DrawsAContactSheet) {
  EXPECT_EQ(refusal({a_, "--sheet"}), "");
  const auto [width, height] = size();
  EXPECT_EQ(refusal({a_, c_, a_, c_, a_, c_, "--sheet"}), "");
  EXPECT_EQ(size(), std::make_pair(5 * width, 2 * height));
  EXPECT_NE(refusal({a_, "--sheet", "--rows"}).find("exclude"), std::string::npos);
  EXPECT_NE(refusal({a_, "--sheet", "--frames", "1"}).find("worst"), std::string::npos);
}

TEST_F(Render, DrawsAContactSheetOfACorpus) {
  const Corpus corpus = create(folder_);
  EXPECT_NE(refusal({corpus.folder(), "--sheet"}).find("corpus.no_case"), std::string::npos);
  EXPECT_TRUE(corpus.add(found(160, 30, 1)));
  Found other = found(160, 30, 1);
  other.minimal.expect.subject = other.original.expect.subject = "arm_right/elbow max";
  EXPECT_TRUE(corpus.add(other));
  EXPECT_EQ(refusal({corpus.folder(), "--sheet"}), "");
  const int two = size().first;
  EXPECT_EQ(refusal({corpus.folder(), a_, "--sheet"}), "");
  EXPECT_EQ(2 * size().first, 3 * two);
  EXPECT_NE(refusal({folder_ / "nowhere", "--sheet"}), "");
}

TEST_F(Render, DrawsWhatMoves) {
  EXPECT_EQ(refusal({a_, "--clip", folder_ / "a.webp"}), "");
  EXPECT_TRUE(slurp(folder_ / "a.webp").starts_with("RIFF"));
  EXPECT_NE(refusal({a_, c_, "--rows", "--clip", folder_ / "b.webp"}), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.webp"));
}

TEST_F(Render, SaysWhereTwoMotionsPart) {
  const auto compare = [&](const std::string& other, std::vector<std::string> more = {}) {
    std::filesystem::remove(picture());
    std::vector<std::string> arguments = {"--library", kSquat + "actions", "render", a_, "--compare", other,
                                          "-o",        picture()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = contort_program(arguments);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(std::filesystem::exists(picture()));
    return ran.out;
  };
  EXPECT_EQ(compare(a_).rfind("no difference (", 0), 0U);
  EXPECT_EQ(size(), std::make_pair(8 * 178 + 2, 2 * 234 + 2));
  const std::string same = slurp(picture());
  EXPECT_EQ(compare(c_).rfind("first difference at frame ", 0), 0U);
  EXPECT_NE(slurp(picture()), same);
  EXPECT_EQ(compare(c_, {"--tolerance", "10000"}).rfind("no difference (", 0), 0U);
  const auto json = nlohmann::json::parse(compare(c_, {"--json"}));
  EXPECT_FALSE(json["same"].get<bool>());
  EXPECT_GE(json["first_difference"]["frame"].get<int>(), 0);
  EXPECT_EQ(json["tolerance_m"], 0.001);
  EXPECT_TRUE(nlohmann::json::parse(compare(a_, {"--json"}))["same"].get<bool>());
}

TEST_F(Render, SaysWhyItCannotCompare) {
  EXPECT_NE(refusal({a_, "--compare", folder_ / "missing.json"}).find("missing.json"), std::string::npos);
  EXPECT_NE(refusal({a_, c_, "--compare", a_}).find("one FILE beside another"), std::string::npos);
  EXPECT_NE(refusal({a_, "--rows", "--compare", c_}).find("one FILE beside another"), std::string::npos);
  EXPECT_NE(refusal({a_, "--compare", c_, "--label", "(a)"}).find("1 labels for 2 files"), std::string::npos);
  EXPECT_NE(refusal({a_, "--compare", c_, "--clip", folder_ / "a.webp"}), "");
  EXPECT_NE(refusal({a_, "--json"}).find("--compare"), std::string::npos);
  for (const char* tolerance : {"nan", "-1", "x"})
    EXPECT_NE(refusal({a_, "--compare", c_, "--tolerance", tolerance}), "");
}

TEST_F(Render, DrawsColliders) {
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{a_, "--frames", "0"}, {a_, "--rows", "--frames", "0"}, {a_, "--sheet"}}) {
    EXPECT_EQ(refusal(how), "");
    const std::string plain = slurp(picture());
    std::vector<std::string> with = how;
    with.push_back("--colliders");
    EXPECT_EQ(refusal(with), "");
    EXPECT_NE(slurp(picture()), plain);
  }
}

TEST_F(Render, SaysWhatDoesNotFitTogether) {
  EXPECT_NE(refusal({a_, c_}).find("--rows"), std::string::npos);
  EXPECT_NE(refusal({a_, c_, "--rows", "--label", "(a)"}).find("found 1 labels for 2 files"), std::string::npos);
  EXPECT_NE(refusal({a_, "--label", "(a)", "--label", "(b)"}).find("found 2 labels for 1 files"), std::string::npos);
}

TEST_F(Render, SaysWhichFramesThereAre) {
  EXPECT_NE(refusal({a_, "--frames", "86"}).find("frames 0 to 85"), std::string::npos);
  const std::string in_row = refusal({a_, c_, "--rows", "--frames", "0,86"});
  EXPECT_NE(in_row.find("a_nothing_added"), std::string::npos);
  EXPECT_NE(in_row.find("frames 0 to 85"), std::string::npos);
  EXPECT_NE(refusal({a_, "--frames", "0,-1"}), "");
  EXPECT_NE(refusal({a_, "--rows", "--tiles", "17"}).find("render.bad_size"), std::string::npos);
}

TEST_F(Render, RefusesWhatIsNoNumber) {
  for (const char* frames : {"x", "0,x", "1.5", "0;1"}) EXPECT_NE(refusal({a_, "--frames", frames}), "") << frames;
  for (const char* azimuth : {"nan", "east", "400"}) EXPECT_NE(refusal({a_, "--azimuth", azimuth}), "") << azimuth;
}

TEST_F(Render, NamesTheFileThatCannotBeRead) {
  EXPECT_NE(refusal({a_, folder_ / "missing.json", "--rows"}).find("missing.json"), std::string::npos);
  spill(folder_ / "bad.json", R"({"format":"contort.spec/1","character":{"name":"nobody"}})");
  EXPECT_NE(refusal({a_, folder_ / "bad.json", "--rows"}).find("bad.json"), std::string::npos);
}

TEST_F(Render, TakesSeveralLibraries) {
  EXPECT_EQ(refusal({a_, "--frames", "0", "--library", kRoot + "/docs/examples/own_actions"}), "");
}

}  // namespace

}  // namespace contort
