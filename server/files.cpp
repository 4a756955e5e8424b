#include "server/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <utility>

namespace contort::server {

namespace {

constexpr off_t kMostBytes = off_t{256} << 20;

const Issue kNotFound{"call.not_found", "", "there is no such page"};

// Closes itself.
struct File {
  int number = -1;
  ~File() {
    if (number >= 0) ::close(number);
  }
};

bool is_plain(std::string_view name) {
  return !name.empty() && name.front() != '.' && name.find('\\') == std::string_view::npos &&
         name.find('\0') == std::string_view::npos;
}

// Step by step, so that no link on the way is followed, whenever it was put there.
Result<Done> open_below(const std::string& folder, std::string_view path, File& file) {
  file.number = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  while (file.number >= 0) {
    const std::size_t slash = path.find('/');
    const std::string name(path.substr(0, slash));
    if (!is_plain(name)) return kNotFound;
    const bool is_last = slash == std::string_view::npos;
    const int kind = is_last ? O_NONBLOCK : O_DIRECTORY;
    const int next = ::openat(file.number, name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | kind);
    ::close(std::exchange(file.number, next));
    if (is_last) break;
    path.remove_prefix(slash + 1);
  }
  if (file.number < 0) return kNotFound;
  return Done{};
}

}  // namespace

Result<std::string> read_below(const std::string& folder, const std::string& path) {
  File file;
  if (const Result<Done> opened = open_below(folder, path, file); !opened) return opened.issue();
  struct stat about {};
  if (::fstat(file.number, &about) != 0 || !S_ISREG(about.st_mode) || about.st_size > kMostBytes) return kNotFound;
  std::string bytes(static_cast<std::size_t>(about.st_size), '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t got = ::read(file.number, bytes.data() + have, bytes.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return kNotFound;
    have += static_cast<std::size_t>(got);
  }
  return bytes;
}

std::string type_of(const std::string& path) {
  constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
      {".html", "text/html; charset=utf-8"}, {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},   {".json", "application/json"},
      {".png", "image/png"},                 {".webp", "image/webp"},
      {".glb", "model/gltf-binary"},         {".txt", "text/plain; charset=utf-8"},
  };
  for (const auto& [ending, type] : kTypes)
    if (path.ends_with(ending)) return std::string(type);
  return "application/octet-stream";
}

}  // namespace contort::server
