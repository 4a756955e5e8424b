// The list of targets, and the sources of their seeds: the project's own examples and stock, and small files that the
// tests make.
#include "tests/libfuzzer/targets.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "checks/joint_map.h"
#include "corpus/case.h"
#include "model/character/library.h"
#include "tests/corpus/temp_folder.h"
#include "tests/gltf/glb_builder.h"
#include "tests/mocap/asf_text.h"
#include "tests/mocap/bvh_text.h"

namespace contort::hostile {

namespace {

using Texts = std::vector<std::string>;

// All JSON files.
Texts texts_in(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(CONTORT_SOURCE_DIR) + "/" + folder))
    if (entry.is_regular_file() && entry.path().extension() == ".json") paths.push_back(entry.path().string());
  std::ranges::sort(paths);
  Texts out;
  for (const std::string& path : paths) out.push_back(slurp(path));
  return out;
}

Spec with_masses(Spec spec, Mode mode) {
  spec.dynamics.mode = mode;
  spec.dynamics.loads = {{"arm_left", "wrist", Vec3(0.0), Vec3(0.3), 5.0}};
  spec.dynamics.impacts = {{1, "arm_left", "", Vec3(0.0), Vec3(0.0, 0.0, 5.0)}};
  return spec;
}

// The examples; one of them with masses; and a recording.
Texts spec_seeds() {
  Texts out = texts_in("docs/examples");
  Spec reach = *parse_spec(slurp(std::string(CONTORT_SOURCE_DIR) + "/docs/examples/reach_hand.json"));
  for (const Mode mode : {Mode::tracking, Mode::dynamic}) out.push_back(print_spec(with_masses(reach, mode)));
  reach.sequences.clear();
  reach.recording = {"small", "", 0.0, {{"Hips", "root"}}};
  out.push_back(print_spec(reach));
  return out;
}

Texts case_seeds() {
  Texts out;
  for (const std::string& text : texts_in("docs/examples")) {
    Case stored{*parse_spec(text), {}, {}};
    stored.spec.sequences.resize(std::min<std::size_t>(stored.spec.sequences.size(), 1));
    stored.expect = {"joint_range", "arm_left/elbow max", "rad", 1, 2, 3, -0.5, 0.5, "00", "00", "0123456789abcdef"};
    out.push_back(print_case(stored));
  }
  return out;
}

// Returns the seeds, renamed to names that are not taken.
Texts description_seeds() {
  Texts out = texts_in("docs/examples/own_actions");
  for (auto [name, part] : stock_library().parts) part.name = "own", out.push_back(print_part(part));
  for (auto [name, object] : stock_library().objects) object.name = "own", out.push_back(print_object(object));
  for (auto [name, character] : stock_library().characters)
    character.name = "own", out.push_back(print_character(character));
  out.push_back(R"({"format": "contort.map/1", "joints": {"LeftForeArm": "arm_left/elbow"}})");
  out.push_back(R"({"format": "contort.settings/1", "limits": [{"check": "joint_range", "subject": "arm_*/elbow max",
    "phase": "at_rest", "use": "ignore", "tolerance": 0.1, "reason": "r"}], "waivers": [{"check": "pop", "subject": "*",
    "deepest": 0.5, "reason": "r", "owner": "o", "expires": "2030-01-31"}]})");
  return out;
}

std::string text_of(const fixtures::ByteList& bytes) {
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// A channel of each interpolation; the text has its buffer from the target.
Texts gltf_seeds() {
  fixtures::GlbBuilder arm = fixtures::small_arm();
  Texts out = {text_of(arm.glb())};
  fixtures::GlbBuilder text = arm;
  text.root["buffers"] = {{{"byteLength", 512}}};
  text.root["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 128}},
                              {{"buffer", 0}, {"byteOffset", 128}, {"byteLength", 384}}};
  for (fixtures::Json& accessor : text.root["accessors"]) accessor["bufferView"] = accessor["type"] == "SCALAR" ? 0 : 1;
  out.push_back(text.document().dump());
  const int times = arm.add_scalars({0.0F, 0.5F});
  const int spline = arm.add_vec4({0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0});
  arm.add_channel(1, 1, "rotation", times, spline, "CUBICSPLINE");
  out.push_back(text_of(arm.glb()));
  return out;
}

Texts bvh_seeds() { return {small_bvh(), replaced(small_bvh(), "0.25", "0.01")}; }
Texts asf_amc_seeds() { return {small_asf() + small_amc()}; }

Texts joint_table_seeds() {
  return {"t,a,b,note\n0,0.1,0.3,x\n0.5,0.2,0.5,y\n0.7,0.3,0.7,\n", "# a log\n\"time [ms]\";a [deg];b\n0,5;10;0\n1,5;20;0\n",
          "%time,field.header.stamp,field.name0,field.position0\n5,7,a,0.1\n6,9,a,0.2\n"};
}

Texts generator_seeds() {
  const std::string joints = R"([{"name":"hips","position":[0,1,0]},{"name":"knee","parent":"hips","slot":"leg",)"
                             R"("type":"hinge","axis":[1,0,0],"low_deg":-10,"high_deg":120}])";
  const std::string manifest =
      R"({"contort":1,"name":"g","convention":{"up":"+z","forward":"-y","handed":"left"},)"
      R"("characters":[{"name":"hero","joints":)" +
      joints +
      R"(,"parts":{"leg":["a","b"]}}],"actions":[{"name":"kick","slots":["leg"],"effect":"cut",)"
      R"("params":{"far":{"low":-1,"high":2,"special":[0.5]},"to":{"type":"vec3"}}}]})";
  constexpr double kFrame[] = {0, 1, 0, 0, 0, 0, 1, 0.6, 0, 0, 0.8};
  return {manifest, manifest + "\n#!\n" + std::string(reinterpret_cast<const char*>(kFrame), sizeof kFrame)};
}

// Two postures of an arm of seven coordinates: a ball and three hinges.
Texts aim_table_seeds() {
  constexpr double kPostures[] = {1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0.5, 0, 0};
  return {std::string(reinterpret_cast<const char*>(kPostures), sizeof kPostures)};
}

// One robot in each format.
Texts robot_seeds() {
  const std::string link = R"(<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>)"
                           R"(</inertial><collision><origin xyz="0 0 1" rpy="0 1 0"/><geometry><cylinder radius="0.1" )"
                           R"(length="1"/></geometry></collision></link>)";
  const std::string urdf = R"(<robot name="r"><link name="a">)" + link + R"(<link name="b">)" + link +
                           R"(<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/>)"
                           R"(<limit lower="1" upper="2" velocity="3" effort="4"/><mimic joint="j"/></joint></robot>)";
  const std::string srdf = R"(#!<robot name="r"><disable_collisions link1="a" link2="b" reason="Never"/></robot>)";
  const std::string mjcf =
      R"(<mujoco><compiler angle="radian" eulerseq="XYZ"/><default><joint range="-1 1"/><default class="c"><geom )"
      R"(type="capsule" size="0.1"/></default></default><worldbody><body name="a" childclass="c"><freejoint/><geom )"
      R"(fromto="0 0 0 0 0 1"/><body name="b" pos="0 0 1" euler="1 0 0"><joint name="j"/><joint name="k" type="ball"/>)"
      R"(<geom type="box" size="1 2 3" contype="2"/></body></body></worldbody><contact><exclude body1="a" body2="b"/>)"
      R"(</contact><actuator><motor joint="j" ctrlrange="-1 1"/></actuator></mujoco>)";
  return {urdf, urdf + srdf, mjcf};
}

constexpr Target kTargets[] = {
    {"spec", try_spec, spec_seeds},
    {"case", try_case, case_seeds},
    {"description", try_description, description_seeds},
    {"gltf", try_gltf, gltf_seeds},
    {"bvh", try_bvh, bvh_seeds},
    {"asf_amc", try_asf_amc, asf_amc_seeds},
    {"joint_table", try_joint_table, joint_table_seeds},
    {"generator", try_generator, generator_seeds},
    {"aim_table", try_aim_table, aim_table_seeds},
    {"robot", try_robot, robot_seeds},
};

}  // namespace

std::span<const Target> all_targets() { return kTargets; }

void require(bool is_so, const char* promise) {
  if (is_so) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace contort::hostile
