// Files that pages load, from folders of ours.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "model/core/result.h"

namespace contort::server {

// Reads a plain file below `folder`, without following links or "..". `path` is the relative path of a request. Code
// call.not_found, whatever the reason, so that a client cannot learn which other files exist.
Result<std::string> read_below(const std::string& folder, const std::string& path);

// A plain file that is read piece by piece, so that it is never in memory as a whole, even if a client receives it
// slowly.
class PlainFile {
 public:
  PlainFile() = default;
  ~PlainFile();
  PlainFile(const PlainFile&) = delete;
  PlainFile& operator=(const PlainFile&) = delete;

  std::size_t left() const { return left_; }
  // Returns the next bytes; "" at the end.
  std::string read(std::size_t most);

 private:
  friend Result<std::shared_ptr<PlainFile>> open_below(const std::string& folder, const std::string& path);
  int number_ = -1;
  std::size_t left_ = 0;
};
Result<std::shared_ptr<PlainFile>> open_below(const std::string& folder, const std::string& path);

// Returns the media type by the file's extension; application/octet-stream for unknown ones.
std::string type_of(const std::string& path);

}  // namespace contort::server
