// A program of its own, used through the common Generator interface. It has the characters and actions of its manifest,
// plays the uses of a spec on one time line, and has no interrupts, grounds, obstacles, dynamics, or speeds.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "guest/frames.h"
#include "guest/guest_program.h"
#include "guest/promised.h"
#include "guest/request.h"
#include "model/generator.h"

namespace contort {

// A manifest and everything derived from it, shared by all generators that start the same command. Immutable.
struct GuestDescription {
  std::string command;
  GuestLimits limits;
  GuestManifest said;
  std::map<std::string, GuestCharacter> models{};  // the model files that the manifest names, by path
  Library library;
  Manifest manifest;  // the manifest in our terms; it refers to `library`
};

class GuestGenerator final : public Generator {
 public:
  // Starts the program, reads its manifest, and reads each model file that the manifest names once. Codes of
  // GuestProgram::greet and of build_character.
  static Result<std::unique_ptr<GuestGenerator>> start(const std::string& command, const GuestLimits& limits = {},
                                                       const ModelReader& models = {});

  explicit GuestGenerator(std::shared_ptr<const GuestDescription> description);
  ~GuestGenerator() override;

  const GuestManifest& said() const { return description_->said; }
  const Manifest& manifest() const override { return description_->manifest; }
  const Offers& offers(const Character& character) override;
  Result<Admission> admit(const Spec& spec) override;  // codes of admit_request and build_character
  // Throws ProgramEnded if the program ends or breaks the protocol. Code guest.refused if it refuses.
  Result<Done> run(const Spec& spec, Execution& execution) override;
  std::unique_ptr<Generator> another() const override;
  // Code generator.own_library: the program has its own characters.
  Result<std::unique_ptr<Generator>> with(const Library& library) const override;

  // The frames that the program sends for the spec, for comparisons of whole motions. Code guest.refused.
  Result<std::string> raw_frames(const Spec& spec);
  // Ends the program; the next request starts another.
  void restart();

 private:
  struct Figure {  // the character for one choice of parts
    CharacterChoice choice;
    std::shared_ptr<const Character> character;
    std::vector<int> joints;
  };

  Result<const Figure*> figure_of(const CharacterChoice& choice);
  Result<GuestAnswer> ask(const Spec& spec, const Figure& figure, GuestRequest& request);
  Result<Done> ask_motion(const Spec& spec, const Figure& figure, GuestRequest request, Motion& motion,
                          ForeignFacts& facts);
  Result<Done> add_equal(const Spec& spec, const Figure& figure, Promised promised, ForeignFacts& facts);
  Result<Done> add_promised(const Spec& spec, const Figure& figure, const GuestRequest& whole, ForeignFacts& facts);
  Result<Done> add_mirrored(const Spec& spec, const Figure& figure, const GuestRequest& whole, ForeignFacts& facts);
  GuestRequest request_of(const Spec& spec, const Figure& figure);
  Result<Done> add_relations(const Spec& spec, const Figure& figure, const GuestRequest& whole, ForeignFacts& facts);
  GuestProgram& program();

  std::shared_ptr<const GuestDescription> description_;
  std::map<std::uint64_t, Offers> offers_;  // by the character's hash
  std::unique_ptr<Figure> figure_;          // the figure of the last spec
  std::unique_ptr<GuestProgram> program_;
  int owner_ = -1;  // the thread that started the program; the program ends when that thread does
  int process_ = -1;
  std::int64_t id_ = 0;
};

}  // namespace contort
