#include "renders/shots.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/motion/legs.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "renders/contact_marks.h"
#include "renders/range_marks.h"
#include "renders/response_marks.h"
#include "renders/scenery.h"

namespace contort {
namespace {

bool has_response(const Motion& motion) { return !motion.response.stances.empty(); }

bool is_whole(const Character& character, const Motion& motion) {
  return motion.coord_count == character.coord_count() && motion.frame_count >= 0 &&
         motion.coords.size() == at(motion.frame_count) * at(motion.coord_count) &&
         motion.root.size() == at(motion.frame_count);
}

// The degrees of freedom of the root and all joints, which is the length of a row of Response::control.
int freedoms_of(const Character& character) {
  int count = 0;
  for (const Joint& joint : character.joints()) count += freedom_count(joint.kind);
  return count;
}

bool is_whole(const Character& character, const Motion& motion, const Response& response) {
  const auto frames = at(motion.frame_count);
  return response.dof_count == freedoms_of(character) && response.stances.size() == frames &&
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
      : story_(story),
        figure_(figure),
        highlight_(highlight),
        environment_(environment_of(story)),
        figure_m_(figure_size_m(story.character)),
        world_(story.character.joints().size()) {
    if (story.finding && story.finding->check == "joint_range") ranged_ = highlight.joints;
    if (story.skin) groups_ = highlight_groups_of_joints(story.character, highlight, story.skin->moved);
    if (has_response(story.motion)) legs_ = find_legs(story.character);
  }

  DrawList shoot(int frame, std::vector<Triangles>& meshes) {
    DrawList list;
    const bool haunted = place_ghost(frame);
    if (haunted) add_look(Look::ghost, list, meshes);
    place_figure(story_.motion.root[at(frame)], story_.motion.row(frame));
    add_look(haunted ? Look::pale : Look::solid, list, meshes);
    for (const int joint : ranged_)
      add_range_mark(story_.character, joint, world_, story_.motion.row(frame), list, meshes);
    if (const auto contact = contact_of_finding()) add_contact_mark(*contact, figure_m_, list, meshes);
    if (!has_response(story_.motion)) return list;
    const ResponseFrame of{story_.character, legs_, story_.motion, frame, world_};
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

  void add_look(Look look, DrawList& list, std::vector<Triangles>& meshes) const {
    add_figure(list, figure_, world_, look);
    if (!story_.skin) return;
    PosedSkin posed = pose_skin(*story_.skin, world_, groups_);
    list.complete = list.complete && posed.complete;
    for (SkinPiece& piece : posed.pieces) {
      const bool ghost = look == Look::ghost;
      meshes.push_back(std::move(piece.triangles));
      add_instance(list, {.mesh = static_cast<int>(meshes.size()) - 1,
                          .world_from_mesh = {kNoRotation, posed.origin_m},
                          .color = color_in(look, skin_color(piece.group, !highlight_.empty()), piece.group),
                          .highlight = ghost ? 0 : piece.group,
                          .ghost = ghost});
    }
  }

  // Returns false if there is no ghost.
  bool place_ghost(int frame) {
    const Response& response = story_.motion.response;
    if (story_.ghost) {
      if (frame >= story_.ghost->frame_count) return false;
      place_figure(story_.ghost->root[at(frame)], story_.ghost->row(frame));
    } else if (has_response(story_.motion)) {
      const auto count = at(story_.motion.coord_count);
      place_figure(response.target_root[at(frame)],
                   std::span(response.target_coords).subspan(at(frame) * count, count));
    }
    return story_.ghost || has_response(story_.motion);
  }

  std::optional<NearestPoints> contact_of_finding() const {
    if (!story_.finding) return {};
    if (story_.finding->check == "obstacle_penetration")
      return contact_with_obstacle(story_.character, environment_, highlight_, world_);
    return contact_of_pair(story_.character, highlight_, world_);
  }

  const Story& story_;
  const Figure& figure_;
  const Highlight& highlight_;
  Environment environment_;
  double figure_m_;
  std::vector<Rigid> world_;
  std::vector<int> groups_;               // groups of joints, by highlight; only for a skin
  std::vector<int> ranged_;               // joints whose range is shown
  std::vector<Leg> legs_;                 // legs of a motion with a response
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
  // At most 40 degrees off the axis, because a view from the front is easier to understand.
  constexpr double kGoodEnough = 0.75;
  std::erase_if(views, [&](const View& view) { return along(view) < kGoodEnough * most; });
  return views;
}

Shots take_shots(const Story& story, std::span<const int> frames) {
  const Environment environment = environment_of(story);
  const Highlight highlight = story.finding ? highlighted(story.character, *story.finding) : Highlight{};
  Figure figure = make_figure(story.character, highlight, story.skin != nullptr);
  if (story.colliders) add_wires(story.character, figure);
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
