// The base of a comparison: another build that measures the same specs (docs/reference/against.md).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corpus/measurement.h"
#include "fuzz/comparison.h"
#include "process/line_program.h"
#include "process/worker_pool.h"

namespace contort {

class BaseBuild {
 public:
  virtual ~BaseBuild() = default;

  // Begins to measure. answer() must be called before the next request.
  virtual void ask(const MeasureRequest& request) = 0;

  // Waits for the measurement. If the base crashes, hangs or uses too much memory, the result is a refusal with the
  // code base.crash, base.timeout or base.memory. `on_wait` is called repeatedly while it waits.
  virtual Measurement answer(const std::function<void()>& on_wait) = 0;
};

// A process of another program. If it ends on a spec, it is started anew and asked once more; a second end is the
// answer.
class BaseProgram final : public BaseBuild {
 public:
  // Starts the program at the first request. `limits` are those of one spec.
  BaseProgram(std::vector<std::string> command, const WorkerLimits& limits)
      : command_(std::move(command)), limits_(limits) {}
  void ask(const MeasureRequest& request) override;
  Measurement answer(const std::function<void()>& on_wait) override;

 private:
  void start(const std::function<void()>& on_wait);
  Ending try_once(const std::function<void()>& on_wait);

  std::vector<std::string> command_;
  WorkerLimits limits_;
  std::string line_;  // the request that waits for its answer
  std::int64_t id_ = 0;
  bool is_asked_ = false;  // the running program has the request
  std::unique_ptr<LineProgram> program_;
};

// Starts the program once and reads its first line. Codes against.cannot_start, against.no_protocol.
Result<MeasureHello> greet(const std::vector<std::string>& command, const WorkerLimits& limits);

// The settings of a run that compares two builds.
struct AgainstConfig {
  std::function<std::unique_ptr<BaseBuild>()> start;  // starts the base; called in the process that uses it
  std::string base;                                   // version and content hash of the other build, "0.1.0 1a2b…"
  std::string build;                                  // version and content hash of this build
  CompareRules rules;
};

}  // namespace contort
