#include "fuzz/ddmin.h"

#include <algorithm>

namespace contort {

namespace {

// Tries to remove one chunk after the other. Returns how many chunks are left.
int remove_chunks(int chunks, const std::function<int()>& count, const std::function<bool(int, int)>& remove) {
  for (int c = 0; c < chunks && count() > 1;) {
    const int first = c * count() / chunks, end = (c + 1) * count() / chunks;
    if (chunks > 1 && remove(first, end - first))
      --chunks;  // the next chunk now has this index
    else
      ++c;
  }
  return chunks;
}

}  // namespace

void ddmin(const std::function<int()>& count, const std::function<bool(int first, int n)>& remove) {
  if (count() == 0 || remove(0, count())) return;
  for (int chunks = 2; count() > 1;) {
    const int left = remove_chunks(chunks, count, remove);
    if (left == chunks && chunks >= count()) return;
    chunks = std::clamp(left == chunks ? 2 * chunks : left, 2, std::max(2, count()));
  }
}

}  // namespace contort
