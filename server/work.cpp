#include "server/work.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "corpus/case.h"
#include "formats/gltf/write.h"
#include "model/core/base64.h"
#include "model/core/hash.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "model/spec/spec_fields.h"
#include "renders/scene_fields.h"

namespace contort::server {

namespace {

using json_fields::Json;

constexpr std::string_view kKinds[] = {"model", "play", "judge", "evaluate", "model_file", "make_case"};
constexpr double kSight_m = 8.0;  // ground that is shown around the start
constexpr int kMostHold = 6000;   // as spec_fields.h has it

}  // namespace

template <class V>
void fields(V& v, const Task*) {
  const json_fields::Rule text{.text = json_fields::Text::prose, .may_be_empty = true};
  v.field("kind", &Task::kind, {.names = kKinds, .required = true}, "");
  v.field("spec", &Task::spec, {.required = true}, "");
  v.field("take_frames", &Task::take_frames, {.low = 0, .high = 36000}, "");
  v.field("most_frames", &Task::most_frames, {.low = 0, .high = 1e6}, "");
  v.field("library", &Task::library, text, "");
  v.field("check", &Task::check, text, "");
  v.field("subject", &Task::subject, text, "");
}

std::string print_task(const Task& task) { return json_fields::write_canonical(task); }
Result<Task> parse_task(const std::string& text) { return json_fields::read_document<Task>(text, "task"); }

std::string print_issue(const Issue& issue) {
  const Json json = {{"code", issue.code}, {"pointer", issue.pointer}, {"text", issue.text}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Length of the head in one line, the head, the bytes.
std::string print_reply(const Result<Reply>& reply) {
  if (reply) return std::to_string(reply->head.size()) + "\n" + reply->head + reply->bytes;
  return "issue\n" + print_issue(reply.issue());
}

Result<Reply> parse_reply(const std::string& text) {
  const std::size_t end = text.find('\n');
  const Issue damaged{"work.damaged", "", "a worker answered something that is no answer"};
  if (end == std::string::npos) return damaged;
  if (text.starts_with("issue\n")) {
    const Result<Json> json = json_fields::parse_document(std::string_view(text).substr(end + 1));
    if (!json) return damaged;
    return Issue{json->value("code", ""), json->value("pointer", ""), json->value("text", "")};
  }
  const std::size_t length = std::strtoull(text.c_str(), nullptr, 10);
  if (length > text.size() - end - 1) return damaged;
  return Reply{text.substr(end + 1, length), text.substr(end + 1 + length)};
}

namespace {

void append(std::string& bytes, double value) {
  const auto narrow = static_cast<float>(value);
  char raw[sizeof narrow];
  std::memcpy(raw, &narrow, sizeof raw);
  bytes.append(raw, sizeof raw);
}

// For each joint its place and rotation against its parent, which is what nodes of the .glb have.
std::string compact_frames(const Character& character, const Motion& motion) {
  std::string bytes;
  std::vector<Rigid> world(character.joints().size());
  bytes.reserve(at(motion.frame_count) * world.size() * kJointBytes);
  for (int f = 0; f < motion.frame_count; ++f) {
    forward_kinematics(character, motion.root[at(f)], motion.row(f), world);
    for (std::size_t j = 0; j < world.size(); ++j) {
      const int parent = character.joints()[j].parent;
      const Rigid local = parent < 0 ? world[j] : inverse(world[at(parent)]) * world[j];
      for (const double v : {local.p_m.x, local.p_m.y, local.p_m.z, local.q.x, local.q.y, local.q.z, local.q.w})
        append(bytes, v);
    }
  }
  return bytes;
}

Json joints_json(const Character& character) {
  Json all = Json::array();
  for (const Joint& joint : character.joints())
    all.push_back({{"name", joint.name},
                   {"local_name", joint.local_name},
                   {"parent", joint.parent},
                   {"slot", character.parts()[at(joint.part)].slot}});
  return all;
}

// What can aim, with the points that it can aim with; of look_at there are none.
Json aims_json(const Character& character) {
  Json all = Json::array();
  for (const Part& part : character.parts())
    for (const char* name : {"aim", "look_at"})
      if (const std::optional<Action> action = find_action(character, part, name))
        all.push_back({{"slot", part.slot},
                       {"action", name},
                       {"points", action->name == "aim" ? own_points(character, part) : std::vector<std::string>{}}});
  return all;
}

Result<Reply> model_of(const Stage& stage) {
  const Character& character = *stage.character;
  const Result<std::vector<std::byte>> glb = write_glb(character, Motion{}, {});
  if (!glb) return glb.issue();
  const Rigid here{kNoRotation, stage.start.p_m};
  const Rigid path[] = {{kNoRotation, here.p_m + Vec3(kSight_m, 0, kSight_m)},
                        {kNoRotation, here.p_m - Vec3(kSight_m, 0, kSight_m)}};
  const Quat rest = character.rest_root().q;
  return Reply{json_fields::compact_text({{"joints", joints_json(character)},
                                          {"glb", to_base64(*glb)},
                                          {"colliders", scene::colliders_json(character)},
                                          {"ground", scene::ground_json(stage.environment, path)},
                                          {"obstacles", scene::obstacles_json(stage.environment)},
                                          {"aims", aims_json(character)},
                                          {"rest", {rest.x, rest.y, rest.z, rest.w}}}),
               ""};
}

Json queue_json(const Motion& motion) {
  Json all = Json::array();
  for (const QueueSpan& span : motion.queue)
    all.push_back({{"first_frame", span.first_frame},
                   {"last_frame", span.last_frame},
                   {"sequence", span.sequence},
                   {"first_content", span.first_content}});
  return all;
}

Json findings_json(const std::vector<Finding>& findings) {
  Json all = Json::array();
  for (const Finding& finding : findings)
    all.push_back({{"check", finding.check},
                   {"subject", finding.subject},
                   {"unit", finding.unit},
                   {"worst_margin", scene::number(finding.worst_margin)},
                   {"depth", scene::number(finding.depth)},
                   {"first_frame", finding.first_frame},
                   {"worst_frame", finding.worst_frame},
                   {"last_frame", finding.last_frame}});
  return all;
}

Issue too_long(int frames, const Task& task) {
  return {"take.too_long", "",
          "the motion would be " + std::to_string(frames) + " frames long, allowed are " +
              std::to_string(task.most_frames)};
}

Result<Done> refuse_long(const Stage& stage, const Task& task) {
  if (task.most_frames == 0 || stage.most_frames <= task.most_frames) return Done{};
  return too_long(stage.most_frames, task);
}

// The longest time that the queue is dry before something comes into it.
int longest_gap(const Motion& motion) {
  int gap = 0, ended = 0;
  for (const QueueSpan& span : motion.queue) {
    gap = std::max(gap, span.first_frame - ended);
    ended = span.last_frame;
  }
  return gap;
}

// Frames to hold still so that the motion has `take_frames`, and does not end before the last interrupt. When the queue
// runs dry does not depend on dynamics.
Result<int> hold_for(const Task& task, const Library& library) {
  Spec plain = task.spec;
  plain.dynamics.mode = Mode::kinematic, plain.hold_frames = 0;
  const Result<Stage> bare = build_stage(plain, library);
  if (!bare) return bare.issue();
  const int ends = 1 + static_cast<int>(plain.interrupts.size());
  const int room = std::clamp((kMaxFrames - bare->timeline.frame_count) / ends, 0, kMostHold);
  if (task.most_frames > 0 && bare->timeline.frame_count > task.most_frames)
    return too_long(bare->timeline.frame_count, task);
  plain.hold_frames = std::min(room, task.take_frames);
  const Result<Stage> stage = build_stage(plain, library);
  if (!stage) return stage.issue();
  const Motion motion = generate(*stage);
  const int ended = motion.queue.empty() ? 0 : motion.queue.back().last_frame;
  const int gap = longest_gap(motion);
  if (gap > room)
    return Issue{"take.full", "", "this take holds as many interrupts as its length allows; begin a new one"};
  return std::clamp(std::max(task.take_frames - 1 - ended, gap), 0, room);
}

Result<Reply> make_case(const Stage& stage, const Task& task, const std::string& tool, Evaluator& evaluator) {
  const Evaluation evaluation = evaluator.run(stage);
  const Finding* found = deepest(evaluation.findings, task.check, task.subject);
  if (found == nullptr)
    return Issue{"case.no_such_finding", "", "this motion does not show " + task.check + " of " + task.subject};
  Case made;
  made.spec = task.spec;
  made.expect = expectation_of(stage, evaluator.motion(), evaluation, *found);
  made.provenance.tool = tool;
  return Reply{print_case(made), ""};
}

Result<Reply> model_file(const Stage& stage, const Task& task) {
  const Motion motion = generate(stage);
  const Result<std::vector<std::byte>> glb = write_glb(*stage.character, motion, {spec_id(task.spec), ""});
  if (!glb) return glb.issue();
  return Reply{
      json_fields::compact_text({{"motion_hash", to_hex(motion_hash(motion))}, {"frame_count", motion.frame_count}}),
      std::string(reinterpret_cast<const char*>(glb->data()), glb->size())};
}

}  // namespace

Worker::Worker(const Library& library, CheckSettings settings, std::string tool)
    : base_(library), tool_(std::move(tool)), evaluator_(std::move(settings)) {}

Result<const Library*> Worker::library_of(const Task& task) {
  if (task.library.empty()) return &base_;
  if (task.library == registered_) return &with_registered_;
  Library merged = base_;
  if (const Result<Done> loaded = load_folder(task.library, merged); !loaded) return loaded.issue();
  if (const Result<Done> fit = check_actions(merged); !fit) return fit.issue();
  with_registered_ = std::move(merged);
  registered_ = task.library;
  return &with_registered_;
}

Result<Reply> Worker::play(Task task, const Library& library) {
  if (task.take_frames > 0 && task.spec.recording.name.empty()) {
    const Result<int> hold = hold_for(task, library);
    if (!hold) return hold.issue();
    task.spec.hold_frames = *hold;
  }
  const Result<Stage> stage = build_stage(task.spec, library);
  if (!stage) return stage.issue();
  const Motion motion = generate(*stage);
  if (task.most_frames > 0 && motion.frame_count > task.most_frames) return too_long(motion.frame_count, task);
  return Reply{json_fields::compact_text({{"rate_hz", motion.rate_hz},
                                          {"frame_count", motion.frame_count},
                                          {"joint_count", stage->character->joints().size()},
                                          {"hold_frames", task.spec.hold_frames},
                                          {"motion_hash", to_hex(motion_hash(motion))},
                                          {"queue", queue_json(motion)},
                                          {"spans", scene::spans_json(*stage, motion)},
                                          {"marks", scene::marks_json(*stage, motion)}}),
               compact_frames(*stage->character, motion)};
}

Result<Reply> Worker::judge(const Stage& stage, const Task& task) {
  const Evaluation evaluation = evaluator_.run(stage);
  Finding about;
  about.check = task.check, about.subject = task.subject;
  if (about.check.empty() && !evaluation.findings.empty()) about = evaluation.findings.front();
  return Reply{json_fields::compact_text({{"motion_hash", to_hex(evaluation.motion_hash)},
                                          {"curves", scene::curves_json(evaluator_.curves(about, 12))},
                                          {"findings", findings_json(evaluation.findings)}}),
               ""};
}

Result<Reply> Worker::run(const Task& task) {
  const Result<const Library*> library = library_of(task);
  if (!library) return library.issue();
  if (task.kind == TaskKind::play) return play(task, **library);
  const Result<Stage> stage = build_stage(task.spec, **library);
  if (!stage) return stage.issue();
  if (const Result<Done> fits = refuse_long(*stage, task); !fits) return fits.issue();
  switch (task.kind) {
    case TaskKind::model: return model_of(*stage);
    case TaskKind::judge: return judge(*stage, task);
    case TaskKind::model_file: return model_file(*stage, task);
    case TaskKind::make_case: return make_case(*stage, task, tool_, evaluator_);
    case TaskKind::play:
    case TaskKind::evaluate: break;
  }
  const Evaluation evaluation = evaluator_.run(*stage);
  return Reply{json_fields::compact_text({{"motion_hash", to_hex(evaluation.motion_hash)},
                                          {"frame_count", evaluation.frame_count},
                                          {"rate_hz", stage->rate_hz},
                                          {"findings", findings_json(evaluation.findings)}}),
               ""};
}

}  // namespace contort::server
