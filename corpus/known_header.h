// The text of known.h, compiled in (the build makes the .cpp).
#pragma once

#include <span>

#include "model/character/stock_files.h"

namespace contort {

std::span<const StockFile> known_header();

}  // namespace contort
