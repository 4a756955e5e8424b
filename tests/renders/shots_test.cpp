#include "renders/shots.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "generator/generate.h"
#include "model/core/files.h"
#include "model/motion/kinematics.h"
#include "renders/response_marks.h"

namespace contort {
namespace {

const std::string kSquat = CONTORT_SOURCE_DIR "/docs/experiments/squat/";
constexpr int kFrames[] = {0, 4, 20, 40};

struct Played {
  Spec spec;
  Stage stage;
  Motion motion;
  explicit Played(const std::string& name) {
    Library library = stock_library();
    if (const Result<Done> loaded = load_folder(kSquat + "actions", library); !loaded) ADD_FAILURE();
    spec = parse_spec(read_file(kSquat + name + ".json").value()).value();
    stage = build_stage(spec, library).value();
    motion = generate(stage);
  }
  Story story() const {
    return {
        .character = *stage.character, .motion = motion, .environment = &stage.environment, .dynamics = &spec.dynamics};
  }
};

// One for each piece of the mesh, in their order.
std::vector<DrawInstance> figure_of(const DrawList& list, bool ghost) {
  std::vector<DrawInstance> pieces;
  for (const DrawInstance& instance : list.instances)
    if (!instance.mark && instance.ghost == ghost) pieces.push_back(instance);
  return pieces;
}

int count(const DrawList& list, const Vec3& color) {
  return static_cast<int>(
      std::ranges::count_if(list.instances, [&](const DrawInstance& i) { return i.color == color; }));
}

TEST(Shots, ShowTheTargetAsAGreyGhostOfAPaleFigure) {
  const Played played("c_8_kg");
  const Shots shots = take_shots(played.story(), kFrames);
  ASSERT_EQ(shots.lists.size(), std::size(kFrames));
  const auto mesh = played.stage.character->mesh();
  std::vector<Rigid> target(played.stage.character->joints().size()), result = target;
  for (std::size_t i = 0; i < std::size(kFrames); ++i) {
    const auto frame = static_cast<std::size_t>(kFrames[i]),
               count = static_cast<std::size_t>(played.motion.coord_count);
    const Response& response = played.motion.response;
    forward_kinematics(*played.stage.character, response.target_root[frame],
                       std::span(response.target_coords).subspan(frame * count, count), target);
    forward_kinematics(*played.stage.character, played.motion.root[frame], played.motion.row(kFrames[i]), result);
    const std::vector<DrawInstance> ghost = figure_of(shots.lists[i], true), pale = figure_of(shots.lists[i], false);
    ASSERT_EQ(ghost.size(), mesh.size());
    ASSERT_EQ(pale.size(), mesh.size());
    for (std::size_t p = 0; p < mesh.size(); ++p) {
      const auto joint = static_cast<std::size_t>(mesh[p].joint);
      EXPECT_EQ(ghost[p].world_from_mesh, target[joint]);
      EXPECT_EQ(pale[p].world_from_mesh, result[joint]);
      EXPECT_LT(ghost[p].color.x, 0.2);
      EXPECT_GT(pale[p].color.x, 0.7);
    }
  }
}

TEST(Shots, ShowWhatControlDid) {
  const Played played("c_8_kg");
  const Shots shots = take_shots(played.story(), kFrames);
  const auto& links = played.stage.dynamics->figure.body.links();
  for (std::size_t i = 0; i < std::size(kFrames); ++i) {
    int shown = 0;  // number of visible angles; no limb here turns about its own length
    for (const Link& link : links) {
      double square = 0.0;
      for (int k = 0; k < (link.dof == 0 ? 3 : link.dof_count); ++k) {
        const int entry = kFrames[i] * played.motion.response.dof_count + link.dof + k;
        const double value = played.motion.response.control[static_cast<std::size_t>(entry)];
        square += value * value;
      }
      const double scale = link.dof == 0 ? kArrow_m_per_m_s2 : kArrow_m_per_rad_s2;
      shown += scale * scale * square >= kLeastArrow_m * kLeastArrow_m ? 1 : 0;
    }
    EXPECT_EQ(count(shots.lists[i], kControlColor), shown) << kFrames[i];
    if (kFrames[i] > 0) {
      EXPECT_GT(shown, 0) << kFrames[i];
    }
    EXPECT_EQ(count(shots.lists[i], kLoadColor), 1);
    EXPECT_EQ(count(shots.lists[i], kBalancedColor), 2);
    EXPECT_EQ(count(shots.lists[i], kImpactColor), 0);
  }
}

TEST(Shots, ShowTheBlowFromItsFrameOn) {
  const Played played("d_blow");
  const Shots shots = take_shots(played.story(), std::vector<int>{2, 3, 12, 13});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(count(shots.lists[i], kImpactColor), i == 1 || i == 2 ? 1 : 0) << i;
    EXPECT_EQ(count(shots.lists[i], kLoadColor), 0);
  }
}

TEST(Shots, OfAKinematicMotionHaveNothingAdded) {
  Played played("a_nothing_added");
  played.motion.response = {};
  const Shots shots = take_shots(played.story(), kFrames);
  const auto mesh = played.stage.character->mesh();
  for (const DrawList& list : shots.lists) {
    ASSERT_EQ(list.instances.size(), mesh.size());
    for (std::size_t p = 0; p < mesh.size(); ++p) EXPECT_EQ(list.instances[p].color, mesh[p].color);
  }
}

TEST(Shots, KeepWhatIsHighlightedRed) {
  const Played played("d_blow");
  const Finding finding{"self_collision", "arm_right/forearm ~ waist", "m", 8, 12, 16, -0.08, 1.0};
  Story story = played.story();
  story.finding = &finding;
  const Shots shots = take_shots(story, kFrames);
  for (const DrawInstance& instance : figure_of(shots.lists[1], false)) {
    EXPECT_EQ(instance.highlight > 0, instance.color.y < 0.3) << instance.color.x;
  }
}

TEST(CheckStory, RefusesWhatDoesNotBelongTogether) {
  Played played("a_nothing_added");
  EXPECT_TRUE(check_story(played.story(), kFrames).ok());
  const int beyond[] = {0, played.motion.frame_count};
  EXPECT_EQ(check_story(played.story(), beyond).issue().code, "render.bad_frame");
  played.motion.response.control.pop_back();
  EXPECT_EQ(check_story(played.story(), kFrames).issue().code, "render.wrong_motion");
  played.motion = {};
  played.motion.coord_count = played.stage.character->coord_count();
  EXPECT_EQ(check_story(played.story(), {}).issue().code, "render.no_frames");
}

}  // namespace
}  // namespace contort
