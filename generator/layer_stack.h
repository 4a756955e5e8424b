// The actions that control the two exclusive layers of a part, overwrite and ik, and how far each has blended in. The
// postures are moved in generate.cpp; docs/reference/timeline.md has the rules.
#pragma once

#include "generator/playback.h"

namespace contort {

// The action that controls a layer. It takes over from the present posture: `eased` is the progress of its easing in
// the previous frame, so the rest of the distance is covered in the rest of the time.
struct LayerHold {
  int action = -1;        // index into Timeline::actions; -1: none
  int run = -1;           // index into the queue's history
  int frame = -1;         // frame of the motion in which it took over
  double came = 0.0;      // the content frame at which it took over
  double eased = 0.0;     // [0, 1]
  int restarts = 0;       // number of restarts of this hold by restart_ik
  // Frames in which an action with automatic blending blends in, or a course of legs that needs longer than its use
  // asks; -1: not known yet, or as in the use.
  int blend_frames = -1;
  // Frames in which a course of legs fades out that needs longer than its use asks; -1: as in the use.
  int fade_frames = -1;
  double since = -1e30;   // frame of the motion in which the latest action of the layer began
  int since_action = -1;  // that action: no earlier one gets the layer
  bool operator==(const LayerHold&) const = default;
};

// The plan of a hold's action, and its content frame; in [0, 1] how far it has blended in, and how much of it is left
// while it fades out. The hold must have an action.
const PlannedAction& planned(const Playback& playback, const LayerHold& hold);
int content(const Playback& playback, const LayerHold& hold);
double come_in(const Playback& playback, const LayerHold& hold);
double left_of(const Playback& playback, const LayerHold& hold);

// The fraction of the way from the posture at the hold's start to its wanted one, in [0, 1] for eased < 1.
double covered(const Playback& playback, const LayerHold& hold);

bool moves_legs(const Playback& playback, const LayerHold& hold);

// Returns true if the action takes its part at once, as its use asks, in this frame or the previous one.
bool is_cut(const Playback& playback, const LayerHold& hold);

// Returns true if legs have placed the foot: with blended angles it would slide.
bool places_foot(const Playback& playback, const LayerHold& hold, std::size_t part);

class LayerStack {
 public:
  // The steps of a frame, in this order.
  struct Change {
    bool settles = false;           // the ik pose becomes the base, and an overwrite action beneath continues from it
    bool overwrite_begins = false;  // from the base
    bool ik_begins = false;         // from the base, or,
    bool ik_follows = false;        // if ik had the layer already, from the shown posture
    bool ik_restarts = false;       // the same action, from the shown posture
    bool returns = false;           // a leg or foot returns to its course; another action moved it before
    bool operator==(const Change&) const = default;
  };

  // Advances both holds to the playback's frame; frames in rising order. `root` is the hold of the layer ik of the root
  // part in this frame; it is ignored for that part itself.
  Change advance(const Playback& playback, std::size_t part, const LayerHold& root);

  // Sets the number of frames in which the action that has just begun blends in.
  void set_ik_blend(int frames) { ik_.blend_frames = frames; }

  // Sets the number of frames in which the course on the layer ik fades out before its end.
  void set_ik_fade(int frames) { ik_.fade_frames = frames; }

  // Lets the action on the layer ik blend in once more, from its part's present posture, in the next frame.
  void restart_ik() { restarts_ = ik_.action >= 0; }

  const LayerHold& overwrite() const { return overwrite_; }
  const LayerHold& ik() const { return ik_; }

 private:
  bool restart(const Playback& playback);
  bool take_over(const Playback& playback, std::size_t part, const LayerHold& next, LayerHold& hold) const;
  bool comes_to_course(const Playback& playback, std::size_t part) const;
  bool stands_for(const Playback& playback, const LayerHold& next, std::size_t part) const;

  LayerHold overwrite_;
  LayerHold ik_;
  bool restarts_ = false;
};

}  // namespace contort
