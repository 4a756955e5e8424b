// The rules for includes: the arrows of docs/internals/architecture.md, and one door for each third-party library.
#include <fnmatch.h>
#include <gtest/gtest.h>

#include <optional>

#include "tests/guards/source_text.h"

namespace contort::guards {
namespace {

// Files in a folder may include their own layer and the listed ones; "generator/*" is the folder with all folders
// below.
struct Layer {
  std::string folder;
  std::vector<std::string> may_include;
};

const std::vector<Layer> kLayers = {
    {"model/core", {}},
    {"model/asset", {"model/core"}},
    {"model/character", {"model/core", "model/asset"}},
    {"model/geometry", {"model/core", "model/character"}},
    {"model/world", {"model/core", "model/character"}},
    {"model/motion", {"model/core", "model/asset", "model/character", "model/world"}},
    {"model/spec", {"model/core", "model/character", "model/world"}},
    {"model", {"model/*"}},  // generator.h: the interface
    {"formats/gltf", {"model/*"}},
    {"formats/mocap", {"model/core", "model/asset"}},
    {"formats/robot", {"model/*"}},
    {"formats/table", {"model/core", "model/asset"}},
    {"formats/detect", {"model/core", "model/asset", "formats/gltf", "formats/mocap", "formats/table"}},
    {"generator/motion", {"model/*"}},
    {"generator/actions", {"model/*", "generator/motion"}},
    {"generator/timeline", {"model/*", "generator/motion", "generator/actions"}},
    {"generator/dynamics", {"model/*", "generator/motion"}},
    {"generator", {"model/*", "formats/*", "generator/*"}},  // stage, generate: the interface for other folders
    {"process", {"model/core"}},
    {"guest", {"model/*", "formats/*", "process"}},
    {"checks", {"model/*"}},
    {"import", {"model/*", "formats/*", "generator/*", "checks"}},
    {"corpus", {"model/*", "formats/*", "process", "checks"}},
    {"fuzz", {"model/*", "formats/*", "process", "checks", "corpus"}},
    {"renders", {"model/*", "formats/*", "process", "checks", "corpus"}},
    {"renders/raster", {"model/*", "formats/*", "process", "checks", "corpus", "renders"}},
    {"server", {"model/*", "formats/*", "process", "checks", "corpus", "fuzz", "renders"}},
    {"cli",
     {"model/*", "formats/*", "generator/*", "guest", "process", "checks", "import", "corpus", "fuzz", "renders",
      "server"}},
    {"cli/render_main.cpp",
     {"model/*", "formats/*", "generator", "process", "checks", "corpus", "renders", "renders/raster", "cli"}},
    {"wasm", {"model/*", "generator/*", "renders"}},
    {"tests", {"*"}},
    {"bench", {"*"}},
};

// The only files that may include a library. GLM is the exception: its types are ours.
struct Door {
  std::string header;  // or the folder of headers, "glm/"
  std::string files;   // patterns as for fnmatch(3); * does not match a slash
};

const std::vector<Door> kDoors = {
    {"nlohmann/", "model/core/json_value_fields.h"},
    {"tiny_gltf.h", "formats/gltf/*.cpp"},
    {"tiny_gltf.h", "wasm/tiny_gltf.cpp"},
    {"draco/", "formats/gltf/draco.cpp"},
    {"meshoptimizer.h", "formats/gltf/meshopt.cpp"},
    {"rapidcheck", "fuzz/draw*.cpp"},
    {"GL/", "renders/raster/*.cpp"},
    {"EGL/", "renders/raster/egl_backend.cpp"},
    {"webp/", "renders/raster/webp.cpp"},
    {"OpenImageIO/", "renders/raster/*.cpp"},
    {"xxhash.h", "model/core/hash.cpp"},
    {"CLI/", "cli/*.cpp"},
    {"lua.hpp", "generator/actions/script*.cpp"},
    {"zlib.h", "renders/gzip.cpp"},
    {"tinyxml2.h", "renders/junit.cpp"},
    {"tinyxml2.h", "formats/robot/*.cpp"},
    {"httplib.h", "server/http.cpp"},
    {"httplib.h", "server/connection.*"},  // a stream of the library's
    {"netdb.h", "server/connection.cpp"},
};

// Headers of the system, which a .cpp may use.
constexpr std::array kSystemFolders = {"sys/", "netinet/", "arpa/"};
constexpr std::array kSystemHeaders = {"unistd.h", "fcntl.h",   "signal.h", "poll.h",   "dlfcn.h",
                                       "spawn.h",  "stdlib.h",  "stdio.h",  "dirent.h", "errno.h",
                                       "time.h",   "pthread.h", "sched.h",  "malloc.h", "termios.h"};

bool below(std::string_view path, std::string_view folder) {
  return path == folder || (path.starts_with(folder) && path.size() > folder.size() && path[folder.size()] == '/');
}

const Layer* layer_of(std::string_view path) {
  const Layer* found = nullptr;
  for (const Layer& layer : kLayers) {
    if (below(path, layer.folder) && (found == nullptr || layer.folder.size() > found->folder.size())) found = &layer;
  }
  const bool new_folder = found != nullptr && found->folder == "generator" &&
                          path.find('/', found->folder.size() + 1) != std::string_view::npos;
  return new_folder ? nullptr : found;
}

bool sees(const Layer& from, const Layer& to) {
  if (from.folder == to.folder) return true;
  return std::ranges::any_of(from.may_include, [&to](std::string_view allowed) {
    if (allowed == "*") return true;
    if (allowed.ends_with("/*")) return below(to.folder, allowed.substr(0, allowed.size() - 2));
    return to.folder == allowed;
  });
}

bool is_test(std::string_view path) { return below(path, "tests") || below(path, "bench"); }

std::optional<std::string> refuse_ours(std::string_view path, std::string_view header) {
  const Layer* from = layer_of(path);
  const Layer* to = layer_of(header);
  if (to == nullptr) return "\"" + std::string(header) + "\" is not written from the project's root";
  if (header.ends_with(".cpp")) return "a .cpp is compiled, not included";
  if (!sees(*from, *to)) return from->folder + " may not see " + to->folder;
  if (header.ends_with("_fields.h") && path.ends_with(".h") && !path.ends_with("_fields.h") && !is_test(path)) {
    return "headers named *_fields.h bring nlohmann-json: they are for .cpp files and for each other";
  }
  return std::nullopt;
}

std::optional<std::string> refuse_theirs(std::string_view path, std::string_view header) {
  const bool standard = header.find_first_of("./") == std::string_view::npos;
  if (standard || header.starts_with("glm/") || is_test(path)) return std::nullopt;
  std::string doors;
  for (const Door& door : kDoors) {
    if (!header.starts_with(door.header)) continue;
    if (fnmatch(door.files.c_str(), std::string(path).c_str(), FNM_PATHNAME) == 0) return std::nullopt;
    doors += (doors.empty() ? "" : " and ") + door.files;
  }
  if (!doors.empty()) return "<" + std::string(header) + "> is only for " + doors;
  const bool system = std::ranges::find(kSystemHeaders, header) != kSystemHeaders.end() ||
                      std::ranges::any_of(kSystemFolders, [&](const char* f) { return header.starts_with(f); });
  if (!system) return "<" + std::string(header) + "> is a library without a door in tests/guards/layering_test.cpp";
  if (path.ends_with(".h")) return "<" + std::string(header) + "> is for .cpp files";
  return std::nullopt;
}

std::vector<Violation> layering_violations(const std::string& path, std::string_view text) {
  if (layer_of(path) == nullptr) return {{path, 0, "the folder has no layer in tests/guards/layering_test.cpp"}};
  std::vector<Violation> violations;
  for (const Include& include : includes_of(text)) {
    std::optional<std::string> refusal;
    if (include.open == '"') refusal = refuse_ours(path, include.name);
    if (include.open == '<') refusal = refuse_theirs(path, include.name);
    if (include.open == '\0') refusal = "a macro hides what is included";
    if (refusal) violations.push_back({path, include.line, *refusal});
  }
  return violations;
}

TEST(Layering, TheProjectKeepsItsArrows) {
  std::vector<Violation> violations;
  int headers_seen = 0;
  for (const SourceFile& file : project_files()) {
    if (!is_cpp(file.path) && !file.path.ends_with(".inc")) continue;
    if (below(file.path, "adapters")) continue;  // users copy them, so they include no file of ours
    // Users' projects, which include installed headers and are built with them.
    if (below(file.path, "docs/examples")) continue;
    if (file.path.ends_with(".h")) ++headers_seen;
    std::ranges::copy(layering_violations(file.path, file.text), std::back_inserter(violations));
  }
  EXPECT_GT(headers_seen, 20);  // the walk found the project
  EXPECT_TRUE(violations.empty()) << to_text(violations);
}

TEST(Layering, OneFileOpensOSMesa) {
  std::vector<std::string> doors;
  for (const SourceFile& file : project_files()) {
    if (!is_cpp(file.path)) continue;
    for (const Include& include : includes_of(file.text)) {
      if (include.name == "GL/osmesa.h") doors.push_back(file.path);
    }
  }
  EXPECT_EQ(doors.size(), 1U) << testing::PrintToString(doors);
}

struct LayerExample {
  const char* path;
  const char* text;
};

TEST(Layering, RefusesPlantedViolations) {
  constexpr LayerExample kBad[] = {
      {"model/core/math.h", "#include \"model/character/character.h\"\n"},
      {"generator/motion/ik.cpp", "#include \"generator/actions/registry.h\"\n"},
      {"generator/actions/walk.cpp", "#include \"generator/timeline/queue.h\"\n"},
      {"model/motion/motion.cpp", "#include \"model/spec/spec.h\"\n"},
      {"model/spec/spec.h", "#include \"generator/timeline/queue.h\"\n"},
      {"formats/gltf/read.cpp", "#include \"generator/actions/registry.h\"\n"},
      {"generator/sounds/beep.h", ""},
      {"sounds/beep.cpp", ""},
      {"generator/generate.cpp", "#include \"checks/check.h\"\n"},
      {"checks/fold.cpp", "#include \"corpus/store.h\"\n"},
      {"checks/joint_range.cpp", "#include \"generator/motion/ik.h\"\n"},
      {"checks/joint_range.cpp", "#include \"generator/stage.h\"\n"},
      {"checks/joint_range.cpp", "#include \"formats/gltf/read.h\"\n"},
      {"guest/finished_file.cpp", "#include \"generator/stage.h\"\n"},
      {"guest/finished_file.cpp", "#include \"checks/check.h\"\n"},
      {"generator/generate.cpp", "#include \"guest/finished_file.h\"\n"},
      {"corpus/store.cpp", "#include \"fuzz/run.h\"\n"},
      {"fuzz/run.cpp", "#include \"renders/report.h\"\n"},
      {"renders/report.cpp", "#include \"fuzz/run.h\"\n"},
      {"renders/report.cpp", "#include \"renders/raster/image.h\"\n"},
      {"cli/fuzz.cpp", "#include \"renders/raster/image.h\"\n"},
      {"cli/fuzz.cpp", "#include \"tests/scenes.h\"\n"},
      {"cli/fuzz.cpp", "#include \"bench/timer.h\"\n"},
      {"corpus/store.cpp", "#include \"cli/options.h\"\n"},
      {"checks/fold.cpp", "#include \"fold.h\"\n"},
      {"checks/fold.cpp", "#include \"../model/core/math.h\"\n"},
      {"checks/fold.cpp", "#include <model/core/math.h>\n"},
      {"checks/fold.cpp", "#include \"checks/check.cpp\"\n"},
      {"checks/fold.cpp", "  #  include MATH_HEADER\n"},
      {"model/core/math.h", "#include <Eigen/Dense>\n"},
      {"model/character/desc.h", "#include <nlohmann/json.hpp>\n"},
      {"corpus/store.cpp", "#include <nlohmann/json.hpp>\n"},
      {"corpus/store.h", "#include \"model/core/json_fields.h\"\n"},
      {"corpus/store.h", "#include \"model/spec/spec_fields.h\"\n"},
      {"formats/gltf/read.h", "#include <tiny_gltf.h>\n"},
      {"corpus/store.cpp", "#include <tiny_gltf.h>\n"},
      {"fuzz/search.cpp", "#include <rapidcheck.h>\n"},
      {"fuzz/draw.h", "#include <rapidcheck.h>\n"},
      {"fuzz/search.cpp", "#include <rapidcheck/gen/Numeric.h>\n"},
      {"renders/report.cpp", "#include <OpenImageIO/imageio.h>\n"},
      {"renders/raster/image.h", "#include <OpenImageIO/imageio.h>\n"},
      {"renders/camera.cpp", "#include <GL/osmesa.h>\n"},
      {"corpus/store.cpp", "#include <xxhash.h>\n"},
      {"fuzz/run.cpp", "#include <CLI/CLI.hpp>\n"},
      {"fuzz/run.h", "#include <unistd.h>\n"},
      {"fuzz/run.cpp", "/* not here */ #include <Python.h>\n"},
  };
  for (const LayerExample& bad : kBad) {
    EXPECT_EQ(layering_violations(bad.path, bad.text).size(), 1U) << bad.path << " with " << bad.text;
  }
}

TEST(Layering, AllowsWhatIsRight) {
  constexpr LayerExample kGood[] = {
      {"model/core/math.h", "#include <glm/vec3.hpp>\n#include <vector>\n"},
      {"model/core/json_value_fields.h", "#include <nlohmann/json.hpp>\n"},
      {"model/core/hash.cpp", "#include <xxhash.h>\n"},
      {"generator/timeline/queue.cpp", "#include \"generator/actions/registry.h\"\n"},
      {"model/spec/spec_fields.h", "#include \"model/core/json_fields.h\"\n"},
      {"formats/gltf/read.cpp", "#include <tiny_gltf.h>\n#include \"model/motion/motion.h\"\n"},
      {"generator/stage.h", "#include \"generator/timeline/queue.h\"\n"},
      {"guest/finished_file.cpp", "#include \"formats/gltf/read.h\"\n#include \"model/motion/recording.h\"\n"},
      {"checks/fold.cpp", "#include \"checks/fold.h\"\n#include \"model/motion/kinematics.h\"\n"},
      {"corpus/store.cpp", "#include \"model/core/json_fields.h\"\n#include <sys/stat.h>\n"},
      {"fuzz/draw_clip.cpp", "#include <rapidcheck.h>\n#include <rapidcheck/gen/Numeric.h>\n"},
      {"renders/raster/osmesa.cpp", "#include <GL/osmesa.h>\n#include <dlfcn.h>\n#include \"renders/camera.h\"\n"},
      {"cli/render_main.cpp", "#include <CLI/CLI.hpp>\n#include \"renders/raster/image.h\"\n"},
      {"tests/cli/fuzz_test.cpp", "#include <rapidcheck.h>\n#include \"cli/options.h\"\n#include \"bench/timer.h\"\n"},
      {"bench/generate_bench.cpp", "#include <benchmark/benchmark.h>\n#include \"tests/scenes.h\"\n"},
      {"checks/fold.cpp", "// #include \"cli/options.h\"\nconst char* s = R\"(\n#include \"cli/options.h\"\n)\";\n"},
  };
  for (const LayerExample& good : kGood) {
    const std::vector<Violation> violations = layering_violations(good.path, good.text);
    EXPECT_TRUE(violations.empty()) << to_text(violations);
  }
}

TEST(Layering, ReadsCodeAndNotComments) {
  EXPECT_EQ(code_of("a; // sin(x)\nb;"), "a;          \nb;");
  EXPECT_EQ(code_of("a /* sin\n(x) */ b"), "a       \n       b");
  EXPECT_EQ(code_of("f(\"sin(\\\"x)\");"), "f(\"        \");");
  EXPECT_EQ(code_of("n = 1'000'000; c = 'x'; c = '\\'';"), "n = 1'000'000; c = ' '; c = '  ';");
  EXPECT_EQ(code_of("R\"q(a)\" b)q\" c"), "R            c");
  EXPECT_EQ(code_of("#include \"a/b.h\"  // why"), "#include \"a/b.h\"        ");
}

}  // namespace
}  // namespace contort::guards
