// page.css, rows.js and page.js of renders/page, compiled in (the build makes the .cpp), in this order.
#pragma once

#include <span>

#include "model/character/stock_files.h"

namespace contort {

std::span<const StockFile> page_files();

}  // namespace contort
