// A generator other than the built-in one: three links on three hinges, and one action that turns all of them to an
// angle within one frame. It gives no intent.
#pragma once

#include "model/generator.h"

namespace contort::swing {

inline const Library& library() {
  static const Library one = [] {
    PartDesc part;
    part.name = part.kind = "chain";
    for (const char* name : {"hip", "knee", "ankle"}) {
      JointDesc joint;
      joint.name = name, joint.parent = part.joints.empty() ? "" : part.joints.back().name;
      joint.position_m = {0, 0.3, 0}, joint.axis = {0, 0, 1}, joint.mass_kg = 1.0, joint.max_speed_deg_s = 20000;
      part.joints.push_back(joint);
      part.colliders.push_back({joint.name, joint.name, Sphere{{0, 0.15, 0}, 0.05}});
    }
    Library made;
    made.parts["chain"] = part;
    made.characters["pendulum"] = {"pendulum", "", {{"body", "chain", Side::center, "", "", {"chain"}}}, {}, {}, {}, {}};
    return made;
  }();
  return one;
}

class SwingGenerator final : public Generator {
 public:
  SwingGenerator() {
    manifest_.name = "swing";
    manifest_.library = &library();
    manifest_.actions = {"swing"};
    manifest_.can = {.interrupts = false, .grounds = false, .obstacles = false, .dynamics = false};
    const ParamDef angle{.name = "angle_deg", .low = -120, .high = 120, .help = "Of each hinge."};
    offers_ = {{{.name = "swing", .help = "Turns all hinges.", .params = {angle}, .moves = {0}, .tells = {}}}};
  }
  const Manifest& manifest() const override { return manifest_; }
  const Offers& offers(const Character&) override { return offers_; }
  Result<Admission> admit(const Spec& spec) override {
    const Result<Character> built = build_character(spec.character, library());
    if (!built) return built.issue();
    std::size_t most_frames = 1;
    for (const SequenceDesc& sequence : spec.sequences)
      for (const ClipDesc& clip : sequence.clips) most_frames += clip.actions.size();
    return Admission{static_cast<int>(most_frames)};
  }
  Result<Done> run(const Spec& spec, Execution& execution) override {
    const Result<Admission> admitted = admit(spec);
    if (!admitted) return admitted.issue();
    execution.character = std::make_shared<const Character>(*build_character(spec.character, library()));
    Motion& motion = execution.motion = {};
    motion.rate_hz = spec.rate_hz, motion.coord_count = 3;
    double angle_rad = 0.0;
    const auto append = [&] {
      motion.coords.insert(motion.coords.end(), 3, angle_rad);
      motion.root.push_back(execution.character->rest_root());
      ++motion.frame_count;
    };
    append();
    for (const SequenceDesc& sequence : spec.sequences)
      for (const ClipDesc& clip : sequence.clips)
        for (const ActionUse& use : clip.actions) {
          const auto given = use.params.find("angle_deg");
          angle_rad = given == use.params.end() ? 0.0 : std::get<double>(given->second) * kRadPerDeg;
          append();
        }
    return Done{};
  }
  std::unique_ptr<Generator> another() const override { return std::make_unique<SwingGenerator>(); }
  Result<std::unique_ptr<Generator>> with(const Library&) const override {
    return Issue{"generator.own_characters", "", "the pendulum is all that it moves"};
  }

 private:
  Manifest manifest_;
  Offers offers_;
};

}  // namespace contort::swing
