#include "model/core/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>

#include "model/core/descriptor.h"
#include "model/core/files.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // greatest number of successive links, as in Linux
constexpr int kReaderTries = 40;
constexpr useconds_t kReaderPause_us = 50'000;  // pause between two tries; two seconds in all

// The final place of the bytes.
struct Target {
  std::string named;    // the name that the user gave
  std::string path;     // the path with all symbolic links resolved
  int descriptor = -1;  // number of a descriptor of this process, if the name means one: /dev/stdout is 1
  unsigned mode = 0;    // mode of the existing file; 0: there is none
  bool is_plain() const { return mode == 0 || S_ISREG(mode); }
};

// Returns N for /proc/SELF/fd/N, to which /dev/stdout and /dev/fd/N lead; -1 for any other path. Such a file is not
// opened again, because writing would then begin at its start, and replacing it would detach it from standard output.
int own_descriptor(const fs::path& folder, const std::string& name) {
  const std::string own = "/proc/" + std::to_string(::getpid()) + "/";
  if (!folder.string().starts_with(own) || folder.filename() != "fd") return -1;
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc{} && end == name.data() + name.size() ? number : -1;
}

// The folder of a name, with all links resolved.
Result<fs::path> real_folder(const std::string& named, const fs::path& at) {
  std::error_code error;
  const fs::path folder = at.has_parent_path() ? at.parent_path() : fs::path(".");
  fs::path real = fs::canonical(folder, error);
  if (error) return unwritable(named, folder.string() + ": " + error.message());
  if (!fs::is_directory(real, error)) return unwritable(named, folder.string() + " is no folder");
  return real;
}

Result<Target> follow(const std::string& named) {
  fs::path at = named;
  for (int links = 0; links <= kMostLinks; ++links) {
    if (!at.has_filename()) return unwritable(named, "the name of a file is expected, not that of a folder");
    const Result<fs::path> folder = real_folder(named, at);
    if (!folder) return folder.issue();
    if (const int own = own_descriptor(*folder, at.filename().string()); own >= 0) return Target{named, "", own};
    at = *folder / at.filename();
    struct stat found {};
    if (::lstat(at.c_str(), &found) != 0) {
      if (errno != ENOENT) return unwritable(named, std::strerror(errno));
      return Target{named, at.string()};
    }
    if (!S_ISLNK(found.st_mode)) return Target{named, at.string(), -1, found.st_mode};
    std::error_code error;
    const fs::path link = fs::read_symlink(at, error);
    if (error) return unwritable(named, error.message());
    at = *folder / link;  // an absolute link replaces the folder
  }
  return unwritable(named, "too many symbolic links");
}

Result<Target> writable_target(const std::string& named) {
  Result<Target> target = follow(named);
  if (!target) return target;
  const bool is_refused = S_ISDIR(target->mode) || S_ISSOCK(target->mode) || S_ISBLK(target->mode);
  if (is_refused) return unwritable(named, "it is " + std::string(kind_of_mode(target->mode)));
  return target;
}

// Opens without blocking, because opening a pipe without a reader would wait for ever. A reader has some time to come.
Result<Descriptor> open_in_place(const Target& target, int flags) {
  if (target.descriptor >= 0) {
    Descriptor copy(::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 3));
    if (!copy.ok()) return unwritable(target.named, std::strerror(errno));
    return copy;
  }
  int file = -1;
  for (int tries = 0; tries < kReaderTries; ++tries) {
    file = ::open(target.path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC | flags, 0666);
    if (file >= 0 || errno != ENXIO || !S_ISFIFO(target.mode)) break;
    ::usleep(kReaderPause_us);
  }
  if (file < 0 && errno == ENXIO && S_ISFIFO(target.mode))
    return unwritable(target.named, "no program reads from this pipe");
  if (file < 0) return unwritable(target.named, std::strerror(errno));
  ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
  return Descriptor(file);
}

Result<Done> write_in_place(const Target& target, std::string_view bytes, int flags) {
  Result<Descriptor> opened = open_in_place(target, flags);
  if (!opened) return opened.issue();
  std::fflush(stdout);  // earlier output comes first if both go to the same place
  Descriptor file = std::move(opened).value();
  if (write_all(file.number(), bytes) && file.close()) return Done{};
  return unwritable(target.named, std::strerror(errno));
}

}  // namespace

Result<Done> write_output(const std::string& path, std::string_view bytes) {
  const Result<Target> target = writable_target(path);
  if (!target) return target.issue();
  if (target->descriptor >= 0 || !target->is_plain()) return write_in_place(*target, bytes, 0);
  const Result<Done> written = write_file(target->path, bytes);
  return written ? written : about_file(path, written.issue());
}

Result<Done> append_output(const std::string& path, std::string_view bytes) {
  const Result<Target> target = writable_target(path);
  return target ? write_in_place(*target, bytes, target->is_plain() ? O_APPEND | O_CREAT : 0) : target.issue();
}

Result<OutputFile> open_output(const std::string& path, Start start) {
  const Result<Target> target = writable_target(path);
  if (!target) return target.issue();
  const int how = start == Start::anew ? O_CREAT | O_TRUNC : O_CREAT | O_APPEND;
  Result<Descriptor> opened = open_in_place(*target, target->is_plain() ? how : 0);
  if (!opened) return opened.issue();
  Descriptor file = std::move(opened).value();
  OutputFile stream(::fdopen(file.number(), "w"));
  if (!stream) return unwritable(path, std::strerror(errno));
  file.release();
  return stream;
}

Result<Done> check_output(const std::string& path) {
  const Result<Target> target = writable_target(path);
  if (!target) return target.issue();
  if (target->descriptor >= 0) return Done{};
  const std::string asked = target->is_plain() ? fs::path(target->path).parent_path().string() : target->path;
  if (::access(asked.c_str(), W_OK) == 0) return Done{};
  return unwritable(path, asked + ": " + std::strerror(errno));
}

}  // namespace contort
