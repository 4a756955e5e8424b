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
constexpr double kSight_m = 8.0;  // radius of the shown ground around the start
constexpr int kMostHold = 6000;   // as in spec_fields.h

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

// The reply as text: the length of the head in one line, the head, the bytes.
std::string print_reply(const Result<Reply>& reply) {
  if (reply) return std::to_string(reply->head.size()) + "\n" + reply->head + reply->bytes;
  return "issue\n" + print_issue(reply.issue());
}

Result<Reply> parse_reply(const std::string& text) {
  const std::size_t end = text.find('\n');
  const Issue damaged{"work.damaged", "", "the answer of a worker cannot be read"};
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

// The position and rotation of each joint relative to its parent, like the nodes of the .glb.
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

// The aiming actions, with the points that a part can aim; look_at has none.
Json aims_json(const Character& character, const Offers& offers) {
  Json all = Json::array();
  for (std::size_t p = 0; p < offers.size(); ++p)
    for (const OfferedAction& action : offers[p]) {
      if (action.promise != Promise::aims) continue;
      const auto point = std::ranges::find(action.params, ParamType::own_point, &ParamDef::type);
      all.push_back({{"slot", character.parts()[p].slot},
                     {"action", action.name},
                     {"points", point == action.params.end() ? std::vector<std::string>{} : point->points}});
    }
  return all;
}

Result<Reply> model_of(const Spec& spec, Generator& generator) {
  const Result<Character> built = build_character(spec.character, *generator.manifest().library);
  if (!built) return built.issue();
  const Character& character = *built;
  const Result<Environment> environment = build_environment(spec.environment);
  if (!environment) return environment.issue();
  const Result<std::vector<std::byte>> glb = write_glb(character, Motion{}, {});
  if (!glb) return glb.issue();
  const Vec3 here_m(spec.start.position_m.x, 0.0, spec.start.position_m.z);
  const Rigid path[] = {{kNoRotation, here_m + Vec3(kSight_m, 0, kSight_m)},
                        {kNoRotation, here_m - Vec3(kSight_m, 0, kSight_m)}};
  const Quat rest = character.rest_root().q;
  return Reply{json_fields::compact_text({{"joints", joints_json(character)},
                                          {"glb", to_base64(*glb)},
                                          {"colliders", scene::colliders_json(character)},
                                          {"ground", scene::ground_json(*environment, path)},
                                          {"obstacles", scene::obstacles_json(*environment)},
                                          {"aims", aims_json(character, generator.offers(character))},
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

Result<Done> refuse_long(int most_frames, const Task& task) {
  if (task.most_frames == 0 || most_frames <= task.most_frames) return Done{};
  return too_long(most_frames, task);
}

// The longest time for which the queue is empty between two sequences.
int longest_gap(const Motion& motion) {
  int gap = 0, ended = 0;
  for (const QueueSpan& span : motion.queue) {
    gap = std::max(gap, span.first_frame - ended);
    ended = span.last_frame;
  }
  return gap;
}

// The number of frames to hold still, so that the motion has `take_frames` and does not end before the last interrupt.
// Dynamics does not affect the time when the queue is empty.
Result<int> hold_for(const Task& task, Generator& generator) {
  Spec plain = task.spec;
  plain.dynamics.mode = Mode::kinematic, plain.hold_frames = 0;
  const Result<Admission> bare = generator.admit(plain);
  if (!bare) return bare.issue();
  const int most_frames = bare->most_frames - 1;  // without frame 0
  const int ends = 1 + static_cast<int>(plain.interrupts.size());
  const int room = std::clamp((kMaxFrames - most_frames) / ends, 0, kMostHold);
  if (task.most_frames > 0 && most_frames > task.most_frames) return too_long(most_frames, task);
  plain.hold_frames = std::min(room, task.take_frames);
  const Result<Execution> execution = execute(generator, plain);
  if (!execution) return execution.issue();
  const Motion& motion = execution->motion;
  const int ended = motion.queue.empty() ? 0 : motion.queue.back().last_frame;
  const int gap = longest_gap(motion);
  if (gap > room)
    return Issue{"take.full", "", "this take holds as many interrupts as its length allows; begin a new one"};
  return std::clamp(std::max(task.take_frames - 1 - ended, gap), 0, room);
}

Result<Reply> play(Task task, Generator& generator) {
  if (task.take_frames > 0 && task.spec.recording.name.empty()) {
    const Result<int> hold = hold_for(task, generator);
    if (!hold) return hold.issue();
    task.spec.hold_frames = *hold;
  }
  const Result<Execution> execution = execute(generator, task.spec);
  if (!execution) return execution.issue();
  const Motion& motion = execution->motion;
  if (task.most_frames > 0 && motion.frame_count > task.most_frames) return too_long(motion.frame_count, task);
  return Reply{json_fields::compact_text({{"rate_hz", motion.rate_hz},
                                          {"frame_count", motion.frame_count},
                                          {"joint_count", execution->character->joints().size()},
                                          {"hold_frames", task.spec.hold_frames},
                                          {"motion_hash", to_hex(motion_hash(motion))},
                                          {"queue", queue_json(motion)},
                                          {"spans", scene::spans_json(*execution)},
                                          {"marks", scene::marks_json(*execution)}}),
               compact_frames(*execution->character, motion)};
}

Result<Reply> model_file(const Spec& spec, Generator& generator) {
  const Result<Execution> execution = execute(generator, spec);
  if (!execution) return execution.issue();
  const Motion& motion = execution->motion;
  const Result<std::vector<std::byte>> glb = write_glb(*execution->character, motion, {spec_id(spec), ""});
  if (!glb) return glb.issue();
  return Reply{
      json_fields::compact_text({{"motion_hash", to_hex(motion_hash(motion))}, {"frame_count", motion.frame_count}}),
      std::string(reinterpret_cast<const char*>(glb->data()), glb->size())};
}

Result<Reply> make_case(const Evaluator& evaluator, const Evaluation& evaluation, const Task& task,
                        const std::string& tool) {
  const Finding* found = deepest(evaluation.findings, task.check, task.subject);
  if (found == nullptr)
    return Issue{"case.no_such_finding", "", "this motion does not show " + task.check + " of " + task.subject};
  Case made;
  made.spec = task.spec;
  made.expect = expectation_of(evaluator.execution(), evaluation, *found);
  made.provenance.tool = tool;
  return Reply{print_case(made), ""};
}

Reply judge(const Evaluator& evaluator, const Evaluation& evaluation, const Task& task) {
  Finding about;
  about.check = task.check, about.subject = task.subject;
  if (about.check.empty() && !evaluation.findings.empty()) about = evaluation.findings.front();
  return Reply{json_fields::compact_text({{"motion_hash", to_hex(evaluation.motion_hash)},
                                          {"curves", scene::curves_json(evaluator.curves(about, 12))},
                                          {"findings", findings_json(evaluation.findings)}}),
               ""};
}

Reply result_of(const Evaluator& evaluator, const Evaluation& evaluation) {
  return Reply{json_fields::compact_text({{"motion_hash", to_hex(evaluation.motion_hash)},
                                          {"frame_count", evaluation.frame_count},
                                          {"rate_hz", evaluator.motion().rate_hz},
                                          {"findings", findings_json(evaluation.findings)}}),
               ""};
}

}  // namespace

Worker::Worker(Generator& generator, CheckSettings settings, std::string tool)
    : base_(generator), settings_(std::move(settings)), tool_(std::move(tool)) {}

Result<Generator*> Worker::generator_of(const Task& task) {
  if (task.library.empty()) return &base_;
  if (registered_ && task.library == registered_->folder) return registered_->generator.get();
  auto merged = std::make_unique<Registered>(Registered{task.library, *base_.manifest().library, nullptr});
  if (const Result<Done> loaded = load_folder(task.library, merged->library); !loaded) return loaded.issue();
  Result<std::unique_ptr<Generator>> generator = base_.with(merged->library);
  if (!generator) return generator.issue();
  merged->generator = std::move(generator).value();
  registered_ = std::move(merged);
  return registered_->generator.get();
}

Result<Reply> Worker::run(const Task& task) {
  const Result<Generator*> chosen = generator_of(task);
  if (!chosen) return chosen.issue();
  Generator& generator = **chosen;
  if (task.kind == TaskKind::play) return play(task, generator);
  const Result<Admission> admitted = generator.admit(task.spec);
  if (!admitted) return admitted.issue();
  if (const Result<Done> fits = refuse_long(admitted->most_frames, task); !fits) return fits.issue();
  if (task.kind == TaskKind::model) return model_of(task.spec, generator);
  if (task.kind == TaskKind::model_file) return model_file(task.spec, generator);
  Evaluator evaluator(generator, settings_);
  const Result<Evaluation> evaluation = evaluator.run(task.spec);
  if (!evaluation) return evaluation.issue();
  if (task.kind == TaskKind::make_case) return make_case(evaluator, *evaluation, task, tool_);
  return task.kind == TaskKind::judge ? judge(evaluator, *evaluation, task) : result_of(evaluator, *evaluation);
}

}  // namespace contort::server
