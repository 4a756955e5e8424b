// A folder for the files of one run of the server. It goes with the run; of a run that was killed, the next run takes
// it away.
#pragma once

#include <memory>
#include <string>

#include "model/core/result.h"

namespace contort::server {

class Scratch {
 public:
  // A new folder in `parent`, that of this machine for such files where it is "". First removes those that runs of the
  // same user left there and nobody has any more. Made after processes were forked: what they inherit would keep the
  // folder of a run that has ended. Code file.unwritable.
  static Result<std::unique_ptr<Scratch>> make(std::string parent = "");
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::string& path() const { return path_; }
  std::string folder(const std::string& name) const { return path_ + "/" + name; }

 private:
  Scratch(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}
  std::string path_;
  int lock_;  // the folder itself, locked for as long as it is open
};

}  // namespace contort::server
