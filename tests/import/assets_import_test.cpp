// Real characters from other people: shared/assets beside the repository. Skipped if they are missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "tests/stage_evaluator.h"
#include "formats/gltf/read.h"
#include "import/import.h"
#include "model/motion/recording.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

const std::string kModels = std::string(CONTORT_SOURCE_DIR) + "/../shared/assets/gltf";

std::vector<std::string> models() {
  std::vector<std::string> out;
  for (const char* folder : {"/characters", "/modular"}) {
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(kModels + folder, error))
      if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
        out.push_back(entry.path().string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

struct ImportedModel {
  SkinnedAsset asset;
  Imported in;
};

// Imports all models that can be imported; all others must give a reason.
std::map<std::string, ImportedModel> import_all() {
  std::map<std::string, ImportedModel> out;
  for (const std::string& path : models()) {
    const Result<SkinnedAsset> asset = read_skinned_gltf(path);
    EXPECT_TRUE(asset.ok()) << path << ": " << to_line(asset.issue());
    if (!asset.ok()) continue;
    ImportOptions options;
    options.name = name_of_file(path);
    const Result<Imported> in = import_model(*asset, options);
    const bool has_vertices = std::any_of(asset->meshes.begin(), asset->meshes.end(),
                                          [](const SkinnedMesh& mesh) { return !mesh.vertices.empty(); });
    EXPECT_EQ(in.ok(), has_vertices) << path << ": " << (in.ok() ? "" : to_line(in.issue()));
    if (in.ok()) out[fs::path(path).filename().string()] = {*asset, *in};
  }
  return out;
}

const std::map<std::string, ImportedModel>& all_imported() {
  static const std::map<std::string, ImportedModel> imported = import_all();
  return imported;
}

#define SKIP_WITHOUT_MODELS() \
  if (models().empty()) GTEST_SKIP() << "no models in " << kModels

Library library_of(const Imported& in) {
  Library library;
  for (const PartDesc& part : in.cut.parts) library.parts[part.name] = part;
  library.characters[in.cut.character.name] = in.cut.character;
  return library;
}

TEST(AssetImport, EveryModelWithSkinnedVerticesBecomesACharacterThatRestsWithoutFault) {
  SKIP_WITHOUT_MODELS();
  for (const auto& [file, model] : all_imported()) {
    Spec spec;
    spec.character.name = model.in.cut.character.name;
    spec.hold_frames = 2;
    const Result<Stage> stage = build_stage(spec, library_of(model.in));
    ASSERT_TRUE(stage.ok()) << file << ": " << to_line(stage.issue());
    StageEvaluator evaluator;
    for (const Finding& finding : evaluator.run(*stage).findings)
      ADD_FAILURE() << file << ": " << finding.check << " " << finding.subject << " " << finding.worst_margin;
  }
  EXPECT_GE(all_imported().size(), 16U);
}

TEST(AssetImport, IsWhatItLooksLike) {
  SKIP_WITHOUT_MODELS();
  const auto figure = [](const char* file) { return all_imported().at(file).in.figure; };
  for (const char* human : {"Knight.glb", "mannequiny.glb", "CesiumMan.glb", "RiggedFigure.glb", "Worker.glb",
                            "Spacesuit.glb", "manny_med_mod.gltf", "player.glb", "robot.glb", "Stan.glb"})
    EXPECT_TRUE(figure(human).is_humanoid) << human;
  EXPECT_TRUE(figure("Fox.glb").is_quadruped);
  for (const char* other : {"Spider.glb", "Trex.glb", "George.glb", "vintageFan_animated.gltf"})
    EXPECT_FALSE(figure(other).is_humanoid) << other;
}

// The model's own clips on the imported character: joints whose ranges come from clips must allow them.
TEST(AssetImportSlow, OwnClipsStayInTheRangesThatCameFromThem) {
  SKIP_WITHOUT_MODELS();
  for (const auto& [file, model] : all_imported()) {
    std::map<std::string, LimitSource> source;
    std::map<std::string, std::string> joints = model.in.cut.joint_of_node;
    // An ankle's two hinges cannot follow a turn about a third axis, and a recording shares it out between them and the
    // toes otherwise than an import does: neither is judged here.
    for (const BoneReport& bone : model.in.cut.bones)
      if (bone.joint.find("foot_") != 0) source[bone.joint] = bone.limits.source;
    joints[model.in.figure.bones.front().label] = "root";
    const Result<Character> character = build_character({model.in.cut.character.name, {}, {}}, library_of(model.in));
    ASSERT_TRUE(character.ok());
    for (const AssetClip& clip : model.asset.asset.clips) {
      const Result<Motion> motion =
          follow_recording(*character, {model.asset.asset, clip, joints, 0.0, 30.0, 0, Rigid{}});
      ASSERT_TRUE(motion.ok()) << file << ": " << to_line(motion.issue());
      StageEvaluator evaluator;
      for (const Finding& finding : evaluator.judge(*character, *motion, "joint_range")) {
        const std::string joint = finding.subject.substr(0, finding.subject.find(' '));
        if (const auto known = source.find(joint); known != source.end() && known->second == LimitSource::clips)
          ADD_FAILURE() << file << " " << clip.label << ": " << finding.subject << " " << finding.worst_margin;
      }
    }
  }
}

}  // namespace
}  // namespace contort
