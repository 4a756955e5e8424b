#include "generator/motion/aim_table_file.h"

#include <bit>
#include <vector>

#include "generator/motion/joint_clamp.h"
#include "model/core/files.h"
#include "model/core/hash.h"

namespace contort {

namespace {

constexpr std::string_view kMagic = "CTAIMTBL";
constexpr std::uint32_t kVersion = 3;  // of the bytes, and of the choice of postures
constexpr std::size_t kHeaderBytes = 32;
constexpr std::size_t kHashBytes = 8;

void put(std::string& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>((value >> (8 * i)) & 0xff));
}

std::uint64_t get(std::string_view bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i)
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)])) << (8 * i);
  return value;
}

std::uint64_t hash_of(std::string_view bytes) {
  Hash64 hash;
  hash.add(bytes);
  return hash.value();
}

Issue refused(const char* what, std::string text) { return {std::string("aim_table.") + what, "", std::move(text)}; }

std::size_t most_postures(const AimTableOptions& options) {
  return static_cast<std::size_t>(kAimCells) * static_cast<std::size_t>(options.per_cell);
}

// Returns true if the header is ours, and all bytes that it announces are there.
Result<Done> check_frame(std::string_view bytes, const AimGeometry& geometry, const AimTableOptions& options) {
  if (bytes.size() < kHeaderBytes + kHashBytes || !bytes.starts_with(kMagic))
    return refused("damaged", "This is not an aim table, or only the beginning of one.");
  if (get(bytes, 8, 4) != kVersion)
    return refused("version", "The table has version " + std::to_string(get(bytes, 8, 4)) + "; this program reads " +
                                  std::to_string(kVersion) + ".");
  const std::string_view body = bytes.substr(0, bytes.size() - kHashBytes);
  if (get(bytes, body.size(), kHashBytes) != hash_of(body)) return refused("damaged", "The table's hash is wrong.");
  const auto coord_count = static_cast<std::size_t>(geometry.coord_count);
  if (get(bytes, 12, 4) != coord_count || get(bytes, 16, 8) != AimTable::key_of(geometry, options))
    return refused("other_chain", "The table is of another chain of joints, or of other options.");
  const std::uint64_t count = get(bytes, 24, 4);
  if (count < 1 || count > most_postures(options) || body.size() != kHeaderBytes + count * coord_count * 8)
    return refused("damaged", "The table's length is not that of its postures.");
  return Done{};
}

// A ball that is not of unit length is not a rotation; in range is judged as the clamp does it.
bool can_be_taken(const Joint& joint, const double* coords) {
  const Quat q(coords[0], joint.kind == JointKind::ball ? coords[1] : 0.0,
               joint.kind == JointKind::ball ? coords[2] : 0.0, joint.kind == JointKind::ball ? coords[3] : 0.0);
  const double square = glm::dot(q, q);
  if (joint.kind == JointKind::ball && !(square > 1.0 - 1e-9 && square < 1.0 + 1e-9)) return false;
  return normalised_margin(joint, coords) >= -1e-9;
}

}  // namespace

std::string aim_table_bytes(const AimTable& table) {
  std::string bytes(kMagic);
  put(bytes, kVersion, 4);
  put(bytes, static_cast<std::uint64_t>(table.geometry().coord_count), 4);
  put(bytes, table.key(), 8);
  put(bytes, static_cast<std::uint64_t>(table.posture_count()), 4);
  put(bytes, 0, 4);
  for (int i = 0; i < table.posture_count(); ++i)
    for (const double value : table.coords(i)) put(bytes, std::bit_cast<std::uint64_t>(value), 8);
  put(bytes, hash_of(bytes), kHashBytes);
  return bytes;
}

Result<AimTable> aim_table_from_bytes(std::string_view bytes, const AimGeometry& geometry,
                                      const AimTableOptions& options) {
  if (const Result<Done> frame = check_frame(bytes, geometry, options); !frame) return frame.issue();
  std::vector<double> coords;
  for (std::size_t at = kHeaderBytes; at < bytes.size() - kHashBytes; at += 8)
    coords.push_back(std::bit_cast<double>(get(bytes, at, 8)));
  for (std::size_t first = 0; first < coords.size(); first += static_cast<std::size_t>(geometry.coord_count))
    for (const Joint& joint : geometry.joints)
      if (!can_be_taken(joint, coords.data() + first + joint.coord))
        return refused("out_of_range", "A posture of the table is outside the ranges of its joints.");
  return AimTable::of_postures(geometry, options, coords);
}

Result<Done> save_aim_table(const AimTable& table, const std::string& path) {
  return write_file(path, aim_table_bytes(table));
}

Result<AimTable> load_aim_table(const std::string& path, const AimGeometry& geometry, const AimTableOptions& options) {
  const std::size_t most = kHeaderBytes + kHashBytes +
                           most_postures(options) * static_cast<std::size_t>(geometry.coord_count) * sizeof(double);
  const Result<std::string> bytes = read_file(path, most);
  if (!bytes) return bytes.issue();
  return aim_table_from_bytes(*bytes, geometry, options);
}

}  // namespace contort
