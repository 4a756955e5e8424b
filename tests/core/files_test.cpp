#include "generator/core/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace contort {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "contort_files_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(Files, PipesDevicesAndLargeFilesAreNotOpenedForStrangers) {
  ASSERT_TRUE(write_file(at("x.txt"), "12345").ok());
  EXPECT_EQ(*read_regular_file(at("x.txt"), 5), "12345");
  EXPECT_EQ(read_regular_file(at("x.txt"), 4).issue().code, "file.too_large");
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  for (const std::string& path : {at("pipe"), at("nothing"), folder_.string(), std::string("/dev/zero")})
    EXPECT_EQ(read_regular_file(path, 5).issue().code, "file.unreadable") << path;
}

TEST_F(Files, WhatIsWrittenIsRead) {
  const std::string bytes("a\0b\r\n\xff", 6);
  ASSERT_TRUE(write_file(at("x.bin"), bytes).ok());
  const Result<std::string> read = read_file(at("x.bin"));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(*read, bytes);
  ASSERT_TRUE(write_file(at("x.bin"), "").ok());
  EXPECT_EQ(*read_file(at("x.bin")), "");
}

TEST_F(Files, NoHalfWrittenFileIsLeft) {
  ASSERT_TRUE(write_file(at("x"), "one").ok());
  ASSERT_TRUE(write_file(at("x"), "two").ok());
  EXPECT_EQ(*read_file(at("x")), "two");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, AFolderInTheWayIsUnwritableAndStays) {
  ASSERT_TRUE(make_folder(at("x/inner")).ok());
  const Result<Done> written = write_file(at("x"), "text");
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.issue().code, "file.unwritable");
  EXPECT_NE(written.issue().text.find(at("x")), std::string::npos);
  EXPECT_TRUE(fs::is_directory(at("x/inner")));
  EXPECT_EQ(entries(), 1U);  // no .part
}

TEST_F(Files, AMissingFolderIsUnwritable) {
  EXPECT_EQ(write_file(at("none/x"), "text").issue().code, "file.unwritable");
  EXPECT_EQ(entries(), 0U);
}

TEST_F(Files, TooLargeIsRefusedAndExactlyLargeEnoughIsNot) {
  ASSERT_TRUE(write_file(at("x"), std::string(100000, 'x')).ok());
  EXPECT_EQ(read_file(at("x"), 99999).issue().code, "file.too_large");
  EXPECT_TRUE(read_file(at("x"), 100000).ok());
}

TEST_F(Files, FoldersAndMissingFilesAreUnreadable) {
  EXPECT_EQ(read_file(folder_.string()).issue().code, "file.unreadable");
  EXPECT_EQ(read_file(at("none")).issue().code, "file.unreadable");
  EXPECT_EQ(read_file("").issue().code, "file.unreadable");
}

TEST_F(Files, FoldersAreMadeWithThoseAbove) {
  EXPECT_TRUE(make_folder(at("a/b/c")).ok());
  EXPECT_TRUE(fs::is_directory(at("a/b/c")));
  EXPECT_TRUE(make_folder(at("a/b/c")).ok());
  ASSERT_TRUE(write_file(at("file"), "").ok());
  EXPECT_EQ(make_folder(at("file/below")).issue().code, "file.unwritable");
}

}  // namespace
}  // namespace contort
