// Aim tables built on first use and shared: by characters, by their equal arms, by threads.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "generator/motion/aim_table.h"

namespace contort {

class AimTables {
 public:
  explicit AimTables(const AimTableOptions& options = {}) : options_(options) {}

  // The chain's table; stays alive as long as anyone holds it. Safe from any thread. Two threads that ask first may
  // both build it: the tables are equal, and one of them is kept.
  std::shared_ptr<const AimTable> get(const Character& character, const AimChain& chain);

 private:
  AimTableOptions options_;
  std::mutex mutex_;
  std::map<std::uint64_t, std::shared_ptr<const AimTable>> tables_;
};

}  // namespace contort
