// Another program as the base: it answers, crashes, hangs, is too old, or talks nonsense.
#include "fuzz/base_build.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/corpus/sample_cases.h"
#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

constexpr WorkerLimits kLongWait{60.0, std::int64_t{1} << 30};
constexpr char kHelloLine[] = "echo '{\"format\":\"contort.measure/1\",\"version\":\"7\",\"checks\":[\"pop\"]}'\n";
// Reads a request and sets $id to its number.
constexpr char kReadRequest[] = "read -r line || exit 0\nid=$(echo \"$line\" | sed 's/.*\"id\":\\([0-9]*\\).*/\\1/')\n";
constexpr char kAnswerLine[] = "echo \"{\\\"id\\\":$id,\\\"motion_hash\\\":\\\"0123456789abcdef\\\"}\"\n";

class BasePrograms : public testing::Test {
 protected:
  std::vector<std::string> script(const std::string& text) {
    spill(folder_ / "base", "#!/bin/sh\n" + text);
    std::filesystem::permissions(folder_ / "base", std::filesystem::perms::owner_all);
    return {folder_ / "base"};
  }
  Measurement answer(BaseProgram& base) {
    MeasureRequest request;
    request.spec = bent_elbow(100);
    base.ask(request);
    return base.answer({});
  }
  static std::string code_of(const Measurement& measured) { return measured.refusal ? measured.refusal->code : ""; }
  TempFolder folder_;
};

TEST_F(BasePrograms, AnswerOneRequestAfterAnother) {
  BaseProgram base(script(std::string(kHelloLine) + "while true; do\n" + kReadRequest + kAnswerLine + "done\n"),
                   kLongWait);
  for (int i = 1; i <= 3; ++i) {
    const Measurement measured = answer(base);
    EXPECT_EQ(code_of(measured), "");
    EXPECT_EQ(measured.id, i);
    EXPECT_EQ(measured.motion_hash, "0123456789abcdef");
  }
}

TEST_F(BasePrograms, AreGreeted) {
  const Result<MeasureHello> hello = greet(script(kHelloLine), kLongWait);
  ASSERT_TRUE(hello) << to_line(hello.issue());
  EXPECT_EQ(hello->version, "7");
  EXPECT_EQ(hello->checks, std::vector<std::string>{"pop"});
}

TEST_F(BasePrograms, WithoutTheProtocolAreRefused) {
  EXPECT_EQ(greet(script("echo contort 0.0.1\n"), kLongWait).issue().code, "against.no_protocol");
  EXPECT_EQ(greet(script("exit 2\n"), kLongWait).issue().code, "against.no_protocol");
  EXPECT_EQ(greet(script("echo '{\"format\":\"contort.measure/2\",\"version\":\"7\"}'\n"), kLongWait).issue().code,
            "against.no_protocol");
  EXPECT_EQ(greet({folder_ / "nothing"}, kLongWait).issue().code, "against.cannot_start");
}

TEST_F(BasePrograms, ThatCrashTwiceRefuse) {
  BaseProgram base(
      script(std::string(kHelloLine) + kReadRequest + "echo x >> '" + (folder_ / "asked") + "'\nkill -SEGV $$\n"),
      kLongWait);
  const Measurement measured = answer(base);
  EXPECT_EQ(code_of(measured), "base.crash");
  EXPECT_NE(measured.refusal->text.find("SIGSEGV"), std::string::npos) << measured.refusal->text;
  EXPECT_EQ(slurp(folder_ / "asked"), "x\nx\n");
  EXPECT_EQ(code_of(answer(base)), "base.crash") << "and are asked again";
}

TEST_F(BasePrograms, ThatCrashOnceAreAskedAgain) {
  const std::string flag = "'" + (folder_ / "flag") + "'";
  BaseProgram base(script(std::string(kHelloLine) + kReadRequest + "if [ ! -e " + flag + " ]; then touch " + flag +
                          "; kill -SEGV $$; fi\n" + kAnswerLine),
                   kLongWait);
  EXPECT_EQ(code_of(answer(base)), "");
}

TEST_F(BasePrograms, ThatHangRefuse) {
  BaseProgram base(script(std::string(kHelloLine) + kReadRequest + "exec sleep 1000\n"), {0.3, kLongWait.bytes});
  EXPECT_EQ(code_of(answer(base)), "base.timeout");
}

TEST_F(BasePrograms, ThatTalkNonsenseRefuse) {
  BaseProgram nonsense(script(std::string(kHelloLine) + kReadRequest + "echo nonsense\nexec sleep 1000\n"), kLongWait);
  EXPECT_EQ(code_of(answer(nonsense)), "base.bad_answer");
  BaseProgram other(script(std::string(kHelloLine) + kReadRequest + "id=77\n" + kAnswerLine), kLongWait);
  EXPECT_EQ(code_of(answer(other)), "base.bad_answer");
}

}  // namespace
}  // namespace contort
