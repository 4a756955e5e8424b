// The actions that hold the two exclusive layers of a part, overwrite and ik, and the share to which each has come in.
// The postures are moved in generate.cpp; docs/reference/timeline.md has the rules.
#pragma once

#include "generator/playback.h"

namespace contort {

// The action that has a layer. It takes over from the posture that it finds: `eased` is the progress that its easing
// had in the frame before, so the rest of the way is covered in the rest of the time.
struct LayerHold {
  int action = -1;        // index into Timeline::actions; -1: none
  int run = -1;           // index into the queue's history
  int frame = -1;         // of the motion, in which it took over
  double came = 0.0;      // the content frame at which it took over
  double eased = 0.0;     // [0, 1]
  int restarts = 0;       // of this hold, by restart_ik
  int blend_frames = -1;  // over which an action comes in that takes its time, or a course of legs that needs longer
                          // than its use says; -1: not known yet, or as the use says
  int fade_frames = -1;   // over which a course of legs fades out that needs longer than it says; -1: it does not
  double since = -1e30;   // when the last action that had the layer began, in frames of the motion
  int since_action = -1;  // that action: none that began earlier gets the layer
  bool operator==(const LayerHold&) const = default;
};

// The plan of a hold's action and its content frame; in [0, 1] how far it has come in, and how much of it is left while
// it fades out. The hold must have an action.
const PlannedAction& planned(const Playback& playback, const LayerHold& hold);
int content(const Playback& playback, const LayerHold& hold);
double come_in(const Playback& playback, const LayerHold& hold);
double left_of(const Playback& playback, const LayerHold& hold);

// The share of the way from the posture that a hold found to the one that it wants, in [0, 1] for eased < 1.
double covered(const Playback& playback, const LayerHold& hold);

bool moves_legs(const Playback& playback, const LayerHold& hold);

// Whether the action takes its part at once, as its use says, in this frame or the one before.
bool is_cut(const Playback& playback, const LayerHold& hold);

// Whether legs have put the foot where it belongs: blended angles would have it slide.
bool places_foot(const Playback& playback, const LayerHold& hold, std::size_t part);

class LayerStack {
 public:
  // The steps of a frame, in this order.
  struct Change {
    bool settles = false;           // the ik pose becomes the base, and an overwrite action beneath continues from it
    bool overwrite_begins = false;  // from the base
    bool ik_begins = false;         // from the base, or,
    bool ik_follows = false;        // where ik had the layer already, from what was shown
    bool ik_restarts = false;       // the same action, from what was shown
    bool returns = false;           // a leg or foot goes to where its course has it; another action moved it before
    bool operator==(const Change&) const = default;
  };

  // Brings both holds to the playback's frame; frames in rising order. `root` is what holds the layer ik of the root part
  // in this frame; for that part itself it does not matter.
  Change advance(const Playback& playback, std::size_t part, const LayerHold& root);

  // Sets the frames in which the action that has just begun comes in.
  void set_ik_blend(int frames) { ik_.blend_frames = frames; }

  // Sets the frames in which the course that has the layer ik fades out before its end.
  void set_ik_fade(int frames) { ik_.fade_frames = frames; }

  // Has the action that has the layer ik come in once more, from where its part is, in the next frame.
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
