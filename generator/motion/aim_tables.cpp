#include "generator/motion/aim_tables.h"

#include "generator/motion/aim_table_file.h"
#include "model/core/hash.h"
#include "model/core/inside_folder.h"

namespace contort {

std::string aim_table_name(const AimGeometry& geometry, const AimTableOptions& options) {
  return to_hex(AimTable::key_of(geometry, options)) + ".aim";
}

AimTables& shared_aim_tables() {
  static AimTables tables;
  return tables;
}

void AimTables::read_from(const std::string& folder) {
  const std::scoped_lock lock(mutex_);
  folders_.push_back(folder);
}

AimTable AimTables::read_or_build(const AimGeometry& geometry, const std::vector<std::string>& folders) const {
  for (const std::string& folder : folders) {
    const std::string path = folder + "/" + aim_table_name(geometry, options_);
    if (!check_inside(folder, path)) continue;
    if (Result<AimTable> read = load_aim_table(path, geometry, options_); read) return std::move(read).value();
  }
  return AimTable::build(geometry, options_);
}

std::shared_ptr<const AimTable> AimTables::get(const Character& character, const AimChain& chain) {
  const AimGeometry geometry = aim_geometry(character, chain);
  const std::uint64_t key = AimTable::key_of(geometry, options_);
  std::vector<std::string> folders;
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = tables_.find(key); found != tables_.end()) return found->second;
    folders = folders_;
  }
  auto made = std::make_shared<const AimTable>(read_or_build(geometry, folders));  // unlocked: it takes a while
  const std::scoped_lock lock(mutex_);
  return tables_.try_emplace(key, std::move(made)).first->second;
}

}  // namespace contort
