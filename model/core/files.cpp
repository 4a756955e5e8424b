#include "model/core/files.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "model/core/descriptor.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

constexpr int kWaitForWriter_ms = 1000;
constexpr int kLongestSilence_ms = 10'000;

// Non-blocking, because opening a pipe without a writer would wait. O_NOCTTY keeps a terminal from becoming ours.
constexpr int kReadFlags = O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;

Issue too_large(const std::string& path, std::size_t max_bytes) {
  return {"file.too_large", "", path + " is larger than the allowed " + std::to_string(max_bytes) + " bytes"};
}

Issue unreadable(const std::string& path) {
  return {"file.unreadable", "", "cannot read " + path + ": " + std::strerror(errno)};
}

Issue wrong_kind(const std::string& path, unsigned mode) {
  const std::string what = path + " is " + std::string(kind_of_mode(mode));
  return {"file.unreadable", "", S_ISDIR(mode) ? what : what + ", expected a plain file"};
}

// Reads everything to the end. Returns an issue if that is more than max_bytes or cannot be read.
std::optional<Issue> read_rest(int file, const std::string& path, std::size_t max_bytes, std::string& bytes) {
  char block[65536];
  for (;;) {
    const ssize_t got = ::read(file, block, sizeof block);
    if (got == 0) return std::nullopt;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return unreadable(path);
    bytes.append(block, static_cast<std::size_t>(got));
    if (bytes.size() > max_bytes) return too_large(path, max_bytes);
  }
}

// Checks the kind twice, because a path may change in between. The first check avoids opening devices; the second one,
// of the opened file, decides.
Result<Descriptor> open_of_kind(const std::string& path, bool (*is_wanted)(unsigned mode), struct stat& found) {
  if (::stat(path.c_str(), &found) != 0) return unreadable(path);
  if (!is_wanted(found.st_mode)) return wrong_kind(path, found.st_mode);
  Descriptor file(::open(path.c_str(), kReadFlags));
  if (!file.ok() || ::fstat(file.number(), &found) != 0) return unreadable(path);
  if (!is_wanted(found.st_mode)) return wrong_kind(path, found.st_mode);
  return file;
}

// The reason why a pipe cannot be read right now.
enum class Silence { no_writer_yet, writer_is_slow };

// Returns false if nothing happened in the longest time for this silence.
bool wait_for_bytes(int pipe, Silence silence) {
  pollfd ready{pipe, POLLIN, 0};
  const int longest = silence == Silence::no_writer_yet ? kWaitForWriter_ms : kLongestSilence_ms;
  return ::poll(&ready, 1, longest) != 0;
}

Issue silent(const std::string& path, Silence silence) {
  const std::string why = silence == Silence::no_writer_yet ? "no program writes into this pipe"
                                                            : "nothing came through this pipe for 10 s";
  return {"file.unreadable", "", "cannot read " + path + ": " + why};
}

// The system reports the end of a pipe both before the first writer opens it and after the last one closes it.
Result<std::string> read_pipe(int pipe, const std::string& path, std::size_t max_bytes) {
  std::string bytes;
  bool was_there = false;  // a writer was there
  bool waited = false;     // for the first writer
  for (;;) {
    char block[65536];
    const ssize_t got = ::read(pipe, block, sizeof block);
    if (got > 0) bytes.append(block, static_cast<std::size_t>(got)), was_there = true;
    if (bytes.size() > max_bytes) return too_large(path, max_bytes);
    if (got > 0 || (got < 0 && errno == EINTR)) continue;
    if (got < 0 && errno != EAGAIN) return unreadable(path);
    if (got == 0 && was_there) return bytes;
    const Silence silence = got == 0 ? Silence::no_writer_yet : Silence::writer_is_slow;
    was_there = got < 0;
    if (got == 0 && waited) return silent(path, silence);
    if (!wait_for_bytes(pipe, silence) && got < 0) return silent(path, silence);
    waited = true;
  }
}

bool is_plain(unsigned mode) { return S_ISREG(mode); }
bool is_plain_or_pipe(unsigned mode) { return S_ISREG(mode) || S_ISFIFO(mode); }

Result<std::string> read_plain(const Descriptor& file, const struct stat& found, const std::string& path,
                               std::size_t max_bytes) {
  const auto size = static_cast<std::size_t>(found.st_size);
  if (size > max_bytes) return too_large(path, max_bytes);
  std::string bytes;
  bytes.reserve(size);
  if (const std::optional<Issue> why = read_rest(file.number(), path, max_bytes, bytes)) return *why;
  return bytes;
}

// ---- writing

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

std::string reason(const std::string& path) {
  const int error = errno;
  std::error_code ignored;
  if (error == ENOENT && !fs::exists(folder_of(path), ignored)) return "there is no folder " + folder_of(path);
  return std::strerror(error);
}

// Makes a new file. It never opens an existing one, or a link that somebody else made.
Descriptor make_new(const std::string& path) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  const int file = ::open(path.c_str(), kFlags, 0666);
  if (file >= 0 || errno != EEXIST) return Descriptor(file);
  ::unlink(path.c_str());  // left by a killed process with the same number
  return Descriptor(::open(path.c_str(), kFlags, 0666));
}

// Gives the new file the owner and permissions of the old one, as far as the file system and our rights allow it.
void take_over_permissions(int file, const struct stat& old) {
  [[maybe_unused]] const int given = ::fchown(file, old.st_uid, old.st_gid);
  [[maybe_unused]] const int allowed = ::fchmod(file, old.st_mode & 0777);
}

bool fill(Descriptor& file, std::string_view bytes, const struct stat* old) {
  if (!file.ok()) return false;
  if (old != nullptr) take_over_permissions(file.number(), *old);
  return write_all(file.number(), bytes) && file.close();
}

// Returns true if the path occurs in the text as a separate word: the letter "a" occurs in every text.
bool names(const std::string& text, const std::string& path) {
  const auto ends = [&](std::size_t at) { return at >= text.size() || std::strchr(" :;,", text[at]) != nullptr; };
  for (std::size_t at = text.find(path); at != text.npos; at = text.find(path, at + 1))
    if ((at == 0 || text[at - 1] == ' ') && ends(at + path.size())) return true;
  return false;
}

}  // namespace

Issue unwritable(const std::string& path, const std::string& why) {
  return {"file.unwritable", "", "cannot write " + path + ": " + why};
}

std::string_view kind_of_mode(unsigned mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a named pipe (FIFO)";
  if (S_ISSOCK(mode)) return "a socket";
  if (S_ISCHR(mode)) return "a device";
  if (S_ISBLK(mode)) return "a disk (block device)";
  return S_ISLNK(mode) ? "a symbolic link" : "a plain file";
}

Issue about_file(const std::string& path, Issue issue) {
  if (!names(issue.text, path)) issue.text = path + ": " + issue.text;
  return issue;
}

Result<std::string> read_file(const std::string& path, std::size_t max_bytes) {
  struct stat found {};
  const Result<Descriptor> file = open_of_kind(path, is_plain, found);
  if (!file) return file.issue();
  return read_plain(*file, found, path, max_bytes);
}

std::string beginning_of(const std::string& path, std::size_t bytes) {
  struct stat found {};
  const Result<Descriptor> file = open_of_kind(path, is_plain, found);
  std::string head(file ? bytes : 0, '\0');
  const ssize_t got = file ? ::read(file->number(), head.data(), head.size()) : 0;
  head.resize(static_cast<std::size_t>(std::max(ssize_t{0}, got)));
  return head;
}

Result<std::string> read_named_file(const std::string& path, std::size_t max_bytes) {
  struct stat found {};
  const Result<Descriptor> file = open_of_kind(path, is_plain_or_pipe, found);
  if (!file) return file.issue();
  if (S_ISFIFO(found.st_mode)) return read_pipe(file->number(), path, max_bytes);
  return read_plain(*file, found, path, max_bytes);
}

Result<Done> write_file(const std::string& path, std::string_view bytes) {
  struct stat old {};
  const bool was_there = ::lstat(path.c_str(), &old) == 0;
  if (was_there && !S_ISREG(old.st_mode) && !S_ISLNK(old.st_mode))
    return unwritable(path, "it is " + std::string(kind_of_mode(old.st_mode)));
  // The process id separates two processes that write into the same folder. The rename is atomic within a folder.
  const std::string temporary = path + "." + std::to_string(::getpid()) + ".part";
  Descriptor file = make_new(temporary);
  const bool replaces = was_there && S_ISREG(old.st_mode);
  if (fill(file, bytes, replaces ? &old : nullptr) && ::rename(temporary.c_str(), path.c_str()) == 0) return Done{};
  const std::string why = reason(path);
  ::unlink(temporary.c_str());
  return unwritable(path, why);
}

Result<Done> make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return unwritable(path, error.message());
  return Done{};
}

}  // namespace contort
