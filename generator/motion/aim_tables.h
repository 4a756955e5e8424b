// Aim tables built on first use and shared: by characters, by their equal arms, by threads.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "generator/motion/aim_table.h"

namespace contort {

class AimTables {
 public:
  explicit AimTables(const AimTableOptions& options = {}) : options_(options) {}

  // Searches this folder for files of tables first. A file that does not fit, because its character has changed or
  // because it is damaged, is ignored.
  void read_from(const std::string& folder);

  // The chain's table; it stays alive as long as a caller holds it. Safe from any thread. Two threads that request it
  // first may both build it: the tables are equal, and one of them is kept.
  std::shared_ptr<const AimTable> get(const Character& character, const AimChain& chain);

 private:
  AimTable read_or_build(const AimGeometry& geometry, const std::vector<std::string>& folders) const;

  AimTableOptions options_;
  std::vector<std::string> folders_;
  std::mutex mutex_;
  std::map<std::uint64_t, std::shared_ptr<const AimTable>> tables_;
};

// The tables of the whole process. They can be shared, because a table depends only on its chain.
AimTables& shared_aim_tables();

// The file name of a chain's table: its key.
std::string aim_table_name(const AimGeometry& geometry, const AimTableOptions& options);

}  // namespace contort
