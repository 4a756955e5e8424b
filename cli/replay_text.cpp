#include "cli/replay_text.h"

#include "renders/wording.h"

namespace contort::cli {

namespace {

struct OutcomeWords {
  const char *line, *one, *many;
};

OutcomeWords words_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::fails: return {"still fails", "still fails", "still fail"};
    case Outcome::differs: return {"fails differently", "fails differently", "fail differently"};
    case Outcome::passes: return {"passes now", "passes now", "pass now"};
    case Outcome::refused: return {"cannot run", "cannot run", "cannot run"};
    case Outcome::unsteady: return {"runs differ", "differs from run to run", "differ from run to run"};
  }
  return {};
}

// A process that ended has no value.
std::string value_of(const Case& stored, const Expectation& now, MeasuredValues& values) {
  if (is_abnormal_exit(now)) return "";
  Case replayed = stored;
  replayed.expect = now;
  return ": " + values.sentence_of(replayed) + ", at frame " + std::to_string(now.worst_frame);
}

}  // namespace

Outcome outcome_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::same:
    case Verdict::same_family: return Outcome::fails;
    case Verdict::different: return Outcome::differs;
    case Verdict::passes: return Outcome::passes;
    case Verdict::refused: return Outcome::refused;
  }
  return Outcome::refused;
}

std::string outcome_words(Outcome outcome) { return words_of(outcome).line; }

std::string tally_text(const std::map<Outcome, int>& outcomes) {
  std::string text;
  for (const auto& [outcome, count] : outcomes)
    text += (text.empty() ? "" : ", ") + counted(count, words_of(outcome).one, words_of(outcome).many);
  return text;
}

std::string failure_text(const Case& minimal) {
  return cause_headline(minimal) + " (" +
         minimal.spec.character.name + ")";
}

std::string change_text(const Replay& result) {
  if (result.verdict != Verdict::same_family) return "";
  if (result.first_difference < 0) return ", not in every bit as stored";
  return ", moves differently from frame " + std::to_string(result.first_difference) + " on";
}

std::string case_text(const Case& stored, const Replay& result, MeasuredValues& values) {
  if (result.verdict == Verdict::refused) return to_line(result.issue);
  std::string text = failure_text(stored);
  if (result.verdict == Verdict::different)
    text += "; now: " + failure_in_words(result.now.check, result.now.subject);
  if (result.verdict != Verdict::passes) text += value_of(stored, result.now, values);
  text += change_text(result);
  if (result.character_changed) text += ", the character has changed";
  return text;
}

std::string state_text(BucketState before, BucketState after) {
  if (before == after) return std::string(state_name(before));
  return "was " + std::string(state_name(before)) + ", now " + std::string(state_name(after));
}

}  // namespace contort::cli
