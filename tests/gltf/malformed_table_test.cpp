// The malformed files of shared/assets, each in a process of its own, compared with the results of Khronos' glTF
// validator. Prints a table. Each difference has its reason in validator_differences.tsv. Skipped if the files are
// missing.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/cli/program.h"

namespace contort {
namespace {

const std::string kTableFolder = std::string(CONTORT_SOURCE_DIR) + "/../shared/assets";
constexpr double kMostSeconds = 1.0;  // of CPU time, because the machine may be busy
constexpr double kMost_MB = 512.0;

// The validator's report: the worst severity, and the codes of its errors.
struct Expected {
  std::string severity = "none";
  std::set<std::string> errors;
};

Expected of_report(const std::string& path) {
  constexpr const char* kSeverities[] = {"error", "warning", "info", "hint"};
  Expected out;
  int worst = 4;
  const nlohmann::json report = nlohmann::json::parse(slurp(path));
  for (const auto& message : report["issues"]["messages"]) {
    const int severity = message["severity"];
    worst = std::min(worst, severity);
    if (severity == 0) out.errors.insert(message["code"].get<std::string>());
  }
  if (worst < 4) out.severity = kSeverities[worst];
  return out;
}

// "validator: 2 err 1 warn [E:UNDEFINED_PROPERTY, E:TYPE_MISMATCH x3, W:…]", of files without a report.
Expected of_facts(const std::string& facts) {
  Expected out;
  for (std::size_t at = facts.find("E:"); at != std::string::npos; at = facts.find("E:", at + 2))
    out.errors.insert(facts.substr(at + 2, facts.find_first_of(" ,]", at) - at - 2));
  out.severity = out.errors.empty() ? "no error" : "error";
  return out;
}

// Returns the expectations by path below shared/assets/gltf.
std::map<std::string, Expected> malformed_files() {
  std::map<std::string, Expected> out;
  std::ifstream manifest(kTableFolder + "/MANIFEST.tsv");
  for (std::string line; std::getline(manifest, line);) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, '\t');) fields.push_back(field);
    if (fields.size() < 11 || fields[1] != "gltf-malformed" || fields[2] != "main") continue;
    const std::string report = kTableFolder + "/" + fields[0] + ".report.json";
    out[fields[0].substr(5)] = std::filesystem::exists(report) ? of_report(report) : of_facts(fields[10]);
  }
  return out;
}

std::map<std::string, std::string> known_reasons() {
  std::map<std::string, std::string> out;
  std::ifstream file(std::string(CONTORT_SOURCE_DIR) + "/tests/gltf/validator_differences.tsv");
  for (std::string line; std::getline(file, line);)
    if (const std::size_t tab = line.find('\t'); tab != std::string::npos)
      out[line.substr(0, tab)] = line.substr(tab + 1);
  return out;
}

// The code of a finding about a part of the file that cannot be read; or "".
std::string refused_part(const std::string& out) {
  for (const std::string& line : lines_of(out)) {
    if (line.starts_with("  quaternion_length  ")) return "gltf.not_unit";
    const std::size_t start = line.find("  gltf.");
    if (line.starts_with("  unreadable_channel  ") && start != std::string::npos)
      return line.substr(start + 2, line.find(' ', start + 2) - start - 2);
  }
  return "";
}

// "accepted", or the code of the refusal, of the file or of a channel. A file without a clip, or without two keys, was
// read, though it has nothing to check.
std::string answer(const Ran& ran) {
  if (const std::string part = refused_part(ran.out); ran.code == 1 && !part.empty()) return part;
  if (ran.code == 0 || ran.code == 1) return "accepted";
  const std::string first = lines_of(ran.err).empty() ? "" : lines_of(ran.err).front();
  const std::size_t start = first.find("gltf.");
  for (const char* code : {"check.no_clip", "check.nothing_judged"})
    if (ran.code == 2 && first.find(code) != std::string::npos) return "accepted";
  if (ran.code != 2 || start == std::string::npos) return "exit code " + std::to_string(ran.code) + " " + ran.err;
  return first.substr(start, first.find_first_of(" :", start) - start);
}

// The rows in the table of reasons that a difference needs: each error of an accepted file; the refused file.
std::vector<std::string> differences(const std::string& file, const Expected& expected, const std::string& ours) {
  if (ours == "accepted") return {expected.errors.begin(), expected.errors.end()};
  if (expected.severity == "error") return {};
  const std::filesystem::path path(file);
  return {path.parent_path().filename().string() + "/" + path.filename().string()};
}

TEST(MalformedAssets, EachGetsACleanAnswerWithinItsLimitsAndDifferencesAreExplained) {
  if (!std::filesystem::exists(kTableFolder + "/MANIFEST.tsv")) GTEST_SKIP() << "no folder " << kTableFolder;
  const std::map<std::string, std::string> reasons = known_reasons();
  std::set<std::string> used;
  const auto files = malformed_files();
  EXPECT_EQ(files.size(), 138U);
  std::printf("%-110s %-10s %-18s %6s %5s  %s\n", "file", "validator", "contort", "ms", "MB", "why they differ");
  for (const auto& [file, expected] : files) {
    const Ran ran = contort_program({"check", kTableFolder + "/gltf/" + file});
    const std::string ours = answer(ran);
    EXPECT_TRUE(ours == "accepted" || ours.starts_with("gltf.")) << file << ": " << ours;
    EXPECT_EQ(ran.err.find("ERROR: "), std::string::npos) << ran.err;  // a sanitizer's
    EXPECT_LE(ran.cpu_s, kMostSeconds) << file;
    EXPECT_LE(ran.peak_MB, kMost_MB) << file;
    std::string why;
    for (const std::string& difference : differences(file, expected, ours)) {
      const auto reason = reasons.find(difference);
      EXPECT_NE(reason, reasons.end()) << file << ": no reason is known for " << difference;
      used.insert(difference);
      why += (why.empty() ? "" : " · ") + difference + ": " + (reason == reasons.end() ? "?" : reason->second);
    }
    std::printf("%-110s %-10s %-18s %6.0f %5.0f  %s\n", file.c_str(), expected.severity.c_str(), ours.c_str(),
                1000.0 * ran.cpu_s, ran.peak_MB, why.c_str());
  }
  EXPECT_EQ(used.size(), reasons.size()) << "a reason that nothing needs any more";
}

}  // namespace
}  // namespace contort
