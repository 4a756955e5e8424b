#include "renders/shots.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "generator/motion/kinematics.h"
#include "generator/motion/legs.h"
#include "renders/range_marks.h"
#include "renders/response_marks.h"
#include "renders/scenery.h"

namespace contort {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

bool has_response(const Motion& motion) { return !motion.response.stances.empty(); }

bool is_whole(const Character& character, const Motion& motion) {
  return motion.coord_count == character.coord_count() && motion.frame_count >= 0 &&
         motion.coords.size() == at(motion.frame_count) * at(motion.coord_count) &&
         motion.root.size() == at(motion.frame_count);
}

bool is_whole(const Character& character, const Motion& motion, const Response& response) {
  const auto frames = at(motion.frame_count);
  return response.dof_count == Multibody::of(character).dof_count() && response.stances.size() == frames &&
         response.target_coords.size() == motion.coords.size() && response.target_root.size() == frames &&
         response.control.size() == frames * at(response.dof_count);
}

Result<Done> check_motion(const Character& character, const Motion& motion) {
  if (!is_whole(character, motion) || (has_response(motion) && !is_whole(character, motion, motion.response)))
    return Issue{"render.wrong_motion", "", "The motion does not belong to the character " + character.name() + "."};
  if (motion.frame_count == 0) return Issue{"render.no_frames", "", "The motion has no frames."};
  return Done{};
}

// Draws frame by frame.
class Photographer {
 public:
  Photographer(const Story& story, const Figure& figure, const Highlight& highlight)
      : story_(story), figure_(figure), world_(story.character.joints().size()) {
    if (story.finding && story.finding->check == "joint_range") ranged_ = highlight.joints;
    if (has_response(story.motion)) physics_ = build_figure(story.character, find_legs(story.character), {});
  }

  DrawList shoot(int frame, std::vector<Triangles>& meshes) {
    DrawList list;
    const bool haunted = place_ghost(frame);
    if (haunted) add_figure(list, figure_, world_, Look::ghost);
    place_figure(story_.motion.root[at(frame)], story_.motion.row(frame));
    add_figure(list, figure_, world_, haunted ? Look::pale : Look::solid);
    for (const int joint : ranged_)
      add_range_mark(story_.character, joint, world_, story_.motion.row(frame), list, meshes);
    if (!physics_) return list;
    const ResponseFrame of{story_.character, *physics_, story_.motion, frame, world_};
    if (story_.dynamics) add_loads(story_.dynamics->loads, story_.character, world_, list, meshes);
    add_balance_marks(of, list, meshes);
    add_control_arrows(of, list, meshes);
    add_impact_arrows(of, list, meshes);
    return list;
  }

 private:
  void place_figure(const Rigid& root, std::span<const double> coords) {
    forward_kinematics(story_.character, root, coords, world_);
  }

  // false: there is none.
  bool place_ghost(int frame) {
    const Response& response = story_.motion.response;
    if (story_.ghost) {
      if (frame >= story_.ghost->frame_count) return false;
      place_figure(story_.ghost->root[at(frame)], story_.ghost->row(frame));
    } else if (physics_) {
      const auto count = at(story_.motion.coord_count);
      place_figure(response.target_root[at(frame)],
                   std::span(response.target_coords).subspan(at(frame) * count, count));
    }
    return story_.ghost || physics_;
  }

  const Story& story_;
  const Figure& figure_;
  std::vector<Rigid> world_;
  std::vector<int> ranged_;  // joints whose range is shown
  std::optional<DynamicFigure> physics_;  // of a motion with a response
};

Vec3 anchor_of(const Motion& motion, const Environment& environment, int frame) {
  const Vec3& root = motion.root[at(frame)].p_m;
  const bool usable = std::fabs(root.x) <= kWorldReach_m && std::fabs(root.z) <= kWorldReach_m;
  return usable ? Vec3(root.x, environment.height_at(root.x, root.z), root.z) : Vec3(0.0);
}

}  // namespace

Environment environment_of(const Story& story) { return story.environment ? *story.environment : Environment(); }

Result<Done> check_story(const Story& story, std::span<const int> frames) {
  if (Result<Done> fits = check_motion(story.character, story.motion); !fits) return fits;
  for (const int frame : frames)
    if (frame < 0 || frame >= story.motion.frame_count)
      return Issue{"render.bad_frame", "",
                   "found frame " + std::to_string(frame) + ", the motion has frames 0 to " +
                       std::to_string(story.motion.frame_count - 1)};
  return story.ghost ? check_motion(story.character, *story.ghost) : Done{};
}

std::vector<View> views_of_angle(const Story& story, int frame, std::vector<View> views) {
  const bool ranged = story.finding && story.finding->check == "joint_range";
  const Highlight highlight = ranged ? highlighted(story.character, *story.finding) : Highlight{};
  if (highlight.joints.size() != 1) return views;
  const Joint& joint = story.character.joints()[at(highlight.joints.front())];
  if (joint.kind != JointKind::hinge) return views;
  std::vector<Rigid> world(story.character.joints().size());
  forward_kinematics(story.character, story.motion.root[at(frame)], story.motion.row(frame), world);
  const Vec3 axis = world[at(highlight.joints.front())].q * joint.axis;
  const auto along = [&](const View& view) { return std::fabs(glm::dot(towards_eye(view), axis)); };
  double most = 0.0;
  for (const View& view : views) most = std::max(most, along(view));
  constexpr double kGoodEnough = 0.75;  // 40 degrees off the axis; a view from the front is understood sooner
  std::erase_if(views, [&](const View& view) { return along(view) < kGoodEnough * most; });
  return views;
}

Shots take_shots(const Story& story, std::span<const int> frames) {
  const Environment environment = environment_of(story);
  const Highlight highlight = story.finding ? highlighted(story.character, *story.finding) : Highlight{};
  const Figure figure = make_figure(story.character, highlight);
  Photographer photographer(story, figure, highlight);
  Shots shots;
  shots.meshes = figure.meshes;
  for (const int frame : frames) {
    shots.frames.push_back(frame);
    shots.lists.push_back(photographer.shoot(frame, shots.meshes));
    shots.outlines.push_back(outline(shots.lists.back(), shots.meshes));
    shots.anchors.push_back(anchor_of(story.motion, environment, frame));
  }
  return shots;
}

void add_scenery(const Story& story, std::span<const std::vector<Vec3>> outlines, Shots& shots) {
  const Scenery scenery = make_scenery(environment_of(story), region_around(outlines), shots.meshes);
  for (DrawList& list : shots.lists) list.scenery = scenery;
}

}  // namespace contort
