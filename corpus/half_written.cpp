#include "corpus/half_written.h"

#include <filesystem>
#include <vector>

#include "corpus/lock.h"
#include "model/core/inside_folder.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

// Removes files whose names begin like this, in a folder and all folders below it.
void drop_below(const std::string& folder, const std::string& begin) {
  std::error_code ignored;
  std::vector<fs::path> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (entry.path().extension() == ".part" && entry.path().filename().string().starts_with(begin))
      left.push_back(entry.path());
  for (const fs::path& path : left) fs::remove(path, ignored);
}

}  // namespace

Result<Done> drop_half_written(const Corpus& corpus, const RunRecord& run) {
  const Result<CorpusLock> lock = CorpusLock::take(corpus.folder());
  if (!lock) return lock.issue();
  drop_below(corpus.folder() + "/buckets", "");
  for (const char* ending : {".json.", ".state."}) drop_below(corpus.folder() + "/runs", record_name(run) + ending);
  const std::string leads = corpus.folder() + "/leads/" + run.name;
  if (run.shards == 1 && check_inside(corpus.folder(), leads)) drop_below(leads, "");
  return Done{};
}

}  // namespace contort
