// The skin of an imported character: the triangles of its own model, moved by the joints of its vertices.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/asset/skinned.h"
#include "model/character/character.h"
#include "model/character/skin_desc.h"
#include "model/core/result.h"

namespace contort {

// The limit of triangles. A model with more triangles is probably a scan, and would take longer to draw than everything
// else in a strip.
inline constexpr std::size_t kMostSkinTriangles = 60'000;

struct Skin {
  struct Influence {
    int joint = 0;  // joint of the character
    double weight = 0.0;
    Vec3 point_m{0.0};  // the vertex in the joint's frame
  };
  std::vector<Influence> influences;  // influences of all vertices, in their order
  std::vector<int> first;             // vertex i has influences [first[i], first[i + 1])
  std::vector<int> shared;            // for vertex i: the first vertex in the same place, which has the same normal
  std::vector<int> indices;           // three to a triangle, counter-clockwise seen from outside
  std::vector<int> owners;            // for each triangle the joint with the greatest weight
  std::vector<bool> moved;            // true for joints that own a triangle
};

// Binds a skin to a character. Codes skin.*: no node of the model is the root, no vertex follows the character's
// joints, or there are too many triangles.
Result<Skin> bind_skin(const SkinDesc& desc, const SkinnedAsset& asset, const Character& character);

// The triangles of one group, relative to `origin_m`.
struct SkinPiece {
  int group = 0;
  Triangles triangles;
};

// A skin in the pose `world` (world_from_joint). `group_of_joint` is the piece for the triangles that a joint owns.
// Triangles without a finite position near the origin are left out, and `complete` is then false.
struct PosedSkin {
  Vec3 origin_m{0.0};
  std::vector<SkinPiece> pieces;  // sorted by group; none is empty
  bool complete = true;
};
PosedSkin pose_skin(const Skin& skin, std::span<const Rigid> world, const std::vector<int>& group_of_joint);

// The skins of library folders. Each model is read once.
class Wardrobe {
 public:
  explicit Wardrobe(std::vector<std::string> folders);
  Wardrobe(Wardrobe&&) noexcept;
  ~Wardrobe();

  // Returns the skin of a character, or nullptr if no folder has one. Codes: those of parse_skin, bind_skin and
  // read_gltf, file.unreadable, and skin.outside if the model's file is a link to another folder.
  Result<std::shared_ptr<const Skin>> skin_of(const Character& character);

 private:
  struct Models;
  std::vector<std::string> folders_;
  std::unique_ptr<Models> models_;
};

}  // namespace contort
