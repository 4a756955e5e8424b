#include "tests/scenes.h"

#include <stdexcept>

namespace contort {

namespace {

constexpr NamedScene kScenes[] = {
    {"human_reaches", R"({"format":"contort.spec/1","character":{"name":"human"},"sequences":[{"clips":[{"actions":[
      {"action":"reach","slot":"arm_left","duration_frames":45,"params":{"target_m":[0.35,1.3,0.4],"swivel_deg":20}},
      {"action":"reach","slot":"arm_right","start_frame":10,"duration_frames":40,"params":{"target_m":[0.1,1.0,0.3]}},
      {"action":"direction","slot":"head","duration_frames":50,"params":{"azimuth_deg":60,"elevation_deg":-20}},
      {"action":"reach","slot":"leg_left","duration_frames":50,"params":{"target_m":[0.15,0.4,0.3]}}]}]}]})"},
    {"human_overlaps", R"({"format":"contort.spec/1","character":{"name":"human","attachments":[
      {"object":"backpack","slot":"torso","socket":"back"}]},"hold_frames":5,"sequences":[{"clips":[{"speed":1.25,"actions":[
      {"action":"pose","slot":"arm_left","duration_frames":60,"params":{"shoulder_deg":[-100,0,20],"elbow_deg":90}},
      {"action":"pose","slot":"arm_left","start_frame":30,"duration_frames":20,"params":{"shoulder_deg":[0,0,60]}},
      {"action":"reach","slot":"arm_left","start_frame":40,"duration_frames":30,"params":{"target_m":[0.0,1.2,0.35]}},
      {"action":"pose","slot":"torso","duration_frames":80,"params":{"lumbar_flex_deg":40,"lumbar_rot_deg":-30}}]}]},
      {"duration_frames":70,"clips":[{"duration_frames":35,"actions":[
      {"action":"pose","slot":"leg_right","duration_frames":25,"params":{"hip_flex_deg":80,"knee_deg":100}}]}]}]})"},
    {"mech_rifle", R"({"format":"contort.spec/1","character":{"name":"mech","attachments":[
      {"object":"rifle","slot":"arm_right","socket":"grip"}]},"sequences":[{"clips":[{"actions":[
      {"action":"pose","slot":"arm_left","duration_frames":40,"params":{"shoulder_deg":[-60,20,10],"elbow_deg":60}},
      {"action":"reach","slot":"arm_right","start_frame":10,"duration_frames":60,"params":{"target_m":[0.4,1.2,0.5]}},
      {"action":"direction","slot":"torso","duration_frames":70,"params":{"azimuth_deg":-50}},
      {"action":"direction","slot":"head","duration_frames":80,"params":{"azimuth_deg":170}},
      {"action":"reach","slot":"leg_left","duration_frames":80,"params":{"target_m":[0.3,0.6,0.5]}}]}]}]})"},
    {"mech_swapped", R"({"format":"contort.spec/1","character":{"name":"mech","parts":{"torso":"mech_torso_heavy",
      "arm_left":"mech_arm_shield","arm_right":"mech_arm_extend","leg_left":"mech_leg_reverse",
      "leg_right":"mech_leg_reverse","head":"mech_head_turret","back":"mech_pack_large"}},"rate_hz":30,
      "sequences":[{"clips":[{"actions":[
      {"action":"reach","slot":"arm_left","duration_frames":30,"params":{"target_m":[0.2,1.0,0.6]}},
      {"action":"pose","slot":"arm_right","duration_frames":30,"params":{"extend_m":0.3,"elbow_deg":80}},
      {"action":"reach","slot":"leg_right","duration_frames":40,"params":{"target_m":[-0.3,0.5,0.4],"swivel_deg":-15}}]},
      {"start_frame":40,"actions":[
      {"action":"direction","slot":"head","duration_frames":40,"speed":2,"params":{"azimuth_deg":-120}}]}]}]})"},
    {"mech_walk_aim", R"({"format":"contort.spec/1","character":{"name":"mech","attachments":[
      {"object":"rifle","slot":"arm_right","socket":"grip"}]},"sequences":[{"clips":[{"actions":[
      {"action":"walk","slot":"waist","duration_frames":240,"params":{"speed_m_s":1.1,"heading_deg":15}},
      {"action":"aim","slot":"arm_right","duration_frames":240,"blend_in_frames":20,"params":{"target_m":[-1,1.5,6]}},
      {"action":"recoil","slot":"arm_right","start_frame":60,"duration_frames":90}]}]}]})"},
    {"human_interrupted", R"({"format":"contort.spec/1","character":{"name":"human","attachments":[
      {"object":"rifle","slot":"hand_right","socket":"grip"}]},"environment":{"heading_deg":20,
      "ground":{"type":"steps","start_m":0.6,"depth_m":0.4,"height_m":0.12,"count":4},
      "obstacles":[{"name":"wall","shape":{"type":"box","center_m":[0.6,1,1],"half_m":[0.1,1,3]}}]},
      "start":{"position_m":[0.2,0,0.1],"heading_deg":20},"sequences":[{"clips":[{"name":"climb","actions":[
      {"action":"walk","slot":"waist","duration_frames":150,"params":{"speed_m_s":0.8,"lead":"right"}},
      {"action":"look_at","slot":"head","duration_frames":150,"blend_in_frames":12,"params":{"target_m":[1,1,4]}},
      {"action":"weapon_hold","slot":"arm_left","start_frame":20,"duration_frames":80,"blend_in_frames":15,"blend_out_frames":9}]}]}],
      "interrupts":[{"when":{"event":"contact","slot":"foot_left"},"enter":"after_clip","sequence":{"clips":[{"actions":[
      {"action":"squat","slot":"waist","duration_frames":50,"params":{"share":0.25}},
      {"action":"hit_reaction","slot":"torso","start_frame":5,"duration_frames":30,"params":{"azimuth_deg":70}}]}]}},
      {"when":{"event":"impact"},"sequence":{"clips":[{"actions":[
      {"action":"touch","slot":"arm_left","duration_frames":40,"blend_in_frames":10,"params":{"within_m":2}}]}]}}]})"},
    {"quadruped_slope", R"({"format":"contort.spec/1","character":{"name":"quadruped","parts":{"tail":"quad_tail_bushy"},
      "attachments":[{"object":"backpack","slot":"trunk","socket":"back"}]},
      "environment":{"ground":{"type":"slope","slope_deg":12}},"sequences":[{"clips":[{"actions":[
      {"action":"walk","slot":"hips","duration_frames":200,"params":{"speed_m_s":0.8}},
      {"action":"look_at","slot":"head","duration_frames":200,"blend_in_frames":15,"params":{"target_m":[2,0.5,4]}},
      {"action":"aim","slot":"tail","duration_frames":120,"blend_in_frames":15,"params":{"target_m":[0,4,-4]}},
      {"action":"hit_reaction","slot":"trunk","start_frame":90,"duration_frames":40,"params":{"azimuth_deg":90}}]}]}]})"},
    {"human_tracking", R"({"format":"contort.spec/1","character":{"name":"human"},"hold_frames":20,"sequences":[{"clips":[{"actions":[
      {"action":"walk","slot":"waist","duration_frames":120,"params":{"speed_m_s":0.7}},
      {"action":"pose","slot":"arm_right","duration_frames":40,"params":{"shoulder_deg":[-60,0,20],"elbow_deg":70}}]}]}],
      "dynamics":{"mode":"tracking","impacts":[{"frame":30,"slot":"head","impulse_N_s":[2,0,-3]}]}})"},
    {"human_dynamic", R"({"format":"contort.spec/1","character":{"name":"human"},"rate_hz":30,"start":{"ahead_m":0.04,
      "lower_m":0.005},"hold_frames":30,"sequences":[{"clips":[{"actions":[
      {"action":"squat","slot":"waist","duration_frames":40,"params":{"share":0.3,"lean_deg":40,"back_m":0.21}}]}]}],
      "dynamics":{"mode":"dynamic","loads":[{"slot":"torso","socket":"back","mass_kg":8}],
      "impacts":[{"frame":10,"slot":"arm_left","impulse_N_s":[1,0,-3]}]}})"},
    {"mech_falls", R"({"format":"contort.spec/1","character":{"name":"mech"},"environment":{"ground":{"type":"slope","slope_deg":6}},
      "hold_frames":120,"dynamics":{"mode":"dynamic","impacts":[{"frame":5,"slot":"torso","impulse_N_s":[900,100,1500]}]}})"},
    {"quadruped_dynamic", R"({"format":"contort.spec/1","character":{"name":"quadruped"},"hold_frames":60,"sequences":[{"clips":[
      {"actions":[{"action":"walk","slot":"hips","duration_frames":120,"params":{"speed_m_s":0.5}}]}]}],
      "dynamics":{"mode":"dynamic","loads":[{"slot":"trunk","socket":"back","mass_kg":4}]}})"},
};

}  // namespace

std::span<const NamedScene> all_scenes() { return kScenes; }

Spec scene(std::string_view name) {
  for (const NamedScene& candidate : kScenes) {
    if (candidate.name != name) continue;
    const Result<Spec> spec = parse_spec(candidate.spec_json);
    if (!spec) throw std::logic_error(std::string(name) + ": " + to_line(spec.issue()));
    return *spec;
  }
  throw std::logic_error("no scene " + std::string(name));
}

}  // namespace contort
