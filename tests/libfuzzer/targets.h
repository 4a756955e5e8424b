// The untrusted files that a user may get, one target for each format: from bytes as far as the program would process
// them, with bounded work. libFuzzer runs them (docs/internals/hostile_input.md), and hostile_files_test.cpp runs them
// on earlier findings.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contort::hostile {

// Return true if the input was accepted. Forbidden behaviour aborts: a sanitizer's report, an assert, a failed
// require().
bool try_spec(std::string_view bytes);
bool try_case(std::string_view bytes);
bool try_description(std::string_view bytes);  // part, object, character, action, joint map
bool try_gltf(std::string_view bytes);         // a GLB, or the JSON of a .gltf
bool try_bvh(std::string_view bytes);
bool try_asf_amc(std::string_view bytes);    // an ASF, and after a line that begins with "#!" its AMC
bool try_joint_table(std::string_view bytes);  // joint values, as a motion of a character
bool try_generator(std::string_view bytes);  // a manifest, and after a line "#!" frames of its first character
bool try_robot(std::string_view bytes);      // an MJCF, or a URDF and after "#!" its SRDF
bool try_aim_table(std::string_view bytes);  // the postures of a table; header and hash are put around them

struct Target {
  std::string_view name;
  bool (*run)(std::string_view bytes);
  std::vector<std::string> (*seeds)();  // all of them accepted
};
std::span<const Target> all_targets();

// Aborts where `is_so` is false: a promise of a reader that its input broke.
void require(bool is_so, const char* promise);

}  // namespace contort::hostile
