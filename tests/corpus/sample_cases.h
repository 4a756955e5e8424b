// Cases for tests: real ones, that fail as stored, and made-up ones.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "corpus/case.h"
#include "corpus/corpus.h"
#include "model/character/library.h"
#include "tests/stage_evaluator.h"

namespace contort {

inline ActionUse pose_use(const std::string& slot, std::map<std::string, ParamValue> params, int duration = 30) {
  ActionUse use;
  use.slot = slot;
  use.duration_frames = duration;
  use.params = std::move(params);
  return use;
}

inline Spec spec_of(std::vector<ActionUse> uses, const std::string& character = "human") {
  Spec spec;
  spec.character.name = character;
  ClipDesc clip;
  clip.actions = std::move(uses);
  SequenceDesc sequence;
  sequence.clips.push_back(std::move(clip));
  spec.sequences.push_back(std::move(sequence));
  return spec;
}

// The left elbow may bend to 150 degrees.
inline Spec bent_elbow(double elbow_deg, int duration = 60) {
  return spec_of({pose_use("arm_left", {{"elbow_deg", elbow_deg}}, duration)});
}

inline const char* const kElbow = "arm_left/elbow max";

// The case of a failure that the spec really shows.
inline Case failing_case(const Spec& spec, const std::string& check, const std::string& subject,
                         const Library& library = stock_library()) {
  BuiltInGenerator generator(library);
  Evaluator evaluator(generator);
  const Result<Evaluation> evaluation = evaluator.run(spec);
  if (!evaluation) {
    ADD_FAILURE() << to_line(evaluation.issue());
    return {};
  }
  const Finding* finding = deepest(evaluation->findings, check, subject);
  if (finding == nullptr) {
    ADD_FAILURE() << "no " << check << " of " << subject;
    return {};
  }
  return {spec, expectation_of(evaluator.execution(), *evaluation, *finding), {}};
}

inline Case elbow_case(double elbow_deg = 190, int duration = 60) {
  return failing_case(bent_elbow(elbow_deg, duration), "joint_range", kElbow);
}

// The stock library with hands that stand nowhere: their clearances are NaN.
inline Library library_with_nowhere() {
  Library library = stock_library();
  library.parts.at("human_hand").joints.front().position_m.x = std::numeric_limits<double>::quiet_NaN();
  return library;
}

}  // namespace contort
