// A glTF file may name only files in its own folder or below it.
#include "formats/gltf/buffers.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "formats/gltf/read.h"
#include "tests/gltf/glb_builder.h"

namespace contort {
namespace {

using fixtures::ByteList;
using fixtures::GlbBuilder;
using fixtures::Json;
using fixtures::pack_glb;
using fixtures::small_arm;

class GltfFiles : public ::testing::Test {
 protected:
  GltfFiles() : folder_(std::filesystem::temp_directory_path() / ("contort_gltf_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_ / "asset" / "buffers");
  }
  ~GltfFiles() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  // small_arm as text, with its buffer in a file beside it.
  Result<Asset> read_with_uri(const std::string& uri) const {
    Json root = small_arm().document();
    root["buffers"][0]["uri"] = uri;
    write("asset/arm.gltf", root.dump());
    return read_gltf((folder_ / "asset" / "arm.gltf").string());
  }
  static std::string bin() {
    const ByteList bytes = small_arm().bin;
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  std::filesystem::path folder_;
};

TEST_F(GltfFiles, BuffersMayBeFilesInTheAssetsFolder) {
  write("asset/arm.bin", bin());
  write("asset/buffers/an arm+.bin", bin() + "more bytes than are needed");
  const auto same = parse_glb(small_arm().glb());
  for (const char* uri : {"arm.bin", "./arm.bin", "buffers/an%20arm+.bin", "buffers/an arm%2b.bin"}) {
    const auto result = read_with_uri(uri);
    ASSERT_TRUE(result.ok()) << uri << " " << to_line(result.issue());
    EXPECT_EQ(*result, *same) << uri;
  }
}

TEST_F(GltfFiles, BuffersMayBeDataUris) {
  GlbBuilder b;
  b.root["nodes"] = Json::array({Json::object()});
  b.root["animations"] = Json::array({Json::object()});
  b.root["buffers"] = {{{"byteLength", 16}, {"uri", "data:application/octet-stream;base64,AAAAPwAAgD8AAABAAABAQA=="}}};
  b.root["bufferViews"] = {{{"buffer", 0}, {"byteLength", 4}}, {{"buffer", 0}, {"byteOffset", 4}, {"byteLength", 12}}};
  b.root["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}},
                         {{"bufferView", 1}, {"componentType", 5126}, {"count", 1}, {"type", "VEC3"}}};
  b.add_channel(0, 0, "translation", 0, 1);
  const auto result = parse_glb(pack_glb(b.root.dump(), {}));
  ASSERT_TRUE(result.ok()) << to_line(result.issue());
  EXPECT_EQ(result->clips[0].channels[0].times_s, std::vector<double>{0.5});
  EXPECT_EQ(result->clips[0].channels[0].values, (std::vector<double>{1, 2, 3}));
}

TEST_F(GltfFiles, BuffersMayNotLieElsewhere) {
  write("outside.bin", bin());
  std::filesystem::create_directories(folder_ / "asset2");
  write("asset2/near.bin", bin());  // "asset" is a prefix of "asset2", but not its folder
  const std::string absolute = (folder_ / "outside.bin").string();
  for (const std::string& uri :
       {std::string("../outside.bin"), std::string("buffers/../../outside.bin"), std::string("%2e%2e/outside.bin"),
        std::string("..%2Foutside.bin"), absolute, "file://" + absolute, std::string("http://example.com/x.bin"),
        std::string("..\\outside.bin"), std::string("C:/x.bin"), std::string("../asset2/near.bin"), std::string(""),
        std::string("arm%zz.bin"), std::string("arm.bin%00.png")}) {
    const auto result = read_with_uri(uri);
    ASSERT_FALSE(result.ok()) << uri;
    EXPECT_EQ(result.issue().code, "gltf.bad_uri") << uri;
    EXPECT_EQ(result.issue().pointer, "/buffers/0/uri") << uri;
  }
}

TEST_F(GltfFiles, SymbolicLinksMayNotLeadOut) {
  write("outside.bin", bin());
  write("asset/arm.bin", bin());
  std::filesystem::create_symlink(folder_ / "outside.bin", folder_ / "asset" / "out.bin");
  std::filesystem::create_directory_symlink(folder_, folder_ / "asset" / "up");
  std::filesystem::create_symlink("arm.bin", folder_ / "asset" / "in.bin");
  EXPECT_EQ(read_with_uri("out.bin").issue().code, "gltf.bad_uri");
  EXPECT_EQ(read_with_uri("up/outside.bin").issue().code, "gltf.bad_uri");
  EXPECT_TRUE(read_with_uri("in.bin").ok());
}

TEST_F(GltfFiles, MissingShortAndEmptyFilesAreRefused) {
  EXPECT_EQ(read_with_uri("nothing.bin").issue().code, "gltf.missing_file");
  EXPECT_EQ(read_with_uri("buffers").issue().code, "gltf.missing_file");
  write("asset/short.bin", bin().substr(1));
  EXPECT_EQ(read_with_uri("short.bin").issue().code, "gltf.truncated");
  write("asset/empty.bin", "");
  EXPECT_EQ(read_with_uri("empty.bin").issue().code, "gltf.truncated");
}

TEST_F(GltfFiles, OnlyRegularFilesAreOpened) {
  EXPECT_EQ(read_gltf(folder_.string()).issue().code, "gltf.unreadable");
  EXPECT_EQ(read_gltf((folder_ / "nothing.glb").string()).issue().code, "gltf.unreadable");
  EXPECT_EQ(read_gltf("/dev/zero").issue().code, "gltf.unreadable");
}

TEST_F(GltfFiles, AFileNamedGlbIsOneOrAModelAsText) {
  write("asset/arm.glb", "glT");
  EXPECT_EQ(read_gltf((folder_ / "asset" / "arm.glb").string()).issue().code, "gltf.truncated");
  write("asset/arm.glb", "{}");
  EXPECT_EQ(read_gltf((folder_ / "asset" / "arm.glb").string()).issue().code, "gltf.missing");
}

}  // namespace
}  // namespace contort
