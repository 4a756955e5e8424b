// The kernel's records of processes.
#pragma once

#include <cstdint>
#include <string>

namespace contort {

// Returns the resident memory of a process in bytes; 0 if it has ended.
std::int64_t resident_bytes(int pid);

// Returns the name of a signal: "SIGSEGV".
std::string signal_name(int number);

}  // namespace contort
