// contort generate: makes one motion, as a glTF animation or as a table of numbers.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/unmet_text.h"
#include "formats/gltf/write.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/json_fields.h"
#include "model/core/output.h"
#include "process/ended.h"

namespace contort::cli {

namespace {

using json_fields::Json;

struct GenerateOptions {
  std::string spec;
  std::string level;
  std::string output;
};

// The only part that moves, if the spec names one.
std::optional<int> part_alone(const Spec& spec, const Character& character) {
  return spec.only_slot.empty() ? std::nullopt : std::optional(character.find_part(spec.only_slot));
}

// The coordinates of one part are next to each other in a posture.
struct Columns {
  int first = 0;
  int count = 0;
};

Columns columns_of(const Character& character, std::optional<int> part) {
  if (!part) return {0, character.coord_count()};
  Columns columns{character.coord_count(), 0};
  for (const Joint& joint : character.joints()) {
    if (joint.part != *part || coord_size(joint.kind) == 0) continue;
    columns.first = std::min(columns.first, joint.coord), columns.count += coord_size(joint.kind);
  }
  return columns;
}

Json frame_json(const Motion& motion, int frame, const Columns& columns) {
  const Rigid& root = motion.root[static_cast<std::size_t>(frame)];
  const std::span<const double> row = motion.row(frame).subspan(static_cast<std::size_t>(columns.first),
                                                                static_cast<std::size_t>(columns.count));
  return {{"root", {root.p_m.x, root.p_m.y, root.p_m.z, root.q.w, root.q.x, root.q.y, root.q.z}},
          {"coords", std::vector<double>(row.begin(), row.end())}};
}

std::string trajectory_json(const Character& character, const Motion& motion, std::optional<int> part) {
  const Columns columns = columns_of(character, part);
  Json joints = Json::array();
  for (const Joint& joint : character.joints())
    if (!part || joint.part == *part)
      joints.push_back(
          {{"name", joint.name}, {"first_coord", joint.coord - columns.first}, {"coords", coord_size(joint.kind)}});
  Json frames = Json::array();
  for (int f = motion.first_frame; f < motion.frame_count; ++f) frames.push_back(frame_json(motion, f, columns));
  return Json{{"format", "contort.trajectory/1"},
              {"character", character.name()},
              {"rate_hz", motion.rate_hz},
              {"first_frame", motion.first_frame},
              {"joints", joints},
              {"frames", frames},
              {"motion_hash", to_hex(motion_hash(motion))}}
             .dump() +
         "\n";
}

std::string command_of(const GenerateOptions& options) {
  const std::string level = options.level.empty() ? "" : " --level " + shell_quoted(options.level);
  return "contort generate " + shell_quoted(options.spec) + level;
}

void run(const GenerateOptions& options, Context& context) {
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<SpecInput> input = read_spec_input(options.spec, options.level);
  if (!input) return context.fail(input.issue());
  const Result<Execution> execution = unless_it_ends([&] { return execute(*generator, input->spec); });
  if (!execution) return context.fail(about_file(options.spec, execution.issue()), exit_of(execution.issue()));
  const Motion& motion = execution->motion;
  const std::optional<int> part = part_alone(input->spec, *execution->character);
  const std::string ending = std::filesystem::path(options.output).extension().string();
  Result<Done> saved = Done{};
  if (ending == ".json")
    saved = write_output(options.output, trajectory_json(*execution->character, motion, part));
  else if (ending == ".glb")
    saved = save_glb(options.output, *execution->character, motion,
                     {spec_id(input->spec), command_of(options)}, part);
  else
    return context.fail(
        {"usage.bad_output", "", "found \"" + options.output + "\", allowed are names ending in .glb or .json"});
  if (!saved) return context.fail(saved.issue(), kInternal);
  std::printf("%s: %d frames at %g Hz, motion %s\n", options.output.c_str(),
              motion.frame_count - motion.first_frame, motion.rate_hz,
              to_hex(motion_hash(motion)).c_str());
  for (const std::string& line : unmet_lines(*execution)) std::printf("%s\n", line.c_str());
}

}  // namespace

void add_generate(CLI::App& app, Context& context) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App* command = app.add_subcommand("generate", "Write the motion of a spec as a file");
  command->add_option("SPEC", options->spec, "Spec or case file")->required();
  command->add_option("-o,--output", options->output, "OUT.glb (animated model) or OUT.json (numbers)")->required();
  add_level_option(*command, options->level);
  command->footer("Example: contort generate docs/examples/reach_hand.json -o reach.glb");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
