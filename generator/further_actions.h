// Further actions: if a part cannot point at its target, the torso that carries it turns, and if that is not enough,
// the figure steps round (docs/internals/aim.md).
#pragma once

#include <span>
#include <vector>

#include "generator/layer_stack.h"
#include "generator/rule_runner.h"
#include "generator/stage.h"

namespace contort {

class FurtherActions {
 public:
  void begin(const Stage& stage);

  // The frame from which each of them is in force, in the form of Playback.
  std::span<const int> acquired() const { return acquired_; }

  // Call it after each frame. If a part's aim misses its target, or reaches it only with a twist, the next further
  // action starts for it. `root` is the shown root.
  void ask(const Playback& playback, std::size_t part, std::span<const LayerStack> stacks, RuleRunner& rules,
           const Rigid& root);

  // Returns true if a further action is helping an aim that remains in force after this frame.
  bool is_coming(const Playback& playback, const LayerHold& aim, std::span<const LayerStack> stacks,
                 const Rigid& root) const;

 private:
  std::span<const FurtherAction> of_use(int use) const;
  int& acquired_at(const FurtherAction& further);
  bool needs_help(const Playback& playback, const LayerHold& hold, RuleRunner& rules) const;
  bool acquire(const Playback& playback, const PlannedAction& aim, std::span<const LayerStack> stacks,
               const RuleRunner& rules, const Rigid& root);
  bool faces_elsewhere(const PlannedAction& turn, const Rigid& root) const;

  const Stage* stage_ = nullptr;
  std::vector<int> acquired_;
};

}  // namespace contort
