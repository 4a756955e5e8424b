// Checks the files of a corpus and repairs them. Nothing that a person may need is deleted: it moves to DIR/invalid/,
// under the same path. Nothing outside of the corpus is read, moved or written: a field that names a file elsewhere is
// replaced, and a link that leads out is moved as a link.
#pragma once

#include <string>
#include <vector>

#include "corpus/corpus.h"

namespace contort {

struct CorpusFault {
  std::string path;    // below the corpus' folder
  std::string code;    // temporary, missing_case, wrong_name, wrong_folder, unknown_file, unreadable, bad_name, outside
  std::string text;    // the fault, in words
  std::string mended;  // the repair; "" if there was none
  bool operator==(const CorpusFault&) const = default;
};

// Returns the faults, sorted by path. With `repair` it holds the corpus' lock. Code file.unwritable if a repair
// fails.
Result<std::vector<CorpusFault>> check_files(const Corpus& corpus, bool repair);

}  // namespace contort
