// Files that pages load, from folders of ours.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "model/core/result.h"

namespace contort::server {

// A plain file below `folder`, whose way there has neither links nor "..". `path` is what a request asked for,
// relative. Code call.not_found, whatever the reason: who asks learns nothing of what else there is.
Result<std::string> read_below(const std::string& folder, const std::string& path);

// The same file, to be read piece by piece: however slowly somebody takes it, it is not in memory meanwhile.
class PlainFile {
 public:
  PlainFile() = default;
  ~PlainFile();
  PlainFile(const PlainFile&) = delete;
  PlainFile& operator=(const PlainFile&) = delete;

  std::size_t left() const { return left_; }
  // The next bytes; "" at its end.
  std::string read(std::size_t most);

 private:
  friend Result<std::shared_ptr<PlainFile>> open_below(const std::string& folder, const std::string& path);
  int number_ = -1;
  std::size_t left_ = 0;
};
Result<std::shared_ptr<PlainFile>> open_below(const std::string& folder, const std::string& path);

// By the ending; application/octet-stream for those that are not known.
std::string type_of(const std::string& path);

}  // namespace contort::server
