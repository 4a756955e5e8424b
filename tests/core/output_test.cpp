// Output files that a user names: existing files are neither destroyed nor replaced by other kinds.
#include "model/core/output.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>

#include "model/core/descriptor.h"
#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

class Output : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return folder_ / name; }
  // A pipe with a reader that never waits.
  int read_end_of(const std::string& path) const {
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  }
  static std::string all_in(int pipe) {
    char block[4096];
    const ssize_t got = ::read(pipe, block, sizeof block);
    return got > 0 ? std::string(block, static_cast<std::size_t>(got)) : "";
  }
  TempFolder folder_;
};

using Write = Result<Done> (*)(const std::string&, std::string_view);
constexpr Write kWays[] = {write_output, append_output};

TEST_F(Output, APipeTakesTheBytesAndStaysAPipe) {
  const Descriptor reader(read_end_of(at("pipe")));
  for (const Write write : kWays) {
    ASSERT_TRUE(write(at("pipe"), "text\n").ok());
    EXPECT_EQ(all_in(reader.number()), "text\n");
    EXPECT_TRUE(fs::is_fifo(at("pipe")));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "no temporary file is left";
}

TEST_F(Output, APipeThatNobodyReadsIsRefusedAndNotWaitedFor) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  const Result<Done> written = write_output(at("pipe"), "text");
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.issue().code, "file.unwritable");
  EXPECT_NE(written.issue().text.find("no program reads from this pipe"), std::string::npos) << written.issue().text;
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
}

TEST_F(Output, ALinkStaysAndWhatItLeadsToIsWritten) {
  fs::create_directories(at("far/away"));
  spill(at("far/away/target"), "old");
  ASSERT_EQ(::chmod(at("far/away/target").c_str(), 0640), 0);
  fs::create_symlink("far/away/target", at("second"));
  fs::create_symlink(at("second"), at("first"));
  ASSERT_TRUE(write_output(at("first"), "new").ok());
  EXPECT_TRUE(fs::is_symlink(at("first")));
  EXPECT_TRUE(fs::is_symlink(at("second")));
  EXPECT_EQ(slurp(at("far/away/target")), "new");
  EXPECT_EQ(static_cast<unsigned>(fs::status(at("far/away/target")).permissions()), 0640U);
  ASSERT_TRUE(append_output(at("first"), "er").ok());
  EXPECT_EQ(slurp(at("far/away/target")), "newer");
  EXPECT_EQ(std::distance(fs::directory_iterator(at("far/away")), {}), 1);
}

TEST_F(Output, ALinkToNothingMakesWhatItLeadsTo) {
  fs::create_symlink(at("target"), at("link"));
  ASSERT_TRUE(write_output(at("link"), "new").ok());
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(slurp(at("target")), "new");
}

TEST_F(Output, ALinkToAPipeReachesIt) {
  const Descriptor reader(read_end_of(at("pipe")));
  fs::create_symlink(at("pipe"), at("link"));
  ASSERT_TRUE(write_output(at("link"), "text").ok());
  EXPECT_EQ(all_in(reader.number()), "text");
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
}

TEST_F(Output, LinksInACircleAreRefused) {
  fs::create_symlink(at("b"), at("a"));
  fs::create_symlink(at("a"), at("b"));
  EXPECT_EQ(write_output(at("a"), "x").issue().code, "file.unwritable");
  EXPECT_TRUE(fs::is_symlink(at("a")));
}

// Makes a device like /dev/null, to spare the real one.
TEST_F(Output, ADeviceStaysADevice) {
  if (::mknod(at("null").c_str(), S_IFCHR | 0600, ::makedev(1, 3)) != 0)
    GTEST_SKIP() << "needs the right to make devices";
  const int opened = ::open(at("null").c_str(), O_WRONLY | O_CLOEXEC);
  if (opened < 0) GTEST_SKIP() << "devices cannot be opened here";
  ::close(opened);
  for (const Write write : kWays) EXPECT_TRUE(write(at("null"), "text").ok());
  EXPECT_TRUE(open_output(at("null"), Start::anew).ok());
  EXPECT_TRUE(check_output(at("null")).ok());
  EXPECT_TRUE(fs::is_character_file(at("null")));
}

// A disk is not overwritten with a report, even by a privileged user.
TEST_F(Output, ADiskIsRefused) {
  if (::mknod(at("disk").c_str(), S_IFBLK | 0600, ::makedev(7, 250)) != 0)
    GTEST_SKIP() << "needs the right to make devices";
  EXPECT_NE(write_output(at("disk"), "x").issue().text.find("disk"), std::string::npos);
  EXPECT_TRUE(fs::is_block_file(at("disk")));
}

TEST_F(Output, ADescriptorOfThisProcessIsWrittenWhereItStands) {
  const Descriptor file(::open(at("file").c_str(), O_RDWR | O_CREAT, 0600));
  ASSERT_TRUE(write_all(file.number(), "printed before, "));
  ASSERT_TRUE(write_output("/dev/fd/" + std::to_string(file.number()), "written, ").ok());
  ASSERT_TRUE(append_output("/proc/self/fd/" + std::to_string(file.number()), "appended, ").ok());
  ASSERT_TRUE(write_all(file.number(), "printed after"));
  EXPECT_EQ(slurp(at("file")), "printed before, written, appended, printed after");
  EXPECT_EQ(write_output("/dev/fd/999999", "x").issue().code, "file.unwritable");
}

TEST_F(Output, FoldersSocketsAndPlacesThatAreNoneAreRefusedByName) {
  fs::create_directories(at("folder"));
  spill(at("file"), "x");
  const Descriptor socket(::socket(AF_UNIX, SOCK_STREAM, 0));
  sockaddr_un address{AF_UNIX, {}};
  at("socket").copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (const std::string name : {"folder", "folder/", "folder/.", "none/x", "file/x", "socket", "none/"}) {
    SCOPED_TRACE(name);
    for (const Write write : kWays) {
      const Result<Done> written = write(at(name), "x");
      ASSERT_FALSE(written.ok());
      EXPECT_EQ(written.issue().code, "file.unwritable");
      EXPECT_NE(written.issue().text.find(at(name)), std::string::npos) << written.issue().text;
    }
    EXPECT_EQ(check_output(at(name)).issue().code, "file.unwritable");
    EXPECT_EQ(open_output(at(name), Start::anew).issue().code, "file.unwritable");
  }
  EXPECT_NE(write_output(at("folder"), "x").issue().text.find("it is a folder"), std::string::npos);
  EXPECT_EQ(write_output("", "x").issue().code, "file.unwritable");
  EXPECT_TRUE(fs::is_socket(at("socket")));
  EXPECT_EQ(slurp(at("file")), "x");
}

TEST_F(Output, WhatIsOpenedIsWrittenInPlace) {
  spill(at("log"), "old\n");
  fs::create_symlink(at("log"), at("link"));
  {
    const Result<OutputFile> log = open_output(at("link"), Start::at_the_end);
    ASSERT_TRUE(log.ok());
    std::fputs("more\n", log->get());
  }
  EXPECT_EQ(slurp(at("log")), "old\nmore\n");
  ASSERT_TRUE(open_output(at("link"), Start::anew).ok());
  EXPECT_EQ(slurp(at("log")), "");
  EXPECT_TRUE(fs::is_symlink(at("link")));
}

TEST_F(Output, ACheckWritesNothing) {
  EXPECT_TRUE(check_output(at("new")).ok());
  spill(at("old"), "old");
  EXPECT_TRUE(check_output(at("old")).ok());
  EXPECT_EQ(slurp(at("old")), "old");
  EXPECT_FALSE(fs::exists(at("new")));
}

}  // namespace
}  // namespace contort
