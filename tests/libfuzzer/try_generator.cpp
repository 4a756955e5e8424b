#include "checks/judge.h"
#include "guest/frames.h"
#include "guest/guest_figure.h"
#include "guest/guest_offers.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

constexpr std::string_view kBetween = "\n#!\n";
constexpr std::size_t kMostJoints = 64;
constexpr int kMostFramesRead = 12;

void read_and_judge(const GuestManifest& manifest, const Library& library, std::string_view bytes) {
  const Result<Character> built = build_character({manifest.characters.front().name, {}, {}}, library);
  if (!built) return require_clean(built.issue());
  Execution made;
  made.character = std::make_shared<const Character>(*built);
  require(offers_of(manifest, *made.character).size() == made.character->parts().size(), "every part has its offers");
  const std::vector<int> joints = joints_of(manifest.characters.front(), *made.character);
  const FrameLayout layout{*made.character, joints, Basis(manifest.convention), manifest.frames};
  const int frames = static_cast<int>(std::min<std::size_t>(kMostFramesRead, bytes.size() / bytes_of(layout, 1)));
  if (frames == 0) return;
  read_frames(bytes, layout, frames, made.motion, made.foreign.emplace());
  Judge().evaluate(made);
}

}  // namespace

bool try_generator(std::string_view bytes) {
  const std::size_t end = bytes.find(kBetween);
  const Result<GuestManifest> manifest = parse_manifest(bytes.substr(0, end));
  if (!manifest) return require_clean(manifest.issue()), false;
  if (manifest->characters.front().joints.size() > kMostJoints) return true;
  require(manifest_hash(*manifest).size() == 16, "a manifest has a hash");
  const Library library = library_of(*manifest);
  read_and_judge(*manifest, library, end == std::string_view::npos ? "" : bytes.substr(end + kBetween.size()));
  return true;
}

}  // namespace contort::hostile
