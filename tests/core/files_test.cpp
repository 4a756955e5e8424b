#include "model/core/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <thread>

#include "model/core/descriptor.h"

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

TEST_F(Files, PipesDevicesFoldersAndLargeFilesAreRefusedAtOnce) {
  ASSERT_TRUE(write_file(at("x.txt"), "12345").ok());
  EXPECT_EQ(*read_file(at("x.txt"), 5), "12345");
  EXPECT_EQ(read_file(at("x.txt"), 4).issue().code, "file.too_large");
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  for (const std::string& path : {at("pipe"), at("nothing"), folder_.string(), std::string("/dev/zero")})
    EXPECT_EQ(read_file(path, 5).issue().code, "file.unreadable") << path;
}

TEST_F(Files, AnIssueSaysWhatKindOfThingThePathNames) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  EXPECT_NE(read_file(at("pipe"), 5).issue().text.find(at("pipe") + " is a named pipe"), std::string::npos);
  EXPECT_NE(read_file("/dev/zero", 5).issue().text.find("/dev/zero is a device"), std::string::npos);
  EXPECT_NE(read_named_file("/dev/zero", 5).issue().text.find("/dev/zero is a device"), std::string::npos);
  fs::create_symlink(at("pipe"), at("link"));
  EXPECT_EQ(read_file(at("link"), 5).issue().code, "file.unreadable");
}

// The writer has one second to open the pipe.
TEST_F(Files, APipeThatIsNamedIsReadToItsEnd) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  const std::string text(200'000, 'x');  // more than a pipe holds
  std::thread writer([&] {
    const int pipe = ::open(at("pipe").c_str(), O_WRONLY);
    EXPECT_TRUE(write_all(pipe, text));
    ::close(pipe);
  });
  const Result<std::string> read = read_named_file(at("pipe"), 1 << 20);
  writer.join();
  ASSERT_TRUE(read.ok()) << to_line(read.issue());
  EXPECT_EQ(*read, text);
}

TEST_F(Files, APipeIsReadNoFartherThanAllowed) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_TRUE(write_all(ends[1], "123456"));
  EXPECT_EQ(read_named_file("/dev/fd/" + std::to_string(ends[0]), 5).issue().code, "file.too_large");
  ::close(ends[0]), ::close(ends[1]);
}

TEST_F(Files, APipeThatNobodyWritesIntoIsRefused) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  const Result<std::string> read = read_named_file(at("pipe"), 5);
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.issue().code, "file.unreadable");
  EXPECT_NE(read.issue().text.find("no program writes into this pipe"), std::string::npos) << read.issue().text;
}

TEST_F(Files, AReplacedFileKeepsItsPermissions) {
  ASSERT_TRUE(write_file(at("x"), "old").ok());
  ASSERT_EQ(::chmod(at("x").c_str(), 0640), 0);
  ASSERT_TRUE(write_file(at("x"), "new").ok());
  struct stat now {};
  ASSERT_EQ(::stat(at("x").c_str(), &now), 0);
  EXPECT_EQ(now.st_mode & 07777U, 0640U);
  EXPECT_EQ(*read_file(at("x")), "new");
}

// In the program's own folders, which may come from strangers, a link may lead to somebody else's file.
TEST_F(Files, ALinkInAnOwnFolderIsReplacedAndNotFollowed) {
  ASSERT_TRUE(write_file(at("precious"), "keep me").ok());
  fs::create_symlink(at("precious"), at("x"));
  ASSERT_TRUE(write_file(at("x"), "new").ok());
  EXPECT_FALSE(fs::is_symlink(at("x")));
  EXPECT_EQ(*read_file(at("precious")), "keep me");
  fs::create_symlink(at("precious"), at("y." + std::to_string(::getpid()) + ".part"));
  ASSERT_TRUE(write_file(at("y"), "new").ok());
  EXPECT_EQ(*read_file(at("precious")), "keep me") << "nor is one at the temporary name";
}

TEST_F(Files, APipeInAnOwnFolderIsLeftAlone) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  EXPECT_EQ(write_file(at("pipe"), "x").issue().code, "file.unwritable");
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
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
