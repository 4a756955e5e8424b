// A folder for the files of one run of the server. It is removed when the run ends; the next run removes the folder
// of a run that was killed.
#pragma once

#include <memory>
#include <string>

#include "model/core/result.h"

namespace contort::server {

class Scratch {
 public:
  // Makes a new folder in `parent`, or in the machine's folder for temporary files if that is "". It first removes
  // folders of ended runs of the same user. Call it after forking: a forked process would inherit the lock and keep the
  // folder of an ended run. Code file.unwritable.
  static Result<std::unique_ptr<Scratch>> make(std::string parent = "");
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::string& path() const { return path_; }
  std::string folder(const std::string& name) const { return path_ + "/" + name; }

 private:
  Scratch(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}
  std::string path_;
  int lock_;  // file descriptor of the folder, locked as long as it is open
};

}  // namespace contort::server
