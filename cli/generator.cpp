// contort generator check: checks whether a program keeps the protocol contort.generator/1, and reports it in
// sentences.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/conformance.h"
#include "cli/guest_model.h"
#include "cli/print.h"
#include "guest/manifest_check.h"
#include "process/clock.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

constexpr GuestLimits kExamined{60.0, 5.0};  // users do not want to wait longer for an answer
constexpr std::size_t kMostReasonsShown = 20;

constexpr std::size_t kMostFollowersShown = 20;

void print_followers(const GuestCharacter& character) {
  std::size_t count = 0;
  for (const GuestJoint& joint : character.joints)
    if (joint.follows && ++count <= kMostFollowersShown)
      std::printf("  %s follows %s: %s times its angle from rest, plus %s degrees\n", printable(joint.name).c_str(),
                  printable(joint.follows->joint).c_str(), rounded_text(joint.follows->multiplier).c_str(),
                  rounded_text(joint.follows->offset_deg).c_str());
  if (count > kMostFollowersShown) std::printf("  and %zu more joints follow others\n", count - kMostFollowersShown);
}

void print_understood(const GuestManifest& said) {
  std::printf("%s%s%s\n", printable(said.name).c_str(), said.build.empty() ? "" : ", build ",
              printable(said.build).c_str());
  for (const GuestCharacter& character : said.characters) {
    std::printf("  character %s: %zu joints, %zu colliders", character.name.c_str(), character.joints.size(),
                character.colliders.size());
    if (!character.may_touch.empty()) std::printf(", of which %zu pairs may touch", character.may_touch.size());
    std::printf("\n");
    print_followers(character);
  }
  for (const GuestAction& action : said.actions)
    std::printf("  action %s: %zu parameters, %g to %g s\n", action.name.c_str(), action.params.size(),
                action.duration_s[0], action.duration_s[1]);
}

std::string swing_text(const GuestJoint& joint) {
  const std::array<double, 2> swing = as_two(joint.swing_deg);
  const std::string one = rounded_text(swing[0]);
  return swing[0] == swing[1] ? one : one + " and " + rounded_text(swing[1]);
}

void print_limits(const GuestCharacter& character) {
  std::printf("limits of %s as understood:\n", character.name.c_str());
  for (const GuestJoint& joint : character.joints) {
    if (joint.parent.empty()) continue;
    if (joint.type == GuestJointType::fixed)
      std::printf("  %-24s does not move\n", joint.name.c_str());
    else if (joint.type == GuestJointType::hinge)
      std::printf("  %-24s %g to %g degrees about its axis, at most %g degrees/s\n", joint.name.c_str(), joint.low_deg,
                  joint.high_deg, joint.max_speed_deg_s);
    else
      std::printf("  %-24s swing %s degrees, twist %g to %g degrees, at most %g degrees/s\n", joint.name.c_str(),
                  swing_text(joint).c_str(), joint.low_deg, joint.high_deg, joint.max_speed_deg_s);
  }
}

void print_conformance(const Conformance& found) {
  std::printf("started in %.2f s; %d motions, %.0f checked frames per second\n", found.start_s, found.motions,
              found.frames_per_s);
  if (!found.determinism.empty()) std::printf("determinism: %s\n", found.determinism.c_str());
  std::string judged;
  for (const std::string& name : found.judged) judged += (judged.empty() ? "" : ", ") + name;
  std::printf("judged: %s\n", judged.empty() ? "nothing" : judged.c_str());
  for (const auto& [check, reason] : found.not_judged)
    std::printf("not judged: %s: %s\n", check.c_str(), reason.c_str());
  for (const std::string& line : refusal_lines(found.refusals, found.refused, found.motions, kMostReasonsShown))
    std::printf("%s\n", printable(line).c_str());
  for (const ProtocolRemark& remark : found.remarks)
    std::printf("%s: %s\n", remark.is_fault ? "FAULT" : "note", printable(remark.text).c_str());
  const auto faults = std::ranges::count_if(found.remarks, &ProtocolRemark::is_fault);
  std::printf("%s\n", faults == 0 ? "OK: the generator keeps the protocol."
                                  : ("FAILED: " + counted(faults, "fault", "faults") + ".").c_str());
}

void run(const std::string& command, bool limits, Context& context) {
  const double start_s = steady_s();
  Result<std::unique_ptr<GuestGenerator>> started = GuestGenerator::start(command, kExamined, model_reader(command));
  if (!started) return context.fail(started.issue());
  const double manifest_s = steady_s() - start_s;
  GuestGenerator& generator = **started;
  print_understood(generator.said());
  if (limits)
    for (const GuestCharacter& character : generator.said().characters) print_limits(character);
  Conformance found = check_conformance(generator);
  found.start_s = manifest_s;
  print_conformance(found);
  context.exit_code = found.has_fault() ? kFindings : kClean;
}

}  // namespace

void add_generator(CLI::App& app, Context& context) {
  CLI::App* group = app.add_subcommand("generator", "Examine a generator that is a program of its own");
  group->require_subcommand(1);
  CLI::App* check = group->add_subcommand(
      "check", "Check whether a program keeps the protocol contort.generator/1, and say what can be judged");
  auto command = std::make_shared<std::string>();
  auto limits = std::make_shared<bool>(false);
  check->add_option("CMD", *command, "The program, as --generator takes it")->required();
  check->add_flag("--limits", *limits, "List the limits of every joint as they were understood");
  check->callback([=, &context] { run(*command, *limits, context); });
}

}  // namespace contort::cli
