#include "import/names.h"

#include <algorithm>
#include <array>

namespace contort {

namespace {

constexpr std::size_t kMaxNameBytes = 32;  // of 64: the figure's name and numbers are added

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
char to_lower(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr std::array<std::string_view, 3> kLeft = {"l", "left", "lft"};
constexpr std::array<std::string_view, 4> kRight = {"r", "right", "rgt", "rt"};
// Words that do not help to recognise a joint.
constexpr std::array<std::string_view, 13> kNoise = {"mixamorig", "skeleton", "joint", "jnt", "bone", "def",      "org",
                                                     "bip",       "armature", "rig",   "b",   "j",    "character"};

// CMU's skeletons write the side as the first letter of a word: "lfemur".
constexpr std::array<std::string_view, 12> kWordsOfCmu = {"femur", "tibia", "foot",  "toes",     "humerus", "radius",
                                                          "wrist", "hand",  "thumb", "clavicle", "fingers", "hipjoint"};

constexpr std::array<std::string_view, 3> kTurnsOfCmu = {"rx", "ry", "rz"};

// The first matching row counts: "forearm" comes before "arm".
struct FamilyRow {
  std::string_view part;
  BoneFamily family;
};
constexpr FamilyRow kRows[] = {
    {"thumb", BoneFamily::finger},      {"index", BoneFamily::finger},       {"middle", BoneFamily::finger},
    {"pinky", BoneFamily::finger},      {"little", BoneFamily::finger},      {"finger", BoneFamily::finger},
    {"palm", BoneFamily::finger},       {"tail", BoneFamily::tail},          {"forearm", BoneFamily::forearm},
    {"lowerarm", BoneFamily::forearm},  {"lowarm", BoneFamily::forearm},     {"elbow", BoneFamily::forearm},
    {"humerus", BoneFamily::upper_arm}, {"radius", BoneFamily::forearm},     {"ulna", BoneFamily::forearm},
    {"legpelvis", BoneFamily::unknown}, {"legupper", BoneFamily::thigh},     {"leglower", BoneFamily::shank},
    {"hipjoint", BoneFamily::unknown},  {"tibia", BoneFamily::shank},        {"armupper", BoneFamily::upper_arm},
    {"armlower", BoneFamily::forearm},  {"upperarm", BoneFamily::upper_arm}, {"uparm", BoneFamily::upper_arm},
    {"clavicle", BoneFamily::clavicle}, {"collar", BoneFamily::clavicle},    {"shoulder", BoneFamily::clavicle},
    {"hand", BoneFamily::hand},         {"wrist", BoneFamily::hand},         {"arm", BoneFamily::arm},
    {"thigh", BoneFamily::thigh},       {"upperleg", BoneFamily::thigh},     {"upleg", BoneFamily::thigh},
    {"femur", BoneFamily::thigh},       {"calf", BoneFamily::shank},         {"shin", BoneFamily::shank},
    {"shank", BoneFamily::shank},       {"lowerleg", BoneFamily::shank},     {"lowleg", BoneFamily::shank},
    {"knee", BoneFamily::shank},        {"foot", BoneFamily::foot},          {"ankle", BoneFamily::foot},
    {"paw", BoneFamily::foot},          {"hoof", BoneFamily::foot},          {"toe", BoneFamily::toe},
    {"leg", BoneFamily::leg},           {"neck", BoneFamily::neck},          {"head", BoneFamily::head},
    {"skull", BoneFamily::head},        {"pelvis", BoneFamily::hips},        {"hip", BoneFamily::hips},
    {"spine", BoneFamily::spine},       {"chest", BoneFamily::spine},        {"torso", BoneFamily::spine},
    {"abdomen", BoneFamily::spine},     {"waist", BoneFamily::spine},        {"thorax", BoneFamily::spine},
    {"trunk", BoneFamily::spine},       {"belly", BoneFamily::spine},        {"body", BoneFamily::spine},
};

BoneFamily family_of(std::string_view squashed, Side side) {
  if (squashed == "ring") return BoneFamily::finger;  // whole words only, because of "spring" and "football"
  if (squashed == "ball") return BoneFamily::toe;
  if (squashed == "back") return BoneFamily::spine;
  for (const FamilyRow& row : kRows) {
    if (!contains(squashed, row.part)) continue;
    if (row.family == BoneFamily::hips && side != Side::center) return BoneFamily::thigh;      // "hip.l"
    if (row.family == BoneFamily::clavicle && side == Side::center) return BoneFamily::spine;  // "shoulders"
    return row.family;
  }
  return BoneFamily::unknown;
}

}  // namespace

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  std::string word;
  const auto finish = [&] {
    if (!word.empty()) words.push_back(word);
    word.clear();
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_upper(c) && !is_lower(c)) {
      finish();
      continue;
    }
    const bool begins =
        is_upper(c) && i > 0 && (is_lower(name[i - 1]) || (i + 1 < name.size() && is_lower(name[i + 1])));
    if (begins) finish();
    word += to_lower(c);
  }
  finish();
  return words;
}

namespace {

// Splits CMU's names: "lfemur", and the degree of freedom "lfemur_rz", give "l" and "femur".
std::vector<std::string> split_cmu(std::vector<std::string> words) {
  if (words.size() == 2 && is_one_of(words[1], kTurnsOfCmu)) words.pop_back();
  if (words.size() != 1 || words[0].size() < 2) return words;
  const std::string side = words[0].substr(0, 1), rest = words[0].substr(1);
  if ((side == "l" || side == "r") && is_one_of(rest, kWordsOfCmu)) return {side, rest};
  return words;
}

}  // namespace

NameSense sense_of(std::string_view name) {
  NameSense out;
  std::string squashed;
  for (const std::string& word : split_cmu(words_of(name))) {
    if (is_one_of(word, kLeft))
      out.side = Side::left;
    else if (is_one_of(word, kRight))
      out.side = Side::right;
    else if (!is_one_of(word, kNoise))
      squashed += word;
  }
  out.family = family_of(squashed, out.side);
  return out;
}

NameSense sense_of_vrm(std::string_view bone) {
  NameSense out = sense_of(bone);
  const bool is_proximal = contains(bone, "Metacarpal") || contains(bone, "Proximal");
  const bool is_distal = contains(bone, "Intermediate") || contains(bone, "Distal");
  if (is_proximal || is_distal) out.family = BoneFamily::finger;
  return out;
}

std::string legal_name(std::string_view any, std::string_view fallback) {
  std::string out;
  for (const char c : any) {
    const bool keeps = is_upper(c) || is_lower(c) || is_digit(c);
    if (keeps)
      out += to_lower(c);
    else if (!out.empty() && out.back() != '_')
      out += '_';
    if (out.size() == kMaxNameBytes) break;
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? std::string(fallback) : out;
}

std::string claim_name(const std::string& name, std::set<std::string>& taken) {
  std::string claimed = name;
  for (int n = 2; !taken.insert(claimed).second; ++n) claimed = name + "_" + std::to_string(n);
  return claimed;
}

}  // namespace contort
