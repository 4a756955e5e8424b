#include "corpus/cause.h"

#include <algorithm>
#include <set>
#include <utility>

#include "model/core/hash.h"

namespace contort {

namespace {

constexpr std::size_t kCauseDigits = 12;
constexpr std::string_view kBetween = " ~ ";

std::vector<std::string_view> bodies_of(std::string_view subject) {
  std::vector<std::string_view> bodies;
  for (std::size_t end = subject.find(kBetween); end != std::string_view::npos; end = subject.find(kBetween)) {
    bodies.push_back(subject.substr(0, end));
    subject.remove_prefix(end + kBetween.size());
  }
  bodies.push_back(subject);
  return bodies;
}

std::string_view side_of(std::string_view slot) {
  return slot.ends_with("_left") ? "left" : slot.ends_with("_right") ? "right" : "";
}

std::string_view without_side(std::string_view slot) {
  const std::string_view side = side_of(slot);
  return side.empty() ? slot : slot.substr(0, slot.size() - side.size() - 1);
}

bool has_letters_of(std::string_view text, std::string_view lower_case) {
  const auto is_same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; };
  return std::search(text.begin(), text.end(), lower_case.begin(), lower_case.end(), is_same) != text.end();
}

// "ball_r" of a right foot is "ball", and "ball_r swing" is "ball swing": the side is said before it.
std::string without_side_letter(std::string_view name, std::string_view side) {
  for (const std::string_view angle : {" swing", " twist"})
    if (name.ends_with(angle))
      return without_side_letter(name.substr(0, name.size() - angle.size()), side) + std::string(angle);
  for (const char mark : {'_', '.'})
    for (const char letter : {side.front(), static_cast<char>(side.front() - 32)}) {
      const std::string end = {mark, letter};
      if (name.size() > end.size() && name.ends_with(end)) return std::string(name.substr(0, name.size() - end.size()));
    }
  return std::string(name);
}

// The name of a subject in plain words: "arm_left/elbow max" becomes "left elbow".
std::string body_in_words(std::string_view body) {
  for (const std::string_view end : {" min", " max"})
    if (body.ends_with(end)) body.remove_suffix(end.size());
  const std::size_t slash = body.find('/');
  const std::string_view slot = body.substr(0, slash), side = side_of(slot);
  std::string words(slash == std::string_view::npos ? without_side(slot) : body.substr(slash + 1));
  if (!side.empty() && !has_letters_of(words, side))
    words = std::string(side) + " " + without_side_letter(words, side);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string joined(const std::vector<std::string>& names, std::string_view between) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : std::string(between)) + name;
  return text;
}

// The first few names, and the number of the others.
std::string first_joined(const std::vector<std::string>& names, std::string_view between) {
  constexpr std::size_t kMost = 4;
  if (names.size() <= kMost) return joined(names, between);
  return joined({names.begin(), names.begin() + kMost}, between) + " and " + std::to_string(names.size() - kMost) +
         " others";
}

// The verb of each check; the judged subject stands before it. Checks that are not listed are given by their name.
struct Verb {
  std::string_view check, text;
};
constexpr Verb kVerbs[] = {
    {"non_finite", "has NaN or infinite values"},
    {"quaternion_length", "has a quaternion whose length is not 1"},
    {"joint_range", "leaves its range"},
    {"off_axis", "turns about another axis than its own"},
    {"angular_velocity", "turns too fast"},
    {"pop", "jumps"},
    {"root_pop", "jumps"},
    {"angular_acceleration", "changes its speed too abruptly"},
    {"bind_pose_flash", "flashes to the rest pose"},
    {"bone_position", "leaves its region"},
    {"aim_error", "misses the target of its aim"},
    {"reach_error", "misses its target"},
    {"mimic_error", "does not follow its leading joint"},
    {"residue", "does not return to its earlier posture"},
    {"stuck", "keeps a sequence after its end"},
    {"queue_gap", "begins or continues a sequence at the wrong place"},
    {"joint_torque", "needs more effort than its strength"},
    {"balance", "loses balance"},
    {"tracking_error", "does not return to its target"},
    {"ground_penetration", "sinks into the ground"},
    {"foot_slide", "slides on the ground"},
    {"contact_slide", "moves although its channel says that it stands still"},
    {"rest_error", "does not return to the rest pose"},
    {"fresh_error", "moves differently after other actions"},
    {"none_error", "is changed by an action that should change nothing"},
    {"history_error", "moves differently after other requests"},
    {"rate_error", "moves differently at half the frame rate"},
    {"undo_error", "does not return when an action is over"},
    {"gain_error", "moves differently with nearly equal parameters"},
    {"mirror_error", "moves differently on the other side"},
};

std::string_view verb_of(std::string_view check) {
  if (check == "obstacle_penetration") return "goes through an obstacle";
  for (const Verb& verb : kVerbs)
    if (verb.check == check) return verb.text;
  return "";
}

// "leaves its range" of several: "leave their range".
std::string of_several(std::string_view verb) {
  static constexpr std::pair<std::string_view, std::string_view> kIrregular[] = {
      {"has", "have"}, {"is", "are"}, {"does", "do"}, {"goes", "go"}, {"misses", "miss"}, {"flashes", "flash"}};
  const std::size_t end = std::min(verb.find(' '), verb.size());
  const std::string_view first = verb.substr(0, end);
  std::string text(first.ends_with('s') ? first.substr(0, first.size() - 1) : first);
  for (const auto& [one, many] : kIrregular)
    if (one == first) text = many;
  text += verb.substr(end);
  for (const auto& [one, many] : {std::pair(" its ", " their "), std::pair(" it stands", " they stand")})
    if (const std::size_t at = text.find(one); at != std::string::npos)
      text.replace(at, std::string_view(one).size(), many);
  return text;
}

// The names of the subjects, each once.
std::vector<std::string> names_of(std::span<const std::string> subjects) {
  std::vector<std::string> names;
  for (const std::string& subject : subjects)
    if (std::string name = body_in_words(bodies_of(subject).front()); std::ranges::find(names, name) == names.end())
      names.push_back(std::move(name));
  return names;
}

// "pan", "pan and tilt", "pan, tilt and 3 others"
std::string some_names(const std::vector<std::string>& names) {
  if (names.size() == 1) return names.front();
  if (names.size() == 2) return names[0] + " and " + names[1];
  const std::size_t others = names.size() - 2;
  return names[0] + ", " + names[1] + " and " + std::to_string(others) + (others == 1 ? " other" : " others");
}

std::string collision_in_words(std::span<const std::string> subjects) {
  const std::vector<std::string_view> bodies = bodies_of(subjects.front());
  const std::set<std::string> pairs(subjects.begin(), subjects.end());
  const std::size_t others = pairs.size() - 1;
  const std::string more =
      others == 0 ? "" : " (and " + std::to_string(others) + (others == 1 ? " other pair)" : " other pairs)");
  return body_in_words(bodies[0]) + " goes through " + body_in_words(bodies[1]) + more;
}

std::string what_happens(std::string_view check, std::span<const std::string> subjects) {
  if (check == "crash") return "the generator ends with " + subjects.front();
  if (check == "timeout") return "the generator does not answer in time";
  if (check == "memory") return "the generator uses too much memory";
  if (check == "self_collision" && bodies_of(subjects.front()).size() > 1) return collision_in_words(subjects);
  const std::vector<std::string> names = names_of(subjects);
  const std::string_view verb = check == "self_collision" ? verb_of("obstacle_penetration") : verb_of(check);
  if (verb.empty()) return some_names(names) + ": " + std::string(check);
  return some_names(names) + " " + (names.size() == 1 ? std::string(verb) : of_several(verb));
}

bool is_disturbed(const Spec& spec) { return !spec.dynamics.impacts.empty() || !spec.dynamics.loads.empty(); }

std::vector<std::string> disturbances_of(const Spec& spec) {
  std::vector<std::string> names;
  if (!spec.dynamics.impacts.empty()) names.emplace_back("impact");
  if (!spec.dynamics.loads.empty()) names.emplace_back("load");
  return names;
}

// The name of a part of the setting in a sentence.
std::string setting_in_words(const std::string& name, const EnvironmentDesc* environment) {
  static constexpr std::string_view kGrounds[] = {"on level ground", "on a slope", "on steps", "on uneven ground"};
  if (name == "ground" && environment != nullptr) return std::string(kGrounds[environment->ground.index()]);
  static constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"ground", "on uneven ground"},        {"impact", "after an impact"},
      {"load", "under a load"},              {"obstacle", "beside an obstacle"},
      {"pose", "in the start pose"},         {"recording", "in a recording"},
      {"swap", "with another part or object"}};
  for (const auto& [setting, words] : kWords)
    if (setting == name) return std::string(words);
  return name;
}

std::string settings_in_words(const std::vector<std::string>& names, const EnvironmentDesc* environment) {
  std::vector<std::string> words;
  for (const std::string& name : names) words.push_back(setting_in_words(name, environment));
  return joined(words, " and ");
}

void add_actions(const SequenceDesc& sequence, std::vector<LoneAction>& list) {
  for (const ClipDesc& clip : sequence.clips)
    for (const ActionUse& use : clip.actions) {
      LoneAction& one = list.emplace_back(LoneAction{use.action, sequence});
      one.sequence.clips = {clip};
      one.sequence.clips.front().actions = {use};
    }
}

}  // namespace

std::span<const std::string_view> cause_scope_names() {
  static constexpr std::string_view kNames[] = {"alone", "company", "setting"};
  return kNames;
}

std::vector<LoneAction> lone_actions_of(const Spec& spec) {
  std::vector<LoneAction> list;
  for (const SequenceDesc& sequence : spec.sequences) add_actions(sequence, list);
  for (const InterruptDesc& interrupt : spec.interrupts) add_actions(interrupt.sequence, list);
  return list;
}

std::vector<std::string> surroundings_of(const Spec& spec) {
  std::vector<std::string> names;
  if (!std::holds_alternative<PlaneGround>(spec.environment.ground)) names.emplace_back("ground");
  if (!spec.dynamics.impacts.empty()) names.emplace_back("impact");
  if (!spec.dynamics.loads.empty()) names.emplace_back("load");
  if (!spec.environment.obstacles.empty()) names.emplace_back("obstacle");
  if (!spec.recording.name.empty()) names.emplace_back("recording");
  if (!spec.character.parts.empty() || !spec.character.attachments.empty()) names.emplace_back("swap");
  if (names.empty()) names.emplace_back("pose");
  return names;
}

Cause cause_without_experiments(const Spec& minimal) {
  const std::vector<LoneAction> uses = lone_actions_of(minimal);
  std::set<std::string> actions;
  for (const LoneAction& one : uses) actions.insert(one.action);
  Cause cause{.scheme = kCauseScheme, .is_simulated = minimal.dynamics.mode != Mode::kinematic};
  if (cause.is_simulated && is_disturbed(minimal)) {
    cause.scope = CauseScope::setting;
    cause.names = disturbances_of(minimal);
    cause.also.assign(actions.begin(), actions.end());
    return cause;
  }
  cause.scope = uses.empty()       ? CauseScope::setting
                : uses.size() == 1 ? CauseScope::alone
                                   : CauseScope::company;
  cause.names = actions.empty() ? surroundings_of(minimal) : std::vector(actions.begin(), actions.end());
  return cause;
}

std::string cause_id(const Cause& cause, CheckKind kind) {
  const std::string key = std::to_string(cause.scheme) + "|" +
                          std::string(cause_scope_names()[static_cast<std::size_t>(cause.scope)]) + "|" +
                          joined(cause.names, ",") + "|" +
                          std::string(check_kind_names()[static_cast<std::size_t>(kind)]) +
                          (cause.is_simulated ? "|simulated" : "");
  return content_id(key).substr(0, kCauseDigits);
}

std::vector<std::string> limbs_of(std::string_view subject) {
  std::set<std::string> limbs;
  for (const std::string_view body : bodies_of(subject)) limbs.emplace(without_side(body.substr(0, body.find('/'))));
  return {limbs.begin(), limbs.end()};
}

namespace {

std::string as_sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() = static_cast<char>(text.front() - 32);
  return text;
}

}  // namespace

std::string failure_in_words(std::string_view check, std::string_view subject) {
  const std::string one(subject);
  return as_sentence(what_happens(check, std::span(&one, 1)));
}

std::string cause_headline(const Cause& cause, std::string_view check, std::span<const std::string> subjects,
                           const EnvironmentDesc* environment) {
  std::string text = as_sentence(what_happens(check, subjects));
  switch (cause.scope) {
    case CauseScope::alone: text += " during " + joined(cause.names, ", "); break;
    case CauseScope::company: text += " during " + first_joined(cause.names, " together with "); break;
    case CauseScope::setting: text += " " + settings_in_words(cause.names, environment); break;
  }
  return text + (cause.is_simulated ? ", simulated" : "");
}

std::string cause_headline(const Cause& cause, std::string_view check, std::string_view subject) {
  const std::string one(subject);
  return cause_headline(cause, check, std::span(&one, 1), nullptr);
}

}  // namespace contort
