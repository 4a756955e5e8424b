// The example of figure 16 of the seed (docs/experiments/aim): both motions hit their target, and are clean.
#include <gtest/gtest.h>

#include <algorithm>

#include "model/core/files.h"
#include "model/spec/spec.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

struct Shown {
  std::size_t findings = 0;
  Execution execution;

  bool moves(const std::string& slot) const {
    const int part = execution.character->find_part(slot);
    return std::ranges::any_of(execution.motion.spans, [&](const ActionSpan& span) { return span.part == part; });
  }
  bool aims_at_the_end(const std::string& socket) const {
    const int wanted = execution.character->find_socket(socket);
    return std::ranges::any_of(execution.motion.aims, [&](const AimSpan& aim) {
      return aim.socket == wanted && aim.last_frame >= execution.motion.frame_count - 2;
    });
  }
};

Shown shown(const std::string& name) {
  const Result<std::string> text = read_file(CONTORT_SOURCE_DIR "/docs/experiments/aim/" + name + ".json");
  const Result<Spec> spec = parse_spec(text ? *text : "");
  if (!spec) throw std::logic_error(to_line(spec.issue()));
  StageEvaluator evaluator;
  const std::size_t findings = evaluator.run(*build_stage(*spec, stock_library())).findings.size();
  return {findings, evaluator.execution()};
}

TEST(AimExperiment, HeadAndTorsoFindATargetThenTheRifleAims) {
  const Shown front = shown("a_in_front");
  EXPECT_EQ(front.findings, 0U);
  EXPECT_TRUE(front.aims_at_the_end("torso/chest"));
  EXPECT_TRUE(front.aims_at_the_end("object:rifle/muzzle"));
  EXPECT_TRUE(front.execution.intent->unmet.empty());
  EXPECT_FALSE(front.moves("waist"));
}

TEST(AimExperiment, ATargetBehindIsHitByFurtherActions) {
  const Shown behind = shown("b_behind");
  EXPECT_EQ(behind.findings, 0U);
  EXPECT_TRUE(behind.aims_at_the_end("head/face"));
  EXPECT_TRUE(behind.aims_at_the_end("object:rifle/muzzle"));
  EXPECT_TRUE(behind.moves("torso"));
  EXPECT_TRUE(behind.moves("leg_left"));
}

}  // namespace
}  // namespace contort
