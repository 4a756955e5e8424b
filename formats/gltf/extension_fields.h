// Reads the extensions that extensions.h describes from a glTF document, and removes them from it.
#pragma once

#include "formats/gltf/extensions.h"
#include "model/core/json_fields.h"
#include "model/core/result.h"

namespace contort {

// Removes the extensions from the root of a document and returns them. Pointers to the translation, rotation, scale and
// weights of nodes become plain targets, and the indices of Draco's primitives are removed. Codes gltf.wrong_type,
// .missing, .bad_pointer.
Result<GltfExtensions> take_extensions(json_fields::Json& root, bool with_meshes);

}  // namespace contort
