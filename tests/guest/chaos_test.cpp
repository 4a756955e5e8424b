// Replies with all kinds of faults: the case has an ending or a motion, and the next case is played.
#include <dirent.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <map>

#include "checks/judge.h"
#include "guest/guest_generator.h"
#include "process/ended.h"

namespace contort {
namespace {

constexpr char kMutating[] = CONTORT_BINARY_DIR "/tests/contort_mutating_guest";

Spec one_wave() {
  Spec spec;
  spec.character.name = "hero", spec.hold_frames = 5;
  return spec;
}

// Counts how often each ending occurred; "motion" and "refused" are no endings.
std::map<std::string, int> endings_of(GuestGenerator& guest, int cases) {
  std::map<std::string, int> endings;
  for (int i = 0; i < cases; ++i) try {
      const Result<Execution> made = execute(guest, one_wave());
      if (made) (void)Judge().evaluate(*made);
      ++endings[made ? "motion" : "refused"];
    } catch (const ProgramEnded& ended) {
      ++endings[ended.ending().signal];
    }
  return endings;
}

int running_guests() {
  int count = 0;
  DIR* processes = ::opendir("/proc");
  for (const dirent* entry = ::readdir(processes); entry != nullptr; entry = ::readdir(processes)) {
    std::ifstream name(std::string("/proc/") + entry->d_name + "/comm");
    std::string text;
    std::getline(name, text);
    count += text.starts_with("contort_mutati") ? 1 : 0;
  }
  ::closedir(processes);
  return count;
}

// A reply that breaks off is waited for as long as a case may take.
void try_replies(int replies, double case_s) {
  {
    Result<std::unique_ptr<GuestGenerator>> started = GuestGenerator::start(kMutating, {30.0, case_s});
    ASSERT_TRUE(started) << to_line(started.issue());
    const std::map<std::string, int> endings = endings_of(**started, replies);
    int cases = 0;
    for (const auto& [ending, count] : endings) cases += count;
    EXPECT_EQ(cases, replies);
    for (const char* expected : {"motion", "refused", "no JSON", "wrong length", "SIGSEGV", "exit 3"})
      EXPECT_GT(endings.contains(expected) ? endings.at(expected) : 0, cases / 200) << expected;
  }
  EXPECT_EQ(running_guests(), 0) << "no program is left behind";
}

TEST(GuestChaos, WrongRepliesEndOneCaseAndNoMore) { try_replies(400, 10.0); }

TEST(GuestChaos, ThousandsOfWrongRepliesLoseNoCase) { try_replies(10'000, 0.5); }

}  // namespace
}  // namespace contort
