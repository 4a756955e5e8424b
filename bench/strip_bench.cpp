// Measures the cost of a film strip and of its stages: one thread, one context. A strip has six tiles of 320 x 240; a
// whole case has eight and a .glb.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "tests/stage_evaluator.h"
#include "formats/gltf/write.h"
#include "generator/generate.h"
#include "generator/stage.h"
#include "renders/case_data.h"
#include "renders/frames.h"
#include "renders/raster/auto_camera.h"
#include "renders/raster/picture.h"
#include "renders/raster/renderer.h"
#include "renders/raster/strip.h"
#include "renders/raster/webp.h"
#include "tests/scenes.h"

namespace contort {
namespace {

constexpr int kWidth = 320, kHeight = 240, kTiles = 6;

// A scene with a finding, as the fuzzer makes one.
struct Subject {
  Stage stage = build_stage(scene("human_overlaps"), stock_library()).value();
  Motion motion = generate(stage);
  Finding finding{"self_collision", "arm_left/forearm ~ torso/chest", "m", 20, 30, 40, -0.02, 1.0};
  StripInput input{*stage.character, motion, &finding};
  Story story{*stage.character, motion, &finding, nullptr, &stage.environment, nullptr};
  Shots shots = take_shots(story, choose_frames(20, 30, 40, motion.frame_count, kTiles));
  std::unique_ptr<Renderer> renderer = Renderer::create(make_gl_backend(GlSource::any).value()).value();
  Camera camera = frame_points(shots.outlines[0], probe_views().front(), static_cast<double>(kWidth) / kHeight);
  Subject() {
    input.tiles = kTiles, input.columns = 3;
    add_scenery(story, shots.outlines, shots);
    renderer->set_meshes(shots.meshes);
  }
  Image tile() { return renderer->draw(shots.lists[0], camera, kWidth, kHeight).value(); }
};

std::string scratch(const char* name) { return (std::filesystem::temp_directory_path() / name).string(); }

void strip(benchmark::State& state) {
  const Subject subject;
  StripRenderer renderer = StripRenderer::create().value();
  for (auto _ : state) benchmark::DoNotOptimize(renderer.render(subject.input, scratch("contort_bench.png")).ok());
  state.counters["strips/s"] = benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void strip_and_clip(benchmark::State& state) {
  const Subject subject;
  StripRenderer renderer = StripRenderer::create().value();
  for (auto _ : state)
    benchmark::DoNotOptimize(
        renderer.render(subject.input, scratch("contort_bench.png"), scratch("contort_bench.webp")).ok());
}

// The cost of a failing case: choosing the view, eight antialiased tiles in one PNG, and the motion as .glb.
struct WholeCase : Subject {
  StripRenderer strips = StripRenderer::create().value();
  WholeCase() { input.tiles = 8, input.columns = 4; }
  bool draw(const std::string& clip) {
    return strips.render(input, scratch("contort_bench.png"), clip).ok() &&
           save_glb(scratch("contort_bench.glb"), *stage.character, motion, {}).ok();
  }
};

void whole_case(benchmark::State& state) {
  WholeCase subject;
  for (auto _ : state) benchmark::DoNotOptimize(subject.draw(""));
  state.counters["cases/s"] = benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void whole_case_and_clip(benchmark::State& state) {
  WholeCase subject;
  for (auto _ : state) benchmark::DoNotOptimize(subject.draw(scratch("contort_bench.webp")));
  state.counters["cases/s"] = benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

// The parts of a whole case, like the next benchmarks.
void generate_and_judge(benchmark::State& state) {
  const Subject subject;
  StageEvaluator evaluator;
  for (auto _ : state) benchmark::DoNotOptimize(evaluator.run(subject.stage).findings.size());
}

void take_the_shots(benchmark::State& state) {
  const Subject subject;
  const std::vector<int> frames = choose_frames(20, 30, 40, subject.motion.frame_count, 8);
  for (auto _ : state) {
    Shots shots = take_shots(subject.story, frames);
    add_scenery(subject.story, shots.outlines, shots);
    benchmark::DoNotOptimize(shots.meshes.size());
  }
}

void set_the_meshes(benchmark::State& state) {
  Subject subject;
  for (auto _ : state) subject.renderer->set_meshes(subject.shots.meshes);
}

void png_of_eight_tiles(benchmark::State& state) {
  Subject subject;
  const Image tile = subject.tile();
  Image sheet(4 * tile.width, 2 * tile.height);
  for (int i = 0; i < 8; ++i) paste(sheet, tile, i % 4 * tile.width, i / 4 * tile.height);
  for (auto _ : state) benchmark::DoNotOptimize(png_bytes(sheet, "contort replay x").value());
}

void glb_of_the_motion(benchmark::State& state) {
  const Subject subject;
  for (auto _ : state)
    benchmark::DoNotOptimize(save_glb(scratch("contort_bench.glb"), *subject.stage.character, subject.motion, {}).ok());
}

void choose_the_view(benchmark::State& state) {
  Subject subject;
  for (auto _ : state)
    benchmark::DoNotOptimize(choose_view(*subject.renderer, subject.story, subject.shots, 0, std::nullopt).ok());
}

void draw_and_read_one_tile(benchmark::State& state) {
  Subject subject;
  for (auto _ : state) benchmark::DoNotOptimize(subject.tile());
}

// Converts oversampled pixels to those of the picture.
void halve_one_tile(benchmark::State& state) {
  const std::vector<std::uint8_t> rgba(std::size_t{4} * 4 * kWidth * kHeight, 128);
  for (auto _ : state) benchmark::DoNotOptimize(halve_and_flip(rgba, 2 * kWidth, 2 * kHeight));
}

void write_a_caption(benchmark::State& state) {
  Image image(kWidth, kHeight);
  const Face face{kStripFont};
  for (auto _ : state)
    benchmark::DoNotOptimize(write_text(image, 12, 200, "frame 55  0.917 s", 13, {240, 240, 240}, face).ok());
}

void png_of_a_tile(benchmark::State& state) {
  Subject subject;
  const Image image = subject.tile();
  for (auto _ : state) benchmark::DoNotOptimize(png_bytes(image, "contort replay x").value());
}

void webp_of_a_tile(benchmark::State& state) {
  Subject subject;
  const std::vector<Image> images(1, subject.tile());
  for (auto _ : state) benchmark::DoNotOptimize(webp_bytes(images, 66).value());
}

void case_data_of_one_motion(benchmark::State& state) {
  Case stored;
  stored.spec = scene("human_overlaps"), stored.expect.check = "self_collision";
  const std::vector<ShownCase> shown = {{"minimal", stored}};
  for (auto _ : state) benchmark::DoNotOptimize(case_data("k", shown, stock_generator(), {}).value());
}

BENCHMARK(whole_case)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(whole_case_and_clip)->Unit(benchmark::kMillisecond);
BENCHMARK(generate_and_judge)->Unit(benchmark::kMillisecond);
BENCHMARK(take_the_shots)->Unit(benchmark::kMillisecond);
BENCHMARK(set_the_meshes)->Unit(benchmark::kMillisecond);
BENCHMARK(png_of_eight_tiles)->Unit(benchmark::kMillisecond);
BENCHMARK(glb_of_the_motion)->Unit(benchmark::kMillisecond);
BENCHMARK(strip)->Unit(benchmark::kMillisecond);
BENCHMARK(strip_and_clip)->Unit(benchmark::kMillisecond);
BENCHMARK(choose_the_view)->Unit(benchmark::kMillisecond);
BENCHMARK(draw_and_read_one_tile)->Unit(benchmark::kMillisecond);
BENCHMARK(halve_one_tile)->Unit(benchmark::kMillisecond);
BENCHMARK(write_a_caption)->Unit(benchmark::kMillisecond);
BENCHMARK(png_of_a_tile)->Unit(benchmark::kMillisecond);
BENCHMARK(webp_of_a_tile)->Unit(benchmark::kMillisecond);
BENCHMARK(case_data_of_one_motion)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace contort

BENCHMARK_MAIN();
