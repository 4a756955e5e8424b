// A server leaves no folder and no process behind, however it ends.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "corpus/corpus.h"
#include "process/program.h"
#include "server/scratch.h"
#include "tests/corpus/temp_folder.h"
#include "tests/server/program.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> entries_of(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  return names;
}

// Returns false for a process that has ended, even if its parent has not waited for it.
bool is_running(int pid) {
  const std::string text = slurp("/proc/" + std::to_string(pid) + "/stat");
  const std::size_t at = text.rfind(')');
  return at != std::string::npos && text.substr(at + 2, 1) != "Z";
}

// Within a minute.
bool comes_true(const std::function<bool()>& what) {
  for (int i = 0; i < 6000; ++i) {
    if (what()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

int parent_of(const std::string& pid) {
  const std::string text = slurp("/proc/" + pid + "/stat");
  const std::size_t at = text.rfind(')');
  return at == std::string::npos ? 0 : std::atoi(text.c_str() + at + 4);
}

// All processes below this one.
std::vector<int> below(int pid) {
  std::vector<int> all;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos || parent_of(name) != pid) continue;
    all.push_back(std::stoi(name));
    for (const int child : below(all.back())) all.push_back(child);
  }
  return all;
}

// Uses the server, so that its folder has files.
void use(const Program& server) {
  httplib::Client client = server.client();
  const std::string library =
      R"({"files":{"a.json":{"format":"contort.action/1","name":"bow","on":["waist"],"base":"crouch","params":{}}}})";
  (void)post(client, "/api/libraries", library);
  EXPECT_EQ(status(client.Get("/api/health")), 200);
}

TEST(Endings, AServerThatIsToldToEndLeavesNothing) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    TempFolder folder, temporary;
    ASSERT_TRUE(Corpus::create(folder / "corpus"));
    Program server({"--corpus", folder / "corpus"}, temporary.path());
    EXPECT_EQ(entries_of(temporary.path()).size(), 1u);
    use(server);
    const std::vector<int> children = below(server.pid());
    EXPECT_GE(children.size(), 2u) << "a broker and a worker";
    EXPECT_EQ(server.end(signal), 0) << signal;
    EXPECT_EQ(entries_of(temporary.path()), std::vector<std::string>{}) << signal;
    for (const int child : children) EXPECT_TRUE(comes_true([&] { return !is_running(child); })) << child;
  }
}

TEST(Endings, ASignalBeforeTheFirstAnswerLeavesNothing) {
  TempFolder temporary;
  for (int wait_ms = 0; wait_ms < 60; wait_ms += 6) {
    const pid_t server = ::fork();
    if (server == 0) {
      ::setenv("TMPDIR", temporary.path().c_str(), 1);
      ::close(1);
      ::execl(CONTORT_BINARY_DIR "/contort", "contort", "serve", "--port", "0", nullptr);
      ::_exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    ::kill(server, SIGTERM);
    ASSERT_EQ(::waitpid(server, nullptr, 0), server);
    EXPECT_EQ(entries_of(temporary.path()), std::vector<std::string>{}) << wait_ms;
  }
}

TEST(Endings, AServerThatIsKilledLeavesNoProcessAndTheNextOneTidiesUp) {
  TempFolder folder, temporary;
  ASSERT_TRUE(Corpus::create(folder / "corpus"));
  Program other({}, temporary.path());
  const std::vector<std::string> others = entries_of(temporary.path());
  Program killed({"--corpus", folder / "corpus"}, temporary.path());
  use(killed);
  const std::vector<int> children = below(killed.pid());
  EXPECT_EQ(killed.end(SIGKILL), 128 + SIGKILL);
  for (const int child : children) EXPECT_TRUE(comes_true([&] { return !is_running(child); })) << child;
  EXPECT_EQ(entries_of(temporary.path()).size(), 2u) << "nobody was there to remove it";
  spill(temporary / "contort-serve-file", "no folder");
  fs::create_directory(temporary / "something-else");
  Program next({}, temporary.path());
  const std::vector<std::string> now = entries_of(temporary.path());
  EXPECT_EQ(now.size(), 4u) << "two servers, and what is not ours";
  EXPECT_NE(std::ranges::find(now, others.front()), now.end()) << "a server that lives keeps its folder";
  EXPECT_EQ(status(other.client().Get("/api/health")), 200);
}

TEST(Scratch, ALinkIsNotFollowed) {
  TempFolder parent, elsewhere;
  spill(elsewhere / "precious", "x");
  fs::create_directory_symlink(elsewhere.path(), parent / "contort-serve-link");
  const auto scratch = server::Scratch::make(parent.path());
  ASSERT_TRUE(scratch);
  EXPECT_EQ(slurp(elsewhere / "precious"), "x");
  EXPECT_TRUE(fs::is_directory((*scratch)->path()));
}

TEST(Scratch, WithoutAPlaceForItIsAnErrorThatNamesThePlace) {
  const auto scratch = server::Scratch::make("/nowhere/at/all");
  ASSERT_FALSE(scratch);
  EXPECT_EQ(scratch.issue().code, "file.unwritable");
  EXPECT_NE(scratch.issue().text.find("/nowhere/at/all"), std::string::npos) << scratch.issue().text;
}

// A process that runs `work`, and is killed as soon as `file` has the number of the process that it started.
int killed_with_a_child(const std::string& file, const std::function<void()>& work) {
  const pid_t parent = ::fork();
  if (parent == 0) {
    work();
    ::_exit(0);
  }
  EXPECT_TRUE(comes_true([&] { return slurp(file).ends_with("\n"); }));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  return std::atoi(slurp(file).c_str());
}

TEST(Endings, AJobEndsWithTheServer) {
  TempFolder folder;
  const std::string file = folder / "pid";
  const int child = killed_with_a_child(file, [&] {
    std::thread([&] {
      (void)run_program({"/bin/sh", "-c", "echo $$ > " + file + "; exec sleep 1000"}, 1000.0,
                                [] { return false; });
    }).join();
  });
  ASSERT_GT(child, 0);
  EXPECT_TRUE(comes_true([&] { return !is_running(child); }));
}

TEST(Endings, AProgramThatIsNotThereIsAnError) {
  const auto ran = run_program({"/nowhere/at/all"}, 10.0, [] { return false; });
  ASSERT_FALSE(ran);
  EXPECT_EQ(ran.issue().code, "work.no_process");
}

}  // namespace
}  // namespace contort
