// Asks the rules that Contort has learned before a motion is played.
#include <known_rules.h>

#include <cstdio>

namespace {

using contort::known::Value;

void play(double angle_deg) {
  const Value values[] = {{"bend.seconds", 1.0}, {"bend.angle_deg", angle_deg}};
  const contort::known::KnownRule* rule = contort::known::find_rule(contort::known::kRules, {"hero", values});
  if (rule != nullptr)
    std::printf("bend %g deg: skipped, %.*s\n", angle_deg, static_cast<int>(rule->text.size()), rule->text.data());
  else
    std::printf("bend %g deg: played\n", angle_deg);
}

}  // namespace

int main() {
  play(60.0);
  play(175.0);
}
