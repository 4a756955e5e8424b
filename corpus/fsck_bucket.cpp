// The part of fsck that checks the folder of one bucket.
#include <algorithm>
#include <filesystem>

#include "corpus/bucket_files.h"
#include "corpus/fsck_files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

struct Role {
  const char* name;
  std::string Bucket::*file;
};
constexpr Role kRoles[] = {{"min", &Bucket::min}, {"worst", &Bucket::worst}, {"orig", &Bucket::orig}};

class BucketFolder {
 public:
  BucketFolder(std::string folder, FaultList& faults) : folder_(std::move(folder)), faults_(faults) {}

  void check() {
    if (!load()) return;
    const Bucket before = bucket_;
    for (const Role& role : kRoles) check_case(role);
    if (files_of(bucket_).empty())
      return faults_.add(folder_, "missing_case", "holds no case that can be read", aside(folder_));
    replace_missing();
    // A replacement with the same spec has the same name as the missing file, so copies are checked too.
    if (bucket_ != before || !copies_.empty()) write();
    check_unknown();
    check_name();
  }

 private:
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  FaultList::Mend aside(const std::string& path) const {
    return [this, path] { return faults_.move_aside(path); };
  }

  // Reads bucket.json. If it is unreadable, or names files that are no cases of this folder, the bucket is rebuilt from
  // the cases. Returns false if there is none.
  bool load() {
    const Result<Bucket> stored = read_bucket(folder_);
    if (stored) return bucket_ = *stored, true;
    const Issue& why = stored.issue();
    if (!rebuild()) return faults_.add_unread(folder_, why, aside(folder_)), false;
    const Result<Bucket> known = why.code == "bucket.bad_name" ? read_bucket_without_bad_names(folder_) : stored;
    if (known) keep_what_is_known(*known);
    const std::string how =
        known ? "named anew from the cases; its state stays" : "made anew from the cases; its state is new";
    const FaultList::Mend mend = [&]() -> Result<std::string> { return replace_bucket_file(how); };
    if (known)
      faults_.add(path("bucket.json"), "bad_name", to_line(why), mend);
    else
      faults_.add_unread(path("bucket.json"), why, mend);
    return true;
  }

  // Keeps valid names, and all fields that people and replays set. The rebuilt bucket replaces the rest.
  void keep_what_is_known(Bucket known) {
    for (const Role& role : kRoles)
      if ((known.*role.file).empty()) known.*role.file = bucket_.*role.file;
    if (known.id.empty()) {
      known.id = bucket_.id, known.check = bucket_.check, known.family = bucket_.family;
      known.features = bucket_.features, known.signature = bucket_.signature;
    }
    bucket_ = std::move(known);
  }

  Result<std::string> replace_bucket_file(const std::string& how) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(path("bucket.json"), error)))
      if (const Result<std::string> moved = faults_.move_aside(path("bucket.json")); !moved) return moved;
    if (const Result<Done> written = write_bucket(folder_, bucket_); !written) return written.issue();
    return how;
  }

  bool rebuild() {
    for (const Role& role : kRoles)
      for (const std::string& name : names_in(folder_)) {
        if (!name.starts_with(std::string(role.name) + "-") || !name.ends_with(".json")) continue;
        const Result<Case> stored = read_case_of(folder_, name);
        if (!stored || case_file_name(role.name, stored->spec) != name) continue;
        if (bucket_.id.empty()) bucket_ = bucket_of(*stored);
        bucket_.*role.file = name;
        break;
      }
    return !bucket_.id.empty();
  }

  void check_case(const Role& role) {
    std::string& file = bucket_.*role.file;
    if (file.empty()) return;
    const std::string full = path(file);
    const Result<Case> stored = read_case_of(folder_, file);
    std::error_code error;
    if (!fs::exists(fs::symlink_status(full, error)))
      faults_.add(full, "missing_case", "bucket.json names it, but it is not there",
                  [] { return std::string("taken out of bucket.json"); });
    else if (!stored)
      faults_.add_unread(full, stored.issue(), aside(full));
    else if (family_of(*stored) != bucket_.family)
      faults_.add(full, "wrong_name", "its family is " + print_family(family_of(*stored)), aside(full));
    else if (const std::string name = case_file_name(role.name, stored->spec); name != file)
      return rename_case(full, name, file);
    else
      return;
    listed_.push_back(full);
    file.clear();
  }

  Result<Done> copy(const std::string& from, const std::string& to) const {
    const Result<std::string> bytes = read_inside(folder_, from, json_fields::kMaxDocumentBytes);
    if (!bytes) return bytes.issue();
    return write_inside(folder_, to, *bytes);
  }

  void rename_case(const std::string& full, const std::string& name, std::string& file) {
    faults_.add(full, "wrong_name", "its spec belongs to the name " + name, [&]() -> Result<std::string> {
      // Copies first, because bucket.json still has the old name.
      if (const Result<Done> copied = copy(fs::path(full).filename().string(), name); !copied) return copied.issue();
      renamed_.push_back(full);
      return "renamed to " + name;
    });
    listed_.push_back(full);
    file = name;
  }

  // People read the min and worst case of a bucket. If one is missing, another case replaces it, even an unshrunk one.
  void replace_missing() {
    const std::string stand_in = files_of(bucket_).front();
    for (const Role& role : {kRoles[0], kRoles[1]}) {
      std::string& file = bucket_.*role.file;
      if (!file.empty()) continue;
      const Result<Case> stored = read_case_of(folder_, stand_in);
      if (!stored) continue;  // not repaired
      file = case_file_name(role.name, stored->spec);
      copies_.emplace_back(stand_in, file);
    }
  }

  void write() {
    faults_.mend([&]() -> Result<std::string> {
      for (const auto& [from, to] : copies_)
        if (const Result<Done> copied = copy(from, to); !copied) return copied.issue();
      if (const Result<Done> written = write_bucket(folder_, bucket_); !written) return written.issue();
      std::error_code ignored;
      for (const std::string& old : renamed_) fs::remove(old, ignored);
      return std::string();
    });
  }

  void check_unknown() {
    const std::vector<std::string> named = files_of(bucket_);
    for (const std::string& name : names_in(folder_)) {
      const bool known = name == "bucket.json" || name.ends_with(".part") || std::ranges::count(named, name) > 0;
      const bool handled = std::ranges::count(listed_, path(name)) > 0;
      if (!known && !handled)
        faults_.add(path(name), "unknown_file", "bucket.json does not name it", aside(path(name)));
    }
  }

  void check_name() {
    const std::string right = folder_name(bucket_);
    if (fs::path(folder_).filename() == right) return;
    faults_.add(folder_, "wrong_folder", "it belongs to " + right, [&]() -> Result<std::string> {
      const std::string target = (fs::path(folder_).parent_path() / right).string();
      std::error_code error;
      if (fs::exists(fs::symlink_status(target, error))) return faults_.move_aside(folder_);
      fs::rename(folder_, target, error);
      if (error) return Issue{"file.unwritable", "", "cannot rename " + folder_ + ": " + error.message()};
      return "renamed to buckets/" + right;
    });
  }

  std::string folder_;
  FaultList& faults_;
  Bucket bucket_;
  std::vector<std::string> listed_;                          // cases whose fault is already listed
  std::vector<std::string> renamed_;                         // old names, removed once bucket.json is written
  std::vector<std::pair<std::string, std::string>> copies_;  // from, to
};

}  // namespace

void check_bucket_folder(const Corpus& corpus, const std::string& name, FaultList& faults) {
  BucketFolder(corpus.folder() + "/buckets/" + name, faults).check();
}

}  // namespace contort
