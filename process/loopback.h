// Connections from programs on this machine, over TCP on 127.0.0.1.
#pragma once

#include <string>

namespace contort {

// Listens on a free port and returns its number in `port`. Returns -1 if no socket can be opened.
int listen_on_loopback(int& port);

// The first connection that waits, without Nagle's delay, or -1 if none does.
int accept_on_loopback(int listener);

// 32 hex digits that nobody can guess.
std::string random_word();

}  // namespace contort
