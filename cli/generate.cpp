// contort generate: one motion, as glTF animation or as a plain table of numbers.
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

namespace contort::cli {

namespace {

using json_fields::Json;

struct GenerateOptions {
  std::string spec;
  std::string output;
};

std::string trajectory_json(const Character& character, const Motion& motion) {
  Json joints = Json::array();
  for (const Joint& joint : character.joints())
    joints.push_back({{"name", joint.name}, {"first_coord", joint.coord}, {"coords", coord_size(joint.kind)}});
  Json frames = Json::array();
  for (int f = 0; f < motion.frame_count; ++f) {
    const Rigid& root = motion.root[static_cast<std::size_t>(f)];
    const auto row = motion.row(f);
    frames.push_back({{"root", {root.p_m.x, root.p_m.y, root.p_m.z, root.q.w, root.q.x, root.q.y, root.q.z}},
                      {"coords", std::vector<double>(row.begin(), row.end())}});
  }
  return Json{{"format", "contort.trajectory/1"},
              {"character", character.name()},
              {"rate_hz", motion.rate_hz},
              {"joints", joints},
              {"frames", frames},
              {"motion_hash", to_hex(motion_hash(motion))}}
             .dump() +
         "\n";
}

void run(const GenerateOptions& options, Context& context) {
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<SpecInput> input = read_spec_input(options.spec);
  if (!input) return context.fail(input.issue());
  const Result<Execution> execution = execute(*generator, input->spec);
  if (!execution) return context.fail(about_file(options.spec, execution.issue()));
  const Motion& motion = execution->motion;
  const std::string ending = std::filesystem::path(options.output).extension().string();
  Result<Done> saved = Done{};
  if (ending == ".json")
    saved = write_output(options.output, trajectory_json(*execution->character, motion));
  else if (ending == ".glb")
    saved = save_glb(options.output, *execution->character, motion,
                     {spec_id(input->spec), "contort generate " + shell_quoted(options.spec)});
  else
    return context.fail(
        {"usage.bad_output", "", "found \"" + options.output + "\", allowed are names ending in .glb or .json"});
  if (!saved) return context.fail(saved.issue(), kInternal);
  std::printf("%s: %d frames at %g Hz, motion %s\n", options.output.c_str(), motion.frame_count, motion.rate_hz,
              to_hex(motion_hash(motion)).c_str());
  for (const std::string& line : unmet_lines(*execution)) std::printf("%s\n", line.c_str());
}

}  // namespace

void add_generate(CLI::App& app, Context& context) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App* command = app.add_subcommand("generate", "Make one motion of a spec");
  command->add_option("SPEC", options->spec, "Spec or case file")->required();
  command->add_option("-o,--output", options->output, "OUT.glb (animated model) or OUT.json (numbers)")->required();
  command->footer("Example: contort generate docs/examples/reach_hand.json -o reach.glb");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
