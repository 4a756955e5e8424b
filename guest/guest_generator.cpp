#include "guest/guest_generator.h"

#include <unistd.h>

#include <algorithm>

#include "guest/guest_figure.h"
#include "guest/guest_intent.h"
#include "guest/guest_offers.h"
#include "guest/relations.h"
#include "model/core/index.h"
#include "process/ended.h"

namespace contort {

namespace {

constexpr std::size_t kMostFigures = 256;  // greatest number of figures whose offers are cached

using Models = std::map<std::string, GuestCharacter>;

// Reads each model once and caches it.
ModelReader keeping(const ModelReader& models, Models& kept) {
  if (!models) return {};
  return [&](const std::string& path) -> Result<GuestCharacter> {
    if (const auto known = kept.find(path); known != kept.end()) return known->second;
    Result<GuestCharacter> read = models(path);
    if (read) kept[path] = *read;
    return read;
  };
}

// Reads models from the cache only. A later start of the program must name the same models, otherwise its manifest
// differs.
ModelReader kept_only(const Models& kept) {
  return [&](const std::string& path) -> Result<GuestCharacter> {
    if (const auto known = kept.find(path); known != kept.end()) return known->second;
    return Issue{"generator.other_model", "", "found another model than at the first start: " + path};
  };
}

std::shared_ptr<GuestDescription> describe(const std::string& command, const GuestLimits& limits, GuestManifest said,
                                           Models models) {
  auto description = std::make_shared<GuestDescription>();
  description->command = command;
  description->limits = limits;
  description->said = std::move(said);
  description->models = std::move(models);
  description->library = library_of(description->said);
  Manifest& manifest = description->manifest;
  manifest.name = description->said.name;
  manifest.library = &description->library;
  for (const GuestAction& action : description->said.actions) manifest.actions.push_back(action.name);
  manifest.can = {false, false, false, false, false};
  manifest.rate_hz = description->said.rate_hz;
  manifest.build = description->said.build + " " + manifest_hash(description->said);
  return description;
}

EqualMotion with_frames(EqualMotion equal, const Motion& motion, int first_row) {
  equal.coords.assign(motion.coords.begin() + first_row * motion.coord_count, motion.coords.end());
  equal.root.assign(motion.root.begin() + first_row, motion.root.end());
  return equal;
}

}  // namespace

Result<std::unique_ptr<GuestGenerator>> GuestGenerator::start(const std::string& command, const GuestLimits& limits,
                                                              const ModelReader& models) {
  auto program = std::make_unique<GuestProgram>(command, limits);
  Models kept;
  Result<GuestManifest> said = program->greet(keeping(models, kept));
  if (!said) return said.issue();
  const std::shared_ptr<const GuestDescription> description =
      describe(command, limits, std::move(said).value(), std::move(kept));
  for (const auto& [name, desc] : description->library.characters)
    if (const Result<Character> built = build_character({name, {}, {}}, description->library); !built)
      return built.issue();
  auto generator = std::make_unique<GuestGenerator>(description);
  generator->program_ = std::move(program);
  generator->owner_ = ::gettid(), generator->process_ = ::getpid();
  return generator;
}

GuestGenerator::GuestGenerator(std::shared_ptr<const GuestDescription> description)
    : description_(std::move(description)) {}

GuestGenerator::~GuestGenerator() { restart(); }

// A copy of this object in a forked process must not end the program of the original.
void GuestGenerator::restart() {
  if (process_ != ::getpid()) (void)program_.release();
  program_.reset();
}

// The program of this thread. Each thread has its own, because two threads with one program would read each other's
// answers.
GuestProgram& GuestGenerator::program() {
  if (owner_ != ::gettid()) restart();
  if (program_ != nullptr && description_->said.determinism != Determinism::history) return *program_;
  program_ = std::make_unique<GuestProgram>(description_->command, description_->limits);
  owner_ = ::gettid(), process_ = ::getpid();
  const Result<GuestManifest> again = program_->greet(kept_only(description_->models));
  if (!again) throw ProgramEnded({Ending::Kind::crash, "does not start", {}, to_line(again.issue())});
  if (manifest_hash(*again) != manifest_hash(said()))
    throw ProgramEnded({Ending::Kind::crash, "another manifest", {}, "the manifest differs from that of its first start"});
  return *program_;
}

const Offers& GuestGenerator::offers(const Character& character) {
  const auto known = offers_.find(character.hash());
  if (known != offers_.end()) return known->second;
  if (offers_.size() >= kMostFigures) offers_.clear();
  return offers_.emplace(character.hash(), offers_of(said(), character)).first->second;
}

Result<const GuestGenerator::Figure*> GuestGenerator::figure_of(const CharacterChoice& choice) {
  if (figure_ != nullptr && figure_->choice == choice) return static_cast<const Figure*>(figure_.get());
  Result<Character> built = build_character(choice, description_->library);
  if (!built) return built.issue();
  auto character = std::make_shared<const Character>(std::move(built).value());
  std::vector<int> joints = joints_of(*find_character(said(), choice.name), *character);
  figure_ = std::make_unique<Figure>(Figure{choice, std::move(character), std::move(joints)});
  return static_cast<const Figure*>(figure_.get());
}

Result<Admission> GuestGenerator::admit(const Spec& spec) {
  const Result<const Figure*> figure = figure_of(spec.character);
  if (!figure) return Issue{figure.issue().code, "/character" + figure.issue().pointer, figure.issue().text};
  const Result<Done> admitted = admit_request(spec, *(*figure)->character, offers(*(*figure)->character));
  if (!admitted) return admitted.issue();
  return Admission{frames_of(spec)};
}

Result<GuestAnswer> GuestGenerator::ask(const Spec& spec, const Figure& figure, GuestRequest& request) {
  const FrameLayout layout{*figure.character, figure.joints, Basis(said().convention), said().frames};
  request.id = ++id_;
  try {
    GuestAnswer answer = program().ask(print_request(request, said(), spec), request.id,
                                       {request.frames, bytes_of(layout, request.frames)}, said().channels);
    if (answer.refusal) return Issue{std::string(kRefusedCode), "", std::string(kRefusedText) + *answer.refusal};
    return answer;
  } catch (const ProgramEnded&) {
    restart();
    throw;
  }
}

Result<Done> GuestGenerator::ask_motion(const Spec& spec, const Figure& figure, GuestRequest request, Motion& motion,
                                        ForeignFacts& facts) {
  Result<GuestAnswer> answer = ask(spec, figure, request);
  if (!answer) return answer.issue();
  facts.runs = std::move(answer->channels.runs), facts.numbers = std::move(answer->channels.numbers);
  const FrameLayout layout{*figure.character, figure.joints, Basis(said().convention), said().frames};
  read_frames(answer->bytes, layout, request.frames, motion, facts);
  motion.rate_hz = request.rate_hz;
  return Done{};
}

Result<Done> GuestGenerator::add_equal(const Spec& spec, const Figure& figure, Promised promised, ForeignFacts& facts) {
  Motion motion;
  ForeignFacts unused;
  const Result<Done> asked = ask_motion(spec, figure, std::move(promised.request), motion, unused);
  if (!asked) return asked;
  facts.equals.push_back(with_frames(std::move(promised.equal), motion, promised.first_row));
  return Done{};
}

Result<Done> GuestGenerator::add_promised(const Spec& spec, const Figure& figure, const GuestRequest& whole,
                                          ForeignFacts& facts) {
  for (const Promised& promised : promises_of(whole)) {
    if (promised.equal.why == Equality::rest) {
      facts.equals.push_back(rest_motion(*figure.character, root_at_rest(said(), spec.character.name), promised));
      continue;
    }
    if (const Result<Done> added = add_equal(spec, figure, promised, facts); !added) return added;
  }
  return Done{};
}

Result<Done> GuestGenerator::add_mirrored(const Spec& spec, const Figure& figure, const GuestRequest& whole,
                                          ForeignFacts& facts) {
  const std::optional<Spec> other =
      mirrored(said(), spec, whole.uses, *figure.character, offers(*figure.character));
  if (!other) return Done{};
  Motion motion;
  ForeignFacts unused;
  const Result<Done> asked = ask_motion(*other, figure, request_of(*other, figure), motion, unused);
  if (!asked) return asked;
  const FrameLayout layout{*figure.character, figure.joints, Basis(said().convention), said().frames};
  const Rigid rest = root_at_rest(said(), spec.character.name);
  motion = mirror_image(*find_character(said(), spec.character.name), rest, layout, motion);
  facts.equals.push_back(with_frames({Equality::mirror, 0, 1, {}, {}}, motion, 0));
  return Done{};
}

GuestRequest GuestGenerator::request_of(const Spec& spec, const Figure& figure) {
  return {0, spec.rate_hz, frames_of(spec), placed_uses(said(), spec, *figure.character, offers(*figure.character))};
}

Result<Done> GuestGenerator::add_relations(const Spec& spec, const Figure& figure, const GuestRequest& whole,
                                           ForeignFacts& facts) {
  if (said().declares("history")) {
    const Spec others = spec_of_all_actions(spec.character, *figure.character, offers(*figure.character), spec.rate_hz);
    GuestRequest other = request_of(others, figure);
    if (const Result<GuestAnswer> asked = ask(others, figure, other); !asked) return asked.issue();
    if (const Result<Done> added = add_equal(spec, figure, {whole, {Equality::history, 0, 1, {}, {}}}, facts); !added)
      return added;
  }
  if (said().declares("gain")) {
    const Spec near = nudged(spec, whole.uses);
    const Promised promised{request_of(near, figure), {Equality::gain, 0, 1, {}, {}}};
    if (const Result<Done> added = add_equal(near, figure, promised, facts); !added) return added;
  }
  if (said().declares("mirror"))
    if (const Result<Done> added = add_mirrored(spec, figure, whole, facts); !added) return added;
  if (!said().declares("rate")) return Done{};
  GuestRequest half = whole;
  half.rate_hz = 0.5 * whole.rate_hz, half.frames = (whole.frames - 1) / 2 + 1;
  return add_equal(spec, figure, {half, {Equality::rate, 0, 2, {}, {}}}, facts);
}

Result<Done> GuestGenerator::run(const Spec& spec, Execution& execution) {
  if (const Result<Admission> admitted = admit(spec); !admitted) return admitted.issue();
  const Figure& figure = *figure_;
  const GuestRequest whole = request_of(spec, figure);
  ForeignFacts& facts = execution.foreign.emplace();
  execution.motion = {};
  if (const Result<Done> asked = ask_motion(spec, figure, whole, execution.motion, facts); !asked) return asked;
  execution.character = figure.character;
  execution.couplings = couplings_of(*find_character(said(), spec.character.name), figure.joints);
  execution.intent = intent_of(said(), whole.uses, *figure.character);
  execution.motion.spans = spans_of(*execution.intent, execution.motion.frame_count);
  facts.jumps = jumps_of(whole.uses), facts.travels = travels_of(whole.uses);
  facts.root_max_speed_rad_s =
      kRadPerDeg * find_character(said(), spec.character.name)->joints.front().max_speed_deg_s;
  facts.contacts = contacts_of(said(), spec.character.name, figure.joints, facts.runs);
  if (const Result<Done> added = add_promised(spec, figure, whole, facts); !added) return added;
  return add_relations(spec, figure, whole, facts);
}

Result<std::string> GuestGenerator::raw_frames(const Spec& spec) {
  if (const Result<Admission> admitted = admit(spec); !admitted) return admitted.issue();
  GuestRequest whole = request_of(spec, *figure_);
  Result<GuestAnswer> answer = ask(spec, *figure_, whole);
  if (!answer) return answer.issue();
  return std::move(answer).value().bytes;
}

std::unique_ptr<Generator> GuestGenerator::another() const { return std::make_unique<GuestGenerator>(description_); }

Result<std::unique_ptr<Generator>> GuestGenerator::with(const Library&) const {
  return Issue{"generator.own_library", "",
               "a generator that is a program of its own brings its characters along; --library cannot change them"};
}

}  // namespace contort
