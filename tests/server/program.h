// contort serve as a program, and bytes sent to it as they are.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace contort {

// contort serve on a free port, ended with the test.
class Program {
 public:
  // `temporary`: its folder for files that pass; "": as this process has it.
  explicit Program(const std::vector<std::string>& options, const std::string& temporary = "") {
    int out[2];
    EXPECT_EQ(::pipe(out), 0);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      ::dup2(out[1], 1);
      if (!temporary.empty()) ::setenv("TMPDIR", temporary.c_str(), 1);
      std::vector<std::string> words = {CONTORT_BINARY_DIR "/contort", "--gl", "none", "serve", "--port", "0"};
      words.insert(words.end(), options.begin(), options.end());
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
    ::close(out[1]);
    std::string line;
    for (char c = 0; ::read(out[0], &c, 1) == 1 && c != '\n';) line += c;
    ::close(out[0]);
    port_ = std::atoi(line.c_str() + line.rfind(':') + 1);
    EXPECT_GT(port_, 0) << line;
  }
  ~Program() { end(SIGTERM); }

  int port() const { return port_; }
  httplib::Client client() const {
    httplib::Client client("127.0.0.1", port_);
    client.set_read_timeout(60);
    return client;
  }
  // Its exit code, or 128 + the signal.
  int end(int signal) {
    if (pid_ <= 0) return -1;
    ::kill(pid_, signal);
    int status = 0;
    ::waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  bool lives() const { return ::kill(pid_, 0) == 0 && ::waitpid(pid_, nullptr, WNOHANG) == 0; }
  int pid() const { return pid_; }
  // The most memory that the front has had, in MB.
  double peak_MB() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/status");
    for (std::string line; std::getline(file, line);)
      if (line.starts_with("VmHWM:")) return std::strtod(line.c_str() + 6, nullptr) / 1024.0;
    return -1.0;
  }
  // Resident memory of the front and of all processes below it, in bytes.
  long resident() const {
    long pages = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      if (entry.path().filename().string().find_first_not_of("0123456789") != std::string::npos) continue;
      std::ifstream group(entry.path() / "stat");
      std::string text((std::istreambuf_iterator<char>(group)), {});
      const std::size_t at = text.rfind(')');
      if (at == std::string::npos) continue;
      int parent = 0;
      char state = 0;
      std::sscanf(text.c_str() + at + 1, " %c %d", &state, &parent);
      const int own = std::atoi(text.c_str());
      if (own != pid_ && parent != pid_ && !below(parent)) continue;
      long all = 0, resident = 0;
      std::ifstream(entry.path() / "statm") >> all >> resident;
      pages += resident;
    }
    return pages * ::sysconf(_SC_PAGESIZE);
  }

 private:
  bool below(int pid) const {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t at = text.rfind(')');
    int parent = 0;
    char state = 0;
    return at != std::string::npos && std::sscanf(text.c_str() + at + 1, " %c %d", &state, &parent) == 2 &&
           parent == pid_;
  }
  pid_t pid_ = -1;
  int port_ = 0;
};

inline const std::string kSpec = R"({"format":"contort.spec/1","character":{"name":"mech"},"rate_hz":30})";

inline int status(const httplib::Result& result) { return result ? result->status : -1; }

inline httplib::Result post(httplib::Client& client, const std::string& path, const std::string& body,
                            const httplib::Headers& headers = {}) {
  return client.Post(path, headers, body, "application/json");
}

// A plain socket from 127.0.0.`from`, which the server treats as one client.
class Caller {
 public:
  explicit Caller(int port, unsigned from = 1) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in here = address(0, from), there = address(port, 1);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here), 0);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof there), 0);
  }
  Caller(Caller&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  Caller& operator=(Caller&&) = delete;
  ~Caller() {
    if (socket_ >= 0) ::close(socket_);
  }

  // Returns true if the other end still accepts bytes.
  bool send(const std::string& bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  // Everything received until the other end closes, `enough` was received, or nothing came for `seconds`.
  std::string receive(int seconds, const std::string& enough = "") const {
    const timeval most{seconds, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
    std::string answer;
    char buffer[1 << 16];
    for (ssize_t got = 0; (got = ::recv(socket_, buffer, sizeof buffer, 0)) > 0;) {
      answer.append(buffer, static_cast<std::size_t>(got));
      if (!enough.empty() && answer.find(enough) != std::string::npos) break;
    }
    return answer;
  }
  // Returns true if the other end has closed the connection by now.
  bool is_over() const {
    char byte = 0;
    return ::recv(socket_, &byte, 1, MSG_DONTWAIT | MSG_PEEK) == 0;
  }

 private:
  static sockaddr_in address(int port, unsigned last) {
    sockaddr_in all{};
    all.sin_family = AF_INET, all.sin_port = htons(static_cast<std::uint16_t>(port));
    all.sin_addr.s_addr = htonl((127U << 24) + last);
    return all;
  }
  int socket_;
};

// The head of a request, to which the caller adds its own lines and the empty one.
inline std::string head_of(int port, const std::string& line) {
  return line + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n";
}

// Sends bytes unchanged, and returns what comes back within a second.
inline std::string raw(int port, const std::string& bytes, bool hang_up = false) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET, to.sin_port = htons(static_cast<std::uint16_t>(port)),
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (::connect(socket, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0) {
    (void)!::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    const timeval second{1, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &second, sizeof second);
    char buffer[4096];
    for (ssize_t got = 0; !hang_up && (got = ::recv(socket, buffer, sizeof buffer, 0)) > 0;) {
      answer.append(buffer, static_cast<std::size_t>(got));
      if (answer.find("\r\n\r\n") != std::string::npos) break;
    }
  }
  ::close(socket);
  return answer;
}

}  // namespace contort
