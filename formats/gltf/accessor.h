// Reads numbers from accessors. Every format, offset, stride and length is checked before a byte is read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/gltf/limits.h"
#include "model/core/result.h"

namespace tinygltf {
class Model;
struct Accessor;
}  // namespace tinygltf

namespace contort {

enum class ElementKind : std::uint8_t { scalar, vec3, vec4, mat4 };

// Integers that are allowed in place of 32-bit floats: none, fractions of [-1, 1], or any of up to 16 bits, as
// positions by KHR_mesh_quantization.
enum class Integers : std::uint8_t { none, normalized, any };

// The JSON pointer of an accessor in the file, for messages.
inline std::string accessor_pointer(int accessor) { return "/accessors/" + std::to_string(accessor); }

class AccessorReader {
 public:
  explicit AccessorReader(const tinygltf::Model& model) : model_(model) {}

  // Returns the number of elements of an accessor, and whether it has its own bytes; without, it is all zeros. The
  // index must be valid; anything else may be wrong with the accessor.
  std::size_t count(int accessor) const;
  bool has_data(int accessor) const;

  // Reads the first `count` elements (at most all), component by component, all finite: 32-bit floats and the allowed
  // integers. Codes gltf.bad_accessor, .bad_index, .truncated, .not_finite, .too_large (see kMaxGltfNumbers).
  Result<std::vector<double>> read(int accessor, ElementKind kind, std::size_t count,
                                   Integers integers = Integers::none);

  // Reads all elements as unsigned integers: indices of vertices, numbers of joints. Codes as above, and
  // gltf.unsupported for sparse accessors.
  Result<std::vector<int>> read_indices(int accessor, ElementKind kind);

 private:
  Result<Done> take_numbers(std::size_t count, const std::string& pointer);
  Result<Done> check_format(int accessor, ElementKind kind, Integers integers) const;
  Result<std::vector<double>> read_dense(const tinygltf::Accessor& accessor, const std::string& pointer,
                                         std::size_t components, std::size_t count) const;
  Result<Done> apply_sparse(const tinygltf::Accessor& accessor, const std::string& pointer,
                            std::vector<double>& values) const;
  const tinygltf::Model& model_;
  std::uint64_t numbers_left_ = kMaxGltfNumbers;
};

}  // namespace contort
