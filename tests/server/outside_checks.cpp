// Calls about a corpus that a stranger made.
#include <gtest/gtest.h>

#include "tests/corpus/sample_corpus.h"
#include "tests/server/app_fixture.h"

namespace contort::server {
namespace {

// A corpus of a stranger's: names and links in it lead to no other file.
TEST(Triage, NothingOutsideOfTheCorpusIsShownReplayedOrChanged) {
  Server server;
  const Result<Corpus> corpus = Corpus::open(server.folder / "corpus");
  const Found kept = found(160, 40, 1);
  ASSERT_TRUE(corpus->add(kept));
  const Bucket bucket = only_bucket(*corpus);
  const std::string folder = corpus->folder_of(bucket), path = "/api/corpus/" + folder_name(bucket);
  spill(server.folder / "secret.json", R"({"secret": "hunter2"})");
  const auto expect_nothing_shown = [&] {
    EXPECT_EQ(server.call("GET", path).status, 404);
    for (const char* call : {"/replay", "/shrink"})
      EXPECT_EQ(server.post(path + call, Json::object()).status, 404) << call;
    EXPECT_EQ(server.post(path + "/note", {{"text", "x"}}).status, 404);
    const Json list = server.get("/api/corpus");
    EXPECT_TRUE(list["buckets"].empty());
    EXPECT_EQ(list["damaged"].size(), 1u);
    EXPECT_EQ(list.dump().find("hunter2"), std::string::npos);
  };
  const std::string honest = slurp(folder + "/bucket.json");
  Json json = Json::parse(honest);
  json["orig"] = "../../../secret.json";
  spill(folder + "/bucket.json", json.dump());
  expect_nothing_shown();
  spill(folder + "/bucket.json", honest);
  EXPECT_EQ(server.call("GET", path).status, 200);
  std::filesystem::remove(folder + "/" + bucket.orig);
  std::filesystem::create_symlink(server.folder / "secret.json", folder + "/" + bucket.orig);
  expect_nothing_shown();
}

}  // namespace
}  // namespace contort::server
