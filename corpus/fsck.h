// Whether a corpus' files are what they should be, and how they are mended. Nothing that a person may need is deleted:
// it moves to DIR/invalid/, under the path that it had. Nothing outside of the corpus is read, moved or written: a
// field that names a file elsewhere is replaced, and a link that leads out moves as a link.
#pragma once

#include <string>
#include <vector>

#include "corpus/corpus.h"

namespace contort {

struct CorpusFault {
  std::string path;    // below the corpus' folder
  std::string code;    // temporary, missing_case, wrong_name, wrong_folder, unknown_file, unreadable, bad_name, outside
  std::string text;    // what is wrong
  std::string mended;  // what was done about it; "" where nothing was
  bool operator==(const CorpusFault&) const = default;
};

// By path. With `repair` nobody else writes meanwhile; code file.unwritable where mending fails.
Result<std::vector<CorpusFault>> check_files(const Corpus& corpus, bool repair);

}  // namespace contort
