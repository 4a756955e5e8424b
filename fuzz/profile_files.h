// The files of fuzz/profiles, compiled in (the build makes the .cpp).
#pragma once

#include <span>

#include "model/character/stock_files.h"

namespace contort {

std::span<const StockFile> profile_files();

}  // namespace contort
