// All of some bytes through a socket, however many calls that takes.
#pragma once

#include <cstddef>

namespace contort {

// False where the other end is gone.
bool send_all(int socket, const void* bytes, std::size_t size);
bool receive_all(int socket, void* bytes, std::size_t size);

}  // namespace contort
