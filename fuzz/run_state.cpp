#include "fuzz/run_state.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>

#include "fuzz/state_fields.h"
#include "model/core/inside_folder.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostStateBytes = std::size_t{256} << 20;

std::string path_of(const Corpus& corpus, const RunRecord& record, const std::string& ending) {
  return corpus.folder() + "/runs/" + record_name(record) + ending;
}

// Returns true if the locked file still exists at this path. The holder of a lock removes its file at the end, and a
// lock on a removed file protects nothing.
bool is_still_there(int file, const std::string& path) {
  struct stat held {
  }, present{};
  return ::fstat(file, &held) == 0 && ::stat(path.c_str(), &present) == 0 && held.st_ino == present.st_ino;
}

}  // namespace

namespace {

// Replaces the folder of each lead by this corpus: the folder may have another name than when the run was stopped, or
// be a copy.
Result<Done> take_paths_here(const Corpus& corpus, std::vector<std::string>& leads) {
  for (std::size_t i = 0; i < leads.size(); ++i) {
    const fs::path lead(leads[i]), run = lead.parent_path().filename();
    const Result<std::string> here =
        place_inside(corpus.folder(), "leads/" + run.string() + "/" + lead.filename().string());
    if (!here) return Issue{here.issue().code, "/unconfirmed/" + std::to_string(i), here.issue().text};
    leads[i] = *here;
  }
  return Done{};
}

// Checks that the names in the state belong to this run and this corpus.
Result<Done> check_names(const Corpus& corpus, const RunRecord& record, RunState& state) {
  if (record_name(state.record) != record_name(record))
    return Issue{"state.other_run", "/record/name", "found the run " + record_name(state.record)};
  return take_paths_here(corpus, state.unconfirmed);
}

}  // namespace

std::string state_path(const Corpus& corpus, const RunRecord& record) { return path_of(corpus, record, ".state"); }

Result<Done> keep_state(const Corpus& corpus, const RunState& state) {
  return write_inside(corpus.folder() + "/runs", record_name(state.record) + ".state",
                      json_fields::write_canonical(state));
}

Result<std::optional<RunState>> load_state(const Corpus& corpus, const RunRecord& record, const std::string& plan) {
  const std::string path = state_path(corpus, record);
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return std::optional<RunState>();
  const Result<std::string> text = read_beside(path, kMostStateBytes);
  if (!text) return text.issue();
  Result<RunState> read = json_fields::read_document<RunState>(*text, "state");
  const auto refused = [&](const Issue& why) {
    return Issue{why.code, why.pointer, path + ": " + why.text + "; remove the file to begin the run anew"};
  };
  if (!read) return refused(read.issue());
  RunState state = std::move(read).value();
  if (const Result<Done> own = check_names(corpus, record, state); !own) return refused(own.issue());
  if (state.plan != plan || state.islands.size() != static_cast<std::size_t>(kIslands) ||
      state.ingredients.size() != static_cast<std::size_t>(kIslands))
    return Issue{"state.other_plan", "", path + " is of a run with other options; remove it to begin anew"};
  return std::optional<RunState>(std::move(state));
}

void drop_state(const Corpus& corpus, const RunRecord& record) {
  std::error_code ignored;
  fs::remove(state_path(corpus, record), ignored);
}

std::int64_t unsettled_failures(const Corpus& corpus) {
  std::int64_t count = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(corpus.folder() + "/runs", error)) {
    if (entry.path().extension() != ".state") continue;
    const Result<std::string> text = read_beside(entry.path().string(), kMostStateBytes);
    if (!text) continue;
    const Result<RunState> state = json_fields::read_document<RunState>(*text, "state");
    if (state) count += std::ssize(state->wanted);
  }
  return count;
}

Result<RunLock> RunLock::take(const Corpus& corpus, const RunRecord& record) {
  const std::string path = path_of(corpus, record, ".lock");
  for (;;) {
    const int file = ::open(path.c_str(), O_CREAT | O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    if (file < 0) return Issue{"file.unwritable", "", path + " cannot be written, or is a link"};
    RunLock lock(file, path);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
      lock.path_.clear();  // the file belongs to another process
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
