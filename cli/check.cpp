// contort check: a spec, or an animation made elsewhere.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "checks/clip_speed.h"
#include "checks/evaluate.h"
#include "cli/commands.h"
#include "cli/input.h"
#include "cli/print.h"
#include "generator/core/hash.h"
#include "generator/core/json_fields.h"
#include "generator/gltf/read.h"

namespace contort::cli {

namespace {

using json_fields::Json;

struct Options {
  std::string file;
  std::string character;
  std::string clip;
  double max_speed_deg_s = 3000.0;
  bool json = false;
};

void print_result(std::size_t findings, int clips) {
  std::printf("%s\n", findings == 0 ? "OK: nothing found." : "FAILED: limits are violated.");
  if (clips >= 0)
    std::printf("RESULT findings=%zu clips=%d\n", findings, clips);
  else
    std::printf("RESULT findings=%zu\n", findings);
}

void check_spec(const Options& options, Context& context) {
  const Library* library = context.load_library();
  if (library == nullptr) return;
  const Result<SpecInput> input = read_spec_input(options.file);
  if (!input) return context.fail(input.issue());
  const Result<Stage> stage = build_stage(input->spec, *library);
  if (!stage) return context.fail(stage.issue());
  Evaluator evaluator;
  const Evaluation evaluation = evaluator.run(*stage);
  context.exit_code = evaluation.findings.empty() ? kClean : kFindings;
  std::vector<Circumstances> at_worst;
  for (const Finding& finding : evaluation.findings)
    at_worst.push_back(circumstances_of(*stage, evaluator.motion(), finding.worst_frame));
  if (options.json) {
    const Json out = {{"file", options.file},
                      {"character", stage->character->name()},
                      {"frames", evaluation.frame_count},
                      {"motion_hash", to_hex(evaluation.motion_hash)},
                      {"findings", Json::parse(findings_json(evaluation.findings, stage->rate_hz, at_worst))}};
    std::printf("%s\n", out.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    return;
  }
  for (std::size_t i = 0; i < at_worst.size(); ++i)
    std::printf("%s\n", finding_line(evaluation.findings[i], stage->rate_hz, at_worst[i]).c_str());
  print_result(evaluation.findings.size(), -1);
}

Result<SpeedLimits> limits_of(const Options& options, Context& context) {
  SpeedLimits limits{options.max_speed_deg_s * kRadPerDeg, {}};
  if (options.character.empty()) return limits;
  const Library* library = context.load_library();
  if (library == nullptr) return Issue{"library.unreadable", "", "the library could not be read"};
  const Result<Character> character = build_character({options.character, {}, {}}, *library);
  if (!character) return character.issue();
  for (const Joint& joint : character->joints())
    if (joint.kind == JointKind::hinge || joint.kind == JointKind::ball) limits.of_node[joint.name] = joint.max_speed;
  return limits;
}

Json clip_json(const ClipSpeeds& clip) {
  Json findings = Json::array();
  for (const ClipFinding& f : clip.findings)
    findings.push_back({{"check", f.finding.check},
                        {"subject", f.finding.subject},
                        {"unit", f.finding.unit},
                        {"worst_margin", f.finding.worst_margin},
                        {"speed_deg_s", f.worst_speed_rad_s * kDegPerRad},
                        {"first_interval", f.finding.first_frame},
                        {"worst_interval", f.finding.worst_frame},
                        {"last_interval", f.finding.last_frame},
                        {"t0_s", f.worst_t0_s},
                        {"t1_s", f.worst_t1_s}});
  return {{"clip", clip.clip},           {"peak_joint", clip.peak_node}, {"peak_deg_s", clip.peak_rad_s * kDegPerRad},
          {"peak_t0_s", clip.peak_t0_s}, {"peak_t1_s", clip.peak_t1_s},  {"findings", findings}};
}

void print_clip(const ClipSpeeds& clip) {
  std::printf("clip %s: peak %.1f deg/s at %s, %.3f-%.3f s\n", clip.clip.c_str(), clip.peak_rad_s * kDegPerRad,
              clip.peak_node.empty() ? "(nothing turns)" : clip.peak_node.c_str(), clip.peak_t0_s, clip.peak_t1_s);
  for (const ClipFinding& f : clip.findings)
    std::printf("  angular_velocity  %s  %.1f deg/s, allowed %.1f  at %.3f-%.3f s\n", f.finding.subject.c_str(),
                f.worst_speed_rad_s * kDegPerRad, (f.worst_speed_rad_s + f.finding.worst_margin) * kDegPerRad,
                f.worst_t0_s, f.worst_t1_s);
}

void check_gltf(const Options& options, Context& context) {
  const Result<SpeedLimits> limits = limits_of(options, context);
  if (!limits) return context.fail(limits.issue());
  const Result<Asset> asset = read_gltf(options.file);
  if (!asset) return context.fail(asset.issue());
  const std::vector<ClipSpeeds> clips = check_clip_speeds(*asset, *limits, options.clip);
  if (clips.empty())
    return context.fail(
        {"check.no_clip", "",
         options.file + (options.clip.empty() ? " holds no animation" : " holds no clip \"" + options.clip + "\"")});
  std::size_t findings = 0;
  Json list = Json::array();
  for (const ClipSpeeds& clip : clips) {
    findings += clip.findings.size();
    if (options.json)
      list.push_back(clip_json(clip));
    else
      print_clip(clip);
  }
  context.exit_code = findings == 0 ? kClean : kFindings;
  if (options.json)
    std::printf(
        "%s\n",
        Json{{"file", options.file}, {"clips", list}}.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  else
    print_result(findings, static_cast<int>(clips.size()));
}

}  // namespace

void add_check(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("check", "Check a spec, or an animation made elsewhere (.glb, .gltf)");
  command->add_option("FILE", options->file, "Spec or case (.json), or animation (.glb, .gltf)")->required();
  command->add_option("--character", options->character,
                      "Take speed limits from this character's joints, where names match");
  command->add_option("--clip", options->clip, "Only this clip of the file");
  command
      ->add_option("--max-speed-deg-s", options->max_speed_deg_s,
                   "Greatest angular speed of joints without their own limit")
      ->check(CLI::Range(1e-3, 1e6))
      ->check(refuse_nan)
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer("Exit code 1 when something was found.\nExample: contort check robot.glb --max-speed-deg-s 1500");
  command->callback([options, &context] {
    if (is_gltf(options->file))
      check_gltf(*options, context);
    else
      check_spec(*options, context);
  });
}

}  // namespace contort::cli
