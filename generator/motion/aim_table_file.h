// Aim tables in files, so that a large one is built once. Little endian:
//
//   8 bytes  "CTAIMTBL"          u32  version      u32  doubles per posture
//   u64  key (AimTable::key_of)  u32  postures     u32  0
//   f64  coordinates, posture by posture           u64  hash of all before
//
// Points and directions are not stored: the reader computes them, so a file cannot hold one that its posture does not
// have. A file is read for a chain; it is refused where it was made for another geometry or with other options.
#pragma once

#include <string>
#include <string_view>

#include "generator/motion/aim_table.h"
#include "model/core/result.h"

namespace contort {

std::string aim_table_bytes(const AimTable& table);

// Codes aim_table.damaged (length, magic or hash), .version, .other_chain, .out_of_range (a posture that the joints
// cannot take). Never reads more than the geometry and options allow: 1,944 cells of per_cell postures.
Result<AimTable> aim_table_from_bytes(std::string_view bytes, const AimGeometry& geometry,
                                      const AimTableOptions& options = {});

// Write and read a table's file. They also have the codes of write_file and read_file.
Result<Done> save_aim_table(const AimTable& table, const std::string& path);
Result<AimTable> load_aim_table(const std::string& path, const AimGeometry& geometry,
                                const AimTableOptions& options = {});

}  // namespace contort
