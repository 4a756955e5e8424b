#include "cli/conformance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "checks/measured.h"
#include "corpus/evaluator.h"
#include "fuzz/draw.h"
#include "guest/guest_figure.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "process/clock.h"
#include "process/ended.h"
#include "renders/measured_text.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

constexpr int kDrawn = 24;                    // number of drawn motions
constexpr double kMostDrawn_s = 8.0;          // time limit for all drawn motions together
constexpr double kSlow_frames_s = 1000.0;
constexpr double kAtRest_rad = 1.0 * kRadPerDeg;
constexpr double kAtRest_m = 0.01;
constexpr double kSmallest_m = 0.05, kGreatest_m = 20.0;  // size of a plausible figure
constexpr double kWild_rad = 0.35;            // rotation in one frame: 20 degrees
constexpr int kMostPairsNamed = 6;
constexpr double kOften = 0.5;                // fraction of motions

std::string ending_text(const ProgramEnded& ended) {
  const Ending& ending = ended.ending();
  const std::string printed = ending.printed.empty() ? "" : " It printed: " + ending.printed;
  if (ending.kind == Ending::Kind::timeout)
    return "The generator does not answer in time; a request needs an answer within seconds." + printed;
  if (ending.kind == Ending::Kind::memory) return "The generator uses more than 4 GiB of memory." + printed;
  if (ending.signal == kNoJson)
    return "The generator writes something else than replies to its standard output after the manifest; write logs to "
           "standard error." + printed;
  if (ending.signal == kWrongChannels)
    return "A reply must have every channel of the manifest, with one value of its type for each frame." + printed;
  if (ending.signal == kWrongLength)
    return "A reply has another number of bytes than the frames that were asked for: frames x (3 + 4 x joints) numbers "
           "of the format that the manifest names." + printed;
  if (ending.signal == kWrongId) return "A reply has another id than its request." + printed;
  if (ending.signal == kFailed) return "The generator fails for a request that its manifest allows." + printed;
  return "The generator ends while it makes a motion (" + ending.signal + ")." + printed;
}

// The conversation so far. Every problem becomes a remark.
class Examination {
 public:
  explicit Examination(GuestGenerator& generator) : generator_(generator), evaluator_(generator) {
    for (const auto& [name, desc] : generator.manifest().library->characters) config_.characters.push_back(name);
  }

  Conformance run() {
    examine_manifest();
    examine_contacts();
    if (!examine_rest()) return std::move(out_);
    examine_determinism();
    examine_drawn();
    examine_ends_of_parameters();
    return std::move(out_);
  }

 private:
  void fault(const std::string& text) { add({true, text}); }
  void note(const std::string& text) { add({false, text}); }
  void add(const ProtocolRemark& remark) {
    if (std::ranges::find(out_.remarks, remark) == out_.remarks.end()) out_.remarks.push_back(remark);
  }

  // The answer has no value if the generator ended; its ending is then a fault.
  template <class Ask>
  auto guarded(const Ask& ask, const std::string& about = "") -> std::optional<decltype(ask())> {
    try {
      return ask();
    } catch (const ProgramEnded& ended) {
      has_ended_ = true;
      return fault(about + ending_text(ended)), std::nullopt;
    }
  }

  // A range such as -1.57 to 1.57 is probably in radians; in degrees the joint would hardly move.
  void examine_manifest() {
    int hinges = 0, in_radians = 0;
    for (const GuestCharacter& character : generator_.said().characters)
      for (const GuestJoint& joint : character.joints)
        if (joint.type == GuestJointType::hinge) {
          ++hinges;
          const double most = std::max(std::fabs(joint.low_deg), std::fabs(joint.high_deg));
          if (most > 0.0 && most <= 2.0 * kPi + 1e-3) ++in_radians;
        }
    if (hinges > 0 && in_radians == hinges)
      fault("All ranges of hinges are within 6.3: they look like radians, but low_deg and high_deg are degrees.");
  }

  // Contacts at rest are not judged, so a wrong radius would hide collisions.
  void examine_contacts() {
    for (const auto& [name, desc] : generator_.manifest().library->characters) {
      std::string pairs;
      int count = 0;
      for (const AllowedPairDesc& pair : desc.allowed_pairs)
        if (pair.reason == kOverlapAtRest && ++count <= kMostPairsNamed)
          pairs += (pairs.empty() ? "" : ", ") + pair.a + " ~ " + pair.b;
      if (count > 0)
        note(name + ": " + std::to_string(count) + " pairs of colliders overlap at rest and are not judged: " + pairs +
             (count > kMostPairsNamed ? ", ..." : ""));
    }
  }

  // Compares the pose of a request without actions with the rest pose of the manifest.
  bool examine_rest() {
    for (const std::string& name : config_.characters) {
      Spec spec;
      spec.character.name = name, spec.rate_hz = generator_.manifest().rate_hz, spec.hold_frames = 2;
      const auto evaluation = guarded([&] { return evaluator_.run(spec); });
      if (!evaluation) return false;
      if (!*evaluation)
        return fault("A request without actions is refused: " + reason_of((*evaluation).issue())), false;
      compare_with_rest(name, evaluator_.execution());
    }
    return true;
  }

  void compare_with_rest(const std::string& name, const Execution& execution) {
    const Rigid rest = root_at_rest(generator_.said(), name), root = execution.motion.root.front();
    const double turned = rotation_angle(glm::conjugate(rest.q) * root.q);
    if (turned > kAtRest_rad)
      fault(name + ": without actions the root is turned by " + rounded_text(turned * kDegPerRad) +
            " degrees against the manifest's rest pose; are up, forward and handed of the convention those of the frames?");
    if (const double moved = length(rest.p_m - root.p_m); moved > kAtRest_m)
      fault(name + ": without actions the root is " + rounded_text(moved) +
            " m from its position in the manifest; are the axes and unit_m of the convention those of the frames?");
    examine_size(name, *execution.character, root);
    for (const Joint& joint : execution.character->joints().subspan(1))
      if (const double away = away_from_rest(joint, execution); away > kAtRest_rad)
        return note(name + ": " + joint.name + " is at " + rounded_text(away * kDegPerRad) +
                    " degrees although no action was requested. If you meant rest: rotations are relative to the parent "
                    "(x y z w) and must include the rest rotation.");
  }

  static double away_from_rest(const Joint& joint, const Execution& execution) {
    const double* now = execution.motion.row(0).data() + joint.coord;
    return joint.kind == JointKind::ball ? rotation_angle(quat_at(now)) : std::fabs(*now);
  }

  void examine_size(const std::string& name, const Character& character, const Rigid& root) {
    std::vector<Rigid> world(character.joints().size());
    forward_kinematics(character, root, character.rest_coords(), world);
    Vec3 low = root.p_m, high = root.p_m;
    for (const Rigid& joint : world) low = glm::min(low, joint.p_m), high = glm::max(high, joint.p_m);
    const double size_m = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (world.size() > 1 && (size_m < kSmallest_m || size_m > kGreatest_m))
      note(name + ": the figure is " + rounded_text(size_m) + " m large; is unit_m the length of one unit in metres?");
  }

  std::optional<std::string> frames_of(const Spec& spec) {
    const auto frames = guarded([&] { return generator_.raw_frames(spec); });
    if (!frames || !*frames) return std::nullopt;
    return **frames;
  }

  // Compares two fresh processes, then repeats the request after another one.
  void examine_determinism() {
    const Spec spec = drawn_long(0), other = drawn_long(1);
    generator_.restart();
    const auto first = frames_of(spec);
    generator_.restart();
    const auto second = frames_of(spec);
    const auto again = frames_of(spec);
    (void)frames_of(other);
    const auto after_other = frames_of(spec);
    if (!first || !second || !again || !after_other) return;
    const Determinism said = generator_.said().determinism;
    if (*first != *second) {
      out_.determinism = "Two fresh processes answer the same request differently.";
      if (said != Determinism::noisy)
        fault("Two fresh processes answer the same request differently: the motion depends on time, a random number or "
              "an address. Seed it from the request, or declare determinism \"noisy\".");
    } else if (*again != *second || *after_other != *second) {
      out_.determinism = "A request is answered differently after another one.";
      if (said == Determinism::exact)
        fault("A request is answered differently after another one: state of an earlier request is left. Begin each "
              "request anew, or declare determinism \"history\".");
    } else {
      out_.determinism = "The same request gives the same bits, in fresh processes and after other requests.";
    }
  }

  // The longest of several draws, because its state could affect later requests most.
  Spec drawn_long(std::int64_t seed) {
    Spec longest = draw_spec(config_, generator_, seed, 0);
    for (std::int64_t index = 1; index < 8; ++index)
      if (Spec spec = draw_spec(config_, generator_, seed, index); contort::frames_of(spec) > contort::frames_of(longest))
        longest = std::move(spec);
    return longest;
  }

  void examine_drawn() {
    std::map<std::string, int> failing;
    int frames = 0;
    double spent_s = 0.0;
    const double begin_s = steady_s();
    for (int index = 0; index < kDrawn && !has_ended_ && steady_s() - begin_s < kMostDrawn_s; ++index) {
      const Spec spec = draw_spec(config_, generator_, 7, index);
      const double start_s = steady_s();
      const auto evaluation = guarded([&] { return evaluator_.run(spec); });
      spent_s += steady_s() - start_s;
      ++out_.motions;
      if (!evaluation) continue;
      if (!*evaluation) {
        ++out_.refused;
        count_refusal(reason_of((*evaluation).issue()), index, out_.refusals);
        continue;
      }
      frames += (*evaluation)->frame_count;
      for (const std::string& check : failing_checks(**evaluation)) ++failing[check];
      note_judged(**evaluation);
      note_beyond(**evaluation, *evaluator_.execution().character);
      look_for_degrees(evaluator_.execution());
    }
    out_.frames_per_s = spent_s > 0.0 ? frames / spent_s : 0.0;
    remark_on(failing);
    remark_on_refusals();
  }

  static std::vector<std::string> failing_checks(const Evaluation& evaluation) {
    std::vector<std::string> names;
    for (const Finding& finding : evaluation.findings)
      if (std::ranges::find(names, finding.check) == names.end()) names.push_back(finding.check);
    return names;
  }

  // The joint that is farthest beyond its limit, in proportion.
  struct Beyond {
    std::string joint, unit;
    Measured worst;
    int motions = 0;  // that show a finding of it
  };

  void note_beyond(const Evaluation& evaluation, const Character& character) {
    for (const char* check : {"angular_velocity", "joint_range"}) {
      std::set<std::string> seen;
      for (const Finding& f : evaluation.findings) {
        const auto measured = f.check != check ? std::nullopt
                                               : measured_of(character, CheckSettings{}, check, f.subject, f.worst_margin);
        if (!measured) continue;
        Beyond& beyond = beyond_[check][f.subject];
        if (std::fabs(f.worst_margin) > std::fabs(beyond.worst.value - beyond.worst.limit)) beyond.worst = *measured;
        beyond.joint = f.subject, beyond.unit = f.unit;
        if (seen.insert(f.subject).second) ++beyond.motions;
      }
    }
  }

  // "body/pan turns 1 980 deg/s, limit 120 deg/s, in 24 of 24 motions."
  std::string worst_joint(const std::string& check) const {
    const auto found = beyond_.find(check);
    if (found == beyond_.end()) return "A joint is beyond its limit.";
    const auto excess = [](const Beyond& b) { return std::fabs(b.worst.value - b.worst.limit); };
    const Beyond& beyond =
        std::max_element(found->second.begin(), found->second.end(), [&](const auto& a, const auto& b) {
          return excess(a.second) < excess(b.second);
        })->second;
    return beyond.joint + " " + measured_text(check, beyond.unit, beyond.worst) + ", in " +
           std::to_string(beyond.motions) + " of " + std::to_string(out_.motions) + " motions.";
  }

  void note_judged(const Evaluation& evaluation) {
    for (const JudgedCheck& judged : evaluation.judged)
      if (std::ranges::find(out_.judged, judged.check) == out_.judged.end()) out_.judged.emplace_back(judged.check);
    out_.not_judged.clear();
    for (const NotJudged& missing : evaluation.not_judged)
      if (std::ranges::find(out_.judged, missing.check) == out_.judged.end())
        out_.not_judged.emplace_back(missing.check, missing.reason);
  }

  // If degrees are used as radians, a joint turns by tens of degrees in most frames.
  void look_for_degrees(const Execution& execution) {
    for (const Joint& joint : execution.character->joints()) {
      int moving = 0, wild = 0;
      for (int frame = 1; frame < execution.motion.frame_count; ++frame) {
        const double step_rad = step_of(joint, execution.motion, frame);
        moving += step_rad > 1e-6 ? 1 : 0;
        wild += step_rad > kWild_rad ? 1 : 0;
      }
      if (moving >= 8 && wild * 2 > moving) wild_joint_ = joint.name;
    }
  }

  static double step_of(const Joint& joint, const Motion& motion, int frame) {
    if (joint.kind == JointKind::root)
      return rotation_angle(glm::conjugate(motion.root[at(frame - 1)].q) * motion.root[at(frame)].q);
    const double* before = motion.row(frame - 1).data() + joint.coord;
    const double* now = motion.row(frame).data() + joint.coord;
    if (joint.kind == JointKind::ball) return rotation_angle(glm::conjugate(quat_at(before)) * quat_at(now));
    return std::fabs(wrap_angle(*now - *before));
  }

  void remark_on(const std::map<std::string, int>& failing) {
    const auto share = [&](const char* check) {
      const auto found = failing.find(check);
      return found == failing.end() ? 0.0 : static_cast<double>(found->second) / std::max(1, out_.motions);
    };
    if (share("non_finite") > 0.0)
      fault("Frames have NaN or infinite values in " + rounded_text(100.0 * share("non_finite")) + " % of the motions.");
    if (share("quaternion_length") > 0.0)
      fault("Quaternions do not have length 1 in " + rounded_text(100.0 * share("quaternion_length")) +
            " % of the motions; are they x y z w, and normalised?");
    if (!wild_joint_.empty())
      fault(wild_joint_ + " turns by more than 20 degrees from frame to frame most of the time; is an angle in degrees "
            "used where radians are expected?");
    else if (share("angular_velocity") > kOften)
      fault(worst_joint("angular_velocity") +
            " Either the unit of max_speed_deg_s is wrong (degrees per second), or the motion is too fast; contort fuzz "
            "then shows where.");
    if (share("joint_range") > kOften)
      fault(worst_joint("joint_range") +
            " Either low_deg and high_deg are wrong (degrees, relative to the rest pose), or the motion leaves the range; "
            "contort fuzz then shows where.");
    if (share("off_axis") > kOften)
      fault("Hinges turn about other axes than the manifest declares in " + rounded_text(100.0 * share("off_axis")) +
            " % of the motions; is axis in the joint's own frame?");
    if (out_.frames_per_s > 0.0 && out_.frames_per_s < kSlow_frames_s)
      note("The generator makes " + rounded_text(out_.frames_per_s) +
           " frames per second; a night of eight hours then sees " +
           rounded_text(out_.frames_per_s * 8.0 * 3600.0 / 120.0) + " motions of two seconds on a core.");
  }

  void remark_on_refusals() {
    if (out_.refused * 2 > out_.motions)
      fault(rounded_text(100.0 * out_.refused / std::max(1, out_.motions)) +
            " % of the motions that the manifest allows are refused: " + by_frequency(out_.refusals).front().text);
  }

  // Requests each number at the ends of its range, with all other numbers at their defaults.
  void examine_ends_of_parameters() {
    if (has_ended_) return;
    for (const std::string& name : config_.characters) {
      const Result<Character> character = build_character({name, {}, {}}, *generator_.manifest().library);
      const Offers offers = generator_.offers(*character);
      for (std::size_t part = 0; part < offers.size(); ++part)
        for (const OfferedAction& action : offers[part])
          for (const ParamDef& def : action.params)
            for (const double end : {def.low, def.high})
              if (def.type == ParamType::number) try_end(name, character->parts()[part].slot, action, def, end);
    }
  }

  void try_end(const std::string& character, const std::string& slot, const OfferedAction& action, const ParamDef& def,
               double end) {
    ActionUse use;
    use.action = action.name, use.slot = slot, use.duration_frames = action.duration->most;
    use.blend_in_frames = action.blend_in->least, use.blend_out_frames = action.blend_out->least;
    use.params[def.name] = end;
    Spec spec;
    spec.character.name = character, spec.rate_hz = generator_.manifest().rate_hz;
    ClipDesc clip;
    clip.actions = {use};
    spec.sequences.push_back({"", 0, {clip}});
    const std::string what = action.name + " with " + def.name + " = " + rounded_text(end);
    const auto evaluation = guarded([&] { return evaluator_.run(spec); }, what + ": ");
    if (evaluation && !*evaluation)
      fault("The manifest allows " + what + ", but the generator refuses it: " + reason_of((*evaluation).issue()));
  }

  GuestGenerator& generator_;
  Evaluator evaluator_;
  DrawConfig config_;
  Conformance out_;
  std::string wild_joint_;
  std::map<std::string, std::map<std::string, Beyond>> beyond_;  // by check and joint
  bool has_ended_ = false;  // one such fault is enough: the next would be the same
};

}  // namespace

bool Conformance::has_fault() const {
  return std::ranges::any_of(remarks, [](const ProtocolRemark& remark) { return remark.is_fault; });
}

Conformance check_conformance(GuestGenerator& generator) { return Examination(generator).run(); }

}  // namespace contort::cli
