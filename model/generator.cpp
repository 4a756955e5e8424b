#include "model/generator.h"

#include <algorithm>

namespace contort {

const OfferedAction* find_offer(const Offers& offers, int part, std::string_view name) {
  if (part < 0) return nullptr;
  const std::vector<OfferedAction>& of_part = offers[static_cast<std::size_t>(part)];
  const auto found = std::ranges::find(of_part, name, &OfferedAction::name);
  return found == of_part.end() ? nullptr : &*found;
}

Result<Execution> execute(Generator& generator, const Spec& spec) {
  Execution execution;
  if (const Result<Done> done = generator.run(spec, execution); !done) return done.issue();
  return execution;
}

}  // namespace contort
