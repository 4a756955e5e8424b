// contort import, as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/import/rigged_model.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

class ImportCommand : public ::testing::Test {
 protected:
  std::string model(const fixtures::GlbBuilder& builder, const std::string& name = "Some One.glb") {
    const fixtures::ByteList bytes = builder.glb();
    const std::string path = folder_ / name;
    spill(path, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    return path;
  }
  std::string library() const { return folder_ / "figures"; }
  TempFolder folder_;
};

// The left elbow turns by 100 degrees in a tenth of a second.
fixtures::GlbBuilder quick_person() {
  fixtures::GlbBuilder b = fixtures::rigged(fixtures::person());
  b.root["animations"] = {{{"name", "quick"}}};
  const Quat q = axis_angle(Vec3(0, 1, 0), -100.0 * kRadPerDeg);
  const auto f = [](double v) { return static_cast<float>(v); };
  b.add_channel(0, 6, "rotation", b.add_scalars({0.0F, 0.1F, 1.0F}),
                b.add_vec4({0, 0, 0, 1, f(q.x), f(q.y), f(q.z), f(q.w), f(q.x), f(q.y), f(q.z), f(q.w)}));
  return b;
}

TEST_F(ImportCommand, MakesALibraryThatFuzzesAtOnce) {
  const Ran import = contort_program({"import", model(fixtures::rigged(fixtures::person())), "-o", library()});
  ASSERT_EQ(import.code, 0) << import.err;
  EXPECT_NE(import.out.find("some_one: humanoid, 1.8 m"), std::string::npos) << import.out;
  EXPECT_TRUE(fs::exists(library() + "/some_one.import.md"));
  const Ran fuzz = contort_program({"fuzz", "--library", library(), "--character", "some_one", "--cases", "5",
                                    "--shrink-evaluations", "0", "--corpus", folder_ / "corpus"});
  EXPECT_LE(fuzz.code, 1) << fuzz.err;
  EXPECT_NE(fuzz.out.find("cases=5"), std::string::npos) << fuzz.out;
}

TEST_F(ImportCommand, IsNotMixedIntoOtherPeoplesFiles) {
  const std::string path = model(fixtures::rigged(fixtures::person()));
  fs::create_directories(folder_ / "sources");
  spill(folder_ / "sources/main.cpp", "int main() {}");
  spill(folder_ / "sources/package.json", "{}");
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--force"}}) {
    std::vector<std::string> call = {"import", path, "-o", folder_ / "sources"};
    call.insert(call.end(), more.begin(), more.end());
    const Ran ran = contort_program(call);
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("folder.other_files"), std::string::npos) << ran.err;
    EXPECT_EQ(tree_of(folder_ / "sources").size(), 2U);
  }
  EXPECT_EQ(contort_program({"import", path, "-o", folder_.path()}).code, 0) << "beside the model itself";
}

TEST_F(ImportCommand, UsesTheSrdfBesideAUrdfUnlessItIsTold) {
  const std::string urdf = folder_ / "arm.urdf";
  spill(urdf, R"(<robot name="arm"><link name="a"/></robot>)");
  spill(folder_ / "arm.srdf", R"(<robot name="arm"/>)");
  const auto imported = [&](const std::vector<std::string>& more) {
    std::vector<std::string> call = {"import", urdf, "-o", library(), "--force", "--json"};
    call.insert(call.end(), more.begin(), more.end());
    const Ran ran = contort_program(call);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return nlohmann::json::parse(ran.out);
  };
  EXPECT_EQ(imported({}).at("srdf"), folder_ / "arm.srdf");
  EXPECT_NE(slurp(library() + "/arm.import.md").find("0 disabled pairs from arm.srdf"), std::string::npos);
  EXPECT_TRUE(imported({"--srdf", "none"}).at("srdf").is_null());
  spill(folder_ / "second.srdf", R"(<robot name="arm"><passive_joint name="j"/></robot>)");
  EXPECT_EQ(imported({"--srdf", folder_ / "second.srdf"}).at("srdf"), folder_ / "second.srdf");
  const Ran several = contort_program({"import", urdf, "-o", library(), "--force"});
  EXPECT_EQ(several.code, 2);
  EXPECT_NE(several.err.find("srdf.several"), std::string::npos) << several.err;
  EXPECT_NE(several.err.find("--srdf FILE chooses one"), std::string::npos) << several.err;
}

TEST_F(ImportCommand, TakesTheModelAlongForPictures) {
  const std::string path = model(fixtures::rigged(fixtures::person()));
  ASSERT_EQ(contort_program({"import", path, "-o", library()}).code, 0);
  EXPECT_EQ(slurp(library() + "/skins/some_one.glb"), slurp(path));
  const std::string spec = folder_ / "spec.json", picture = folder_ / "picture.png";
  spill(spec, R"({"format":"contort.spec/1","character":{"name":"some_one"},"hold_frames":3})");
  const auto draw = [&] {
    const Ran ran = contort_program({"--library", library(), "render", spec, "-o", picture, "--tiles", "1"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return std::pair(slurp(picture), ran.err);
  };
  const auto [worn, no_note] = draw();
  EXPECT_EQ(no_note, "");
  fs::remove(library() + "/skins/some_one.glb");
  const auto [plain, note] = draw();
  EXPECT_NE(plain, worn);
  EXPECT_NE(note.find("skin.no_model"), std::string::npos) << note;
  EXPECT_NE(note.find("some_one is drawn without its skin"), std::string::npos) << note;
}

TEST_F(ImportCommand, LeavesTheModelWhereItIsWhenAsked) {
  ASSERT_EQ(
      contort_program({"import", model(fixtures::rigged(fixtures::person())), "-o", library(), "--no-model"}).code, 0);
  EXPECT_FALSE(fs::exists(library() + "/skins"));
}

TEST_F(ImportCommand, KeepsWhatIsThereUnlessForced) {
  const std::string path = model(fixtures::rigged(fixtures::person()));
  ASSERT_EQ(contort_program({"import", path, "-o", library()}).code, 0);
  const std::string part = library() + "/some_one_arm_left.json";
  const std::string before = slurp(part);
  spill(part, "edited");
  const Ran again = contort_program({"import", path, "-o", library()});
  EXPECT_EQ(again.code, 2);
  EXPECT_EQ(again.err.rfind("contort: import.exists: ", 0), 0U) << again.err;
  EXPECT_EQ(slurp(part), "edited");
  EXPECT_EQ(contort_program({"import", path, "-o", library(), "--force"}).code, 0);
  EXPECT_EQ(slurp(part), before);
}

TEST_F(ImportCommand, WritesNothingThroughALinkThatLeadsOut) {
  const std::string path = model(fixtures::rigged(fixtures::person()));
  fs::create_directories(folder_ / "elsewhere");
  for (const char* own : {"maps", "skins"}) {
    fs::create_directories(library());
    fs::create_directory_symlink(folder_ / "elsewhere", library() + "/" + own);
    spill(library() + "/walk.bvh", "HIERARCHY");
    const Ran ran = contort_program({"import", path, "-o", library(), "--force"});
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_NE(ran.err.find("file.outside"), std::string::npos) << ran.err;
    EXPECT_TRUE(tree_of(folder_ / "elsewhere").empty()) << own;
    fs::remove_all(library());
  }
}

TEST_F(ImportCommand, CheckFindsTheMapBesideTheCharacter) {
  const std::string path = model(quick_person());
  ASSERT_EQ(contort_program({"import", path, "-o", library()}).code, 0);
  const std::vector<std::string> check = {"check", path, "--library", library(), "--character", "some_one"};
  EXPECT_EQ(contort_program(check).code, 0);  // 1000 deg/s of 3000
  const std::string part = library() + "/some_one_arm_left.json";
  auto edited = nlohmann::json::parse(slurp(part));
  edited["joints"][1]["max_speed_deg_s"] = 900;
  spill(part, edited.dump());
  const Ran slower = contort_program(check);
  EXPECT_EQ(slower.code, 1) << slower.err;
  EXPECT_NE(slower.out.find("LeftForeArm"), std::string::npos) << slower.out;
}

TEST_F(ImportCommand, PrintsJson) {
  const Ran ran = contort_program({"import", model(quick_person()), "-o", library(), "--json", "--name", "q"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto out = nlohmann::json::parse(ran.out);
  EXPECT_EQ(out["character"], "q");
  EXPECT_EQ(out["build"], "humanoid");
  EXPECT_EQ(out["joints"], 16);
  EXPECT_EQ(out["limits"]["table"].get<int>() + out["limits"]["clips"].get<int>() + out["limits"]["generic"].get<int>(),
            15);
}

TEST_F(ImportCommand, RefusesByCodeAndWritesNothing) {
  const auto refused = [&](std::vector<std::string> arguments, const std::string& code) {
    arguments.insert(arguments.begin(), "import");
    for (const std::string& more : {std::string("-o"), library()}) arguments.push_back(more);
    const Ran ran = contort_program(arguments);
    EXPECT_EQ(ran.code, 2) << code;
    EXPECT_EQ(ran.err.rfind("contort: " + code, 0), 0U) << ran.err;
    EXPECT_FALSE(fs::exists(library())) << code;
  };
  const std::string person = model(fixtures::rigged(fixtures::person()));
  refused({folder_ / "none.glb"}, "gltf.unreadable");
  refused({person, "--name", "human"}, "import.bad_name");
  refused({person, "--skin", "4"}, "import.unknown_skin");
  refused({model(fixtures::small_arm(), "arm.glb")}, "import.no_vertices");
  refused({person, "--scale", "nan"}, "usage");
  refused({person, "--scale", "1", "--height-m", "2"}, "usage");
}

}  // namespace
}  // namespace contort
