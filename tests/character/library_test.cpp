// Descriptions as files: the stock ones, and those in a user's folder.
#include "model/character/library.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "model/character/part_rules.h"
#include "model/character/stock_files.h"
#include "model/core/files.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

TEST(Library, StockFilesAreAllThere) {
  const Library& stock = stock_library();
  EXPECT_EQ(stock.parts.size() + stock.objects.size() + stock.characters.size(), stock_files().size());
  EXPECT_TRUE(stock.characters.contains("human"));
  EXPECT_TRUE(stock.characters.contains("mech"));
  EXPECT_TRUE(stock.objects.contains("rifle"));
  EXPECT_TRUE(stock.objects.contains("backpack"));
}

TEST(Library, StockFilesAreNamedAfterWhatTheyHold) {
  for (const StockFile& file : stock_files()) {
    const std::string name(file.name.substr(0, file.name.rfind('.')));
    const Library& stock = stock_library();
    EXPECT_TRUE(stock.parts.contains(name) || stock.objects.contains(name) || stock.characters.contains(name)) << name;
  }
}

TEST(Library, PrintedDescriptionsReadBackTheSame) {
  for (const auto& [name, part] : stock_library().parts) {
    const Result<PartDesc> back = parse_part(print_part(part));
    ASSERT_TRUE(back.ok()) << name << to_line(back.issue());
    EXPECT_EQ(*back, part) << name;
    EXPECT_EQ(print_part(*back), print_part(part)) << name;
  }
  for (const auto& [name, object] : stock_library().objects) {
    const Result<ObjectDesc> back = parse_object(print_object(object));
    ASSERT_TRUE(back.ok()) << name << to_line(back.issue());
    EXPECT_EQ(*back, object) << name;
  }
  for (const auto& [name, character] : stock_library().characters) {
    const Result<CharacterDesc> back = parse_character(print_character(character));
    ASSERT_TRUE(back.ok()) << name << to_line(back.issue());
    EXPECT_EQ(*back, character) << name;
  }
}

TEST(Library, EveryStockPartStandsInSomeSlotOfItsKind) {
  for (const auto& [name, part] : stock_library().parts) {
    bool used = false;
    for (const auto& [character_name, character] : stock_library().characters)
      for (const SlotDesc& slot : character.slots)
        used |= slot.kind == part.kind && std::count(slot.parts.begin(), slot.parts.end(), name) == 1;
    EXPECT_TRUE(used) << name;
  }
}

TEST(Library, RestIsWithinTheLimitsOfEveryJoint) {
  for (const auto& [name, part] : stock_library().parts)
    for (const JointDesc& joint : part.joints) {
      EXPECT_LE(joint.low_deg, 0.0) << name << "/" << joint.name;
      EXPECT_GE(joint.high_deg, 0.0) << name << "/" << joint.name;
      if (joint.type != JointType::ball) continue;
      const Quat center = from_rotation_vector(joint.swing_center_deg * kRadPerDeg);
      const Vec3 at_rest = glm::conjugate(center) * joint.axis;  // the axis of rest, seen from the limit frame
      const Vec3 swing = to_rotation_vector(shortest_arc(joint.axis, at_rest)) * kDegPerRad;
      const double a = glm::dot(swing, joint.swing_axis) / joint.swing_deg[0];
      const double b = glm::dot(swing, glm::cross(joint.axis, joint.swing_axis)) / joint.swing_deg[1];
      EXPECT_LT(a * a + b * b, 1.0) << name << "/" << joint.name;
    }
}

class Folder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "contort_library_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  void put(const std::string& name, const std::string& text) {
    ASSERT_TRUE(write_file((folder_ / name).string(), text).ok());
  }
  Issue refusal() {
    Library library;
    const Result<Done> done = load_folder(folder_.string(), library);
    return done ? Issue{} : done.issue();
  }
  fs::path folder_;
};

TEST_F(Folder, DescriptionsAreToldApartByTheirFormat) {
  put("a.json", R"({"format": "contort.part/1", "name": "x", "kind": "arm"})");
  put("b.json", R"({"format": "contort.object/1", "name": "x"})");
  put("c.json", R"({"format": "contort.character/1", "name": "x", "slots": []})");
  put("notes.txt", "not read");
  Library library;
  const Result<Done> done = load_folder(folder_.string(), library);
  ASSERT_TRUE(done.ok()) << to_line(done.issue());
  EXPECT_EQ(library.parts.size() + library.objects.size() + library.characters.size(), 3U);
}

// The rules that one file must satisfy by itself; the rest needs parts (tests/generator/own_actions_test.cpp).
TEST_F(Folder, ActionsAreCheckedOnTheWayIn) {
  const std::pair<const char*, const char*> expected[] = {
      {R"("keys": [{"at": 1, "pose": {"elbow_deg": 1}}])", "action.no_part"},
      {R"("kinds": ["arm"], "parts": ["x"], "of": "pose")", "action.no_part"},
      {R"("kinds": ["arm"])", "action.no_rule"},
      {R"("kinds": ["arm"], "of": "pose", "keys": [{"at": 1, "pose": {"elbow_deg": 1}}])", "action.two_rules"},
      {R"("kinds": ["arm"], "params": {"x": 1}, "keys": [{"at": 1, "pose": {"elbow_deg": 1}}])", "action.bad_params"},
      {R"("kinds": ["arm"], "keys": [{"at": 0, "pose": {"elbow_deg": 1}}])", "action.bad_key"},
      {R"("kinds": ["arm"], "keys": [{"at": 0.5, "pose": {"a": 1}}, {"at": 0.5, "pose": {"a": 1}}])", "action.bad_key"},
      {R"("kinds": ["arm"], "keys": [{"at": 1, "pose": {}}])", "action.bad_key"},
  };
  for (const auto& [rest, code] : expected) {
    put("a.json", std::string(R"({"format": "contort.action/1", "name": "x", )") + rest + "}");
    EXPECT_EQ(refusal().code, code) << rest;
  }
}

TEST_F(Folder, ActionsOfOneNameAreForDifferentParts) {
  const auto action = [](const char* scope) {
    return std::string(R"({"format": "contort.action/1", "name": "x", "of": "pose", )") + scope + "}";
  };
  put("a.json", action(R"("parts": ["p", "q"])"));
  put("b.json", action(R"("kinds": ["arm"])"));
  EXPECT_EQ(refusal().code, "");
  put("c.json", action(R"("parts": ["r", "q"])"));
  EXPECT_EQ(refusal().code, "action.duplicate_name");
  EXPECT_NE(refusal().text.find("for q"), std::string::npos);
}

TEST_F(Folder, TroubleNamesTheFile) {
  put("bad.json", R"({"format": "contort.part/1", "name": "x", "kind": "arm", "colour": 1})");
  EXPECT_EQ(refusal().code, "part.unknown_field");
  EXPECT_EQ(refusal().pointer, "/colour");
  EXPECT_NE(refusal().text.find("bad.json"), std::string::npos);
}

TEST_F(Folder, ANameThatIsThereAlreadyIsRefused) {
  put("a.json", R"({"format": "contort.object/1", "name": "x"})");
  put("b.json", R"({"format": "contort.object/1", "name": "x"})");
  EXPECT_EQ(refusal().code, "object.duplicate_name");
}

TEST_F(Folder, RulesAreCheckedOnTheWayIn) {
  put("a.json",
      R"({"format": "contort.part/1", "name": "x", "kind": "arm", "joints": [{"name": "j", "axis": [1, 1, 0]}]})");
  EXPECT_EQ(refusal().code, "part.bad_axis");
}

TEST_F(Folder, AMeshWithWildIndicesIsRefused) {
  put("a.json", R"({"format": "contort.object/1", "name": "x", "mesh": [{"shape":
      {"type": "triangles", "positions_m": [[0, 0, 0]], "indices": [0, 1, 99999]}}]})");
  EXPECT_EQ(refusal().code, "object.bad_shape");
  EXPECT_EQ(refusal().pointer, "/mesh/0/shape/indices");
}

TEST_F(Folder, AnUnknownFormatIsRefused) {
  put("a.json", R"({"format": "contort.robot/1\n"})");
  EXPECT_EQ(refusal().code, "library.wrong_format");
  EXPECT_EQ(refusal().text.find('\n'), std::string::npos);
  put("a.json", "[]");
  EXPECT_EQ(refusal().code, "library.wrong_format");
}

TEST_F(Folder, AMissingFolderIsUnreadable) {
  Library library;
  EXPECT_EQ(load_folder((folder_ / "none").string(), library).issue().code, "library.unreadable");
}

}  // namespace
}  // namespace contort
