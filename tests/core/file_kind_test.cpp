#include "model/core/file_kind.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "model/core/descriptor.h"
#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

TEST(FileKind, IsToldByTheFirstBytes) {
  const std::pair<std::string, std::string> kinds[] = {
      {"\x89PNG\r\n\x1a\n....", "a PNG image"},
      {"\xff\xd8\xff\xe0", "a JPEG image"},
      {"GIF89a", "a GIF image"},
      {"RIFF\x10\x10\x10\x10WEBPVP8 ", "a WebP image"},
      {"PK\x03\x04", "a ZIP archive"},
      {"\x1f\x8b\x08", "a gzip archive"},
      {"%PDF-1.7", "a PDF document"},
      {"Kaydara FBX Binary  ", "an FBX model"},
      {"; FBX 7.4.0 project file", "an FBX model"},
      {"PXR-USDC", "a USD scene"},
      {"#usda 1.0", "a USD scene"},
      {"glTF\x02", "a glTF model (GLB)"},
      {"HIERARCHY\nROOT hips", "a BVH animation"},
      {"\n\n  <!DOCTYPE HTML><html>", "an HTML page"},
      {"\xef\xbb\xbf<html>", "an HTML page"},
      {"<?xml version=\"1.0\"?>\n<COLLADA>", "a COLLADA model"},
      {"<?xml version=\"1.0\"?>\n<other>", "an XML file"},
      {"version https://git-lfs.github.com/spec/v1\noid",
       "a Git LFS pointer, whose file is not here yet"},
      {"<robot name=\"arm\"/>", "a robot in URDF"},
      {"<?xml version=\"1.0\"?>\n<!-- a licence -->\n<robot name=\"arm\"/>", "a robot in URDF"},
      {"\n<mujoco model=\"hand\">", "a robot in MJCF (MuJoCo)"},
      {std::string("PK\x03\x04") + std::string(22, 'x') + std::string("\x05\0\0\0", 4) + "a.npy",
       "a ZIP archive of NumPy arrays (NPZ)"},
      {std::string("PK\x03\x04") + std::string(22, 'x') + std::string("\x06\0\0\0", 4) + "a.usdc",
       "a USD scene (USDZ)"},
      {"t,j1\n0,0.5\n0.1,-2e-3\n", "a table of numbers (CSV)"},
      {"0;0.5\r\n0.1;1\r\n", "a table of numbers (CSV)"},
      {"404: Not Found", "a web server's answer that there is no such file"},
      {"\x7f"
       "ELF\x02",
       "a program (ELF)"},
      {"\xff\xfe{", "a text in UTF-16, where UTF-8 is needed"}};
  for (const auto& [bytes, kind] : kinds) EXPECT_EQ(kind_of_bytes(bytes), kind);
  for (const char* unknown : {"", "{", "{\"format\": \"contort.spec/1\"}", "RIFF", "\x89", "hello", "[1, 2]", "[1,\n2,\n3]", "a, b\nc, d\n", "1, 2\n3"})
    EXPECT_EQ(kind_of_bytes(unknown), "") << unknown;
}

TEST(FileKind, IsSaidWithTheNameOfTheFile) {
  const TempFolder folder;
  spill(folder / "a.json", "\x89PNG\r\n\x1a\n....");
  const Issue issue = read_json_file(folder / "a.json", "a spec").issue();
  EXPECT_EQ(issue.code, "file.wrong_kind");
  EXPECT_EQ(issue.text, (folder / "a.json") + " is a PNG image, expected a spec");
}

TEST(FileKind, IsSaidWithWhatToDo) {
  EXPECT_EQ(other_kind("a.glb", "version https://git-lfs.github.com/spec/v1\n", "a model")->text,
            "a.glb is a Git LFS pointer, whose file is not here yet, expected a model; run git lfs pull, which gets it");
  EXPECT_NE(other_kind("a.usdz", "PK\x03\x04", "a model")->text.find("a USD scene (USDZ)"), std::string::npos);
  EXPECT_FALSE(other_kind("a.npz", "import numpy", "a model"));
  EXPECT_EQ(unknown_kind("a.npz", "import numpy\nx = 1", "a model").text,
            "a.npz is named like NumPy arrays (NPZ), and begins with \"import numpy\"; expected a model");
  EXPECT_EQ(unknown_kind("a.txt", "", "a model").text, "a.txt is empty, expected a model");
}

// Archives, models and texts are cut off in downloads.
TEST(FileKind, EveryBeginningOfAFileIsLookedAtSafely) {
  const std::string whole[] = {std::string("PK\x03\x04") + std::string(22, 'x') + "\xff\xff\xff\xff" + "a.npy",
                               "\xef\xbb\xbf<?xml version=\"1.0\"?><!-- a --><robot/>", "t,j1\n0,0.5\n1,2\n"};
  for (const std::string& bytes : whole)
    for (std::size_t size = 0; size <= bytes.size(); ++size)
      EXPECT_FALSE(unknown_kind("a.bin", bytes.substr(0, size), "a model").text.empty());
}

// The pipe has been read, and is not opened once more.
TEST(FileKind, APipeThatIsTooLargeIsNotWaitedFor) {
  const TempFolder folder;
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  std::thread writer([&] {
    write_all(ends[1], "PK\x03\x04" + std::string(20 << 20, 'x'));
    ::close(ends[1]);
  });
  EXPECT_EQ(read_named_json("/dev/fd/" + std::to_string(ends[0]), "a spec").issue().code, "file.too_large");
  for (char block[65536]; ::read(ends[0], block, sizeof block) > 0;) continue;
  writer.join();
  ::close(ends[0]);
}

TEST(FileKind, IsSaidOfWhatIsTooLarge) {
  const TempFolder folder;
  spill(folder / "film.json", "PK\x03\x04" + std::string(20 << 20, 'x'));
  EXPECT_EQ(read_json_file(folder / "film.json", "a spec").issue().code, "file.wrong_kind");
  spill(folder / "large.json", std::string(20 << 20, ' '));
  EXPECT_EQ(read_json_file(folder / "large.json", "a spec").issue().code, "file.too_large");
}

}  // namespace
}  // namespace contort
