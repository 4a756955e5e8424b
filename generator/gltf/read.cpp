#include "generator/gltf/read.h"

#include <tiny_gltf.h>

#include <exception>
#include <filesystem>

#include "generator/core/files.h"
#include "generator/gltf/buffers.h"
#include "generator/gltf/container.h"
#include "generator/gltf/document.h"
#include "generator/gltf/from_model.h"
#include "generator/gltf/limits.h"

namespace contort {

namespace {

// The checked document names no file any more. Should tinygltf ask for one all the same, there is none.
tinygltf::FsCallbacks no_files() {
  tinygltf::FsCallbacks out{};
  out.FileExists = [](const std::string&, void*) { return false; };
  out.ExpandFilePath = [](const std::string& path, void*) { return path; };
  out.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) { return false; };
  out.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
  return out;
}

// Always as text: tinygltf's own reader of GLB dies on three kinds of bad chunks, and container.cpp has read them.
Result<tinygltf::Model> to_model(const GltfDocument& document) {
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(no_files());
  loader.RemoveImageLoader();
  tinygltf::Model model;
  std::string error;  // Both texts must be there: without them tinygltf writes through null on some errors.
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

Result<Asset> to_asset(const tinygltf::Model& model) {
  Asset asset;
  AccessorReader accessors(model);
  if (const auto read = read_nodes(model, asset); !read) return read.issue();
  if (const auto read = read_skins(model, accessors, asset); !read) return read.issue();
  if (const auto read = read_clips(model, accessors, asset); !read) return read.issue();
  return asset;
}

Result<Asset> read_container(const GltfContainer& container, const std::string& folder) {
  if (const auto scanned = scan_json(container.json); !scanned) return scanned.issue();
  const Result<GltfDocument> document = check_document(container.json);
  if (!document) return document.issue();
  auto buffers = load_buffers(document->buffers, {container.bin, container.has_bin, folder});
  if (!buffers) return buffers.issue();
  Result<tinygltf::Model> parsed = to_model(*document);
  if (!parsed) return parsed.issue();
  tinygltf::Model model = std::move(parsed).value();
  for (std::vector<unsigned char>& bytes : std::move(buffers).value())
    model.buffers.emplace_back().data = std::move(bytes);
  return to_asset(model);
}

Result<std::string> read_bytes(const std::string& path) {
  const Result<std::string> bytes = read_regular_file(path, kMaxGltfBytes);
  if (bytes) return bytes;
  return Issue{bytes.issue().code == "file.too_large" ? "gltf.too_large" : "gltf.unreadable", "", bytes.issue().text};
}

}  // namespace

Result<Asset> read_gltf(const std::string& path) {
  const Result<std::string> text = read_bytes(path);
  if (!text) return text.issue();
  const auto bytes = std::as_bytes(std::span(*text));
  GltfContainer container{*text, {}, false};
  if (is_glb(bytes) || path.ends_with(".glb")) {  // the name matters for the message only
    const Result<GltfContainer> split = split_glb(bytes);
    if (!split) return split.issue();
    container = *split;
  }
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return read_container(container, folder.empty() ? "." : folder);
}

Result<Asset> parse_glb(std::span<const std::byte> bytes) {
  const Result<GltfContainer> container = split_glb(bytes);
  if (!container) return container.issue();
  return read_container(*container, "");
}

}  // namespace contort
