// The bodies of calls. One list of fields for each: reading, limits and the OpenAPI document come from it.
// Included from .cpp files only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/spec/spec_fields.h"
#include "model/world/environment_fields.h"

namespace contort::server {

using json_fields::Rule;
using json_fields::Text;

inline const Rule kAnyLabel{.text = Text::label, .may_be_empty = true};
inline const Rule kNeededLabel{.text = Text::label, .required = true};
inline constexpr std::string_view kQueueEnds[] = {"front", "after_clip", "after_sequence", "end"};

struct NoBody {};
template <class V>
void fields(V&, const NoBody*) {}

struct EvaluateBody {
  Spec spec;
  std::string library;
};
template <class V>
void fields(V& v, const EvaluateBody*) {
  v.field("spec", &EvaluateBody::spec, {.required = true}, "The action specification.");
  v.field("library", &EvaluateBody::library, kAnyLabel, "Of POST /api/libraries.");
}

struct SessionBody {
  Spec spec;
  std::vector<Mode> modes;
  std::string library;
};
template <class V>
void fields(V& v, const SessionBody*) {
  v.field("spec", &SessionBody::spec, {.required = true}, "The take begins with it.");
  v.field("modes", &SessionBody::modes, {.max_count = 3, .names = mode_names()},
          "Each is a motion of its own; the spec's mode where left out.");
  v.field("library", &SessionBody::library, kAnyLabel, "Of POST /api/libraries.");
}

struct EnqueueBody {
  SequenceDesc sequence;
  Enter enter = Enter::end;
};
template <class V>
void fields(V& v, const EnqueueBody*) {
  v.field("sequence", &EnqueueBody::sequence, {.required = true}, "Waits in the queue.");
  v.field("enter", &EnqueueBody::enter, {.names = kQueueEnds}, "Its place there.");
}

struct InterruptBody {
  SequenceDesc sequence;
  bool resume = true;
};
template <class V>
void fields(V& v, const InterruptBody*) {
  v.field("sequence", &InterruptBody::sequence, {.required = true}, "Sequence that runs at once.");
  v.field("resume", &InterruptBody::resume, {},
          "Whether the interrupted sequence continues afterwards; otherwise its rest is dropped.");
}

struct AimBody {
  std::string slot;
  std::string action = "aim";
  std::string point;
  Vec3 target_m{0.0};
  int duration_frames = 90;
};
inline const Rule kWorld{.low = -1000, .high = 1000, .required = true};
template <class V>
void fields(V& v, const AimBody*) {
  v.field("slot", &AimBody::slot, {.required = true}, "The slot whose part aims.");
  v.field("action", &AimBody::action, {}, "Action that aims: aim or look_at.");
  v.field("point", &AimBody::point, {.may_be_empty = true}, "Point that aims; the model's aims list them.");
  v.field("target_m", &AimBody::target_m, kWorld, "Target in the world.");
  v.field("duration_frames", &AimBody::duration_frames, {.low = 2, .high = 6000}, "Duration of the aim.");
}

struct PushBody {
  std::string slot;
  std::string joint;
  Vec3 point_m{0.0};
  Vec3 impulse_N_s{0.0};
};
template <class V>
void fields(V& v, const PushBody*) {
  v.field("slot", &PushBody::slot, {.required = true}, "The slot whose part is struck.");
  v.field("joint", &PushBody::joint, {.may_be_empty = true}, "Joint of that part, by its name in the part.");
  v.field("point_m", &PushBody::point_m, {.low = -10, .high = 10}, "Struck point in the frame of that joint.");
  v.field("impulse_N_s", &PushBody::impulse_N_s, {.low = -10000, .high = 10000, .required = true},
          "Impulse in the world, N s.");
}

struct ClockBody {
  std::optional<bool> play;
  std::optional<int> step;
  bool restart = false;
};
template <class V>
void fields(V& v, const ClockBody*) {
  v.field("play", &ClockBody::play, {}, "Whether the clock runs.");
  v.field("step", &ClockBody::step, {.low = -36000, .high = 36000},
          "Stops the clock, this number of frames from where it is.");
  v.field("restart", &ClockBody::restart, {}, "Goes to the first frame of the take.");
}

struct ChangeBody {
  std::optional<CharacterChoice> character;
  std::optional<EnvironmentDesc> environment;
  std::optional<std::vector<LoadDesc>> loads;
  std::optional<std::vector<Mode>> modes;
};
template <class V>
void fields(V& v, const ChangeBody*) {
  v.field("character", &ChangeBody::character, {}, "Character with its parts and objects.");
  v.field("environment", &ChangeBody::environment, {}, "Ground and obstacles.");
  v.field("loads", &ChangeBody::loads, {.max_count = 16}, "All loads that the figure carries from now on.");
  v.field("modes", &ChangeBody::modes, {.max_count = 3, .names = mode_names()},
          "Modes of dynamics; each has a motion of its own.");
}

struct CaseBody {
  std::string check;
  std::string subject;
  Mode mode = Mode::kinematic;
  int take = 0;
};
template <class V>
void fields(V& v, const CaseBody*) {
  v.field("check", &CaseBody::check, {.required = true}, "Check of the finding.");
  v.field("subject", &CaseBody::subject, {.text = Text::prose, .required = true}, "Subject of the finding.");
  v.field("mode", &CaseBody::mode, {.names = mode_names(), .required = true},
          "Mode of the motion in which it was found.");
  v.field("take", &CaseBody::take, {.low = 0, .high = 1e9},
          "Number of the present take or of the one before; 0: the present one.");
}

struct AcknowledgeBody {
  std::string owner;
  std::string ticket;
};
template <class V>
void fields(V& v, const AcknowledgeBody*) {
  v.field("owner", &AcknowledgeBody::owner, kNeededLabel, "Person who is responsible for the failure.");
  v.field("ticket", &AcknowledgeBody::ticket, kNeededLabel, "Ticket or address of the ticket.");
}

struct QuarantineBody {
  std::string owner;
  std::string reason;
  std::string expires;
};
template <class V>
void fields(V& v, const QuarantineBody*) {
  v.field("owner", &QuarantineBody::owner, kNeededLabel, "Person who is responsible for the failure.");
  v.field("reason", &QuarantineBody::reason, {.text = Text::prose, .required = true},
          "Reason why the failure may happen.");
  v.field("expires", &QuarantineBody::expires, kNeededLabel, "The last day, YYYY-MM-DD, at most 30 days from now.");
}

struct NoteBody {
  std::string text;
};
template <class V>
void fields(V& v, const NoteBody*) {
  v.field("text", &NoteBody::text, {.text = Text::prose, .required = true, .may_be_empty = true},
          "\"\" takes the note away.");
}

}  // namespace contort::server
