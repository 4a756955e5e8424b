#include "generator/core/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace contort {

namespace {

Issue too_large(const std::string& path, std::size_t max_bytes) {
  return {"file.too_large", "", path + " is larger than the allowed " + std::to_string(max_bytes) + " bytes"};
}

Issue unwritable(const std::string& path, const std::string& why) {
  return {"file.unwritable", "", "cannot write " + path + ": " + why};
}

}  // namespace

Result<std::string> read_file(const std::string& path, std::size_t max_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return Issue{"file.unreadable", "", path + " is a folder"};
  std::ifstream file(path, std::ios::binary);
  if (!file) return Issue{"file.unreadable", "", "cannot read " + path + ": " + std::strerror(errno)};
  std::string bytes;
  if (const auto size = std::filesystem::file_size(path, error); !error && size <= max_bytes) bytes.reserve(size);
  char block[65536];
  while (file.read(block, sizeof block) || file.gcount() > 0) {
    bytes.append(block, static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > max_bytes) return too_large(path, max_bytes);
  }
  if (file.bad()) return Issue{"file.unreadable", "", "cannot read " + path + ": " + std::strerror(errno)};
  return bytes;
}

Result<std::string> read_regular_file(const std::string& path, std::size_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return Issue{"file.unreadable", "", "there is no file " + path};
  if (std::filesystem::file_size(path, error) > max_bytes) return too_large(path, max_bytes);
  return read_file(path, max_bytes);
}

Result<Done> write_file(const std::string& path, std::string_view bytes) {
  // The process id keeps two processes that write the same folder apart; the rename is atomic within one folder.
  const std::string temporary = path + "." + std::to_string(::getpid()) + ".part";
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
      const std::string why = std::strerror(errno);
      std::error_code ignored;
      std::filesystem::remove(temporary, ignored);
      return unwritable(path, why);
    }
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (!error) return Done{};
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  return unwritable(path, error.message());
}

Result<Done> make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return unwritable(path, error.message());
  return Done{};
}

}  // namespace contort
