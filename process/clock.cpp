#include "process/clock.h"

#include <chrono>

namespace contort {

double steady_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace contort
