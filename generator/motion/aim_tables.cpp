#include "generator/motion/aim_tables.h"

namespace contort {

std::shared_ptr<const AimTable> AimTables::get(const Character& character, const AimChain& chain) {
  const AimGeometry geometry = aim_geometry(character, chain);
  const std::uint64_t key = AimTable::key_of(geometry, options_);
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = tables_.find(key); found != tables_.end()) return found->second;
  }
  auto built = std::make_shared<const AimTable>(AimTable::build(geometry, options_));  // unlocked: it takes a while
  const std::scoped_lock lock(mutex_);
  return tables_.try_emplace(key, std::move(built)).first->second;
}

}  // namespace contort
