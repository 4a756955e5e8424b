// A Generator is the system under test. It declares its offers (Manifest, Offers), and turns a Spec into an Execution.
// The built-in one is generator/built_in.h. Search, checks, corpus, renders and server know only this interface.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/character/character.h"
#include "model/character/library.h"
#include "model/core/result.h"
#include "model/motion/execution.h"
#include "model/spec/action_param.h"
#include "model/spec/spec.h"

namespace contort {

inline constexpr int kMaxFrames = 36000;  // longest motion: ten minutes at 60 Hz

// The code of an issue with which a program under test refuses a request that its manifest allows. Its text begins like
// this, followed by the program's own words.
inline constexpr std::string_view kRefusedCode = "guest.refused";
inline constexpr std::string_view kRefusedText = "the generator refuses the request: ";

// A goal is reached at the end of the action's period; a course is a posture as a function of time
// (docs/reference/timeline.md).
enum class Timing { goal, course };

// The goal that an action sets for the limb that it moves. Checks read it from the intent (model/motion/intent.h).
enum class Promise {
  none,
  arrives,  // at its end the part's tip is at its first parameter, a point in the character's frame
  holds,    // while it is in force the part's grip is at its first parameter, a point of an object
  aims,     // while it is in force the part faces a target, or points one of its points at it
};

// An event that a part can cause while an action moves it. Interrupts can wait for it.
struct EventSource {
  Event event = Event::contact;
  int part = 0;
  bool operator==(const EventSource&) const = default;
};

// The smallest and the greatest number of frames that may be requested.
struct FrameRange {
  int least = 0;
  int most = 0;
  bool operator==(const FrameRange&) const = default;
};

// An action as one part of an assembled character can perform it.
struct OfferedAction {
  std::string name;
  std::string help;
  Layer layer = Layer::overwrite;
  Timing timing = Timing::goal;
  Promise promise = Promise::none;
  std::vector<ParamDef> params;    // their limits may depend on the part's joints
  std::vector<int> moves;          // parts, this one first
  std::vector<EventSource> tells;  // in the order of parts
  int file = -1;                   // index into the actions of the manifest's library; -1: the generator's own
  std::optional<FrameRange> duration{};  // empty: the profile of the search decides
  std::optional<FrameRange> blend_in{};
  std::optional<FrameRange> blend_out{};
  bool operator==(const OfferedAction&) const = default;
};

// The offered actions, by part of the character; each list is in the manifest's order.
using Offers = std::vector<std::vector<OfferedAction>>;

// The features that specs may use. The fuzzer draws no others.
struct Capabilities {
  bool interrupts = true;
  bool grounds = true;  // grounds that are not level
  bool obstacles = true;
  bool dynamics = true;
  bool speeds = true;  // speeds of uses, clips and sequences other than 1; durations of clips and sequences
  bool operator==(const Capabilities&) const = default;
};

struct Manifest {
  std::string name;                  // "contort"
  const Library* library = nullptr;  // characters and their parts; never null, and outlives the generator
  std::vector<std::string> actions;  // the names of all actions
  double rate_hz = 60.0;             // the frame rate for which a search draws specs
  std::string build{};               // version or commit of a generator that is a program of its own
  Capabilities can{};
};

// True if a separate program makes the motions, which may crash without ending this one.
inline bool is_own_program(const Manifest& manifest) { return !manifest.build.empty(); }

struct Admission {
  int most_frames = 1;  // >= 1; the motion may be shorter, for example if an interrupt never fires
};

// Only one thread at a time may use a generator; `another` makes one for each further thread.
class Generator {
 public:
  virtual ~Generator() = default;

  virtual const Manifest& manifest() const = 0;

  // Returns the actions of a character's parts. The character was built from the manifest's library. Valid until the
  // next call.
  virtual const Offers& offers(const Character& character) = 0;

  // Refuses a spec with a code and a pointer into it, or returns how long its motion can be.
  virtual Result<Admission> admit(const Spec& spec) = 0;

  // Runs a spec. Overwrites `execution` and reuses its memory. It refuses only specs that `admit` refuses: checks find
  // faults in a motion, including NaN and infinite values.
  virtual Result<Done> run(const Spec& spec, Execution& execution) = 0;

  // Makes an equal generator for another thread.
  virtual std::unique_ptr<Generator> another() const = 0;

  // Makes an equal generator with other descriptions, which must outlive it. Codes action.* if it cannot use them.
  virtual Result<std::unique_ptr<Generator>> with(const Library& library) const = 0;
};

// Returns the offered action of that name; nullptr if the part has none.
const OfferedAction* find_offer(const Offers& offers, int part, std::string_view name);

// Runs a spec into new memory.
Result<Execution> execute(Generator& generator, const Spec& spec);

}  // namespace contort
