// Pipes and devices, in place of standard output, of files to read, and of files to write.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "model/core/descriptor.h"
#include "tests/cli/program.h"
#include "tests/corpus/sample_corpus.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

class Streams : public testing::Test {
 protected:
  Streams() : corpus_(create(folder_)) {
    const Case stored = failing_case(bent_elbow(190), "joint_range", kElbow);
    const Result<Corpus::Added> added = corpus_.add({stored, stored, "seed_1"});
    EXPECT_TRUE(added.ok());
    if (added.ok()) bucket_ = added->bucket;
    spill(folder_ / "spec.json", pretty_spec(bent_elbow(190)));
    spill(folder_ / "case.json", print_case(elbow_case()));
  }
  std::string pipe(const std::string& name) const {
    EXPECT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0);
    return folder_ / name;
  }
  TempFolder folder_;
  Corpus corpus_;
  std::string bucket_;
};

// ---- standard output

TEST_F(Streams, WhatCannotBePrintedIsAnError) {
  const Descriptor full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
  if (!full.ok()) GTEST_SKIP() << "there is no /dev/full";
  const std::vector<std::vector<std::string>> calls = {{"list", "checks"},
                                                       {"list", "actions"},
                                                       {"corpus", "list", corpus_.folder(), "--json"},
                                                       {"corpus", "show", corpus_.folder(), "joint"},
                                                       {"corpus", "fsck", corpus_.folder()},
                                                       {"replay", corpus_.folder()},
                                                       {"report", corpus_.folder(), "--github"},
                                                       {"check", folder_ / "spec.json"},
                                                       {"generate", folder_ / "spec.json", "-o", folder_ / "a.glb"},
                                                       {"schema", "spec"},
                                                       {"--help"},
                                                       {"help", "fuzz"},
                                                       {"version"}};
  for (const std::vector<std::string>& call : calls) {
    const Ran ran = contort_into(full.number(), call);
    EXPECT_EQ(ran.code, 3) << call.front();
    EXPECT_EQ(lines_of(ran.err).size(), 1U) << ran.err;
    EXPECT_TRUE(ran.err.starts_with("contort: output.unwritable: ")) << call.front() << ": " << ran.err;
  }
}

// No file that is opened afterwards gets the number of standard output, and what is printed into it.
TEST_F(Streams, AClosedOutputIsAnErrorAndSpoilsNoFile) {
  const Ran ran = contort_into(Program::kClosed, {"generate", folder_ / "spec.json", "-o", folder_ / "a.json"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("output.unwritable"), std::string::npos) << ran.err;
  EXPECT_TRUE(nlohmann::json::accept(slurp(folder_ / "a.json")));
  EXPECT_EQ(
      contort_into(Program::kClosed, {"fuzz", "--cases", "0", "--log", folder_ / "log", "--corpus", folder_ / "other"})
          .code,
      3);
  EXPECT_EQ(slurp(folder_ / "log"), "");
}

TEST_F(Streams, AReaderThatIsGoneEndsTheProgramSilently) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ::close(ends[0]);
  for (const std::vector<std::string>& call : {std::vector<std::string>{"list", "actions"}, {"version"}}) {
    const Ran ran = contort_into(ends[1], call);
    EXPECT_EQ(ran.code, 141) << call.front();
    EXPECT_EQ(ran.err, "");
  }
  ::close(ends[1]);
}

// ---- files to read

TEST_F(Streams, ASpecMayComeThroughAPipe) {
  const std::string path = pipe("pipe.json"), spec = slurp(folder_ / "spec.json");
  std::thread writer([&] {
    const Descriptor end(::open(path.c_str(), O_WRONLY));
    EXPECT_TRUE(write_all(end.number(), spec));
  });
  const Ran ran = contort_program({"check", path});
  writer.join();
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_EQ(ran.out, contort_program({"check", folder_ / "spec.json"}).out);
}

TEST_F(Streams, APipeThatNobodyWritesIntoIsRefusedWhereverItIsNamed) {
  const std::string path = pipe("pipe.json"), spec = folder_ / "spec.json";
  const std::vector<std::vector<std::string>> calls = {
      {"check", path},
      {"replay", path},
      {"shrink", path},
      {"generate", path, "-o", folder_ / "a.glb"},
      {"contacts", path},
      {"--settings", path, "check", spec},
      {"fuzz", "--profile", path, "--cases", "0"},
      {"report", corpus_.folder(), "--baseline", path, "--gate"},
      {"check", folder_ / "a.glb", "--character", "human", "--map", path}};
  for (const std::vector<std::string>& call : calls) {
    const Ran ran = contort_program(call);
    EXPECT_EQ(ran.code, 2) << call.front();
    EXPECT_NE(ran.err.find(path), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("pipe"), std::string::npos) << ran.err;
  }
}

// Everywhere in a folder, and at once: even one that somebody has open and never writes into.
TEST_F(Streams, APipeInAFolderIsRefused) {
  const std::string other = folder_ / "folder";
  fs::create_directories(other);
  const Descriptor json(::open(pipe("folder/a.json").c_str(), O_RDWR | O_CLOEXEC));
  const Ran library = contort_program({"--library", other, "list", "parts"});
  EXPECT_EQ(library.code, 2);
  EXPECT_NE(library.err.find("a.json is a named pipe"), std::string::npos) << library.err;
  const Ran seeds = contort_program({"fuzz", "--seeds", other, "--cases", "0", "--corpus", folder_ / "new"});
  EXPECT_EQ(seeds.code, 2);
  EXPECT_NE(seeds.err.find("a.json is a named pipe"), std::string::npos) << seeds.err;
  fs::remove(folder_ / "folder/a.json");
  const Descriptor model(::open(pipe("folder/a.glb").c_str(), O_RDWR | O_CLOEXEC));
  EXPECT_NE(contort_program({"--library", other, "list", "parts"}).err.find("a.glb is a named pipe"),
            std::string::npos);
}

TEST_F(Streams, APipeInACorpusIsDamageThatIsTold) {
  fs::remove(bucket_ + "/bucket.json");
  ASSERT_EQ(::mkfifo((bucket_ + "/bucket.json").c_str(), 0600), 0);
  const std::vector<std::vector<std::string>> calls = {
      {"replay", corpus_.folder()},
      {"corpus", "list", corpus_.folder()},
      {"report", corpus_.folder(), "--junit", folder_ / "j.xml"},
      {"merge", corpus_.folder(), "-o", folder_ / "merged"},
      {"report", corpus_.folder(), "--baseline", corpus_.folder(), "--gate"}};
  for (const std::vector<std::string>& call : calls) {
    const Ran ran = contort_program(call);
    EXPECT_EQ(ran.code, 2) << call.front();
    EXPECT_NE(ran.err.find("bucket.json is a named pipe"), std::string::npos) << ran.err;
  }
  EXPECT_EQ(contort_program({"corpus", "fsck", corpus_.folder()}).code, 1);
}

TEST_F(Streams, APipeInPlaceOfTheLockIsNotWaitedFor) {
  fs::remove(corpus_.folder() + "/.lock");
  ASSERT_EQ(::mkfifo((corpus_.folder() + "/.lock").c_str(), 0600), 0);
  spill(bucket_ + "/bucket.json", "{");  // so that the reader asks for the lock
  EXPECT_EQ(contort_program({"corpus", "list", corpus_.folder()}).code, 2);
}

// ---- files to write

TEST_F(Streams, OutputsGoIntoPipesAndThroughLinks) {
  const std::string corpus = corpus_.folder(), spec = folder_ / "spec.json", stored = folder_ / "case.json";
  const auto call_with = [&](const std::string& kind, const std::string& path) -> std::vector<std::string> {
    if (kind == "log") return {"fuzz", "--cases", "0", "--corpus", folder_ / "other", "--log", path};
    if (kind == "contacts") return {"contacts", "human", "--poses", "0", "-o", path};
    if (kind == "shrink") return {"shrink", stored, "--evaluations", "0", "-o", path};
    if (kind == "worst") return {"shrink", stored, "--evaluations", "0", "-o", folder_ / "min.json", "--worst", path};
    if (kind == "glb" || kind == "json") return {"generate", spec, "-o", path};
    if (kind == "mail") return {"--gl", "none", "report", corpus, "-o", folder_ / "report", "--single-file", path};
    return {"report", corpus, "--" + kind, path};
  };
  for (const std::string kind :
       {"junit", "sarif", "markdown", "mail", "contacts", "shrink", "worst", "glb", "json", "log"}) {
    SCOPED_TRACE(kind);
    const std::string ending = kind == "glb" || kind == "json" ? "." + kind : "";
    const std::string plain = folder_ / ("plain_" + kind + ending), link = folder_ / ("link_" + kind + ending);
    fs::create_symlink(plain, link);
    const Ran linked = contort_program(call_with(kind, link));
    EXPECT_LT(linked.code, 2) << linked.err;
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_TRUE(fs::is_regular_file(plain));
    const std::string path = pipe("pipe_" + kind + ending);
    std::string got;
    std::thread reader([&] { got = slurp(path); });
    const Ran piped = contort_program(call_with(kind, path));
    reader.join();
    EXPECT_LT(piped.code, 2) << piped.err;
    EXPECT_TRUE(fs::is_fifo(path));
    EXPECT_EQ(got.size(), fs::file_size(plain));
  }
}

TEST_F(Streams, StandardOutputMayBeNamedAsAFile) {
  const Ran ran = contort_program({"report", corpus_.folder(), "--junit", "/dev/stdout"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(ran.out.starts_with("<?xml")) << ran.out;
  EXPECT_NE(ran.out.find("</testsuites>"), std::string::npos) << ran.out;
}

TEST_F(Streams, WhatCannotBeWrittenIsFoundOutBeforeTheWork) {
  for (const std::string option : {"--junit", "--sarif", "--markdown"}) {
    const Ran ran = contort_program({"fuzz", "--cases", "0", "--corpus", folder_ / "new", option, folder_ / "none/x"});
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_NE(ran.err.find(folder_ / "none/x"), std::string::npos) << ran.err;
    EXPECT_FALSE(fs::exists(folder_ / "new"));
  }
}

// contort-render, which writes pictures.
TEST_F(Streams, PicturesGoIntoPipesAndThroughLinks) {
  const std::string plain = folder_ / "plain.png", link = folder_ / "link.png", clip = pipe("clip.webp");
  fs::create_symlink(plain, link);
  std::string moving;
  std::thread reader([&] { moving = slurp(clip); });
  const Ran ran = contort_program({"render", folder_ / "spec.json", "-o", link, "--clip", clip});
  const bool is_drawn = ran.code == 0;
  if (!is_drawn) std::ofstream(clip).close();  // so that the reader ends
  reader.join();
  ASSERT_TRUE(is_drawn) << ran.err;
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(slurp(plain).starts_with("\x89PNG"));
  EXPECT_TRUE(fs::is_fifo(clip));
  EXPECT_EQ(moving.substr(8, 4), "WEBP");
}

}  // namespace

}  // namespace contort
