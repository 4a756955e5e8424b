// Corpora for tests, made from invented cases without running anything.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "tests/corpus/sample_cases.h"
#include "tests/corpus/temp_folder.h"

namespace contort {

// An invented case of the elbow's family. Its expected results are functions of the spec, as in real cases.
inline Case made_up(int elbow_deg, int duration, std::int64_t seed) {
  Case c;
  c.spec = bent_elbow(elbow_deg, duration);
  c.expect.check = "joint_range";
  c.expect.subject = kElbow;
  c.expect.unit = "rad";
  c.expect.worst_margin = (150 - elbow_deg) * kRadPerDeg;
  c.expect.depth = -c.expect.worst_margin / 0.1;
  c.expect.motion_hash = "0123456789abcdef";
  c.expect.character_hash = "0123456789abcdef";
  c.provenance.seed = seed;
  return c;
}

inline Case made_up_nan(Case c) {
  c.expect.worst_margin = std::numeric_limits<double>::quiet_NaN();
  c.expect.depth = 0.0;
  return c;
}

inline Found found(int elbow_deg, int duration, std::int64_t seed) {
  Found f;
  f.original = made_up(elbow_deg + 7, duration + 40, seed);
  f.minimal = made_up(elbow_deg, duration, seed);
  f.minimal.provenance.shrunk_from = spec_id(f.original.spec);
  f.run = "seed_" + std::to_string(seed);
  return f;
}

inline Corpus create(const TempFolder& folder) {
  Result<Corpus> corpus = Corpus::create(folder / "corpus");
  if (!corpus) ADD_FAILURE() << to_line(corpus.issue());
  return std::move(corpus).value();
}

inline Bucket only_bucket(const Corpus& corpus) {
  std::vector<Issue> damaged;
  const std::vector<Bucket> all = corpus.buckets(damaged);
  EXPECT_TRUE(damaged.empty());
  EXPECT_EQ(all.size(), 1U);
  return all.empty() ? Bucket{} : all.front();
}

inline Case stored(const Corpus& corpus, const Bucket& bucket, const std::string& file) {
  const Result<Case> read = read_case(corpus.folder_of(bucket) + "/" + file);
  EXPECT_TRUE(read) << to_line(read.issue());
  return read ? *read : Case{};
}

}  // namespace contort
