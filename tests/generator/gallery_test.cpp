// The motions of docs/gallery must be clean, because they show the generator's abilities.
#include <gtest/gtest.h>

#include <filesystem>

#include "model/core/files.h"
#include "model/spec/spec.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

TEST(Gallery, IsClean) {
  int shown = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CONTORT_SOURCE_DIR "/docs/gallery")) {
    if (entry.path().extension() != ".json") continue;
    ++shown;
    const Result<std::string> text = read_file(entry.path().string());
    const Result<Spec> spec = parse_spec(text ? *text : "");
    ASSERT_TRUE(spec) << entry.path() << to_line(spec.issue());
    StageEvaluator evaluator;
    for (const Finding& finding : evaluator.run(*build_stage(*spec, stock_library())).findings)
      ADD_FAILURE() << entry.path().filename() << ": " << finding.check << " " << finding.subject;
  }
  EXPECT_EQ(shown, 24);
}

}  // namespace
}  // namespace contort
