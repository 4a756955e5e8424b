#include "server/scratch.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace contort::server {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPrefix = "contort-serve-";
constexpr int kAttempts = 10;

// Returns -1 if it is no folder of this user, or if it is locked.
int lock_folder(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat about {};
  if (file >= 0 && ::fstat(file, &about) == 0 && about.st_uid == ::geteuid() && ::flock(file, LOCK_EX | LOCK_NB) == 0)
    return file;
  if (file >= 0) ::close(file);
  return -1;
}

// Returns true if the locked folder is still at its path.
bool is_at(const std::string& path, int file) {
  struct stat opened {
  }, present{};
  return ::fstat(file, &opened) == 0 && ::lstat(path.c_str(), &present) == 0 && opened.st_ino == present.st_ino &&
         opened.st_dev == present.st_dev;
}

void remove_dead(const std::string& parent) {
  std::error_code error, ignored;
  for (const auto& entry : fs::directory_iterator(parent, error)) {
    if (!entry.path().filename().string().starts_with(kPrefix)) continue;
    const int file = lock_folder(entry.path().string());
    if (file < 0) continue;
    if (is_at(entry.path().string(), file)) fs::remove_all(entry.path(), ignored);
    ::close(file);
  }
}

}  // namespace

Result<std::unique_ptr<Scratch>> Scratch::make(std::string parent) {
  std::error_code error;
  if (parent.empty()) parent = fs::temp_directory_path(error).string();
  remove_dead(parent);
  // Another run may remove the new folder before it is locked, because it looks like one of an ended run. Then another
  // one is made.
  for (int attempt = 0; attempt < kAttempts && !error; ++attempt) {
    std::string path = parent + "/" + kPrefix + "XXXXXX";
    if (::mkdtemp(path.data()) == nullptr) break;
    const int file = lock_folder(path);
    if (file >= 0 && is_at(path, file)) return std::unique_ptr<Scratch>(new Scratch(path, file));
    if (file >= 0) ::close(file);
  }
  const std::string why = error ? error.message() : std::strerror(errno);
  return Issue{
      "file.unwritable", "",
      "cannot make a folder for files that pass in " + parent + ": " + why + "; TMPDIR may name another place"};
}

Scratch::~Scratch() {
  std::error_code error;
  fs::remove_all(path_, error);
  ::close(lock_);
}

}  // namespace contort::server
