#include "corpus/fsck.h"

#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "corpus/fsck_files.h"
#include "corpus/lock.h"
#include "corpus/runs.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort {

namespace fs = std::filesystem;

void FaultList::add(const std::string& path, const std::string& code, const std::string& text, const Mend& mend) {
  CorpusFault fault{fs::path(path).lexically_relative(root_).string(), code, text, ""};
  if (repair_ && ok()) {
    const Result<std::string> done = mend();
    if (done)
      fault.mended = *done;
    else
      issue_ = done.issue();
  }
  faults_.push_back(std::move(fault));
}

void FaultList::add_unread(const std::string& path, const Issue& why, const Mend& mend) {
  add(path, is_outside(why) ? "outside" : "unreadable", to_line(why), mend);
}

void FaultList::mend(const Mend& mend) {
  if (!repair_ || !ok()) return;
  if (const Result<std::string> done = mend(); !done) issue_ = done.issue();
}

Result<std::string> FaultList::move_aside(const std::string& path) const {
  const std::string below = fs::path(path).lexically_relative(root_).string();
  std::string target = root_ + "/invalid/" + below;
  std::error_code error;
  for (int n = 2; fs::exists(fs::symlink_status(target, error)); ++n)
    target = root_ + "/invalid/" + below + "." + std::to_string(n);
  const std::string parent = fs::path(target).parent_path().string();
  for (const std::string& folder : {fs::path(path).parent_path().string(), parent})
    if (const Result<Done> inside = check_inside(root_, folder); !inside) return inside.issue();
  if (const Result<Done> made = make_folder(parent); !made) return made.issue();
  fs::rename(path, target, error);
  if (error) return Issue{"file.unwritable", "", "cannot move " + path + ": " + error.message()};
  return "moved to " + fs::path(target).lexically_relative(root_).string();
}

Result<std::vector<CorpusFault>> FaultList::take() {
  if (!ok()) return issue_;
  std::ranges::stable_sort(faults_, {}, &CorpusFault::path);
  return std::move(faults_);
}

bool is_link(const std::string& path) {
  std::error_code error;
  return fs::is_symlink(fs::symlink_status(path, error));
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

namespace {

// The process that writes "x.json.1234.part"; nothing for other names.
std::optional<pid_t> writer_of(const std::string& name) {
  if (!name.ends_with(".part")) return {};
  const std::string stem = name.substr(0, name.size() - 5);
  const std::string digits = stem.substr(stem.rfind('.') + 1);
  if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) return {};
  return static_cast<pid_t>(std::atoi(digits.c_str()));
}

bool is_running(pid_t process) { return ::kill(process, 0) == 0 || errno == EPERM; }

void check_temporaries(const std::string& root, FaultList& faults) {
  std::vector<std::string> left;
  for (const char* sub : {"buckets", "leads", "runs"}) {
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(root + "/" + sub, error)) {
      const std::optional<pid_t> writer = writer_of(entry.path().filename().string());
      const bool is_file = entry.is_symlink() || entry.is_regular_file();
      if (writer && !is_running(*writer) && is_file) left.push_back(entry.path().string());
    }
  }
  std::ranges::sort(left);
  for (const std::string& path : left)
    faults.add(path, "temporary", "left by a process that was stopped while it wrote", [&]() -> Result<std::string> {
      std::error_code error;
      fs::remove(path, error);
      if (error) return Issue{"file.unwritable", "", "cannot remove " + path + ": " + error.message()};
      return std::string("removed");
    });
}

Result<Done> read_record(const std::string& path) {
  if (const Result<std::string> text = read_file(path, json_fields::kMaxDocumentBytes); !text) return text.issue();
  const Result<RunRecord> record = read_run(path);
  if (!record) return record.issue();
  return Done{};
}

Result<Done> check_lead(const std::string& path) {
  const fs::path file(path), folder = file.parent_path();
  const Result<Case> lead = read_case_of(folder.parent_path().string(), (folder.filename() / file.filename()).string());
  if (!lead) return lead.issue();
  return Done{};
}

// Checks files below runs/ and leads/.
void check_plain(const std::string& folder, Result<Done> (*read)(const std::string&), FaultList& faults) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error))
    if ((entry.is_symlink() || !entry.is_directory()) && !writer_of(entry.path().filename().string()))
      paths.push_back(entry.path().string());
  std::ranges::sort(paths);
  for (const std::string& path : paths) {
    const auto aside = [&] { return faults.move_aside(path); };
    const bool is_of_run = path.ends_with(".state") || path.ends_with(".lock");  // its run continues, or was stopped
    if (const Result<Done> inside = check_inside(folder, path); !inside)
      faults.add_unread(path, inside.issue(), aside);
    else if (is_of_run)
      continue;
    else if (!path.ends_with(".json"))
      faults.add(path, "unknown_file", "is no file of a corpus", aside);
    else if (const Result<Done> good = read(path); !good)
      faults.add_unread(path, good.issue(), aside);
  }
}

}  // namespace

Result<std::vector<CorpusFault>> check_files(const Corpus& corpus, bool repair) {
  std::optional<Result<CorpusLock>> lock;
  if (repair) lock.emplace(CorpusLock::take(corpus.folder()));
  if (lock && !*lock) return lock->issue();
  FaultList faults(corpus.folder(), repair);
  check_temporaries(corpus.folder(), faults);
  const std::string buckets = corpus.folder() + "/buckets";
  for (const std::string& name : names_in(buckets)) {
    const std::string path = buckets + "/" + name;
    if (std::error_code error; fs::is_directory(fs::symlink_status(path, error)))
      check_bucket_folder(corpus, name, faults);
    else if (!writer_of(name))
      faults.add(path, "unknown_file",
                 is_link(path) ? "is a link, and no folder of a bucket" : "is no folder of a bucket",
                 [&] { return faults.move_aside(path); });
  }
  check_plain(corpus.folder() + "/runs", read_record, faults);
  check_plain(corpus.folder() + "/leads", check_lead, faults);
  return faults.take();
}

}  // namespace contort
