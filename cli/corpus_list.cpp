#include "cli/corpus_list.h"

#include <algorithm>
#include <map>
#include <set>

#include "cli/print.h"
#include "corpus/causes.h"
#include "corpus/lifecycle.h"
#include "corpus/sides.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

class CorpusList {
 public:
  explicit CorpusList(const ListedCorpus& listed) : listed_(listed), buckets_(listed.buckets) {
    if (listed.fold_sides)
      for (const std::vector<std::size_t>& group : without_sides(buckets_)) fold(group);
  }

  std::string text() {
    std::vector<Bucket> unfixed = buckets_;
    std::erase_if(unfixed, [](const Bucket& bucket) { return bucket.state == BucketState::fixed; });
    std::vector<Issue> unread;
    const std::vector<CauseRow> rows =
        causes_of(cause_members(listed_.corpus, std::move(unfixed), unread), runs_of(listed_.corpus, unread));
    for (std::size_t i = 0; i < rows.size(); ++i) add_cause(rows[i], i + 1);
    add_others("Failures whose smallest case cannot be read:", false);
    add_others("Fixed failures:", true);
    return out_ + last_line(rows.size());
  }

 private:
  // The line of the first bucket names the others.
  void fold(const std::vector<std::size_t>& group) {
    for (std::size_t i = 1; i < group.size(); ++i) {
      const Bucket& other = buckets_[group[i]];
      others_[buckets_[group.front()].id] += (i == 1 ? "  other side: " : ", ") + other.id + gates_text(other);
      shown_.insert(other.id);
    }
  }

  std::string gates_text(const Bucket& bucket) const {
    return is_gating(bucket, listed_.today) ? ", fails the build" : "";
  }

  void add_line(const Bucket& bucket) {
    if (!shown_.insert(bucket.id).second) return;
    std::string state(state_name(bucket.state));
    state.resize(std::max<std::size_t>(state.size(), 11), ' ');
    const Family& family = bucket.family;
    out_ += "    " + state + "  " + bucket.id + "  " + printable(family.check) +
            (family.subject.empty() ? "" : " of " + printable(family.subject)) +
            (family.character.empty() ? "" : ", " + printable(family.character)) + gates_text(bucket);
    if (const std::string known = known_text(bucket, listed_.today); !known.empty()) out_ += "  " + printable(known);
    out_ += others_[bucket.id] + "\n";
  }

  void add_cause(const CauseRow& row, std::size_t place) {
    const bool has_line = std::ranges::any_of(
        row.members, [&](const CauseMember& member) { return !shown_.contains(member.bucket.id); });
    const std::string other_sides = has_line ? "" : "  (its failures are the other sides of those above)";
    out_ += std::to_string(place) + ". " + printable(row.headline) + "\n    cause " + row.id + other_sides + "\n";
    for (const CauseMember& member : row.members) add_line(member.bucket);
  }

  void add_others(const char* title, bool fixed) {
    const auto is_left = [&](const Bucket& bucket) {
      return (bucket.state == BucketState::fixed) == fixed && !shown_.contains(bucket.id);
    };
    if (std::ranges::none_of(buckets_, is_left)) return;
    out_ += std::string(title) + "\n";
    for (const Bucket& bucket : buckets_)
      if (is_left(bucket)) add_line(bucket);
  }

  std::string last_line(std::size_t causes) const {
    const auto gating =
        std::ranges::count_if(buckets_, [&](const Bucket& bucket) { return is_gating(bucket, listed_.today); });
    const auto fixed = std::ranges::count(buckets_, BucketState::fixed, &Bucket::state);
    return counted(std::ssize(buckets_) - fixed, "failure", "failures") + " of " +
           counted(static_cast<std::int64_t>(causes), "cause", "causes") + ", " +
           counted(gating, "fails", "fail") + " the build" +
           (fixed > 0 ? "; " + counted(fixed, "other is", "others are") + " fixed\n" : "\n");
  }

  const ListedCorpus& listed_;
  const std::vector<Bucket>& buckets_;
  std::map<std::string, std::string> others_;  // names of the other sides in its line, by id
  std::set<std::string> shown_;
  std::string out_;
};

}  // namespace

std::string corpus_list_text(const ListedCorpus& listed) { return CorpusList(listed).text(); }

}  // namespace contort::cli
