// Sends or receives all of the bytes through a socket, with as many calls as needed.
#pragma once

#include <cstddef>

namespace contort {

// Return false if the other end has closed the socket.
bool send_all(int socket, const void* bytes, std::size_t size);
bool receive_all(int socket, void* bytes, std::size_t size);

}  // namespace contort
