#include "formats/gltf/container.h"

#include <cstdint>
#include <string>

#include "formats/gltf/limits.h"

namespace contort {

namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinChunk = 0x004E4942;

std::uint32_t u32_at(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

Issue truncated(const std::string& what, std::size_t needed, std::size_t found) {
  return {"gltf.truncated", "",
          what + " needs " + std::to_string(needed) + " bytes, the file has " + std::to_string(found)};
}

Result<Done> check_header(std::span<const std::byte> bytes) {
  if (bytes.size() < kHeaderBytes) return truncated("a GLB header", kHeaderBytes, bytes.size());
  if (!is_glb(bytes)) return Issue{"gltf.bad_header", "", "the file does not begin with \"glTF\""};
  if (const std::uint32_t version = u32_at(bytes, 4); version != 2)
    return Issue{"gltf.unsupported", "", "GLB version " + std::to_string(version) + "; allowed is 2"};
  const std::size_t length = u32_at(bytes, 8);
  if (length > bytes.size()) return truncated("the GLB, by its header,", length, bytes.size());
  if (length < kHeaderBytes)
    return Issue{"gltf.bad_header", "",
                 "the GLB header says " + std::to_string(length) + " bytes, fewer than the header itself has"};
  return Done{};
}

struct Chunk {
  std::uint32_t type = 0;
  std::span<const std::byte> data;
};

Result<Chunk> chunk_at(std::span<const std::byte> bytes, std::size_t offset, int index) {
  const std::string name = "chunk " + std::to_string(index);
  const std::size_t left = bytes.size() - offset;
  if (left < kChunkHeaderBytes) return truncated("the header of " + name, offset + kChunkHeaderBytes, bytes.size());
  const std::size_t length = u32_at(bytes, offset);
  if (length > left - kChunkHeaderBytes) return truncated(name, offset + kChunkHeaderBytes + length, bytes.size());
  if (length % 4 != 0)
    return Issue{"gltf.bad_chunk", "", name + " has " + std::to_string(length) + " bytes; allowed are multiples of 4"};
  return Chunk{u32_at(bytes, offset + 4), bytes.subspan(offset + kChunkHeaderBytes, length)};
}

// JSON comes first, then at most one BIN. Chunks of other kinds may follow and are ignored, as the standard requires.
Result<Done> take_chunk(const Chunk& chunk, int index, GltfContainer& out) {
  if (index == 0 && chunk.type != kJsonChunk) return Issue{"gltf.bad_chunk", "", "chunk 0 is not JSON"};
  if (index == 0) out.json = {reinterpret_cast<const char*>(chunk.data.data()), chunk.data.size()};
  if (index > 0 && chunk.type == kJsonChunk)
    return Issue{"gltf.bad_chunk", "", "chunk " + std::to_string(index) + " is JSON; only chunk 0 may be"};
  if (index > 1 && chunk.type == kBinChunk)
    return Issue{"gltf.bad_chunk", "", "chunk " + std::to_string(index) + " is BIN; only chunk 1 may be"};
  if (index == 1 && chunk.type == kBinChunk) {
    out.bin = chunk.data;
    out.has_bin = true;
  }
  return Done{};
}

// Counts brackets and commas outside of texts, and ignores all other JSON syntax.
class JsonScan {
 public:
  void feed(char c) {
    if (in_text_) return feed_text(c);
    if (c == '"') in_text_ = true;
    if (c == '[' || c == '{') ++depth_;
    if (c == ']' || c == '}') --depth_;
    if (c == '[' || c == '{' || c == ',') ++values_;
    if (depth_ > deepest_) deepest_ = depth_;
  }
  int deepest() const { return deepest_; }
  std::uint64_t values() const { return values_; }

 private:
  void feed_text(char c) {
    if (escaped_)
      escaped_ = false;
    else if (c == '\\')
      escaped_ = true;
    else if (c == '"')
      in_text_ = false;
  }
  bool in_text_ = false;
  bool escaped_ = false;
  int depth_ = 0;
  int deepest_ = 0;
  std::uint64_t values_ = 0;
};

}  // namespace

bool is_glb(std::span<const std::byte> bytes) { return bytes.size() >= 4 && u32_at(bytes, 0) == kMagic; }

Result<GltfContainer> split_glb(std::span<const std::byte> bytes) {
  if (const auto header = check_header(bytes); !header) return header.issue();
  GltfContainer out;
  const std::size_t length = u32_at(bytes, 8);
  out.bytes_after = bytes.size() - length;
  bytes = bytes.first(length);
  int index = 0;
  for (std::size_t offset = kHeaderBytes; offset < bytes.size() || index == 0; ++index) {
    const Result<Chunk> chunk = chunk_at(bytes, offset, index);
    if (!chunk) return chunk.issue();
    if (const auto taken = take_chunk(*chunk, index, out); !taken) return taken.issue();
    offset += kChunkHeaderBytes + chunk->data.size();
  }
  return out;
}

Result<Done> scan_json(std::string_view json) {
  const std::size_t first = json.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || json[first] != '{')
    return Issue{"gltf.bad_json", "", "the JSON text does not begin with an object, \"{\""};
  JsonScan scan;
  for (const char c : json) {
    scan.feed(c);
    if (scan.deepest() > kMaxGltfDepth)
      return Issue{"gltf.too_deep", "", "the JSON is nested deeper than the allowed " + std::to_string(kMaxGltfDepth)};
    if (scan.values() > kMaxGltfValues)
      return Issue{"gltf.too_large", "",
                   "the JSON has more than the allowed " + std::to_string(kMaxGltfValues) + " values"};
  }
  return Done{};
}

}  // namespace contort
