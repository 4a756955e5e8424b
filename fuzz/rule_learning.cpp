#include "fuzz/rule_learning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace contort {

namespace {

using known::Op;
using known::Quantity;

constexpr std::size_t kBeam = 16;         // number of conjunctions that are extended
constexpr std::size_t kFirstOfPairs = 6;  // number of conjunctions that are tried with a second one
constexpr double kEqual = 1.0;            // weight of recall against precision
constexpr double kPrecise = 0.1;  // the same for the first of two conjunctions, which need not cover everything
constexpr double kPerComparison = 0.02;   // cost of a comparison in F1, so that it must improve the rule
constexpr double kPerDerived = 0.01;

// One number or word for each sample.
struct Column {
  ConditionTerm term;            // the compared value, without operator and limit
  std::vector<double> amounts;   // value of each sample; NaN if a sample does not have it
  std::vector<int> order;        // samples that have the value, by rising value
  std::vector<std::string> words;  // words of the samples, in a column of words
};

// ---- columns

bool tells_angle_way_or_share(std::string_view name) {
  return name.ends_with("_deg") || name.ends_with("_m") || name.ends_with("share") || name.ends_with("_m.x") ||
         name.ends_with("_m.y") || name.ends_with("_m.z") || name.ends_with("_deg.x") || name.ends_with("_deg.y") ||
         name.ends_with("_deg.z");
}

std::vector<Quantity> quantities_of(std::string_view name) {
  if (name.ends_with("_m_s") || name.ends_with("_deg_s"))
    return {Quantity::value, Quantity::magnitude, Quantity::times_seconds};
  if (!tells_angle_way_or_share(name)) return {Quantity::value};
  return {Quantity::value, Quantity::magnitude, Quantity::per_second, Quantity::magnitude_per_second};
}

bool is_of_magnitude(Quantity quantity) {
  return quantity == Quantity::magnitude || quantity == Quantity::magnitude_per_second;
}

class Table {
 public:
  explicit Table(std::span<const RuleSample> samples) {
    for (const RuleSample& sample : samples) {
      fails_.push_back(sample.fails);
      values_.push_back(known_values(sample.request));
      for (const RequestValue& value : sample.request.values) note(value);
    }
    for (const auto& [name, is_mirrored] : numbers_) {
      const bool has_right = on_right_.contains(name.substr(0, name.find('.')));
      for (const Quantity quantity : quantities_of(name))
        add_numbers({.name = name, .quantity = quantity, .is_mirrored = is_mirrored && has_right});
    }
    for (const std::string& name : words_) add_words(name);
  }

  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<char>& fails() const { return fails_; }

 private:
  void note(const RequestValue& value) {
    if (value.word.empty()) return void(numbers_[value.name] |= value.is_mirrored);
    words_.insert(value.name);
    if (value.name.ends_with(".slot") && value.word.ends_with("_right"))
      on_right_.insert(value.name.substr(0, value.name.find('.')));
  }

  void add_numbers(ConditionTerm term) {
    Column column{term, {}, {}, {}};
    const known::Term comparison{term.name, term.quantity, term.is_mirrored, Op::below, 0.0, {}};
    double lowest = 0.0;
    for (const std::vector<known::Value>& values : values_) {
      double amount = std::numeric_limits<double>::quiet_NaN(), plain = 0.0;
      known::tells_amount({{}, values}, comparison, amount);
      if (known::tells_amount({{}, values}, {term.name, Quantity::value, term.is_mirrored, Op::below, 0.0, {}}, plain))
        lowest = std::min(lowest, plain);
      column.amounts.push_back(amount);
    }
    // Without negative values the magnitude equals the value.
    if (is_of_magnitude(term.quantity) && lowest >= 0.0) return;
    for (std::size_t i = 0; i < column.amounts.size(); ++i)
      if (!std::isnan(column.amounts[i])) column.order.push_back(static_cast<int>(i));
    std::ranges::stable_sort(column.order, {}, [&](int i) { return column.amounts[static_cast<std::size_t>(i)]; });
    if (!column.order.empty()) columns_.push_back(std::move(column));
  }

  void add_words(const std::string& name) {
    Column column{{.name = name, .op = Op::is}, {}, {}, {}};
    for (const std::vector<known::Value>& values : values_) {
      const known::Value* const value = known::find_value({{}, values}, name);
      column.words.emplace_back(value != nullptr ? value->word : "");
    }
    columns_.push_back(std::move(column));
  }

  std::vector<char> fails_;
  std::vector<std::vector<known::Value>> values_;
  std::map<std::string, bool> numbers_;  // by name: true if the number is mirrored
  std::set<std::string> words_;
  std::set<std::string> on_right_;       // names of actions that a part on the right side performs in a sample
  std::vector<Column> columns_;
};

// ---- conjunctions

struct Counts {
  int failing = 0;  // samples inside that fail
  int passing = 0;
};

struct Node {
  Conjunction terms;
  std::vector<char> inside;  // one flag for each sample
  double score = 0.0;
};

// A comparison that may extend a conjunction.
struct Candidate {
  const Node* from = nullptr;
  ConditionTerm term;
  double score = 0.0;
};

double cost_of(const Conjunction& terms) {
  double cost = 0.0;
  for (const ConditionTerm& term : terms)
    cost += kPerComparison + (term.quantity == Quantity::value ? 0.0 : kPerDerived);
  return cost;
}

class Learner {
 public:
  explicit Learner(const Table& table) : table_(table) {
    for (const char fails : table.fails()) all_failing_ += fails;
  }

  // Conjunctions of one to `most` comparisons, the best first. Their score is the F-measure, with this weight of
  // recall, of the conjunction together with the covered samples.
  std::vector<Node> conjunctions(const std::vector<char>& covered, double cost, std::size_t most,
                                 double recall_weight) {
    covered_ = counts_of(covered), cost_ = cost, recall_weight_ = recall_weight;
    Node empty{{}, covered, 0.0};
    for (char& inside : empty.inside) inside = !inside;
    std::vector<Node> beam = {std::move(empty)}, all;
    for (std::size_t length = 0; length < most; ++length) {
      beam = longer(beam);
      all.insert(all.end(), beam.begin(), beam.end());
    }
    std::ranges::stable_sort(all, std::greater(), &Node::score);
    return all;
  }

  double score_of_everything() {
    recall_weight_ = kEqual;
    return f_measure({all_failing_, static_cast<int>(table_.fails().size()) - all_failing_});
  }

 private:
  Counts counts_of(const std::vector<char>& inside) const {
    Counts counts;
    for (std::size_t i = 0; i < inside.size(); ++i)
      if (inside[i]) ++(table_.fails()[i] ? counts.failing : counts.passing);
    return counts;
  }

  // Van Rijsbergen's F-measure with beta squared as the weight of recall; F1 for kEqual.
  double f_measure(const Counts& counts) const {
    const double both = counts.failing + counts.passing + recall_weight_ * all_failing_;
    return both > 0.0 ? (1.0 + recall_weight_) * counts.failing / both : 0.0;
  }

  double score(const Counts& counts, const Node& from, const ConditionTerm& term) const {
    const Counts together{covered_.failing + counts.failing, covered_.passing + counts.passing};
    return f_measure(together) - cost_ - cost_of(from.terms) - cost_of({term});
  }

  std::vector<Node> longer(const std::vector<Node>& beam) {
    std::vector<Candidate> candidates;
    for (const Node& node : beam)
      for (const Column& column : table_.columns())
        column.words.empty() ? add_limits(node, column, candidates) : add_words(node, column, candidates);
    std::ranges::stable_sort(candidates, std::greater(), &Candidate::score);
    std::vector<Node> next;
    for (const Candidate& candidate : candidates) {
      if (next.size() == kBeam) break;
      Node node = made(candidate);
      if (std::ranges::find(next, node.inside, &Node::inside) == next.end()) next.push_back(std::move(node));
    }
    return next;
  }

  Node made(const Candidate& candidate) const {
    Node node = *candidate.from;
    const Column& column = *std::ranges::find_if(table_.columns(), [&](const Column& other) {
      return other.term.name == candidate.term.name && other.term.quantity == candidate.term.quantity;
    });
    for (std::size_t i = 0; i < node.inside.size(); ++i)
      node.inside[i] = node.inside[i] && has(column, candidate.term, i);
    node.terms.push_back(candidate.term);
    node.score = candidate.score;
    return node;
  }

  static bool has(const Column& column, const ConditionTerm& term, std::size_t i) {
    if (term.op == Op::below) return column.amounts[i] < term.limit;  // false for NaN
    if (term.op == Op::above) return column.amounts[i] > term.limit;
    return !column.words[i].empty() && (column.words[i] == term.word) == (term.op == Op::is);
  }

  // Adds the best upper and the best lower limit.
  void add_limits(const Node& node, const Column& column, std::vector<Candidate>& out) const {
    std::vector<int> order;
    Counts total, below;
    for (const int i : column.order) {
      if (!node.inside[static_cast<std::size_t>(i)]) continue;
      order.push_back(i);
      ++(table_.fails()[static_cast<std::size_t>(i)] ? total.failing : total.passing);
    }
    std::array<Candidate, 2> best;
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
      ++(table_.fails()[static_cast<std::size_t>(order[k])] ? below.failing : below.passing);
      const double low = column.amounts[static_cast<std::size_t>(order[k])];
      const double high = column.amounts[static_cast<std::size_t>(order[k + 1])];
      if (!(low < high)) continue;
      for (const Op op : {Op::below, Op::above}) {
        const Counts above{total.failing - below.failing, total.passing - below.passing};
        Candidate& so_far = best[op == Op::below ? 0 : 1];
        const double reached = score(op == Op::below ? below : above, node, column.term);
        if (so_far.from != nullptr && reached <= so_far.score) continue;
        so_far = {&node, column.term, reached};
        so_far.term.op = op, so_far.term.lowest = low, so_far.term.highest = high;
      }
    }
    for (Candidate& candidate : best) {
      if (candidate.from == nullptr) continue;
      candidate.term.limit = shortest_between(candidate.term.lowest, candidate.term.highest);
      out.push_back(std::move(candidate));
    }
  }

  void add_words(const Node& node, const Column& column, std::vector<Candidate>& out) const {
    std::map<std::string, Counts> counts;
    Counts total;
    for (std::size_t i = 0; i < node.inside.size(); ++i) {
      if (!node.inside[i] || column.words[i].empty()) continue;
      const bool fails = table_.fails()[i];
      ++(fails ? total.failing : total.passing);
      ++(fails ? counts[column.words[i]].failing : counts[column.words[i]].passing);
    }
    if (counts.size() < 2) return;
    for (const auto& [word, inside] : counts)
      for (const Op op : {Op::is, Op::is_not}) {
        const Counts other{total.failing - inside.failing, total.passing - inside.passing};
        Candidate candidate{&node, column.term, score(op == Op::is ? inside : other, node, column.term)};
        candidate.term.op = op, candidate.term.word = word;
        out.push_back(std::move(candidate));
      }
  }

  const Table& table_;
  int all_failing_ = 0;
  Counts covered_;     // counts of the samples that the first of two conjunctions covers
  double cost_ = 0.0;  // cost of the first conjunction
  double recall_weight_ = kEqual;
};

struct Best {
  std::vector<Conjunction> any_of;
  double score = 0.0;
};

void add_second(const Node& first, Learner& learner, Best& best) {
  const std::vector<Node> seconds =
      learner.conjunctions(first.inside, cost_of(first.terms), kMostComparisons - first.terms.size(), kEqual);
  if (!seconds.empty() && seconds.front().score > best.score)
    best = {{first.terms, seconds.front().terms}, seconds.front().score};
}

}  // namespace

std::optional<std::vector<Conjunction>> learn_rule(std::span<const RuleSample> samples) {
  const auto failing = std::ranges::count_if(samples, &RuleSample::fails);
  if (failing == 0 || failing == std::ssize(samples)) return std::nullopt;
  const Table table(samples);
  Learner learner(table);
  const std::vector<char> nothing(samples.size(), 0);
  const std::vector<Node> alone = learner.conjunctions(nothing, 0.0, kMostComparisons, kEqual);
  if (alone.empty()) return std::nullopt;
  Best best{{alone.front().terms}, alone.front().score};
  const std::vector<Node> firsts = learner.conjunctions(nothing, 0.0, kMostComparisons - 1, kPrecise);
  for (std::size_t i = 0; i < std::min(kFirstOfPairs, firsts.size()); ++i) add_second(firsts[i], learner, best);
  if (best.score <= learner.score_of_everything()) return std::nullopt;
  return best.any_of;
}

bool rule_holds(const std::vector<Conjunction>& any_of, const SpecRequest& request) {
  const std::vector<known::Value> values = known_values(request);
  return std::ranges::any_of(any_of, [&](const Conjunction& all) {
    return std::ranges::all_of(all, [&](const ConditionTerm& term) {
      return known::holds(known::Term{term.name, term.quantity, term.is_mirrored, term.op, term.limit, term.word},
                          {{}, values});
    });
  });
}

double shortest_between(double low, double high) {
  const double middle = low + 0.5 * (high - low);
  double per_unit = 0.01;
  for (int digits = -2; digits <= 12; ++digits, per_unit *= 10.0) {
    const double nearest = std::round(middle * per_unit) / per_unit;
    if (low < nearest && nearest < high) return nearest + 0.0;
  }
  return middle;
}

}  // namespace contort
