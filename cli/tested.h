// The generator under test, as the command line chooses it.
#pragma once

#include <memory>

#include "cli/sources.h"
#include "corpus/corpus.h"
#include "model/generator.h"

namespace contort::cli {

struct Tested {
  std::unique_ptr<Library> library;  // library of the built-in generator, if folders add to the stock
  std::unique_ptr<Generator> generator;
};

// Loads the program of --generator, or the built-in generator with the stock library and these folders. Codes of
// load_libraries, GuestGenerator::start, and generator.own_library if both are given.
Result<Tested> load_tested(const Sources& sources);

// The name of the program under test; "" for the built-in generator.
std::string program_name(const Manifest& manifest);

// Refuses a case of another generator than the one under test. Code replay.other_generator.
Result<Done> check_generator(const Case& stored, const Manifest& manifest);

// Does the same for the first readable case of a corpus.
Result<Done> check_generator(const Corpus& corpus, const Manifest& manifest);

}  // namespace contort::cli
