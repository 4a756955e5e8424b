// Lets workers make the data that a session shows, and adds up their CPU time. Can be used from any thread.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "server/engine.h"
#include "server/session_state.h"

namespace contort::server {

class TakeMaker {
 public:
  // `library`: folder of a registered library; "" for none.
  TakeMaker(Engine& engine, std::string client, std::string library);

  // Plays the spec in each of the modes. Codes of Engine::run; take.too_long if a motion has more bytes than the
  // limit.
  Result<PlayedTake> take(int number, const Spec& spec, const std::vector<Mode>& modes);
  Result<PlayedModel> model(const Spec& spec);
  // Returns the fields of the event with the checks' results.
  Result<std::string> judged(const Spec& spec, Mode mode);

  double cpu_s() const { return cpu_s_; }

 private:
  Result<Reply> run(TaskKind kind, const Spec& spec, Urgency urgency = Urgency::now);

  Engine& engine_;
  const std::string client_, library_;
  std::atomic<double> cpu_s_ = 0.0;
};

}  // namespace contort::server
