// Converts tinygltf's structs to ours: nodes first, then skins, then clips. The model has passed check_document, so
// its indices are valid unless stated otherwise.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/gltf/accessor.h"
#include "model/asset/skinned.h"
#include "model/core/result.h"

namespace contort {

// Splits a 4x4 matrix, column by column, into translation, rotation and scale; a mirroring matrix gets a negative x
// scale. Returns false if it is no such product: sheared, or with a last row other than 0 0 0 1.
bool decompose(std::span<const double> matrix, Trs& out);

// Fills nodes and order. Codes gltf.bad_node, .not_unit, .two_parents, .cycle.
Result<Done> read_nodes(const tinygltf::Model& model, Asset& asset);

enum class Faults : std::uint8_t {
  refuse,     // the first fault ends the reading
  go_around,  // faults of clips and bind matrices are listed in Asset::faults, and everything else is read
};

// Fills skins and AssetNode::is_joint. Codes gltf.bad_skin and those of AccessorReader.
Result<Done> read_skins(const tinygltf::Model& model, AccessorReader& accessors, Faults faults, Asset& asset);

// Fills clips. Codes gltf.bad_index, .unsupported, .duplicate_channel, .bad_times, .bad_accessor, .not_unit and those
// of AccessorReader.
Result<Done> read_clips(const tinygltf::Model& model, AccessorReader& accessors, Faults faults, Asset& asset);

// Fills meshes: of every node with a mesh and a skin. Primitives of points and lines, and those without joints, are
// left out. Codes gltf.bad_mesh, .bad_index, .unsupported and those of AccessorReader.
Result<Done> read_meshes(const tinygltf::Model& model, AccessorReader& accessors, SkinnedAsset& asset);

}  // namespace contort
