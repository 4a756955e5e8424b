// The corpus, as a server lets people work on it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "server/jobs.h"

namespace contort::server {

class Triage {
 public:
  // `program` is how contort is called, with the options that all its commands take; `scratch` is a folder for files
  // that pass, made when it is needed.
  Triage(std::string folder, std::vector<std::string> program, std::string scratch)
      : folder_(std::move(folder)), program_(std::move(program)), scratch_(std::move(scratch)) {}

  const std::string& folder() const { return folder_; }

  // JSON; `today` for what gates. Buckets are found by the names of their folders. Codes corpus.*.
  Result<std::string> list(const std::string& today) const;
  Result<std::string> show(const std::string& bucket, const std::string& today) const;

  // Returns the bucket as it is afterwards, as JSON; it is on the disk by then. Codes bucket.*, file.unwritable.
  Result<std::string> change(const std::string& bucket, const Corpus::Change& change, const std::string& today) const;

  // A case that a session showed: {bucket, is_new}.
  Result<std::string> keep(const Case& shown) const;

  Result<Jobs::Work> replay_work(const std::string& bucket) const;
  // Also stores what comes out of it; a bucket that held only what a session showed, as it was, goes.
  Result<Jobs::Work> shrink_work(const std::string& bucket) const;
  Jobs::Work report_work(const std::string& into) const;

  // Changes whenever a bucket does.
  std::string revision() const;

 private:
  Result<Bucket> find(const Corpus& corpus, const std::string& name) const;
  Result<Jobs::Outcome> shrink(const std::string& bucket, Jobs::Running& running) const;
  Result<Jobs::Outcome> store(const Corpus& corpus, const Bucket& from, const Case& original,
                              const Case& minimal) const;

  std::string folder_;
  std::vector<std::string> program_;
  std::string scratch_;
};

}  // namespace contort::server
