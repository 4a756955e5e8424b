// Walks of real people as targets of a figure with mass: shared/assets beside the repository. Skipped if they are
// missing.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "generator/generate.h"
#include "generator/recordings.h"
#include "model/core/index.h"
#include "tests/character/stock.h"
#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

const std::string kMocap = std::string(CONTORT_SOURCE_DIR) + "/../shared/assets/mocap/";

#define SKIP_WITHOUT_PEOPLE() \
  if (!fs::exists(kMocap)) GTEST_SKIP() << "no recordings in " << kMocap

using Names = std::map<std::string, std::string>;

// "{side}" and "{s}" stand for both sides.
Names both_sides(const Names& pattern, const std::array<std::string, 2>& sides) {
  Names out;
  const auto put = [](std::string text, const std::string& what, const std::string& with) {
    if (const std::size_t found = text.find(what); found != std::string::npos) text.replace(found, what.size(), with);
    return text;
  };
  for (const auto& [node, joint] : pattern)
    for (int s = 0; s < 2; ++s)
      out[put(node, "{side}", sides[at(s)])] = put(joint, "{side}", s == 0 ? "left" : "right");
  return out;
}

const Names kBvh = both_sides({{"Hips", "root"}, {"Spine", "torso/lumbar_flex"}, {"Neck", "head/neck_flex"},
                               {"{side}Arm", "arm_{side}/shoulder"}, {"{side}ForeArm", "arm_{side}/elbow"},
                               {"{side}UpLeg", "leg_{side}/hip_flex"}, {"{side}Leg", "leg_{side}/knee"},
                               {"{side}Foot", "foot_{side}/ankle_flex"}},
                              {"Left", "Right"});
const Names kAsf = both_sides({{"root", "root"}, {"lowerback", "torso/lumbar_flex"}, {"lowerneck", "head/neck_flex"},
                               {"{side}humerus", "arm_{side}/shoulder"}, {"{side}radius", "arm_{side}/elbow"},
                               {"{side}femur", "leg_{side}/hip_flex"}, {"{side}tibia", "leg_{side}/knee"},
                               {"{side}foot", "foot_{side}/ankle_flex"}},
                              {"l", "r"});
const Names kDeepMimic = both_sides({{"root", "root"}, {"chest", "torso/lumbar_flex"}, {"neck", "head/neck_flex"},
                                     {"{side}_shoulder", "arm_{side}/shoulder"}, {"{side}_elbow", "arm_{side}/elbow"},
                                     {"{side}_hip", "leg_{side}/hip_flex"}, {"{side}_knee", "leg_{side}/knee"},
                                     {"{side}_ankle", "foot_{side}/ankle_flex"}},
                                    {"left", "right"});

// DeepMimic's figures look along +X; here they look along +Z.
Vec3 faced(const Vec3& v) { return {-v.z, v.y, v.x}; }
Quat faced(const Quat& q) {
  const Quat turn = axis_angle(Vec3(0, 1, 0), -0.5 * kPi);
  return turn * q * glm::conjugate(turn);
}

// A cycle of DeepMimic's figure, several times over.
Asset deep_mimic(const std::string& name, int cycles) {
  const nlohmann::json figure = nlohmann::json::parse(std::ifstream(kMocap + "deepmimic/humanoid3d.txt"));
  const nlohmann::json clip = nlohmann::json::parse(std::ifstream(kMocap + "deepmimic/" + name + ".txt"));
  Asset asset;
  std::vector<AssetChannel> channels(1);
  std::vector<int> first;  // number of each joint in a frame; -1 for one that does not turn
  int at_number = 4;
  channels[0].path = ChannelPath::translation;
  for (const auto& joint : figure.at("Skeleton").at("Joints")) {
    AssetNode node;
    node.name = node.label = joint.at("Name"), node.parent = joint.at("Parent");
    node.rest.translation = faced(Vec3(joint.at("AttachX"), joint.at("AttachY"), joint.at("AttachZ")));
    asset.order.push_back(static_cast<int>(asset.nodes.size()));
    asset.nodes.push_back(node);
    const std::string type = joint.at("Type");
    first.push_back(type == "fixed" ? -1 : at_number);
    at_number += type == "fixed" ? 0 : type == "revolute" ? 1 : 4;
    AssetChannel turns;
    turns.node = asset.order.back(), turns.path = ChannelPath::rotation;
    channels.push_back(turns);
  }
  const auto& frames = clip.at("Frames");
  const double frame_s = frames[0][0];
  const int count = static_cast<int>(frames.size()) - 1;  // the last frame is the first one of the next cycle
  const auto place = [&](int f) { return Vec3(frames[at(f)][1], frames[at(f)][2], frames[at(f)][3]); };
  Vec3 cycle_m = place(count) - place(0);
  cycle_m.y = 0.0;
  for (int k = 0; k < cycles * count; ++k) {
    const auto& frame = frames[at(k % count)];
    const Vec3 root_m = faced(place(k % count) + static_cast<double>(k / count) * cycle_m);
    channels[0].times_s.push_back(k * frame_s);
    channels[0].values.insert(channels[0].values.end(), {root_m.x, root_m.y, root_m.z});
    for (std::size_t j = 0; j < first.size(); ++j) {
      if (first[j] < 0) continue;
      const auto number = [&](int i) { return frame[at(first[j] + i)].get<double>(); };
      const bool is_hinge = j + 1 < first.size() && (asset.nodes[j].name.ends_with("knee") ||
                                                     asset.nodes[j].name.ends_with("elbow"));
      const Quat q = faced(is_hinge ? axis_angle(Vec3(0, 0, 1), number(0))
                                    : glm::normalize(Quat(number(0), number(1), number(2), number(3))));
      channels[j + 1].times_s.push_back(k * frame_s);
      channels[j + 1].values.insert(channels[j + 1].values.end(), {q.x, q.y, q.z, q.w});
    }
  }
  std::erase_if(channels, [](const AssetChannel& channel) { return channel.times_s.empty(); });
  AssetClip taken;
  taken.name = taken.label = name, taken.last_s = channels[0].times_s.back(), taken.channels = channels;
  asset.clips = {taken};
  return asset;
}

Library library_of_people() {
  const TempFolder folder;
  for (const char* file : {"bvh/pybvh/cmu_12_01_walk.bvh", "asfamc/02_01.amc", "asfamc/02.asf"})
    fs::copy_file(kMocap + file, folder / fs::path(file).filename().string());
  Library library = stock_library();
  EXPECT_TRUE(load_recordings(folder.path(), library));
  library.recordings["deepmimic_walk"] = std::make_shared<const Asset>(deep_mimic("humanoid3d_walk", 4));
  return library;
}

Spec playing(const std::string& name, const Names& joints, double from_s, Mode mode) {
  Spec spec;
  spec.character.name = "human", spec.dynamics.mode = mode;
  spec.recording.name = name, spec.recording.joints = joints, spec.recording.from_s = from_s;
  return spec;
}

double difference_rad(const Joint& joint, std::span<const double> a, std::span<const double> b) {
  const auto quat = [&](std::span<const double> row) {
    const double* q = &row[at(joint.coord)];
    return Quat(q[0], q[1], q[2], q[3]);
  };
  if (coord_size(joint.kind) == 4) return rotation_angle(glm::conjugate(quat(a)) * quat(b));
  return a[at(joint.coord)] - b[at(joint.coord)];
}

// The root mean square of all joints' differences over all frames.
double rms_deg(const Character& character, const Motion& a, const Motion& b) {
  double sum = 0.0, count = 0.0;
  for (int f = 0; f < a.frame_count; ++f)
    for (const Joint& joint : character.joints().subspan(1)) {
      const double rad = difference_rad(joint, a.row(f), b.row(f));
      sum += rad * rad, count += 1.0;
    }
  return std::sqrt(sum / count) * kDegPerRad;
}

TEST(RecordedPeople, AFigureWithMassWalksAsTheyDo) {
  SKIP_WITHOUT_PEOPLE();
  const Library library = library_of_people();
  struct Row {
    const char* name;
    const Names& joints;
    double from_s;
  };
  for (const Row& row : {Row{"cmu_12_01_walk", kBvh, 0.1}, Row{"02_01", kAsf, 0.0}, Row{"deepmimic_walk", kDeepMimic, 0.0}}) {
    const Stage stage = *build_stage(playing(row.name, row.joints, row.from_s, Mode::dynamic), library);
    const Motion motion = generate(stage);
    const Motion recorded = generate(*build_stage(playing(row.name, row.joints, row.from_s, Mode::kinematic), library));
    ASSERT_EQ(motion.frame_count, recorded.frame_count);
    EXPECT_GT(motion.frame_count, 150) << row.name;
    for (int f = 0; f < motion.frame_count; ++f)
      ASSERT_EQ(motion.response.stances[at(f)].footing, Footing::standing) << row.name << " " << f;
    EXPECT_LT(rms_deg(*stage.character, motion, recorded), 8.0) << row.name;
  }
}

}  // namespace
}  // namespace contort
