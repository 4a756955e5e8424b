#include "fuzz/run_state.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "fuzz/case_fields.h"
#include "generator/core/files.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

std::string path_of(const Corpus& corpus, const RunRecord& record, const std::string& ending) {
  return corpus.folder() + "/runs/" + record_name(record) + ending;
}

// Whoever holds a lock removes its file at the end: a lock on a file that is no longer there is worth nothing.
bool is_still_there(int file, const std::string& path) {
  struct stat held {
  }, present{};
  return ::fstat(file, &held) == 0 && ::stat(path.c_str(), &present) == 0 && held.st_ino == present.st_ino;
}

}  // namespace

std::string state_path(const Corpus& corpus, const RunRecord& record) { return path_of(corpus, record, ".state"); }

Result<Done> keep_state(const Corpus& corpus, const RunState& state) {
  return write_file(state_path(corpus, state.record), json_fields::write_canonical(state));
}

Result<std::optional<RunState>> load_state(const Corpus& corpus, const RunRecord& record, const std::string& plan) {
  const std::string path = state_path(corpus, record);
  if (std::error_code error; !fs::exists(path, error)) return std::optional<RunState>();
  const Result<std::string> text = read_file(path);
  if (!text) return text.issue();
  Result<RunState> state = json_fields::read_document<RunState>(*text, "state");
  if (!state) return Issue{state.issue().code, state.issue().pointer, path + ": " + state.issue().text};
  if (state->plan != plan || state->islands.size() != static_cast<std::size_t>(kIslands))
    return Issue{"state.other_plan", "", path + " is of a run with other options; remove it to begin anew"};
  return std::optional<RunState>(std::move(state).value());
}

void drop_state(const Corpus& corpus, const RunRecord& record) {
  std::error_code ignored;
  fs::remove(state_path(corpus, record), ignored);
}

Result<RunLock> RunLock::take(const Corpus& corpus, const RunRecord& record) {
  const std::string path = path_of(corpus, record, ".lock");
  for (;;) {
    const int file = ::open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (file < 0) return Issue{"file.unwritable", "", path + " cannot be written"};
    RunLock lock(file, path);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
      lock.path_.clear();  // it is another's
      return Issue{"run.busy", "",
                   "another process is doing the run " + record_name(record) + " in " + corpus.folder()};
    }
    if (is_still_there(file, path)) return lock;
    lock.path_.clear();
  }
}

RunLock::RunLock(RunLock&& other) noexcept : file_(other.file_), path_(std::move(other.path_)) { other.file_ = -1; }

RunLock::~RunLock() {
  if (file_ < 0) return;
  if (!path_.empty()) ::unlink(path_.c_str());
  ::close(file_);
}

}  // namespace contort
