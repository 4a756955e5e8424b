// The draw is a pure function of seed and index. Every result builds, and everything occurs.
#include "fuzz/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include "fuzz/compose.h"
#include "generator/actions/action.h"
#include "generator/generate.h"
#include "generator/stage.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "tests/checks/small_character.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

const DrawConfig kAll = [] {
  DrawConfig all{{"human", "mech", "quadruped"}};
  all.profile.wild_poses = true;
  return all;
}();

Spec draw(std::int64_t seed, std::int64_t index) { return draw_spec(kAll, stock_generator(), seed, index); }

std::vector<std::string> texts(std::int64_t first, std::int64_t step, int count) {
  std::vector<std::string> out;
  for (int i = 0; i < count; ++i) out.push_back(print_spec(draw(3, first + i * step)));
  return out;
}

TEST(DrawSlow, TwentyThousandDrawsAllBuildAndReadBack) {
  for (int i = 0; i < 20000; ++i) {
    const Spec spec = draw(1, i);
    const Result<Stage> stage = build_stage(spec, stock_library());
    ASSERT_TRUE(stage) << i << ": " << to_line(stage.issue()) << "\n" << pretty_spec(spec);
    if (i % 20 != 0) continue;
    const Result<Spec> read = parse_spec(print_spec(spec));
    ASSERT_TRUE(read) << to_line(read.issue());
    ASSERT_EQ(*read, spec) << i;
  }
}

struct Heaviest {
  double of_figure = 0.0;    // the heaviest load as a fraction of the figure's mass
  double of_strength = 0.0;  // the greatest fraction of a joint's strength that the weight of a load may need at rest
};

Heaviest heaviest_loads(const DrawConfig& config, Mode mode) {
  Heaviest out;
  for (int i = 0; i < 1500; ++i) {
    const Spec spec = draw_spec(config, stock_generator(), 4, i);
    if (spec.dynamics.loads.empty() || spec.dynamics.mode != mode) continue;
    const Stage stage = *build_stage(spec, stock_library());
    const Character& character = *stage.character;
    double mass_kg = 0.0;
    for (const Joint& joint : character.joints()) mass_kg += joint.mass_kg;
    std::vector<Rigid> world(character.joints().size());
    forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
    for (const LoadDesc& load : spec.dynamics.loads) {
      out.of_figure = std::max(out.of_figure, load.mass_kg / mass_kg);
      const Socket& socket = character.sockets()[at(character.find_socket(load.slot + "/" + load.socket))];
      const Vec3 place_m = world[at(socket.joint)] * socket.joint_from_socket.p_m;
      for (int j = socket.joint; j > 0; j = character.joint(j).parent) {
        const Joint& joint = character.joint(j);
        if (joint.kind != JointKind::hinge || load.mass_kg <= 0.5) continue;  // the least load
        const double arm_m = length(glm::cross(world[at(j)].q * joint.axis, place_m - world[at(j)].p_m));
        const double strength_N_m = std::min(joint.strength_high, -joint.strength_low);
        out.of_strength = std::max(out.of_strength, (load.mass_kg - 0.25) * 9.81 * arm_m / strength_N_m);  // rounded
      }
    }
  }
  return out;
}

TEST(Draw, LoadsAreSuchAsTheFigureShouldWithstand) {
  DrawConfig sensible{{"human", "mech", "quadruped"}};
  sensible.profile.tracking = sensible.profile.dynamic = 0.5;
  DrawConfig wild = sensible;
  wild.profile.wild_loads = true;
  const Heaviest tracked = heaviest_loads(sensible, Mode::tracking), simulated = heaviest_loads(sensible, Mode::dynamic);
  const Heaviest any = heaviest_loads(wild, Mode::tracking);
  EXPECT_GT(tracked.of_figure, 0.03);
  EXPECT_LT(tracked.of_figure, 0.06);
  EXPECT_GT(simulated.of_figure, 0.15);
  EXPECT_LE(simulated.of_strength, 0.5);
  EXPECT_GT(simulated.of_strength, 0.3);
  EXPECT_GT(any.of_figure, 0.2);
  EXPECT_GT(any.of_strength, 1.0);
}

TEST(Draw, ACaseDoesNotDependOnWhatWasDrawnBefore) {
  constexpr int kCount = 200;
  const std::vector<std::string> forwards = texts(0, 1, kCount);
  std::vector<std::string> backwards = texts(kCount - 1, -1, kCount);
  std::reverse(backwards.begin(), backwards.end());
  EXPECT_EQ(forwards, backwards);
}

TEST(Draw, ACaseDoesNotDependOnTheThread) {
  constexpr int kCount = 200;
  const std::vector<std::string> alone = texts(0, 1, kCount);
  std::array<std::vector<std::string>, 4> together;
  std::vector<std::thread> threads;
  for (std::vector<std::string>& out : together) threads.emplace_back([&out] { out = texts(0, 1, kCount); });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<std::string>& out : together) EXPECT_EQ(out, alone);
}

TEST(Draw, SeedsAndIndicesAllDiffer) {
  std::set<std::string> seen;
  for (int seed = 0; seed < 20; ++seed)
    for (int i = 0; i < 20; ++i) seen.insert(print_spec(draw(seed, i)));
  EXPECT_EQ(seen.size(), 400U);
}

TEST(Draw, TakesTheLargestSeedAndIndex) {
  const std::int64_t most = std::int64_t{1} << 53;
  EXPECT_TRUE(build_stage(draw(most, most), stock_library()));
  EXPECT_NE(print_spec(draw(most, 0)), print_spec(draw(most - 1, 0)));
}

// A change here means that (seed, index) of every stored case names another spec from now on: change kDrawStream in
// fuzz/draw.cpp, and put the printed values here.
TEST(Draw, TheFirstSpecsOfSeedSevenAreWhatTheyWere) {
  const std::array<std::string, 3> pinned = {"b6197cac8270f73e0479b97cdb13e620", "9fa482060a4a0688b7807f8aa9882667",
                                             "5c9153806f2ef05ad97906b94735b7a5"};
  for (std::size_t i = 0; i < pinned.size(); ++i)
    EXPECT_EQ(spec_id(draw(7, static_cast<std::int64_t>(i))), pinned[i]) << print_spec(draw(7, static_cast<int>(i)));
}

// The features seen in many draws: "action pose on kind arm", "mech_arm_shield in arm_left", "rifle", …
std::set<std::string> seen_in(int draws) {
  std::set<std::string> seen;
  for (int i = 0; i < draws; ++i) {
    const Spec spec = draw(5, i);
    const Result<Character> character = build_character(spec.character, stock_library());
    if (!character) continue;
    seen.insert(spec.character.name);
    for (const auto& [slot, part] : spec.character.parts) seen.insert(part + " in " + slot);
    for (const AttachmentDesc& a : spec.character.attachments) seen.insert(spec.character.name + " with " + a.object);
    for (const SequenceDesc& sequence : spec.sequences)
      for (const ClipDesc& clip : sequence.clips)
        for (const ActionUse& use : clip.actions) {
          const int part = character->find_part(use.slot);
          seen.insert(spec.character.name + " " + use.action + " on " + use.slot + " " +
                      character->parts()[static_cast<std::size_t>(part)].name);
        }
  }
  return seen;
}

void expect_actions(const std::string& name, const Character& character, const std::set<std::string>& seen) {
  for (const Part& part : character.parts())
    for (const ActionDef& action : all_actions())
      if (action.supports(character, part)) {
        EXPECT_EQ(seen.count(name + " " + std::string(action.name) + " on " + part.slot + " " + part.name), 1U)
            << name << " never does " << action.name << " with " << part.name << " on " << part.slot;
      }
}

TEST(Draw, EveryActionPartAndObjectOccurs) {
  const std::set<std::string> seen = seen_in(1500);
  for (const auto& [name, desc] : stock_library().characters) {
    for (const SlotDesc& slot : desc.slots)
      for (std::size_t option = 0; option < slot.parts.size(); ++option) {
        CharacterChoice choice{name, {}, {}};
        if (option > 0) {
          EXPECT_EQ(seen.count(slot.parts[option] + " in " + slot.name), 1U) << slot.parts[option];
          choice.parts[slot.name] = slot.parts[option];
        }
        const Result<Character> character = build_character(choice, stock_library());
        ASSERT_TRUE(character);
        expect_actions(name, *character, seen);
      }
    for (const std::string& object : desc.objects) EXPECT_EQ(seen.count(name + " with " + object), 1U) << object;
  }
}

// A pose that is out of range by itself would be the fuzzer's fault, not the generator's. Whole degrees may round a
// ball joint's target over the edge by at most half a degree an axis.
TEST(Draw, InterruptsWaitForEveryEvent) {
  std::set<std::string_view> seen;
  for (int i = 0; i < 1000; ++i)
    for (const InterruptDesc& interrupt : draw(7, i).interrupts) seen.insert(event_name(interrupt.when.event));
  for (const std::string_view name : event_names()) EXPECT_TRUE(seen.contains(name)) << name;
}

bool has_begun(const Motion& motion, std::size_t sequence) {
  return std::ranges::any_of(motion.queue, [&](const QueueSpan& s) { return std::cmp_equal(s.sequence, sequence); });
}

// An interrupt that waits for an event that nothing causes is never played.
TEST(Draw, MostInterruptsComeIn) {
  DrawConfig config = kAll;
  config.profile.tracking = config.profile.dynamic = 0.0;
  int drawn = 0, came = 0;
  for (int i = 0; i < 1000; ++i) {
    const Spec spec = draw_spec(config, stock_generator(), 7, i);
    if (spec.interrupts.empty()) continue;
    const Motion motion = generate(*build_stage(spec, stock_library()));
    for (std::size_t k = 0; k < spec.interrupts.size(); ++k)
      ++drawn, came += has_begun(motion, spec.sequences.size() + k) ? 1 : 0;
  }
  EXPECT_GT(drawn, 200);
  EXPECT_GT(came, 0.8 * drawn) << came << " of " << drawn;
}

TEST(Draw, AllModesLoadsAndImpactsOccur) {
  std::map<Mode, int> modes;
  int loads = 0, impacts = 0;
  for (int i = 0; i < 1600; ++i) {
    const DynamicsDesc dynamics = draw(7, i).dynamics;
    ++modes[dynamics.mode];
    loads += static_cast<int>(dynamics.loads.size()), impacts += static_cast<int>(dynamics.impacts.size());
    EXPECT_TRUE(dynamics.mode != Mode::kinematic || dynamics == DynamicsDesc{});
  }
  EXPECT_NEAR(modes[Mode::tracking], 50, 25);
  EXPECT_NEAR(modes[Mode::dynamic], 50, 25);
  EXPECT_GT(loads, 30);
  EXPECT_GT(impacts, 30);
}

TEST(Draw, PosesStayWithinTheRangesOfTheirJoints) {
  const double allowance = 0.5 * std::sqrt(3.0) * kRadPerDeg;
  double least = 1.0;
  for (int i = 0; i < 300; ++i) {
    Spec spec = draw(9, i);
    spec.interrupts.clear();
    spec.dynamics = {};
    spec.environment = {};  // feet on a slope bend without any pose
    for (SequenceDesc& sequence : spec.sequences)
      for (ClipDesc& clip : sequence.clips)
        std::erase_if(clip.actions, [](const ActionUse& use) { return use.action != "pose"; });
    const Result<Stage> stage = build_stage(spec, stock_library());
    ASSERT_TRUE(stage);
    StageEvaluator evaluator;
    const Evaluation evaluation = evaluator.run(*stage, "joint_range");
    for (const Finding& finding : evaluation.findings) {
      const bool ball =
          finding.subject.find("swing") != std::string::npos || finding.subject.find("twist") != std::string::npos;
      if (!ball) ADD_FAILURE() << i << " " << finding.subject << " " << finding.worst_margin;
      if (finding.worst_frame == stage->most_frames - 1) least = std::min(least, finding.worst_margin);
    }
  }
  EXPECT_GT(least, -allowance);
}

RawSpec filled(int value) {
  RawSpec raw;
  raw.character = raw.hold = value;
  raw.parts.fill(value);
  raw.objects.fill(value);
  RawAction action{value, value, value, value, value, {}};
  action.values.fill(value);
  const RawClip clip{value, value, value, {action, action}};
  raw.sequences = {{clip}, {clip, clip}};
  return raw;
}

TEST(Compose, EveryRawValueMakesASpecThatBuilds) {
  for (const int value : {0, 1, 3333, 3334, 4999, 5000, 5001, 6666, 9998, 9999, kLattice})
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{"human"}, {"mech"}, {"quadruped"}, {"human", "mech", "quadruped"}}) {
      const Spec spec = compose(filled(value), {names}, stock_generator());
      const Result<Stage> stage = build_stage(spec, stock_library());
      ASSERT_TRUE(stage) << value << ": " << to_line(stage.issue());
      EXPECT_EQ(spec.sequences.size(), 2U);
    }
}

TEST(Compose, WithoutSequencesNothingMoves) {
  RawSpec raw = filled(5000);
  raw.sequences.clear();
  EXPECT_TRUE(compose(raw, {{"human"}}, stock_generator()).sequences.empty());
  raw.sequences = {{}, {RawClip{}}};
  EXPECT_TRUE(compose(raw, {{"human"}}, stock_generator()).sequences.empty());
}

TEST(Compose, ACharacterOfOnesOwnIsDrawnToo) {
  const Library library = small::library();
  BuiltInGenerator generator(library);
  for (int i = 0; i < 50; ++i) {
    const Spec spec = draw_spec({{"small"}}, generator, 1, i);
    EXPECT_FALSE(spec.sequences.empty());
    ASSERT_TRUE(build_stage(spec, library)) << i;
  }
}

}  // namespace

}  // namespace contort
