#include "generator/timeline/part_order.h"

#include <algorithm>

#include "model/motion/legs.h"

namespace contort {

namespace {

// The part whose motion an action looks at before it moves its own, or -1.
int looks_at(const Character& character, const PlannedAction& action) {
  std::size_t at = 0;
  for (const ParamDef& def :
       action.def->params(character, character.parts()[static_cast<std::size_t>(action.named)])) {
    if (def.type == ParamType::object_point) {
      const Socket& socket = character.sockets()[static_cast<std::size_t>(action.params[at])];
      return character.joints()[static_cast<std::size_t>(socket.joint)].part;
    }
    at += def.type == ParamType::vector ? 3 : 1;
  }
  return -1;
}

bool is_leg(const Character& character, std::size_t part) {
  return std::ranges::any_of(find_legs(character), [&](const Leg& leg) {
    return leg.part == static_cast<int>(part) || leg.foot_part == static_cast<int>(part);
  });
}

// The part that a part carries; -1 where it carries none or several.
int only_child_of(const Character& character, int part) {
  int child = -1, count = 0;
  for (int p = 1; p < static_cast<int>(character.parts().size()); ++p)
    if (carrier_of(character, p) == part) child = p, ++count;
  return count == 1 ? child : -1;
}

// The part that may come next: the one that the last one carries, so that a limb is moved as a whole; then legs, which
// have to stand, so that arms make way for them; then in the order of slots. If none may come next, the answer is the
// number of parts.
template <class Ready>
std::size_t next_part(const Character& character, const std::vector<int>& order, const Ready& ready) {
  const std::size_t parts = character.parts().size();
  std::size_t first = parts, leg = parts;
  for (std::size_t p = parts; p-- > 0;) {
    if (!ready(p)) continue;
    if (order.size() > 1 && only_child_of(character, order.back()) == static_cast<int>(p)) return p;
    first = p;
    if (is_leg(character, p)) leg = p;
  }
  return leg < parts ? leg : first;
}

}  // namespace

Result<Done> order_parts(const Character& character, Timeline& out) {
  const std::size_t parts = character.parts().size();
  std::vector<std::vector<int>> before(parts);
  for (std::size_t p = 1; p < parts; ++p) before[p].push_back(carrier_of(character, static_cast<int>(p)));
  for (const PlannedAction& action : out.actions)
    if (const int seen = looks_at(character, action); seen >= 0)
      before[static_cast<std::size_t>(action.part)].push_back(seen);
  std::vector<char> placed(parts, 0);
  const auto ready = [&](std::size_t p) {
    return placed[p] == 0 && std::all_of(before[p].begin(), before[p].end(),
                                         [&](int b) { return placed[static_cast<std::size_t>(b)] != 0; });
  };
  while (out.part_order.size() < parts) {
    const std::size_t next = next_part(character, out.part_order, ready);
    if (next == parts)
      return Issue{"spec.circular_hold", "/sequences", "two parts each hold an object that the other one carries"};
    placed[next] = 1;
    out.part_order.push_back(static_cast<int>(next));
  }
  return Done{};
}

}  // namespace contort
