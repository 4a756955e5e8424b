// Manifests that name a model file, as a user has them: a program and its model in one folder.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/program.h"
#include "tests/import/rigged_model.h"
#include "tests/robot/robot_text.h"

namespace contort {
namespace {

constexpr char kBvh[] =
    "HIERARCHY\nROOT Hips\n{\nOFFSET 0 1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT Knee\n{\nOFFSET 0 -0.5 0\n"
    "CHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 -0.4 0\n}\n}\n}\nMOTION\nFrames: 0\nFrame Time: 0.03\n";

class ModelOfAProgram : public testing::Test {
 protected:
  // A program that holds its figure at rest: the root's place, and no rotation of any joint.
  std::string program(const std::string& character, const std::string& place, int joints, const std::string& more = "") {
    spill(folder_ / "still.py", R"(import sys
sys.path.insert(0, ")" CONTORT_SOURCE_DIR R"(/tests/guest/broken")
import good
MANIFEST = {"contort": 1, "name": "still", "characters": [{"name": "hero", )" + character + R"(}],
            "actions": [{"name": "wait"}])" + more + R"(}
good.serve(manifest=MANIFEST, pose=lambda uses, time_s: )" + place + " + " + std::to_string(joints) + R"( * [0, 0, 0, 1])
)");
    return "/usr/bin/python3 " + (folder_ / "still.py");
  }
  Ran examine(const std::string& command) { return contort_program({"generator", "check", command, "--limits"}); }
  void expect_good(const std::string& command, const std::string& limits) {
    const Ran ran = examine(command);
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_NE(ran.out.find(limits), std::string::npos) << ran.out << ran.err;
    EXPECT_EQ(ran.out.find("from its rest pose"), std::string::npos) << ran.out;
  }
  std::string refusal(const std::string& character) { return examine(program(character, "[0, 0, 0]", 1)).err; }
  TempFolder folder_;
};

TEST_F(ModelOfAProgram, MayBeASkinnedOne) {
  const fixtures::ByteList bytes = fixtures::rigged(fixtures::person()).glb();
  spill(folder_ / "person.glb", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  const std::string some = R"("model": "person.glb", "joints": [{"name": "Hips"}, {"name": "LeftForeArm"}])";
  expect_good(program(some, "[0, 1, 0]", 2), "LeftForeArm              ");
  EXPECT_NE(examine(program(some, "[0, 1, 0]", 2)).out.find("degrees about its axis"), std::string::npos);
  const Ran all = examine(program(R"("model": "person.glb")", "[0, 1, 0]", 16));
  EXPECT_EQ(all.code, 0) << all.out << all.err;
  EXPECT_NE(all.out.find("character hero: 16 joints"), std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("16 joints, 0 colliders"), std::string::npos) << all.out;
}

TEST_F(ModelOfAProgram, MayBeABvhInCentimetres) {
  spill(folder_ / "walk.bvh", kBvh);
  expect_good(program(R"("model": "walk.bvh")", "[0, 1, 0]", 2, R"(, "convention": {"unit_m": 0.5})"),
              "Knee                     swing 180 degrees");
}

TEST_F(ModelOfAProgram, MayBeARobot) {
  spill(folder_ / "arm.urdf",
        fixtures::two_links("revolute", "<origin xyz=\"0 0 0.4\"/><axis xyz=\"0 1 0\"/><limit lower=\"-0.5\" upper=\"1\" "
                                        "velocity=\"2\" effort=\"1\"/>"));
  expect_good(program(R"("model": "arm.urdf")", "[0, 0, 0]", 2, R"(, "convention": {"up": "+z", "forward": "+x"})"),
              "j                        -28.6479 to 57.2958 degrees about its axis, at most 114.592 degrees/s");
}

TEST_F(ModelOfAProgram, MayBeARobotWhoseJointsFollowOthers) {
  std::string urdf = fixtures::two_links("revolute", R"(<limit lower="1" upper="2"/>)");
  urdf.insert(urdf.rfind("</robot>"), R"(<link name="c"/><joint name="k" type="continuous"><parent link="b"/>
    <child link="c"/><mimic joint="j" multiplier="-2" offset="1"/></joint>)");
  spill(folder_ / "arm.urdf", urdf);
  const std::string convention = R"(, "convention": {"up": "+z", "forward": "+x"})";
  // The leader rests in the middle of its range, at 1.5 rad, where the follower is at -2 rad.
  EXPECT_NE(examine(program(R"("model": "arm.urdf")", "[0, 0, 0]", 3, convention)).out.find(
                "  k follows j: -2 times its angle from rest, plus -115 degrees\n"),
            std::string::npos);
  const std::string without = R"("model": "arm.urdf", "joints": [{"name": "a"}, {"name": "k"}])";
  EXPECT_EQ(examine(program(without, "[0, 0, 0]", 2, convention)).out.find("follows"), std::string::npos);
}

// Balls on the links a, b and c; c hangs on b, and b on a.
std::string three_balls() {
  std::string urdf = R"(<robot name="arm">)";
  for (const char* link : {"a", "b", "c"})
    urdf += std::string("<link name=\"") + link +
            R"("><collision><geometry><sphere radius="0.1"/></geometry></collision></link>)";
  for (const auto& [parent, child] : {std::pair("a", "b"), std::pair("b", "c")})
    urdf += std::string("<joint name=\"to_") + child + R"(" type="continuous"><origin xyz="0 0 0.3"/><parent link=")" +
            parent + R"("/><child link=")" + child + R"("/></joint>)";
  return urdf + "</robot>";
}

constexpr char kDisabledPairs[] = R"(<robot name="arm"><disable_collisions link1="a" link2="b" reason="Adjacent"/>
  <disable_collisions link1="c" link2="a" reason="Never"/></robot>)";

TEST_F(ModelOfAProgram, MayBeARobotWhoseSrdfLiesBesideIt) {
  spill(folder_ / "arm.urdf", three_balls());
  const std::string convention = R"(, "convention": {"up": "+z", "forward": "+x"})";
  const std::string command = program(R"("model": "arm.urdf")", "[0, 0, 0]", 3, convention);
  EXPECT_NE(examine(command).out.find("3 joints, 3 colliders\n"), std::string::npos);
  spill(folder_ / "arm.srdf", kDisabledPairs);
  const Ran with_srdf = examine(command);
  EXPECT_EQ(with_srdf.code, 0) << with_srdf.out << with_srdf.err;
  EXPECT_NE(with_srdf.out.find("3 joints, 3 colliders, of which 2 pairs may touch\n"), std::string::npos) << with_srdf.out;
  spill(folder_ / "second.srdf", R"(<robot name="arm"/>)");
  const std::string several = examine(command).err;
  EXPECT_NE(several.find("srdf.several at /characters/0/model: "), std::string::npos) << several;
  EXPECT_NE(several.find("; copy the model into a folder"), std::string::npos) << several;
}

// MJCF: two shapes collide if the contype of one and the conaffinity of the other have a bit in common.
TEST_F(ModelOfAProgram, MayBeAnMjcfWhoseShapesCollideByGroups) {
  spill(folder_ / "arm.xml", R"(<mujoco><worldbody><body name="a"><joint name="ja"/>
    <geom size="0.1" contype="1" conaffinity="2"/>
    <body name="b" pos="0 0 0.3"><joint name="jb"/><geom size="0.1" contype="1" conaffinity="2"/>
    <body name="c" pos="0 0 0.3"><joint name="jc"/><geom size="0.1" contype="2" conaffinity="1"/></body></body></body>
    </worldbody></mujoco>)");
  const std::string convention = R"(, "convention": {"up": "+z", "forward": "+x"})";
  const Ran ran = examine(program(R"("model": "arm.xml")", "[0, 0, 0]", 3, convention));
  EXPECT_NE(ran.out.find("3 colliders, of which 1 pairs may touch\n"), std::string::npos) << ran.out << ran.err;
}

// 40 shapes on one link and 40 on another: 1,600 pairs.
TEST_F(ModelOfAProgram, KeepsEveryPairThatMayTouch) {
  std::string urdf = R"(<robot name="arm">)";
  for (const char* link : {"a", "b"}) {
    urdf += std::string("<link name=\"") + link + "\">";
    for (int n = 0; n < 40; ++n) urdf += R"(<collision><geometry><sphere radius="0.1"/></geometry></collision>)";
    urdf += "</link>";
  }
  spill(folder_ / "arm.urdf", urdf + R"(<joint name="j" type="continuous"><origin xyz="0 0 1"/><parent link="a"/>
    <child link="b"/></joint></robot>)");
  spill(folder_ / "arm.srdf", R"(<robot name="arm"><disable_collisions link1="a" link2="b" reason="Never"/></robot>)");
  const std::string convention = R"(, "convention": {"up": "+z", "forward": "+x"})";
  const Ran ran = examine(program(R"("model": "arm.urdf")", "[0, 0, 0]", 2, convention));
  EXPECT_NE(ran.out.find("of which 1600 pairs may touch\n"), std::string::npos) << ran.out << ran.err;
}

TEST_F(ModelOfAProgram, IsLookedForWhereTheProgramIs) {
  const std::string missing = refusal(R"("model": "none.glb")");
  EXPECT_NE(missing.find("generator.no_model at /characters/0/model: there is no file \"none.glb\" in "), std::string::npos)
      << missing;
  EXPECT_NE(missing.find(folder_.path()), std::string::npos) << missing;
}

TEST_F(ModelOfAProgram, IsRefusedWhereItIsNone) {
  spill(folder_ / "text.glb", "no model");
  EXPECT_NE(refusal(R"("model": "text.glb")").find("at /characters/0/model"), std::string::npos);
  EXPECT_NE(refusal(R"("model": "/dev/zero")").find("at /characters/0/model"), std::string::npos);
  spill(folder_ / "broken.bvh", std::string(kBvh).substr(0, 60));
  EXPECT_NE(refusal(R"("model": "broken.bvh")").find("bvh."), std::string::npos);
  spill(folder_ / "broken.urdf", "<robot name='x'><link/></robot>");
  EXPECT_NE(refusal(R"("model": "broken.urdf")").find("urdf."), std::string::npos);
  std::filesystem::create_directory(folder_ / "folder.glb");
  EXPECT_NE(refusal(R"("model": "folder.glb")").find("at /characters/0/model"), std::string::npos);
}

}  // namespace
}  // namespace contort
