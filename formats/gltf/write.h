// Writes a motion as .glb, for any viewer: one node per joint (of the same name and order), the character's mesh with
// one plain material per colour, and one animation with a linear key for every frame, so that viewers show what was
// checked. Equal input gives equal bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/character/character.h"
#include "model/core/result.h"
#include "model/motion/motion.h"

namespace contort {

// The origin of the motion. It goes into the scene's extras, which viewers show; empty texts are left out.
struct GltfExtras {
  std::string case_id;
  std::string replay;  // The command that makes this motion again.
  bool operator==(const GltfExtras&) const = default;
};

// Codes: gltf.not_finite (a value that no 32-bit float can hold: the first frame and joint), gltf.not_unit (a rotation
// of length 0), gltf.bad_rate, gltf.wrong_character (rows of another size), gltf.too_large, gltf.bad_text (not UTF-8).
// Pointers lead into the Motion: "/coords/17", "/root/3". A motion without frames gives the character at rest.
// The animation begins with the motion's first_frame, at 0 s. With `only_part`, it moves the joints of that part alone.
Result<std::vector<std::byte>> write_glb(const Character& character, const Motion& motion, const GltfExtras& extras,
                                         std::optional<int> only_part = {});

// Writes the .glb to a file, completely or not at all. Also code file.unwritable.
Result<Done> save_glb(const std::string& path, const Character& character, const Motion& motion,
                      const GltfExtras& extras, std::optional<int> only_part = {});

}  // namespace contort
