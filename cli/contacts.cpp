// contort contacts: lists the allowed contacts of a character with their reasons, and proposes contacts to allow.
#include "import/contacts.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "cli/commands.h"
#include "cli/input.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"
#include "model/core/nearest.h"
#include "model/core/output.h"

namespace contort::cli {

namespace {

using json_fields::Json;

constexpr std::string_view kUser = "user: ";  // prefix of contacts that a character's file allows

struct ContactsOptions {
  std::string subject;
  std::string output;
  int poses = 1000;
  bool json = false;
};

// The character with this name in the library; otherwise a spec's character, with its parts and objects.
Result<Character> character_of(const std::string& subject, const Library& library) {
  if (library.characters.contains(subject))
    return build_character({.name = subject, .parts = {}, .attachments = {}}, library);
  std::string names;
  for (const auto& [name, desc] : library.characters) names += (names.empty() ? "" : ", ") + name;
  if (std::error_code error; !std::filesystem::exists(subject, error))
    return Issue{
        "character.unknown_character", "",
        "\"" + subject + "\" is no character (contort list characters) and no file" + did_you_mean(subject, names)};
  const Result<SpecInput> input = read_spec_input(subject);
  if (!input) return input.issue();
  Result<Character> built = build_character(input->spec.character, library);
  return built ? std::move(built) : about_file(subject, built.issue());
}

std::vector<AllowedPairDesc> allowed_of(const Character& character) {
  std::vector<AllowedPairDesc> pairs;
  const auto name = [&](int collider) { return character.colliders()[static_cast<std::size_t>(collider)].name; };
  for (const AllowedPair& pair : character.allowed_pairs()) pairs.push_back({name(pair.a), name(pair.b), pair.reason});
  return pairs;
}

Json to_json(const std::vector<AllowedPairDesc>& pairs) {
  Json list = Json::array();
  for (const AllowedPairDesc& pair : pairs) list.push_back({{"a", pair.a}, {"b", pair.b}, {"reason", pair.reason}});
  return list;
}

void print_json(const Character& character, const OwnContacts& proposed) {
  const Json out = {{"character", character.name()},
                    {"judged", character.judged_colliders().size()},
                    {"allowed", to_json(allowed_of(character))},
                    {"proposed", to_json(proposed.pairs)},
                    {"left_out", proposed.left_out}};
  std::printf("%s\n", out.dump(2).c_str());
}

void print_pair(const AllowedPairDesc& pair) {
  std::printf("  %s ~ %s: %s\n", pair.a.c_str(), pair.b.c_str(), pair.reason.c_str());
}

void print_text(const Character& character, const OwnContacts& proposed, int poses) {
  const std::vector<AllowedPairDesc> allowed = allowed_of(character);
  std::printf("%s: %zu pairs of colliders are judged, %zu are allowed\n", character.name().c_str(),
              character.judged_colliders().size(), allowed.size());
  std::map<std::string, int> counts;
  for (const AllowedPairDesc& pair : allowed)
    pair.reason.starts_with(kUser) ? print_pair(pair) : static_cast<void>(++counts[pair.reason]);
  for (const auto& [reason, count] : counts) std::printf("  %d of them: %s\n", count, reason.c_str());
  std::printf("proposed, by the rest pose and %d poses within all ranges: %zu\n", poses, proposed.pairs.size());
  for (const AllowedPairDesc& pair : proposed.pairs) print_pair(pair);
  if (proposed.left_out > 0)
    std::printf("  and %d more, which a character's file has no place for\n", proposed.left_out);
}

// The proposed and the present pairs, in the form of a character's file.
std::string file_text(const Character& character, const OwnContacts& proposed) {
  std::vector<AllowedPairDesc> pairs;
  for (AllowedPairDesc& pair : allowed_of(character))
    if (pair.reason.starts_with(kUser)) pairs.push_back({pair.a, pair.b, pair.reason.substr(kUser.size())});
  pairs.insert(pairs.end(), proposed.pairs.begin(), proposed.pairs.end());
  return Json{{"allowed_pairs", to_json(pairs)}}.dump(2) + "\n";
}

void run(const ContactsOptions& options, Context& context) {
  const Library* library = context.load_library();
  if (library == nullptr) return;
  const Result<Character> character = character_of(options.subject, *library);
  if (!character) return context.fail(character.issue());
  const OwnContacts proposed = propose_contacts(*character, options.poses);
  if (!options.output.empty())
    if (const Result<Done> written = write_output(options.output, file_text(*character, proposed)); !written)
      return context.fail(written.issue(), kInternal);
  options.json ? print_json(*character, proposed) : print_text(*character, proposed, options.poses);
}

}  // namespace

void add_contacts(CLI::App& app, Context& context) {
  auto options = std::make_shared<ContactsOptions>();
  CLI::App* command = app.add_subcommand("contacts", "List the contacts that a character allows, and propose more");
  command
      ->add_option("CHARACTER", options->subject, "Name of a character, or a spec or case file, whose parts and objects are used")
      ->required();
  command->add_option("--poses", options->poses, "Number of poses to try, in addition to the rest pose")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_option("-o,--output", options->output,
                      "Write the allowed and the proposed pairs as \"allowed_pairs\" of a character's file");
  command->add_flag("--json", options->json, "Print as JSON");
  command->footer("Example: contort contacts mech -o allowed.json");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
