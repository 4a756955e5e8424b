// Aim tables of a library folder. An attacker who can write the file can also set its hash, so the test corrects the
// hash.
#include <array>
#include <cmath>

#include "generator/motion/aim_table_file.h"
#include "model/core/hash.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

constexpr std::size_t kCountAt = 24, kHeaderBytes = 32, kHashBytes = 8;

// The geometry of the human's right arm, from shoulder to grip.
const AimGeometry& geometry() {
  static const AimGeometry out = [] {
    const Result<Character> human = build_character({}, stock_library());
    const int socket = human->find_socket("hand_right/grip");
    return aim_geometry(*human, aim_chain_for(*human, human->find_part("arm_right"), socket));
  }();
  return out;
}

// A table of one posture at rest: its header is that of every other table of the chain.
const std::string& whole_table() {
  static const std::string out = [] {
    std::vector<double> rest(static_cast<std::size_t>(geometry().coord_count), 0.0);
    for (const Joint& joint : geometry().joints)
      if (joint.kind == JointKind::ball) rest[static_cast<std::size_t>(joint.coord)] = 1.0;
    return aim_table_bytes(AimTable::of_postures(geometry(), {}, rest));
  }();
  return out;
}

void put(std::string& bytes, std::size_t at, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) bytes[at + i] = static_cast<char>((value >> (8 * i)) & 0xff);
}

std::string around(std::string_view postures) {
  std::string bytes = whole_table().substr(0, kHeaderBytes) + std::string(postures);
  put(bytes, kCountAt, postures.size() / (8 * static_cast<std::size_t>(geometry().coord_count)), 4);
  Hash64 hash;
  hash.add(std::string_view(bytes));
  const std::size_t end = bytes.size();
  bytes.resize(end + kHashBytes);
  put(bytes, end, hash.value(), kHashBytes);
  return bytes;
}

void aim(const AimTable& table) {
  std::array<AimHit, 8> hits{};
  std::vector<double> coords(static_cast<std::size_t>(geometry().coord_count));
  for (const Vec3 direction : {Vec3(0, 0, 1), Vec3(0, -1, 0), Vec3(0.6, 0, -0.8)}) {
    require(table.nearest(direction, hits) >= 1, "a table knows a posture for every direction");
    table.interpolated(direction, coords);
    for (const double coord : coords) require(std::isfinite(coord), "postures of a table are finite");
  }
}

}  // namespace

bool try_aim_table(std::string_view bytes) {
  const Result<AimTable> table = aim_table_from_bytes(around(bytes), geometry());
  if (!table) return require_clean(table.issue()), false;
  aim(*table);
  return true;
}

}  // namespace contort::hostile
