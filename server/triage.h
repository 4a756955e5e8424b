// The operations on a corpus that a server offers to people.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "server/jobs.h"

namespace contort::server {

class Triage {
 public:
  // `program` is the command line of contort with the options that all commands accept. `scratch` is a folder for
  // temporary files, made when it is needed.
  Triage(std::string folder, std::vector<std::string> program, std::string scratch)
      : folder_(std::move(folder)), program_(std::move(program)), scratch_(std::move(scratch)) {}

  const std::string& folder() const { return folder_; }

  // Returns the buckets as JSON; `today` decides which of them gate. Buckets are found by the names of their folders.
  // Codes corpus.*.
  Result<std::string> list(const std::string& today) const;
  Result<std::string> show(const std::string& bucket, const std::string& today) const;

  // Changes a bucket and returns its new state as JSON, after it is on disk. Codes bucket.*, file.unwritable.
  Result<std::string> change(const std::string& bucket, const Corpus::Change& change, const std::string& today) const;

  // Stores a case that a session showed. Returns {bucket, is_new}.
  Result<std::string> keep(const Case& shown) const;

  Result<Jobs::Work> replay_work(const std::string& bucket) const;
  // Returns work that shrinks a bucket's case and stores the result. It removes a bucket that contained only the
  // unshrunk case of a session.
  Result<Jobs::Work> shrink_work(const std::string& bucket) const;
  Jobs::Work report_work(const std::string& into) const;

  // Returns a text that changes whenever a bucket changes.
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
