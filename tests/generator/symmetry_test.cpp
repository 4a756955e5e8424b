// Laws of generation: a scene that is moved, mirrored or slowed down gives the motion moved, mirrored or slowed down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fuzz/draw.h"
#include "generator/generate.h"
#include "model/motion/kinematics.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

constexpr double kLaw = 1e-9;
constexpr int kSpecs = 500;
constexpr int kLeast = 50;  // number of motions that must be judged

template <class Visit>
void for_sequences(Spec& spec, Visit visit) {
  for (SequenceDesc& sequence : spec.sequences) visit(sequence);
  for (InterruptDesc& interrupt : spec.interrupts) visit(interrupt.sequence);
}

void remove(Spec& spec, const std::vector<std::string>& actions) {
  for_sequences(spec, [&](SequenceDesc& sequence) {
    for (ClipDesc& clip : sequence.clips)
      std::erase_if(clip.actions, [&](const ActionUse& use) {
        return std::find(actions.begin(), actions.end(), use.action) != actions.end();
      });
  });
}

void keep_one_action(Spec& spec, std::int64_t which) {
  spec.interrupts.clear();
  if (spec.sequences.empty() || spec.sequences[0].clips.empty()) return;
  spec.sequences.resize(1);
  spec.sequences[0].clips.resize(1);
  std::vector<ActionUse>& actions = spec.sequences[0].clips[0].actions;
  if (!actions.empty()) actions = {actions[static_cast<std::size_t>(which) % actions.size()]};
}

// Draws a spec without aim and touch. Aim is iterated to within 1e-5 rad, so its postures may differ by as much; a
// separate test is below. Touch chooses among 24 swivels, of which two may be equally good. Every second spec keeps
// one action of its first clip, because crowds of actions are nearly always hindered.
Spec drawn(std::int64_t index) {
  Spec spec = draw_spec({{"human", "mech", "quadruped"}}, stock_generator(), 21, index);
  spec.dynamics = {};  // these laws are about actions; control decides by thresholds
  remove(spec, {"aim", "touch"});
  if (index % 2 == 1) keep_one_action(spec, index / 2);
  return spec;
}

// `was_hindered` is set if bodies kept a limb off, or if a foot was lifted over the ground or stayed where it stood.
// These decisions use thresholds in single frames, which rounding may cross.
Motion play(const Spec& spec, bool& was_hindered, const Library& library = stock_library()) {
  const Result<Stage> stage = build_stage(spec, library);
  EXPECT_TRUE(stage.ok()) << (stage.ok() ? "" : to_line(stage.issue())) << pretty_spec(spec);
  Motion motion;
  GenerateScratch scratch;
  if (stage) generate(*stage, scratch, motion);
  was_hindered = was_hindered || scratch.shift_count > 0;
  return motion;
}

Motion play(const Spec& spec) {
  bool unused = false;
  return play(spec, unused);
}

void expect_near(const Rigid& a, const Rigid& b, const std::string& where) {
  EXPECT_LT(rotation_angle(glm::conjugate(a.q) * b.q), kLaw) << where;
  EXPECT_LT(length(a.p_m - b.p_m), kLaw) << where;
}

TEST(Symmetry, AMovedSceneGivesTheMovedMotion) {
  int judged = 0;
  for (std::int64_t i = 0; i < kSpecs; ++i) {
    Spec spec = drawn(i);
    bool was_hindered = false;
    const Motion here = play(spec, was_hindered);
    spec.start.position_m = Vec3(3.7, 0.0, -12.4);
    spec.start.heading_deg = 137.0;
    spec.environment.position_m = spec.start.position_m;
    spec.environment.heading_deg = 137.0;
    // look_at's point moves along: it is given from where the character stood at first.
    const Motion there = play(spec, was_hindered);
    if (was_hindered) continue;
    ++judged;
    const Rigid there_from_here{axis_angle(Vec3(0, 1, 0), 137.0 * kRadPerDeg), spec.start.position_m};
    ASSERT_EQ(there.frame_count, here.frame_count);
    for (int f = 0; f < here.frame_count; ++f) {
      const auto at = static_cast<std::size_t>(f);
      expect_near(there.root[at], there_from_here * here.root[at], std::to_string(i));
      for (std::size_t c = 0; c < here.row(f).size(); ++c)
        ASSERT_NEAR(there.row(f)[c], here.row(f)[c], kLaw) << "spec " << i << " frame " << f;
    }
  }
  EXPECT_GE(judged, kLeast);
}

bool is_course_of_legs(const std::string& action) { return find_action(action)->spread == Spread::legs; }

// Starts on whole frames, so that the frames of the plain motion are every second one of the slow motion. Lengths of
// blends are of content. Automatic blends take the same time at any speed, and so do those of courses of legs that are
// too short for the distance. A leg that leaves a course to reach does so a frame later, which is half a frame of
// content in the slow motion, so it may take another path.
Spec whole_frames(std::int64_t index) {
  Spec spec = drawn(index);
  spec.interrupts.clear();
  for_sequences(spec, [](SequenceDesc& sequence) {
    sequence.duration_frames = 0;
    for (ClipDesc& clip : sequence.clips) {
      std::erase_if(clip.actions, [](const ActionUse& use) { return use.action == "reach" && use.slot.starts_with("leg"); });
      clip.speed = 1.0, clip.duration_frames = 0;
      for (ActionUse& use : clip.actions) {
        use.speed = 1.0;
        use.blend_in_frames = is_course_of_legs(use.action) ? 0 : std::max(0, use.blend_in_frames);
      }
    }
  });
  return spec;
}

void expect_twice_as_slow(const Motion& plain, const Motion& slow, int frames, std::int64_t index) {
  for (int f = 0; f < frames; ++f)
    for (std::size_t c = 0; c < plain.row(f).size(); ++c)
      ASSERT_NEAR(slow.row(2 * f)[c], plain.row(f)[c], kLaw) << "spec " << index << " frame " << f;
}

TEST(Symmetry, ClipsOfHalfTheSpeedTakeTheSamePosturesAtTwiceTheTime) {
  int judged = 0;
  for (std::int64_t i = 0; i < kSpecs; ++i) {
    Spec spec = whole_frames(i);
    bool was_hindered = false;
    const Motion plain = play(spec, was_hindered, fixtures::tireless_library());
    for_sequences(spec, [](SequenceDesc& sequence) {
      for (ClipDesc& clip : sequence.clips) clip.speed = 0.5, clip.start_frame *= 2;
    });
    const Motion slow = play(spec, was_hindered, fixtures::tireless_library());
    if (was_hindered) continue;
    ++judged;
    expect_twice_as_slow(plain, slow, plain.frame_count - spec.hold_frames, i);
  }
  EXPECT_GE(judged, kLeast);
}

// walk and run have a pace of their own, speed_m_s: a longer period of theirs is a longer way. So has turn.
TEST(Symmetry, ActionsOfTwiceThePeriodTakeTheSamePosturesAtTwiceTheTime) {
  int judged = 0;
  for (std::int64_t i = 0; i < kSpecs; ++i) {
    Spec spec = whole_frames(i);
    remove(spec, {"walk", "run", "turn"});
    bool was_hindered = false;
    const Motion plain = play(spec, was_hindered, fixtures::tireless_library());
    for_sequences(spec, [](SequenceDesc& sequence) {
      for (ClipDesc& clip : sequence.clips) {
        clip.start_frame *= 2;
        for (ActionUse& use : clip.actions) {
          use.start_frame *= 2, use.duration_frames *= 2;
          use.blend_in_frames *= 2, use.blend_out_frames *= 2;
        }
      }
    });
    const Motion slow = play(spec, was_hindered, fixtures::tireless_library());
    if (was_hindered) continue;
    ++judged;
    expect_twice_as_slow(plain, slow, plain.frame_count - spec.hold_frames, i);
  }
  EXPECT_GE(judged, kLeast);
}

std::string other_side(std::string slot) {
  for (const auto& [from, to] : {std::pair("_left", "_right"), std::pair("_right", "_left")})
    if (const std::size_t at = slot.rfind(from);
        at != std::string::npos && at + std::string(from).size() == slot.size())
      return slot.substr(0, at) + to;
  return slot;
}

// The value of a parameter for the mirrored action. Parts on the right are mirrored already, so hinges keep their
// angles on the other side; in the middle, rotations about y or z change their sign.
ParamValue mirrored(const Character& character, const ActionUse& use, const std::string& name,
                    const ParamValue& value) {
  if (use.action == "pose") {
    const Part& part = character.parts()[static_cast<std::size_t>(character.find_part(use.slot))];
    const std::string joint_name = name.substr(0, name.rfind('_'));
    const Joint& joint = fixtures::joint(character, use.slot + "/" + joint_name);
    if (const auto* v = std::get_if<Vec3>(&value)) return Vec3(v->x, -v->y, -v->z);
    const bool turns_over =
        part.side == Side::center && joint.kind == JointKind::hinge && std::fabs(joint.axis.x) < 0.5;
    return turns_over ? ParamValue(-std::get<double>(value)) : value;
  }
  if (name == "lead") return std::string(std::get<std::string>(value) == "left" ? "right" : "left");
  if (name == "heading_deg" || name == "azimuth_deg" || name == "swivel_deg") return -std::get<double>(value);
  if (const auto* v = std::get_if<Vec3>(&value)) return mirror_point(*v);
  return value;
}

EnvironmentDesc mirrored(EnvironmentDesc environment) {
  if (auto* slope = std::get_if<SlopeGround>(&environment.ground)) slope->heading_deg = -slope->heading_deg;
  if (auto* steps = std::get_if<StepsGround>(&environment.ground)) steps->heading_deg = -steps->heading_deg;
  if (auto* field = std::get_if<HeightGround>(&environment.ground))
    for (int r = 0; r < field->rows; ++r)
      std::reverse(field->heights_m.begin() + r * field->columns, field->heights_m.begin() + (r + 1) * field->columns);
  for (ObstacleDesc& obstacle : environment.obstacles) obstacle.shape = mirrored(obstacle.shape);
  return environment;
}

Spec mirrored(const Spec& spec) {
  const Character character = fixtures::built(spec.character);
  Spec out = spec;
  out.environment = mirrored(spec.environment);
  out.character.parts.clear();
  for (const auto& [slot, part] : spec.character.parts) out.character.parts[other_side(slot)] = part;
  for (AttachmentDesc& attachment : out.character.attachments) attachment.slot = other_side(attachment.slot);
  for (InterruptDesc& interrupt : out.interrupts)
    if (!interrupt.when.slot.empty()) interrupt.when.slot = other_side(interrupt.when.slot);
  for_sequences(out, [&](SequenceDesc& sequence) {
    for (ClipDesc& clip : sequence.clips)
      for (ActionUse& use : clip.actions) {
        if (use.action == "walk" || use.action == "run") use.params.try_emplace("lead", std::string("left"));
        for (auto& [name, value] : use.params) value = mirrored(character, use, name, value);
        use.slot = other_side(use.slot);
      }
  });
  return out;
}

void expect_mirrored(const Character& a, const Motion& motion, const Character& b, const Motion& other, int f) {
  for (const Joint& joint : a.joints()) {
    if (joint.kind == JointKind::root) continue;
    const Part& part = a.parts()[static_cast<std::size_t>(joint.part)];
    const Joint& twin = fixtures::joint(b, other_side(part.slot) + "/" + joint.local_name);
    const double* q = motion.row(f).data() + joint.coord;
    const double* r = other.row(f).data() + twin.coord;
    const std::string where = joint.name + " in frame " + std::to_string(f);
    if (joint.kind == JointKind::ball) {
      const Quat expected = mirror_rotation(Quat(q[0], q[1], q[2], q[3]));
      ASSERT_LT(rotation_angle(glm::conjugate(expected) * Quat(r[0], r[1], r[2], r[3])), kLaw) << where;
    } else {
      const bool turns_over =
          part.side == Side::center && joint.kind == JointKind::hinge && std::fabs(joint.axis.x) < 0.5;
      ASSERT_NEAR(r[0], turns_over ? -q[0] : q[0], kLaw) << where;
    }
  }
}

// Ties between ways to reach a target (an elbow above or below, a turn by exactly half a circle) have no mirror image;
// drawn specs meet none.
TEST(Symmetry, AMirroredSpecGivesTheMirroredMotion) {
  int judged = 0;
  for (std::int64_t i = 0; i < kSpecs; ++i) {
    const Spec spec = drawn(i);
    const Spec twin = mirrored(spec);
    const Character a = fixtures::built(spec.character), b = fixtures::built(twin.character);
    bool was_hindered = false;
    const Motion motion = play(spec, was_hindered), other = play(twin, was_hindered);
    if (was_hindered) continue;
    ++judged;
    ASSERT_EQ(motion.frame_count, other.frame_count);
    for (int f = 0; f < motion.frame_count; ++f) {
      SCOPED_TRACE("spec " + std::to_string(i));
      expect_mirrored(a, motion, b, other, f);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GE(judged, kLeast);
}

// Returns the angle by which the muzzle misses a target in the last frame. The target is relative to the start place.
double aim_error_rad(const StartDesc& start, const std::string& side, const Vec3& target_m) {
  Spec spec;
  spec.start = start;
  spec.character.attachments = {{"rifle", "hand_" + side, "grip"}};
  spec.sequences = {fixtures::sequence({fixtures::use("aim", "arm_" + side, 0, 30, {{"target_m", target_m}})})};
  const Motion motion = play(spec);
  const Character character = fixtures::built(spec.character);
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, motion.root.back(), motion.row(motion.frame_count - 1), world);
  const Rigid muzzle = world_from_socket(character, world, character.find_socket("object:rifle/muzzle"));
  const Rigid world_from_start{axis_angle(Vec3(0, 1, 0), start.heading_deg * kRadPerDeg), start.position_m};
  const Vec3 towards = unit_or(world_from_start * target_m - muzzle.p_m, Vec3(0.0));
  return length(muzzle.q * Vec3(0, 0, 1) - towards);
}

TEST(Symmetry, AimHitsTheMovedAndTheMirroredTargetAsWell) {
  const StartDesc there{Vec3(3.0, 0.0, -5.0), 77.0};
  for (const Vec3& target_m : {Vec3(1.0, 1.4, 6.0), Vec3(4.0, 0.5, 3.0), Vec3(2.0, 2.6, 4.0)}) {
    EXPECT_LT(aim_error_rad({}, "left", target_m), 1.1e-5);
    EXPECT_LT(aim_error_rad(there, "left", target_m), 1.1e-5);
    EXPECT_LT(aim_error_rad({}, "right", mirror_point(target_m)), 1.1e-5);
  }
}

}  // namespace
}  // namespace contort
