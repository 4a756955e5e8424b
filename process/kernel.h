// The kernel's records of processes.
#pragma once

#include <cstdint>
#include <string>

namespace contort {

// Memory that the process of this number has; 0 where it has ended.
std::int64_t resident_bytes(int pid);

// "SIGSEGV"
std::string signal_name(int number);

}  // namespace contort
