// Two builds for tests: the swinging pendulum, and one with a planted fault. The base answers in the same process.
#pragma once

#include <signal.h>

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "fuzz/base_build.h"
#include "fuzz/run.h"
#include "tests/fuzz/small_runs.h"
#include "tests/swing_generator.h"

namespace contort::two_builds {

// Any generator as the base. `before` is called with each spec first and may answer with an issue instead.
class GeneratorBase final : public BaseBuild {
 public:
  using Before = std::function<std::optional<Issue>(const Spec&)>;
  explicit GeneratorBase(std::unique_ptr<Generator> generator, Before before = {})
      : generator_(std::move(generator)), evaluator_(*generator_), before_(std::move(before)) {}
  void ask(const MeasureRequest& request) override { request_ = request; }
  Measurement answer(const std::function<void()>&) override {
    Measurement refused;
    if (before_) refused.refusal = before_(request_.spec);
    if (refused.refusal) return refused;
    return *parse_measurement(print_line(measure(*parse_request(print_line(request_)), evaluator_)));
  }

 private:
  std::unique_ptr<Generator> generator_;
  Evaluator evaluator_;
  Before before_;
  MeasureRequest request_;
};

// A build of the pendulum whose motions differ from the sound one's by `Change`.
template <class Change>
class ChangedSwing final : public Generator {
 public:
  const Manifest& manifest() const override { return swing_.manifest(); }
  const Offers& offers(const Character& character) override { return swing_.offers(character); }
  Result<Admission> admit(const Spec& spec) override { return swing_.admit(spec); }
  Result<Done> run(const Spec& spec, Execution& execution) override {
    const Result<Done> done = swing_.run(spec, execution);
    if (done) Change()(execution.motion);
    return done;
  }
  std::unique_ptr<Generator> another() const override { return std::make_unique<ChangedSwing>(); }
  Result<std::unique_ptr<Generator>> with(const Library& library) const override { return swing_.with(library); }

 private:
  swing::SwingGenerator swing_;
};

// It turns three times as far as it should for angles below -115 degrees. A swing to such an angle is then faster than
// its joints allow.
struct SwingWide {
  void operator()(Motion& motion) const {
    for (double& angle_rad : motion.coords)
      if (angle_rad < -115 * kRadPerDeg) angle_rad *= 3.0;
  }
};
using WideSwingGenerator = ChangedSwing<SwingWide>;

inline AgainstConfig against_base(std::unique_ptr<Generator> (*make)(), GeneratorBase::Before before = {}) {
  AgainstConfig config;
  config.start = [make, before] { return std::make_unique<GeneratorBase>(make(), before); };
  config.base = "0.0 0123456789abcdef", config.build = "0.1 fedcba9876543210";
  config.rules = {0.1, own_hello("").checks};
  return config;
}

inline std::unique_ptr<Generator> sound_swing() { return std::make_unique<swing::SwingGenerator>(); }

inline RunConfig compared_config(std::int64_t cases, int jobs) {
  RunConfig config = small_runs::config_of(cases, jobs);
  config.draw.characters = {"pendulum"};
  config.shrink.max_evaluations = 200;
  config.against = against_base(sound_swing);
  return config;
}

inline RunResult run_compared(const RunConfig& config, Generator& generator, const Corpus& corpus) {
  return run_fuzz(
      config, generator, corpus, [](const RunProgress&) {}, [] { return false; });
}

}  // namespace contort::two_builds
