#include "cli/tested.h"

#include "cli/guest_model.h"
#include "cli/input.h"
#include "generator/built_in.h"
#include "guest/guest_generator.h"

namespace contort::cli {

namespace {

Result<Tested> load_program(const Sources& sources) {
  if (!sources.libraries.empty())
    return Issue{"generator.own_library", "", "a program under test brings its characters along; leave --library out"};
  Result<std::unique_ptr<GuestGenerator>> started = GuestGenerator::start(
      sources.generator, {.case_s = sources.case_timeout_s, .bytes = sources.memory_MB << 20},
      model_reader(sources.generator));
  if (!started) return started.issue();
  return Tested{nullptr, std::move(started).value()};
}

}  // namespace

Result<Tested> load_tested(const Sources& sources) {
  if (!sources.generator.empty()) return load_program(sources);
  if (sources.libraries.empty()) return Tested{nullptr, std::make_unique<BuiltInGenerator>(stock_library())};
  Result<Library> merged = load_libraries(sources.libraries);
  if (!merged) return merged.issue();
  auto library = std::make_unique<Library>(std::move(merged).value());
  auto generator = std::make_unique<BuiltInGenerator>(*library);
  return Tested{std::move(library), std::move(generator)};
}

namespace {

std::string named(const std::string& program) {
  return program.empty() ? "the built-in generator" : "the generator \"" + program + "\"";
}

}  // namespace

std::string program_name(const Manifest& manifest) { return is_own_program(manifest) ? manifest.name : ""; }

Result<Done> check_generator(const Case& stored, const Manifest& manifest) {
  const std::string& found_with = stored.provenance.generator;
  const std::string now = program_name(manifest);
  if (found_with == now || stored.provenance.index < 0) return Done{};
  return Issue{"replay.other_generator", "/provenance/generator",
               "the case was found with " + named(found_with) + ", and this is " + named(now) +
                   (found_with.empty() ? "; leave --generator out" : "; --generator CMD says which program it is")};
}

Result<Done> check_generator(const Corpus& corpus, const Manifest& manifest) {
  std::vector<Issue> damaged;
  for (Bucket& bucket : corpus.buckets(damaged))
    if (const Result<Case> minimal = corpus.minimal_of(bucket); minimal) return check_generator(*minimal, manifest);
  return Done{};
}

}  // namespace contort::cli
