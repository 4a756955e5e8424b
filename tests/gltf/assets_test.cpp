// Real files from other people: shared/assets beside the repository. Skipped if they are missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "formats/gltf/read.h"
#include "model/asset/sample.h"

namespace contort {
namespace {

const std::string kAssets = std::string(CONTORT_SOURCE_DIR) + "/../shared/assets";

#define SKIP_WITHOUT_ASSETS() \
  if (!std::filesystem::exists(kAssets + "/MANIFEST.tsv")) GTEST_SKIP() << "no folder " << kAssets

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> out;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, separator);) out.push_back(field);
  return out;
}

struct ManifestRow {
  std::string path;
  std::string kind;
  std::string role;
  std::string facts;
};

std::vector<ManifestRow> manifest() {
  std::vector<ManifestRow> out;
  std::ifstream file(kAssets + "/MANIFEST.tsv");
  for (std::string line; std::getline(file, line);)
    if (const auto fields = split(line, '\t'); fields.size() > 10)
      out.push_back({fields[0], fields[1], fields[2], fields[10]});
  return out;
}

// Each file is read once for all tests, except for the test of the reading time.
const Result<Asset>& cached(const std::string& path) {
  static std::map<std::string, Result<Asset>> read;
  const auto found = read.find(path);
  return found != read.end() ? found->second : read.emplace(path, read_gltf(path)).first->second;
}

// "peak 2983 deg/s (Robot_Punch/UpperArm.R)": measured by someone else's parser.
struct Peak {
  double speed_deg_s = -1.0;
  std::string clip;   // a name, or an index where the clip has none; names may hold "/" for "|"
  std::string joint;  // likewise
};

Peak peak_in(const std::string& facts) {
  const std::size_t start = facts.find("peak ");
  if (start == std::string::npos) return {};
  const std::size_t open = facts.find(" deg/s (", start);
  const std::string place = facts.substr(open + 8, facts.find(')', open) - open - 8);
  const std::size_t slash = place.rfind('/');
  return {std::stod(facts.substr(start + 5)), place.substr(0, slash), place.substr(slash + 1)};
}

// The manifest takes the time between the keys for STEP, too, which jumps within a frame.
double peak_of(const std::vector<double>& times_s, const ChannelSpeeds& speeds) {
  double out = 0.0;
  for (std::size_t i = 0; i < speeds.between_keys.size(); ++i) {
    const auto& [t0_s, t1_s, speed_rad_s] = speeds.between_keys[i];
    const double share = speeds.jumps ? (t1_s - t0_s) / (times_s[i + 1] - times_s[i]) : 1.0;
    out = std::max(out, speed_rad_s * share * kDegPerRad);
  }
  return out;
}

bool is_named(const std::string& name, std::size_t index, const std::string& wanted) {
  std::string plain = name;
  std::replace(plain.begin(), plain.end(), '|', '/');
  return name.empty() ? wanted == std::to_string(index) : plain == wanted;
}

// The fastest channel of all, and the fastest of the clip and joint that the manifest names.
struct Measured {
  Peak fastest;
  double named_deg_s = -1.0;
};

Measured measure(const Asset& asset, const Peak& wanted) {
  Measured out;
  for (std::size_t clip = 0; clip < asset.clips.size(); ++clip)
    for (const ChannelSpeeds& channel : joint_speeds(asset.clips[clip])) {
      const auto node = static_cast<std::size_t>(channel.node);
      const auto& times_s = asset.clips[clip].channels[static_cast<std::size_t>(channel.channel)].times_s;
      const double peak = peak_of(times_s, channel);
      if (peak > out.fastest.speed_deg_s) out.fastest = {peak, asset.clips[clip].label, asset.nodes[node].label};
      if (is_named(asset.clips[clip].name, clip, wanted.clip) && is_named(asset.nodes[node].name, node, wanted.joint))
        out.named_deg_s = std::max(out.named_deg_s, peak);
    }
  return out;
}

// The manifest has whole degrees: half a degree is its rounding.
bool agrees(double measured, double stated) { return std::fabs(measured - stated) <= std::max(0.01 * stated, 0.5); }

TEST(SharedAssets, CharactersHaveThePeakSpeedsOfTheManifest) {
  SKIP_WITHOUT_ASSETS();
  int compared = 0;
  for (const ManifestRow& row : manifest()) {
    if (row.kind != "gltf-character" || row.role != "main") continue;
    const auto& asset = cached(kAssets + "/" + row.path);
    ASSERT_TRUE(asset.ok()) << row.path << ": " << to_line(asset.issue());
    const Peak stated = peak_in(row.facts);
    if (stated.speed_deg_s < 0.0) continue;
    const Measured ours = measure(*asset, stated);
    ++compared;
    std::printf("%-28s manifest %5.0f (%s/%s), ours %8.2f (%s/%s)\n",
                std::filesystem::path(row.path).filename().c_str(), stated.speed_deg_s, stated.clip.c_str(),
                stated.joint.c_str(), ours.fastest.speed_deg_s, ours.fastest.clip.c_str(), ours.fastest.joint.c_str());
    EXPECT_TRUE(agrees(ours.fastest.speed_deg_s, stated.speed_deg_s)) << row.path;
    EXPECT_TRUE(agrees(ours.named_deg_s, stated.speed_deg_s)) << row.path << ": another joint is the fastest";
  }
  EXPECT_EQ(compared, 18);
}

TEST(SharedAssets, OtherFilesHaveThePeakSpeedsOfTheManifest) {
  SKIP_WITHOUT_ASSETS();
  int compared = 0;
  for (const ManifestRow& row : manifest()) {
    const Peak stated = peak_in(row.facts);
    if (!row.kind.starts_with("gltf-") || row.role != "main" || stated.speed_deg_s < 0.0) continue;
    const auto& asset = cached(kAssets + "/" + row.path);
    if (!asset.ok()) continue;
    const Measured ours = measure(*asset, stated);
    ++compared;
    EXPECT_TRUE(agrees(ours.fastest.speed_deg_s, stated.speed_deg_s)) << row.path << ours.fastest.speed_deg_s;
    EXPECT_TRUE(agrees(ours.named_deg_s, stated.speed_deg_s)) << row.path << ": another joint is the fastest";
  }
  EXPECT_GT(compared, 40);
}

std::vector<std::string> all_gltf_files() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kAssets + "/gltf")) {
    const std::string path = entry.path().string();
    if (path.ends_with(".glb") || path.ends_with(".gltf")) out.push_back(path);
  }
  std::sort(out.begin(), out.end());
  return out;
}

// The expected results of all files, beside this test: "ok" or the code of the issue. Each refusal was examined by
// hand.
std::map<std::string, std::string> stored_verdicts() {
  std::map<std::string, std::string> out;
  std::ifstream file(std::string(CONTORT_SOURCE_DIR) + "/tests/gltf/asset_verdicts.tsv");
  for (std::string line; std::getline(file, line);)
    if (const auto fields = split(line, '\t'); fields.size() == 2) out[fields[0]] = fields[1];
  return out;
}

TEST(SharedAssets, EveryFileGetsTheSameCleanAnswerQuickly) {
  SKIP_WITHOUT_ASSETS();
  const std::clock_t start = std::clock();
  const std::map<std::string, std::string> stored = stored_verdicts();
  for (const std::string& path : all_gltf_files()) {
    const std::string name = path.substr(kAssets.size() + 6);
    const auto asset = read_gltf(path);
    const std::string verdict = asset.ok() ? "ok" : asset.issue().code;
    const auto expected = stored.find(name);
    EXPECT_TRUE(expected != stored.end() && expected->second == verdict)
        << "new line: " << name << "\t" << verdict << (asset.ok() ? "" : "  " + to_line(asset.issue()));
  }
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_LT(cpu_s, 30.0);  // 1 s alone on a machine; 5 s under ASan on a busy one
}

// Files that the Khronos validator finds no error in, and that we refuse all the same.
TEST(SharedAssets, ValidFilesAreReadExceptForThreeReasons) {
  SKIP_WITHOUT_ASSETS();
  const std::map<std::string, std::string> reasons = {
      {"min_version_valid.gltf", "asks for a reader of glTF 2.1"},
      {"data_uri.glb", "a data: URI that is not base64"},
      {"non_relative_uri.gltf", "a buffer on the web"},
  };
  for (const ManifestRow& row : manifest()) {
    const bool has_report = row.facts.find("expected report") != std::string::npos;
    const bool is_valid = has_report ? row.facts.find("E:") == std::string::npos
                                     : row.facts.find("validator: clean") != std::string::npos ||
                                           row.facts.find("validator: 0 err") != std::string::npos;
    if (!row.kind.starts_with("gltf-") || row.role != "main" || !is_valid) continue;
    const auto& asset = cached(kAssets + "/" + row.path);
    const bool is_known = reasons.contains(std::filesystem::path(row.path).filename().string());
    EXPECT_EQ(asset.ok(), !is_known) << row.path << (asset.ok() ? "" : ": " + to_line(asset.issue()));
  }
}

// Every pose of every clip, sampled beyond both ends, is finite, so the assets can be used.
TEST(SharedAssets, EveryClipGivesFinitePoses) {
  SKIP_WITHOUT_ASSETS();
  for (const std::string& path : all_gltf_files()) {
    const auto& asset = cached(path);
    if (!asset.ok()) continue;
    for (const AssetClip& clip : asset->clips)
      for (int i = -1; i <= 5; ++i)
        for (const Trs& trs : pose(*asset, clip, clip.first_s + i * 0.25 * (clip.last_s - clip.first_s))) {
          const double sum = glm::dot(trs.translation, trs.translation) + glm::dot(trs.scale, trs.scale);
          ASSERT_TRUE(std::isfinite(sum) && std::fabs(glm::length(trs.rotation) - 1.0) < 1e-9) << path;
        }
  }
}

}  // namespace
}  // namespace contort
