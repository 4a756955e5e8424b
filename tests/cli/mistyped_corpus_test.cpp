#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/program.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

// No command that reads a corpus creates an empty one, without findings, at a mistyped path.
TEST(MistypedCorpus, IsAnErrorAndMakesNothing) {
  const TempFolder folder;
  const Corpus corpus = create(folder);
  const std::string typo = folder / "corpsu", out = folder / "out";
  const std::vector<std::vector<std::string>> commands = {
      {"serve", "--port", "0", "--corpus", typo},
      {"serve", "--port", "0", "--read-only", "--corpus", typo},
      {"report", typo, "-o", out},
      {"report", typo, "--gate"},
      {"report", corpus.folder(), "--gate", "--baseline", typo},
      {"replay", typo},
      {"replay", typo, "--update"},
      {"replay", corpus.folder(), "--baseline", typo},
      {"render", typo, "-o", out},
      {"merge", typo, "-o", out},
      {"merge", corpus.folder(), typo, "-o", out},
      {"fuzz", "--cases", "0", "--corpus", out, "--baseline", typo},
      {"fuzz", "--cases", "0", "--corpus", out, "--seeds", typo},
      {"corpus", "list", typo},
      {"corpus", "show", typo, "0"},
      {"corpus", "ack", typo, "0", "--owner", "a", "--ticket", "b"},
      {"corpus", "quarantine", typo, "0", "--owner", "a", "--reason", "b", "--expires", "2027-01-01"},
      {"corpus", "note", typo, "0", "--text", "a"},
      {"corpus", "fsck", typo},
      {"corpus", "fsck", typo, "--repair"},
      {"corpus", "rekey", typo},
      {"corpus", "prune", typo},
      {"corpus", "migrate", typo},
  };
  for (const std::vector<std::string>& command : commands) {
    const Ran ran = contort_program(command);
    EXPECT_EQ(ran.code, 2) << command[0] << " " << command[1] << "\n" << ran.out << ran.err;
    EXPECT_TRUE(ran.err.find(typo) != std::string::npos) << command[0] << " " << command[1] << "\n" << ran.err;
    EXPECT_FALSE(std::filesystem::exists(typo)) << command[0] << " " << command[1];
    EXPECT_FALSE(std::filesystem::exists(out)) << command[0] << " " << command[1];
  }
  EXPECT_NE(contort_program(commands[0]).err.find("contort fuzz --corpus"), std::string::npos) << "how to make one";
}

}  // namespace

}  // namespace contort
