// The tasks of worker processes, which do all generating. A task contains all its input, so any worker can do any
// task, and repeat it.
#pragma once

#include <memory>
#include <string>

#include "corpus/evaluator.h"
#include "model/generator.h"
#include "model/core/result.h"
#include "model/spec/spec.h"

namespace contort::server {

enum class TaskKind {
  model,       // the character and its surroundings
  play,        // frames
  judge,       // margins and findings
  evaluate,    // motion hash and findings
  model_file,  // .glb of the motion
  make_case,   // make a case from one finding
};

struct Task {
  TaskKind kind = TaskKind::evaluate;
  Spec spec;
  int take_frames = 0;  // play: the motion is held at its end until it has this many frames; 0: as in the spec
  int most_frames = 0;  // longer motions are refused
  std::string library;  // folder of a registered library; "": none
  std::string check;    // make_case: the check of the finding; its curve comes first
  std::string subject;
  bool operator==(const Task&) const = default;
};

// A JSON text, and bytes for binary data: frames of play, the .glb of model_file.
struct Reply {
  std::string head;
  std::string bytes;
  bool operator==(const Reply&) const = default;
};

// Prints an error as {code, pointer, text}, the form of every error.
std::string print_issue(const Issue& issue);

std::string print_task(const Task& task);
Result<Task> parse_task(const std::string& text);
std::string print_reply(const Result<Reply>& reply);
Result<Reply> parse_reply(const std::string& text);

// The JSON text of a reply, by kind of task:
//
//   model     {joints: [{name, parent, slot}], glb, colliders, ground, obstacles, aims: [{slot, action, points}],
//              rest: [x, y, z, w]}
//   play      {rate_hz, frame_count, joint_count, hold_frames, motion_hash, queue, spans, marks}; bytes: compact frames
//   judge     {curves, findings}
//   evaluate  {motion_hash, frame_count, rate_hz, findings}
//   make_case the case as corpus files have it
//
// docs/reference/server.md describes their fields and the form of a compact frame.
class Worker {
 public:
  // `tool` is written into cases.
  Worker(Generator& generator, CheckSettings settings, std::string tool);

  // Runs a task. Codes of the generator, with pointers into the spec; take.too_long, case.no_such_finding.
  Result<Reply> run(const Task& task);

 private:
  // The base generator with the descriptions of a registered library.
  struct Registered {
    std::string folder;
    Library library;
    std::unique_ptr<Generator> generator;
  };

  Generator& base_;
  CheckSettings settings_;
  std::string tool_;
  std::unique_ptr<Registered> registered_;  // the library that was used last

  Result<Generator*> generator_of(const Task& task);
};

// The size of a compact frame in bytes, for each joint.
inline constexpr int kJointBytes = 28;

}  // namespace contort::server
