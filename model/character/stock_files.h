// The files of model/character/stock, compiled in (the build makes the .cpp).
#pragma once

#include <span>
#include <string_view>

namespace contort {

struct StockFile {
  std::string_view name;  // "mech_arm_slim.json"
  std::string_view text;
};

std::span<const StockFile> stock_files();

}  // namespace contort
