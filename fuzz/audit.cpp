#include "fuzz/audit.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>

#include "corpus/ending_case.h"
#include "fuzz/compose_params.h"
#include "fuzz/dice.h"
#include "fuzz/evaluators.h"
#include "fuzz/figure_extent.h"
#include "fuzz/parallel.h"
#include "model/character/character.h"
#include "model/core/index.h"
#include "model/core/nearest.h"
#include "model/motion/kinematics.h"
#include "model/motion/legs.h"
#include "process/ended.h"

namespace contort {

namespace {

constexpr std::uint64_t kAuditStream = 0x6175646974ULL;
constexpr int kShortestFrames = 20, kLongestFrames = 90;
constexpr int kHoldFrames = 30;  // the figure comes to rest in these frames

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || holds(names, name);
}

// A character with at most one change: another part in a slot, or an object at a socket.
struct Variant {
  CharacterChoice choice;
  std::string slot;    // slot of the other part; "" for the default character
  std::string object;  // the object that the character carries
};

void add_parts(const CharacterDesc& desc, std::vector<Variant>& out) {
  for (const SlotDesc& slot : desc.slots)
    for (std::size_t i = 1; i < slot.parts.size(); ++i) {
      Variant variant{{desc.name, {}, {}}, slot.name, ""};
      variant.choice.parts[slot.name] = slot.parts[i];
      out.push_back(std::move(variant));
    }
}

void add_objects(const CharacterDesc& desc, const Library& library, std::vector<Variant>& out) {
  const Result<Character> bare = build_character({desc.name, {}, {}}, library);
  for (const std::string& name : desc.objects) {
    const auto object = library.objects.find(name);
    if (!bare || object == library.objects.end()) continue;
    for (const Socket& socket : bare->sockets()) {
      const std::size_t slash = socket.name.find('/');
      if (!holds(object->second.docks, socket.name.substr(slash + 1))) continue;
      Variant variant{{desc.name, {}, {}}, "", name};
      variant.choice.attachments = {{name, socket.name.substr(0, slash), socket.name.substr(slash + 1)}};
      out.push_back(std::move(variant));
    }
  }
}

std::vector<Variant> variants_of(const CharacterDesc& desc, const Library& library) {
  std::vector<Variant> all = {{{desc.name, {}, {}}, "", ""}};
  add_parts(desc, all);
  add_objects(desc, library, all);
  return all;
}

bool is_point(const ParamDef& def) {
  return def.type == ParamType::object_point || def.type == ParamType::own_point;
}

// The points for which a variant has a row of its own: points of its object or, without an object, points of the parts.
std::vector<std::string> points_of(const OfferedAction& action, const Character& character, const Variant& variant) {
  const auto def = std::ranges::find_if(action.params, is_point);
  std::vector<std::string> points;
  if (def == action.params.end() && variant.object.empty()) points.push_back("");
  if (def == action.params.end()) return points;
  for (const std::string& point : def->points)
    if ((character.find_socket("object:" + variant.object + "/" + point) >= 0) == !variant.object.empty())
      points.push_back(point);
  return points;
}

void add_rows(const AuditOptions& options, const Variant& variant, const Character& character, const Offers& offers,
              std::vector<AuditRow>& rows) {
  for (std::size_t p = 0; p < offers.size(); ++p) {
    const Part& part = character.parts()[p];
    if (!wanted(options.slots, part.slot) || (!variant.slot.empty() && variant.slot != part.slot)) continue;
    for (const OfferedAction& action : offers[p])
      for (const std::string& point : points_of(action, character, variant))
        if (wanted(options.actions, action.name))
          rows.push_back({variant.choice, part.slot, part.name, action.name, point, 0, 0, 0, {}, {}, 0.0});
  }
}

// The character of a row, the action, and the part that performs it.
struct Offered {
  Character character;
  OfferedAction action;
  int part = 0;
  bool touches = false;  // the part touches objects beside it
  double rate_hz = 60.0;
};

bool touches_walls(const Generator& generator, const Character& character, const OfferedAction& action, int part) {
  const bool is_leg = std::ranges::any_of(find_legs(character), [part](const Leg& leg) { return leg.part == part; });
  const bool tells = std::ranges::any_of(action.tells, [part](const EventSource& source) {
    return source.event == Event::contact && source.part == part;
  });
  return tells && !is_leg && generator.manifest().can.obstacles;
}

// A wall to touch, at the part's side, 2 to 40 cm from the figure at rest.
ObstacleDesc wall_beside(const Character& character, const Part& part, Dice& dice) {
  const double distance_m = extent_m(character, part.side == Side::right ? -1.0 : 1.0) + 0.01 * (2 + dice.below(39));
  Box wall;
  wall.center_m = Vec3(part.side == Side::right ? -distance_m - 0.1 : distance_m + 0.1, 1.0, 0.0);
  wall.half_m = Vec3(0.1, 1.0, 2.0);
  return {"wall", wall};
}

struct Outcome {
  std::vector<std::string> checks;  // checks that found something
  std::vector<std::string> reasons;  // reasons of unmet requests
  double depth = 0.0;
  bool still = false;
  std::string ending{};                  // a sentence, if the program under test ended
  std::optional<std::string> refusal{};  // the program's reason, if it refused the request
};

constexpr std::size_t kMostPrintedOfRow = 200;

// A program that ended in a motion gives the same finding as in a run.
Outcome outcome_of(const Spec& spec, const ProgramEnded& ended) {
  const Expectation shown = ending_case(spec, ended.ending()).expect;
  return {{shown.check}, {}, shown.depth, false, describe(ended.ending(), kMostPrintedOfRow), {}};
}

void note_once(std::vector<std::string>& names, std::string name) {
  if (!holds(names, name)) names.push_back(std::move(name));
}

bool is_still(const Motion& motion) {
  for (int frame = 1; frame < motion.frame_count; ++frame)
    if (!std::ranges::equal(motion.row(frame), motion.row(0)) || motion.root[at(frame)] != motion.root[0]) return false;
  return true;
}

// Returns true for a finding about the pose itself: one that lasts until the last frame, in which the figure rests.
bool is_static(const Finding& finding, const Motion& motion) {
  const bool of_poses =
      finding.check == "joint_range" || finding.check == "self_collision" || finding.check == "ground_penetration";
  return of_poses && finding.last_frame == motion.frame_count - 1;
}

Outcome outcome_of(const Evaluation& evaluation, const Execution& made, Layer layer) {
  Outcome outcome;
  if (made.intent)
    for (const UnmetRequest& unmet : made.intent->unmet) note_once(outcome.reasons, std::string(shortfall_name(unmet.why)));
  for (const Finding& finding : evaluation.findings) {
    if (layer == Layer::overwrite && is_static(finding, made.motion)) {
      note_once(outcome.reasons, "pose");
      continue;
    }
    note_once(outcome.checks, finding.check);
    outcome.depth = std::max(outcome.depth, finding.depth);
  }
  outcome.still = outcome.reasons.empty() && is_still(made.motion);
  return outcome;
}

Offered offered(const AuditRow& row, Generator& generator) {
  Character character = build_character(row.character, *generator.manifest().library).value();
  const int part = character.find_part(row.slot);
  OfferedAction action = *find_offer(generator.offers(character), part, row.action);
  const bool touches = touches_walls(generator, character, action, part);
  return {std::move(character), std::move(action), part, touches, generator.manifest().rate_hz};
}

Spec drawn(const AuditRow& row, const Offered& on, std::int64_t seed, int index) {
  Dice dice(seed, index, kAuditStream);
  std::array<int, kRawValues> raw{};
  for (int& value : raw) value = dice.raw();
  ActionUse use;
  use.action = row.action, use.slot = row.slot;
  const FrameRange frames = on.action.duration.value_or(FrameRange{kShortestFrames, kLongestFrames});
  use.duration_frames = frames.least + dice.below(frames.most - frames.least + 1);
  if (on.action.blend_in) use.blend_in_frames = on.action.blend_in->least;
  if (on.action.blend_out) use.blend_out_frames = on.action.blend_out->least;
  const Part& part = on.character.parts()[static_cast<std::size_t>(on.part)];
  draw_params(on.character, part, on.action, Profile{}, raw, use);
  take_corners(on.action, dice, use);
  for (const ParamDef& def : on.action.params)
    if (is_point(def)) use.params[def.name] = row.point;
  Spec spec;
  spec.character = row.character;
  spec.rate_hz = on.rate_hz;
  spec.hold_frames = kHoldFrames;
  spec.dynamics.mode = row.dynamics;
  if (on.touches) spec.environment.obstacles = {wall_beside(on.character, part, dice)};
  ClipDesc clip;
  clip.actions = {use};
  spec.sequences.push_back({});
  spec.sequences.back().clips = {clip};
  return spec;
}

void fold(const Outcome& outcome, const Offered& on, std::int64_t seed, int index, AuditRow& row) {
  const bool is_unmet = !outcome.reasons.empty();
  const bool first_unmet = is_unmet && row.unmet == 0 && row.depth == 0.0;
  ++row.draws;
  if (outcome.refusal) {
    ++row.refused;
    return count_refusal(*outcome.refusal, index, row.refusals);
  }
  if (!outcome.ending.empty()) row.endings.try_emplace(outcome.checks.front(), outcome.ending);
  row.clean += outcome.checks.empty() ? 1 : 0;
  row.unmet += is_unmet ? 1 : 0;
  row.still += outcome.still ? 1 : 0;
  for (const std::string& check : outcome.checks) ++row.findings[check];
  for (const std::string& reason : outcome.reasons) ++row.reasons[reason];
  if (outcome.depth > row.depth || first_unmet)
    row.worst = drawn(row, on, seed, index), row.worst_ends = !outcome.ending.empty();
  row.depth = std::max(row.depth, outcome.depth);
}

Result<Outcome> played(const Spec& spec, Layer layer, Evaluator& evaluator) {
  try {
    const Result<Evaluation> evaluation = evaluator.run(spec);
    if (evaluation) return outcome_of(*evaluation, evaluator.execution(), layer);
    if (evaluation.issue().code != kRefusedCode) return evaluation.issue();
    Outcome refused;
    refused.refusal = reason_of(evaluation.issue());
    return refused;
  } catch (const ProgramEnded& ended) {
    return outcome_of(spec, ended);
  }
}

bool is_timeout(const Result<Outcome>& outcome) { return outcome && holds(outcome->checks, "timeout"); }

// The row ends with the same draw for any number of threads: draws before it that no thread made are made now.
Result<Done> audit_row(const AuditOptions& options, const Offered& on, Evaluators& evaluators, AuditRow& row) {
  std::vector<std::optional<Result<Outcome>>> outcomes(at(options.draws));
  std::atomic<int> timeouts{0};
  const auto play = [&](int worker, int index) {
    outcomes[at(index)] = played(drawn(row, on, options.seed, index), on.action.layer, evaluators.of(worker));
    timeouts += is_timeout(*outcomes[at(index)]) ? 1 : 0;
  };
  parallel_for(options.jobs, options.draws, [&](int worker, int index) {
    if (timeouts < kMostTimeouts) play(worker, index);
  }, [] {});
  int late = 0;
  for (int index = 0; index < options.draws && late < kMostTimeouts; ++index) {
    if (!outcomes[at(index)]) play(0, index);
    const Result<Outcome>& outcome = *outcomes[at(index)];
    if (!outcome) return outcome.issue();
    late += is_timeout(outcome) ? 1 : 0;
    fold(*outcome, on, options.seed, index, row);
  }
  row.is_cut = row.draws < options.draws;
  return Done{};
}

std::vector<std::string> slots_of(const Library& library) {
  std::vector<std::string> names;
  for (const auto& [name, desc] : library.characters)
    for (const SlotDesc& slot : desc.slots)
      if (!holds(names, slot.name)) names.push_back(slot.name);
  return names;
}

std::vector<std::string> characters_of(const Library& library) {
  std::vector<std::string> names;
  for (const auto& [name, desc] : library.characters) names.push_back(name);
  return names;
}

Result<Done> know(const std::vector<std::string>& asked, const std::vector<std::string>& known,
                  const std::string& kind) {
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
  for (const std::string& name : asked)
    if (!holds(known, name))
      return Issue{"audit.unknown_" + kind, "",
                   "there is no " + kind + " \"" + name + "\"; there are " + names + did_you_mean(name, names)};
  return Done{};
}

Result<Done> know_all(const AuditOptions& options, const Manifest& manifest) {
  const Library& library = *manifest.library;
  if (const Result<Done> known = know(options.characters, characters_of(library), "character"); !known) return known;
  if (const Result<Done> known = know(options.actions, manifest.actions, "action"); !known) return known;
  return know(options.slots, slots_of(library), "slot");
}

}  // namespace

Result<std::vector<AuditRow>> audit_rows(const AuditOptions& options, Generator& generator) {
  if (const Result<Done> known = know_all(options, generator.manifest()); !known) return known.issue();
  const Library& library = *generator.manifest().library;
  std::vector<AuditRow> rows;
  for (const auto& [name, desc] : library.characters) {
    if (!wanted(options.characters, name)) continue;
    for (const Variant& variant : variants_of(desc, library)) {
      const Result<Character> character = build_character(variant.choice, library);
      if (!character) return character.issue();
      add_rows(options, variant, *character, generator.offers(*character), rows);
    }
  }
  for (AuditRow& row : rows) row.dynamics = options.dynamics;
  if (rows.empty())
    return Issue{"audit.nothing_matches", "",
                 "none of these characters has such an action in such a slot; contort list actions names all"};
  return rows;
}

Spec audit_spec(const AuditRow& row, Generator& generator, std::int64_t seed, int index) {
  return drawn(row, offered(row, generator), seed, index);
}

Result<Done> audit(const AuditOptions& options, const CheckSettings& settings, Generator& generator,
                   std::vector<AuditRow>& rows, const std::function<void(int)>& progress) {
  Evaluators evaluators(generator, settings, options.jobs);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    progress(static_cast<int>(i));
    if (const Result<Done> done = audit_row(options, offered(rows[i], generator), evaluators, rows[i]); !done)
      return done.issue();
  }
  return Done{};
}

}  // namespace contort
