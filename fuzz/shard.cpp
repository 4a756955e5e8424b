#include "fuzz/shard.h"

#include <algorithm>
#include <charconv>

#include "fuzz/islands.h"

namespace contort {

namespace {

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<Shard> checked(int index, int count, const std::string& said) {
  if (count < 1 || count > kIslands)
    return Issue{"shard.range", "", said + ": a run has 1 to " + std::to_string(kIslands) + " shards"};
  if (index < 0 || index >= count)
    return Issue{
        "shard.range", "",
        said + ": shards of " + std::to_string(count) + " are numbered from 0 to " + std::to_string(count - 1)};
  return Shard{index, count};
}

// The variables of a scheduler. `first` is the number of its first shard, and `step` the difference between two shards;
// both are numbers or names of variables.
struct Scheduler {
  const char* index;
  const char* count;
  const char* first;
  const char* step;
};
constexpr Scheduler kSchedulers[] = {
    {"GTEST_SHARD_INDEX", "GTEST_TOTAL_SHARDS", "0", "1"},
    {"TEST_SHARD_INDEX", "TEST_TOTAL_SHARDS", "0", "1"},
    {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_STEP"},
    {"JOB_COMPLETION_INDEX", "CONTORT_SHARDS", "0", "1"},
    {"CI_NODE_INDEX", "CI_NODE_TOTAL", "1", "1"}};

Result<Shard> shard_of(const Scheduler& scheduler, const Variables& value_of) {
  const auto number = [&](const char* name) -> std::optional<int> {
    const char* text = value_of(name);
    return text == nullptr ? std::nullopt : whole_number(text);
  };
  const auto number_or_name = [&](const char* text) {
    const std::optional<int> fixed = whole_number(text);
    return fixed ? fixed : number(text);
  };
  const std::optional<int> index = number(scheduler.index), count = number(scheduler.count);
  const std::optional<int> first = number_or_name(scheduler.first);
  const int step = std::max(1, number_or_name(scheduler.step).value_or(1));
  const std::string said = std::string(scheduler.index) + ", " + scheduler.count;
  if (!index || !count || !first)
    return Issue{"shard.environment", "", said + " must both be set, to whole numbers; or say --shard K/N"};
  if ((*index - *first) % step != 0)
    return Issue{"shard.range", "", said + ": the numbers of the array are not evenly spaced"};
  return checked((*index - *first) / step, *count, said);
}

}  // namespace

Result<Shard> parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::optional<int> index = whole_number(std::string_view(text).substr(0, slash));
  const std::optional<int> count =
      slash == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(slash + 1));
  if (!index || !count) return Issue{"shard.syntax", "", "\"" + text + "\" is not a shard; write K/N, as in 3/16"};
  return checked(*index, *count, "--shard " + text);
}

Result<std::optional<Shard>> shard_of_environment(const Variables& value_of) {
  for (const Scheduler& scheduler : kSchedulers) {
    if (value_of(scheduler.index) == nullptr) continue;
    const Result<Shard> shard = shard_of(scheduler, value_of);
    if (!shard) return shard.issue();
    return std::optional<Shard>(*shard);
  }
  return std::optional<Shard>();
}

}  // namespace contort
