// What the kernel says about processes.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace contort {

// Memory that it has; 0 where it has ended.
std::int64_t resident_bytes(pid_t process);

// "SIGSEGV"
std::string signal_name(int number);

}  // namespace contort
