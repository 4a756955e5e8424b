#include "server/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <utility>

namespace contort::server {

namespace {

constexpr off_t kMostBytes = off_t{256} << 20;

const Issue kNotFound{"call.not_found", "", "there is no such page"};

bool is_plain(std::string_view name) {
  return !name.empty() && name.front() != '.' && name.find('\\') == std::string_view::npos &&
         name.find('\0') == std::string_view::npos;
}

// Opens one folder after another, so that no link is followed, even one that was made meanwhile. Returns -1 if there is
// no such file.
int open_steps(const std::string& folder, std::string_view path) {
  int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  while (file >= 0) {
    const std::size_t slash = path.find('/');
    const std::string name(path.substr(0, slash));
    const bool is_last = slash == std::string_view::npos;
    const int kind = is_last ? O_NONBLOCK : O_DIRECTORY;
    const int next = is_plain(name) ? ::openat(file, name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | kind) : -1;
    ::close(std::exchange(file, next));
    if (is_last) break;
    path.remove_prefix(slash + 1);
  }
  return file;
}

}  // namespace

PlainFile::~PlainFile() {
  if (number_ >= 0) ::close(number_);
}

std::string PlainFile::read(std::size_t most) {
  std::string bytes(std::min(most, left_), '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t got = ::read(number_, bytes.data() + have, bytes.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    have += static_cast<std::size_t>(got);
  }
  left_ = have < bytes.size() ? 0 : left_ - have;  // the file was cut by another program
  bytes.resize(have);
  return bytes;
}

Result<std::shared_ptr<PlainFile>> open_below(const std::string& folder, const std::string& path) {
  auto file = std::make_shared<PlainFile>();
  file->number_ = open_steps(folder, path);
  struct stat about {};
  if (file->number_ < 0 || ::fstat(file->number_, &about) != 0) return kNotFound;
  if (!S_ISREG(about.st_mode) || about.st_size > kMostBytes) return kNotFound;
  file->left_ = static_cast<std::size_t>(about.st_size);
  return file;
}

Result<std::string> read_below(const std::string& folder, const std::string& path) {
  const Result<std::shared_ptr<PlainFile>> file = open_below(folder, path);
  if (!file) return file.issue();
  const std::size_t all = (*file)->left();
  std::string bytes = (*file)->read(all);
  if (bytes.size() < all) return kNotFound;
  return bytes;
}

std::string type_of(const std::string& path) {
  constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".png", "image/png"},
      {".webp", "image/webp"},
      {".glb", "model/gltf-binary"},
      {".txt", "text/plain; charset=utf-8"},
  };
  for (const auto& [ending, type] : kTypes)
    if (path.ends_with(ending)) return std::string(type);
  return "application/octet-stream";
}

}  // namespace contort::server
