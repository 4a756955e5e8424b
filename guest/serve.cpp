#include "guest/serve.h"

#include <cmath>
#include <cstring>

#include "guest/described.h"
#include "model/core/index.h"
#include "model/core/json_fields.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

using json_fields::Json;

constexpr std::size_t kLongestLine = 1 << 20;

// Returns false at the end of the input.
bool read_request(std::FILE* in, std::string& line) {
  line.clear();
  for (int c = std::fgetc(in); c != EOF; c = std::fgetc(in)) {
    if (c == '\n') return true;
    if (line.size() < kLongestLine) line += static_cast<char>(c);
  }
  return !line.empty();
}

void write_all(std::FILE* out, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), out);
  std::fflush(out);
}

ParamValue value_of(const Json& value) {
  if (value.is_array()) return Vec3(value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>());
  if (value.is_number()) return value.get<double>();
  return value.get<std::string>();
}

ActionUse use_of(const Json& asked, double rate_hz) {
  const auto frames = [&](const char* name) {
    return static_cast<int>(std::lround(asked.at(name).get<double>() * rate_hz));
  };
  ActionUse use;
  use.action = asked.at("action").get<std::string>(), use.slot = asked.at("slot").get<std::string>();
  use.start_frame = asked.at("start_frame").get<int>(), use.duration_frames = frames("duration_s");
  use.blend_in_frames = frames("blend_in_s"), use.blend_out_frames = frames("blend_out_s");
  for (const auto& [name, value] : asked.at("params").items()) use.params[name] = value_of(value);
  return use;
}

// Puts all uses into one clip. After it, the figure holds still until the last frame.
Spec spec_of(const Json& asked) {
  Spec spec;
  spec.character.name = asked.at("character").get<std::string>();
  spec.rate_hz = asked.at("rate_hz").get<double>();
  int end = 0;
  ClipDesc clip;
  for (const Json& use : asked.at("timeline")) {
    clip.actions.push_back(use_of(use, spec.rate_hz));
    end = std::max(end, clip.actions.back().start_frame + clip.actions.back().duration_frames);
  }
  if (!clip.actions.empty()) spec.sequences.push_back({"", 0, {clip}});
  spec.hold_frames = std::max(0, asked.at("frames").get<int>() - 1 - end);
  return spec;
}

void add_numbers(const Quat& q, std::vector<double>& row) { row.insert(row.end(), {q.x, q.y, q.z, q.w}); }

std::string rows_of(const Execution& made) {
  const Motion& motion = made.motion;
  std::vector<double> numbers;
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    const Rigid& root = motion.root[at(frame)];
    numbers.insert(numbers.end(), {root.p_m.x, root.p_m.y, root.p_m.z});
    add_numbers(root.q, numbers);
    for (const Joint& joint : made.character->joints().subspan(1)) {
      const bool turns = joint.kind != JointKind::prismatic;
      const Quat own = turns ? joint_motion(joint, motion.row(frame)).q : kNoRotation;
      add_numbers(joint.parent_from_joint.q * own, numbers);
    }
  }
  std::string bytes(numbers.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::string answer_to(Generator& generator, const Json& asked) {
  const std::int64_t id = asked.at("id").get<std::int64_t>();
  const Result<Execution> made = execute(generator, spec_of(asked));
  if (!made) return Json{{"id", id}, {"error", "refused"}, {"text", to_line(made.issue())}}.dump() + "\n";
  const std::string bytes = rows_of(*made);
  return Json{{"id", id}, {"bytes", bytes.size()}}.dump() + "\n" + bytes;
}

}  // namespace

Result<Done> serve_guest(Generator& generator, std::span<const std::string> characters, std::FILE* in, std::FILE* out) {
  const Result<GuestManifest> manifest = describe(generator, characters);
  if (!manifest) return manifest.issue();
  for (std::string line; read_request(in, line);) {
    const Result<Json> message = json_fields::parse_document(line);
    if (!message) return message.issue();
    try {
      const bool is_greeting = message->at("op") == "hello";
      write_all(out, is_greeting ? print_manifest(*manifest) + "\n" : answer_to(generator, *message));
    } catch (const Json::exception& fault) {
      return Issue{"guest.bad_request", "", std::string("the request is not one of the protocol: ") + fault.what()};
    }
  }
  return Done{};
}

}  // namespace contort
