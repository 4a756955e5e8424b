#include "formats/gltf/buffers.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <filesystem>

#include "formats/gltf/limits.h"
#include "model/core/files.h"

namespace contort {

namespace {

using Bytes = std::vector<unsigned char>;
namespace fs = std::filesystem;

Issue bad_uri(const std::string& pointer, const std::string& why) { return {"gltf.bad_uri", pointer + "/uri", why}; }

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// Decodes "%20" to " ". Returns false if the escapes are broken or contain a zero byte, which would cut the path short.
bool percent_decode(const std::string& uri, std::string& out) {
  for (std::size_t i = 0; i < uri.size(); ++i) {
    char c = uri[i];
    if (c == '%') {
      if (i + 2 >= uri.size() || hex_digit(uri[i + 1]) < 0 || hex_digit(uri[i + 2]) < 0) return false;
      c = static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2]));
      i += 2;
    }
    if (c == '\0') return false;
    out += c;
  }
  return !out.empty();
}

// Returns true for a plain relative path downwards: no scheme or drive, no root, no "..", no backslash.
bool stays_below(const std::string& path) {
  if (path.front() == '/' || path.find('\\') != std::string::npos || path.find(':') != std::string::npos) return false;
  const fs::path parts(path);
  return std::find(parts.begin(), parts.end(), "..") == parts.end();
}

// The path of the file `uri`, after checking that it lies in the folder. A symbolic link inside the folder may lead to
// another place inside it, but not out of it.
Result<std::string> locate(const std::string& uri, const std::string& folder, const std::string& pointer) {
  std::string relative;
  if (!percent_decode(uri, relative)) return bad_uri(pointer, "the URI is empty or has broken % escapes");
  if (folder.empty()) return bad_uri(pointer, "the asset has no folder, so that a buffer cannot be a file");
  if (!stays_below(relative))
    return bad_uri(pointer, "allowed are data: URIs and relative paths into the asset's own folder");
  std::error_code error;
  const fs::path base = fs::canonical(folder, error);
  const fs::path file = error ? fs::path() : fs::canonical(base / relative, error);
  if (error || !fs::is_regular_file(file, error))
    return Issue{"gltf.missing_file", pointer + "/uri", "there is no such file beside the asset"};
  if (std::mismatch(base.begin(), base.end(), file.begin(), file.end()).first != base.end())
    return bad_uri(pointer, "the file leads out of the asset's own folder by a symbolic link");
  return file.string();
}

Result<Bytes> load_file(const BufferRef& buffer, const std::string& folder, const std::string& pointer) {
  const Result<std::string> path = locate(buffer.uri, folder, pointer);
  if (!path) return path.issue();
  const Result<std::string> bytes = read_file(*path, kMaxGltfBytes);
  if (!bytes) return Issue{"gltf.missing_file", pointer + "/uri", bytes.issue().text};
  return Bytes(bytes->begin(), bytes->end());
}

Result<Bytes> load_data_uri(const BufferRef& buffer, const std::string& pointer) {
  Bytes out;
  std::string mime_type;
  if (!tinygltf::DecodeDataURI(&out, mime_type, buffer.uri, 0, false))
    return bad_uri(pointer,
                   "found a data: URI without bytes or of an unknown kind; allowed is "
                   "data:application/octet-stream;base64,...");
  return out;
}

Result<Bytes> load_buffer(const BufferRef& buffer, bool is_first, const BufferSource& source,
                          const std::string& pointer) {
  if (buffer.has_uri && buffer.uri.starts_with("data:")) return load_data_uri(buffer, pointer);
  if (buffer.has_uri) return load_file(buffer, source.folder, pointer);
  if (!is_first || !source.has_bin) return Bytes();
  const auto* first = reinterpret_cast<const unsigned char*>(source.bin.data());
  return Bytes(first, first + source.bin.size());
}

}  // namespace

Result<std::vector<Bytes>> load_buffers(std::span<const BufferRef> buffers, const BufferSource& source) {
  std::vector<Bytes> out;
  std::size_t total = 0;
  for (const BufferRef& buffer : buffers) {
    const std::string pointer = "/buffers/" + std::to_string(out.size());
    Result<Bytes> loaded = load_buffer(buffer, out.empty(), source, pointer);
    if (!loaded) return loaded.issue();
    total += loaded->size();  // size of all buffers together: thousands of them may refer to one large file
    if (total > kMaxGltfBytes)
      return Issue{"gltf.too_large", pointer,
                   "the buffers have more than the allowed " + std::to_string(kMaxGltfBytes) + " bytes in all"};
    const bool has_data = buffer.has_uri || !loaded->empty();
    if (has_data && loaded->size() < buffer.byte_length)
      return Issue{"gltf.truncated", pointer + "/byteLength",
                   "found " + std::to_string(buffer.byte_length) + "; the data has " + std::to_string(loaded->size())};
    out.push_back(std::move(loaded).value());
    if (has_data) out.back().resize(buffer.byte_length);
  }
  return out;
}

}  // namespace contort
