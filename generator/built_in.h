// The built-in generator behind the interface that all other code uses.
#pragma once

#include <cstdint>
#include <map>

#include "generator/generate.h"
#include "generator/stage.h"
#include "model/generator.h"

namespace contort {

class BuiltInGenerator final : public Generator {
 public:
  // The library must outlive it.
  explicit BuiltInGenerator(const Library& library = stock_library());

  const Manifest& manifest() const override { return manifest_; }
  const Offers& offers(const Character& character) override;
  Result<Admission> admit(const Spec& spec) override;  // codes of build_stage
  Result<Done> run(const Spec& spec, Execution& execution) override;
  std::unique_ptr<Generator> another() const override;
  Result<std::unique_ptr<Generator>> with(const Library& library) const override;  // codes of check_actions

 private:
  Result<Done> build(const Spec& spec);

  Manifest manifest_;
  std::map<std::uint64_t, Offers> offers_;  // by hash of the character
  Spec spec_;                               // the spec from which stage_ was built
  Result<Stage> stage_ = Issue{};
  GenerateScratch scratch_;
};

}  // namespace contort
