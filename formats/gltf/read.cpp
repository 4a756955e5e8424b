#include "formats/gltf/read.h"

#include <tiny_gltf.h>

#include <exception>
#include <filesystem>

#include "formats/gltf/buffers.h"
#include "formats/gltf/compression.h"
#include "formats/gltf/container.h"
#include "formats/gltf/document.h"
#include "formats/gltf/from_model.h"
#include "formats/gltf/limits.h"
#include "formats/gltf/vrm.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"

namespace contort {

namespace {

// The checked document refers to no file any more. If tinygltf opens one all the same, it finds none.
tinygltf::FsCallbacks no_files() {
  tinygltf::FsCallbacks out{};
  out.FileExists = [](const std::string&, void*) { return false; };
  out.ExpandFilePath = [](const std::string& path, void*) { return path; };
  out.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; };
  out.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
  return out;
}

// The model is always passed as text: tinygltf's own reader of GLB crashes on three kinds of bad chunks, and
// container.cpp has read them.
Result<tinygltf::Model> to_model(const GltfDocument& document) {
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(no_files());
  loader.RemoveImageLoader();
  tinygltf::Model model;
  std::string error;  // Both texts are needed: without them tinygltf writes through null on some errors.
  std::string warning;
  try {
    if (loader.LoadASCIIFromString(&model, &error, &warning, document.json.data(),
                                   static_cast<unsigned int>(document.json.size()), ""))
      return model;
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  return Issue{"gltf.unreadable", "", "tinygltf: " + error};
}

Result<SkinnedAsset> to_asset(const tinygltf::Model& model, Meshes meshes, Faults faults) {
  SkinnedAsset out;
  AccessorReader accessors(model);
  if (const auto read = read_nodes(model, out.asset); !read) return read.issue();
  if (const auto read = read_skins(model, accessors, faults, out.asset); !read) return read.issue();
  if (const auto read = read_clips(model, accessors, faults, out.asset); !read) return read.issue();
  if (meshes == Meshes::leave_out) return out;
  if (const auto read = read_meshes(model, accessors, out); !read) return read.issue();
  return out;
}

Result<SkinnedAsset> read_container(const GltfContainer& container, const std::string& folder, Meshes meshes,
                                    Faults faults = Faults::refuse) {
  if (const auto scanned = scan_json(container.json); !scanned) return scanned.issue();
  const Result<GltfDocument> document = check_document(container.json, meshes);
  if (!document) return document.issue();
  auto buffers = load_buffers(document->buffers, {container.bin, container.has_bin, folder});
  if (!buffers) return buffers.issue();
  Result<tinygltf::Model> parsed = to_model(*document);
  if (!parsed) return parsed.issue();
  tinygltf::Model model = std::move(parsed).value();
  for (std::vector<unsigned char>& bytes : std::move(buffers).value())
    model.buffers.emplace_back().data = std::move(bytes);
  const GltfExtensions& packed = document->extensions;
  if (const auto filled = fill_views(packed.views, model); !filled) return filled.issue();
  if (const auto filled = fill_primitives(packed.primitives, model); !filled) return filled.issue();
  Result<SkinnedAsset> asset = to_asset(model, meshes, faults);
  if (!asset) return asset;
  SkinnedAsset out = std::move(asset).value();
  if (packed.pointers_not_read > 0)
    out.asset.remarks.push_back({"gltf.pointers", std::to_string(packed.pointers_not_read) +
                                                      " channels move other things than nodes; they are not read"});
  if (container.bytes_after > 0)
    out.asset.remarks.push_back({"gltf.bytes_after", std::to_string(container.bytes_after) +
                                                         " bytes follow the end of the GLB; they are not read"});
  if (meshes == Meshes::leave_out) return out;
  Result<std::map<std::string, int>> humanoid = read_humanoid(container.json, out.asset.nodes.size());
  if (!humanoid) return humanoid.issue();
  out.humanoid = std::move(humanoid).value();
  return out;
}

Result<std::string> read_bytes(const std::string& path) {
  const Result<std::string> bytes = read_file(path, kMaxGltfBytes);
  if (bytes && is_glb(std::as_bytes(std::span(*bytes)))) return bytes;
  if (bytes) {
    constexpr char kExpected[] = "a glTF model (.glb, .gltf, .vrm, .vrma)";
    std::optional<Issue> other = other_kind(path, *bytes, kExpected);
    const bool may_be_gltf = bytes->find_first_not_of(" \t\r\n") == bytes->find('{');
    const bool is_named_so = path.ends_with(".glb") || path.ends_with(".gltf");
    if (!other && !may_be_gltf && !is_named_so) other = unknown_kind(path, *bytes, kExpected);
    return other ? Issue{"gltf.wrong_kind", "", other->text} : bytes;
  }
  return Issue{bytes.issue().code == "file.too_large" ? "gltf.too_large" : "gltf.unreadable", "", bytes.issue().text};
}

Result<SkinnedAsset> read_any(const std::string& path, Meshes meshes, Faults faults = Faults::refuse) {
  const Result<std::string> text = read_bytes(path);
  if (!text) return text.issue();
  const auto bytes = std::as_bytes(std::span(*text));
  GltfContainer container{*text, {}, false, 0};
  const bool is_text = text->find_first_not_of(" \t\r\n") == text->find('{') && text->find('{') != text->npos;
  if (is_glb(bytes) || (path.ends_with(".glb") && !is_text)) {  // the name matters only for the message
    const Result<GltfContainer> split = split_glb(bytes);
    if (!split) return split.issue();
    container = *split;
  }
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return read_container(container, folder.empty() ? "." : folder, meshes, faults);
}

Result<SkinnedAsset> parse_any(std::span<const std::byte> bytes, Meshes meshes) {
  const Result<GltfContainer> container = split_glb(bytes);
  if (!container) return container.issue();
  return read_container(*container, "", meshes);
}

Result<Asset> without_meshes(Result<SkinnedAsset> read) {
  if (!read) return read.issue();
  return std::move(std::move(read).value().asset);
}

}  // namespace

Result<Asset> read_gltf(const std::string& path) { return without_meshes(read_any(path, Meshes::leave_out)); }

Result<Asset> read_gltf_around_faults(const std::string& path) {
  return without_meshes(read_any(path, Meshes::leave_out, Faults::go_around));
}

Result<Asset> parse_glb(std::span<const std::byte> bytes) {
  return without_meshes(parse_any(bytes, Meshes::leave_out));
}

Result<SkinnedAsset> read_skinned_gltf(const std::string& path) { return read_any(path, Meshes::read); }

Result<SkinnedAsset> parse_skinned_glb(std::span<const std::byte> bytes) { return parse_any(bytes, Meshes::read); }

}  // namespace contort
