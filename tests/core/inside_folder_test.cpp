// Names and links that lead out of a folder are refused, and files outside are neither read nor written.
#include "model/core/inside_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include "model/core/json_fields.h"
#include "tests/corpus/temp_folder.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMost = 1000;

const std::string kBadNames[] = {"",       ".",
                                 "..",     "../x",
                                 "a/../b", "/etc/passwd",
                                 "a//b",   "a/",
                                 "a\\b",   std::string(1, '\0'),
                                 "a\nb",   "\x1b[2J",
                                 "a\x7f",  std::string(256, 'a')};

class InsideFolder : public testing::Test {
 protected:
  InsideFolder() {
    for (const char* name : {"own/deep", "elsewhere"}) fs::create_directories(folder_ / name);
    spill(folder_ / "own/deep/a.txt", "inside");
    spill(folder_ / "elsewhere/b.txt", "outside");
  }
  std::string own() const { return folder_ / "own"; }
  void link(const std::string& to, const std::string& name) { fs::create_symlink(to, own() + "/" + name); }
  static std::string code(const Issue& issue) { return issue.code; }
  template <class T>
  static std::string code(const Result<T>& result) {
    return result ? "" : result.issue().code;
  }
  TempFolder folder_;
};

TEST_F(InsideFolder, NamesThatLeadElsewhereAreRefused) {
  for (const std::string& name : kBadNames) {
    EXPECT_FALSE(is_file_name(name)) << name;
    EXPECT_EQ(code(place_inside(own(), name)), "file.bad_name") << name;
    EXPECT_EQ(code(read_inside(own(), name, kMost)), "file.bad_name") << name;
    EXPECT_EQ(code(write_inside(own(), name, "x")), "file.bad_name") << name;
  }
  EXPECT_TRUE(is_file_name("..."));
  EXPECT_TRUE(is_file_name(".hidden"));
}

TEST_F(InsideFolder, AMessageNeverHasAControlCharacter) {
  const std::string text = place_inside(own(), "\x1b[2J/../\n").issue().text;
  for (const char c : text) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << text;
}

TEST_F(InsideFolder, WhatIsInTheFolderIsReadAndWritten) {
  EXPECT_EQ(*place_inside(own(), "deep/new.txt"), own() + "/deep/new.txt");
  EXPECT_EQ(*read_inside(own(), "deep/a.txt", kMost), "inside");
  ASSERT_TRUE(write_inside(own(), "deep/a.txt", "new"));
  EXPECT_EQ(*read_beside(own() + "/deep/a.txt", kMost), "new");
}

TEST_F(InsideFolder, ALinkMayLeadToAnotherPlaceOfTheFolder) {
  link("deep", "alias");
  link("deep/a.txt", "a.txt");
  EXPECT_EQ(*read_inside(own(), "alias/a.txt", kMost), "inside");
  EXPECT_EQ(*read_inside(own(), "a.txt", kMost), "inside");
}

TEST_F(InsideFolder, TheFolderItselfMayBeALink) {
  fs::create_directory_symlink(own(), folder_ / "alias");
  EXPECT_EQ(*read_inside(folder_ / "alias", "deep/a.txt", kMost), "inside");
}

TEST_F(InsideFolder, ALinkThatLeadsOutOrNowhereIsNotFollowed) {
  link("../elsewhere", "folder");
  link("../elsewhere/b.txt", "b.txt");
  link(folder_ / "elsewhere/b.txt", "absolute");
  link("nowhere", "broken");
  link("../elsewhere/made_by_us", "broken_out");
  link("loop", "loop");
  for (const char* name : {"folder/b.txt", "b.txt", "absolute", "broken", "broken_out", "loop"})
    EXPECT_EQ(code(read_inside(own(), name, kMost)), "file.outside") << name;
  EXPECT_EQ(code(write_inside(own(), "folder/b.txt", "x")), "file.outside");
  EXPECT_EQ(code(place_inside(own(), "folder/new/c.txt")), "file.outside");
  EXPECT_EQ(slurp(folder_ / "elsewhere/b.txt"), "outside");
}

TEST_F(InsideFolder, AFolderWhoseNameBeginsTheSameIsOutside) {
  fs::create_directories(folder_ / "own_not");
  spill(folder_ / "own_not/c.txt", "outside");
  link("../own_not/c.txt", "c.txt");
  EXPECT_EQ(code(read_inside(own(), "c.txt", kMost)), "file.outside");
}

TEST_F(InsideFolder, WritingReplacesALinkAndNeverWhatItLeadsTo) {
  link("../elsewhere/b.txt", "b.txt");
  // The name under which a file is written before it gets its own.
  link("../elsewhere/b.txt", "b.txt." + std::to_string(::getpid()) + ".part");
  ASSERT_TRUE(write_inside(own(), "b.txt", "new"));
  EXPECT_EQ(slurp(folder_ / "elsewhere/b.txt"), "outside");
  EXPECT_EQ(*read_inside(own(), "b.txt", kMost), "new");
}

TEST_F(InsideFolder, WhatIsNoRegularFileIsNotRead) {
  EXPECT_EQ(code(read_inside(own(), "deep", kMost)), "file.unreadable");
  EXPECT_EQ(code(read_inside(own(), "missing", kMost)), "file.unreadable");
}

// Random steps, some of which lead upwards: the path of every accepted name is below the folder.
RC_GTEST_PROP(PlaceInside, WhatIsAcceptedStaysBelowTheFolder, ()) {
  const auto steps = *rc::gen::container<std::vector<std::string>>(
      rc::gen::element<std::string>("", ".", "..", "a", "b.json", "...", "/"));
  std::string name;
  for (const std::string& step : steps) name += (name.empty() ? "" : "/") + step;
  const Result<std::string> place = place_inside("/somewhere/own", name);
  if (!place) return;
  const std::string below = fs::path(*place).lexically_normal().lexically_relative("/somewhere/own").string();
  RC_ASSERT(below != "." &&
            !below.starts_with(".."
                               "/") &&
            below != "..");
}

// ---- the rule of a field

struct Named {
  std::string file, id;
};
template <class V>
void fields(V& v, const Named*) {
  using json_fields::Text;
  v.field("file", &Named::file, {.text = Text::file, .begins = "min-", .ends = ".json", .may_be_empty = true},
          "A file.");
  v.field("id", &Named::id, {.text = Text::hex, .digits = 4}, "An id.");
}

TEST(FileField, OnlyANameOfItsFormIsRead) {
  const auto read = [](const std::string& field, const std::string& text) {
    return json_fields::read_document<Named>(
        json_fields::Json({{field, text}, {field == "id" ? "file" : "id", field == "id" ? "" : "00ff"}}).dump(),
        "named");
  };
  EXPECT_TRUE(read("file", "min-a.json"));
  EXPECT_TRUE(read("file", ""));
  for (const char* bad :
       {"min-.json", "min-a", "a.json", "min-/../../a.json", "/min-a.json", "min-a\\b.json", "min-\n.json"}) {
    const Result<Named> refused = read("file", bad);
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.issue().code, "named.bad_text");
    EXPECT_EQ(refused.issue().pointer, "/file");
  }
  EXPECT_TRUE(read("id", "0f9a"));
  for (const char* bad : {"", "0f9", "0f9ab", "0F9A", "../x", "0f9a/"}) EXPECT_FALSE(read("id", bad)) << bad;
}

}  // namespace

}  // namespace contort
