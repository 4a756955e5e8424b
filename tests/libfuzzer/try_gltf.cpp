#include "formats/gltf/read.h"
#include "tests/gltf/glb_builder.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

// Lengths in a GLB's headers hardly survive a change of its text. So texts are tried too, with a chunk of 32 ascending
// floats, for times, and 96 that are 0, 0, 0, 1 in turn, for rotations.
fixtures::ByteList around_gltf(std::string_view json) {
  fixtures::ByteList numbers;
  for (std::uint32_t i = 0; i < 32; ++i) fixtures::append_u32(numbers, 0x3f800000U + (i << 16));
  for (std::uint32_t i = 0; i < 96; ++i) fixtures::append_u32(numbers, i % 4 == 3 ? 0x3f800000U : 0U);
  return fixtures::pack_glb(std::string(json), numbers);
}

}  // namespace

bool try_gltf(std::string_view bytes) {
  const bool is_text = !bytes.empty() && bytes.front() != 'g';
  const fixtures::ByteList glb = is_text ? around_gltf(bytes) : fixtures::to_bytes(bytes);
  if (const Result<SkinnedAsset> skinned = parse_skinned_glb(glb); !skinned) require_clean(skinned.issue());
  const Result<Asset> asset = parse_glb(glb);
  if (!asset) return require_clean(asset.issue()), false;
  look_at(*asset);
  return true;
}

}  // namespace contort::hostile
