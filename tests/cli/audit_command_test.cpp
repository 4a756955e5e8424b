// contort audit as a user runs it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/cli/small_library.h"
#include "tests/corpus/sample_cases.h"

namespace contort {
namespace {

using Json = nlohmann::json;

class AuditCommand : public testing::Test {
 protected:
  Ran audit(const std::vector<std::string>& more) {
    small::write_library(folder_ / "library");
    std::vector<std::string> arguments = {"audit",   "--library", folder_ / "library", "--character", "small",
                                          "--draws", "40"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return contort_program(arguments);
  }
  TempFolder folder_;
};

TEST_F(AuditCommand, PrintsARowForEachActionAndFailsWhereOneIsNotClean) {
  const Json rows = Json::parse(audit({"--json"}).out);
  ASSERT_FALSE(rows.empty());
  int clean = 0;
  for (const Json& row : rows) {
    EXPECT_EQ(row["draws"], 40);
    EXPECT_EQ(row["findings"].empty(), row["clean"] == 40) << row;
    clean += row["clean"] == 40 ? 1 : 0;
  }
  ASSERT_LT(clean, static_cast<int>(rows.size())) << "something must fail, or the rest shows nothing";
  const Ran ran = audit({});
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(last_line(ran.out), "RESULT rows=" + std::to_string(rows.size()) + " clean=" + std::to_string(clean));
}

TEST_F(AuditCommand, NamesTheModesOfDynamics) {
  const Json rows = Json::parse(contort_program({"audit", "--character", "human", "--action", "turn", "--draws", "1",
                                                 "--dynamics", "dynamic", "--json"})
                                    .out);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["dynamics"], "dynamic");
  const Ran unknown = contort_program({"audit", "--dynamics", "rigid"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("tracking"), std::string::npos) << unknown.err;
}

TEST_F(AuditCommand, WritesTheWorstOfEachRowInAFileOfItsOwn) {
  const std::string worst = folder_ / "worst";
  const Json rows = Json::parse(audit({"--json", "--worst", worst}).out);
  std::size_t with_worst = 0, files = 0;
  for (const Json& row : rows) with_worst += row["worst"].is_null() ? 0 : 1;
  for (const auto& entry : std::filesystem::directory_iterator(worst)) {
    ++files;
    const Ran checked = contort_program({"check", entry.path(), "--library", folder_ / "library"});
    EXPECT_TRUE(checked.code == 0 || checked.code == 1) << checked.err;
  }
  EXPECT_GT(files, 0U);
  EXPECT_EQ(files, with_worst);
}

TEST_F(AuditCommand, MakesAPageWithTheWorstMotionsAndNoScript) {
  const std::string page = folder_ / "page";
  const Json rows = Json::parse(audit({"--json", "--page", page, "--gl", "none"}).out);
  const std::string html = slurp(page + "/index.html");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_NE(html.find("contort audit --draws 40 --seed 1 --library"), std::string::npos);
  std::size_t places = 0, links = 0;
  for (const Json& row : rows) links += row["worst"].is_null() ? 0 : 1;
  for (std::size_t at = html.find("href='motions/"); at != std::string::npos; at = html.find("href='motions/", at + 1)) {
    const std::size_t begin = at + std::string("href='").size();
    EXPECT_TRUE(std::filesystem::exists(page + "/" + html.substr(begin, html.find('\'', begin) - begin)));
    ++places;
  }
  EXPECT_EQ(places, links);
  EXPECT_EQ(html.find("<img"), std::string::npos) << "no pictures were drawn";
}

TEST_F(AuditCommand, RefusesANameThatIsNotThere) {
  const Ran ran = audit({"--action", "rech"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("audit.unknown_action"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("did you mean \"reach\"?"), std::string::npos) << ran.err;
}

TEST(UnmetRequests, ArePrintedAsNotesThatFailNothing) {
  const TempFolder folder;
  ActionUse reach = pose_use("arm_left", {{"target_m", Vec3(0.2, 1.4, 3.0)}}, 60);
  reach.action = "reach";
  spill(folder / "far.json", pretty_spec(spec_of({reach})));
  const Ran checked = contort_program({"check", folder / "far.json"});
  EXPECT_EQ(checked.code, 0) << checked.out;
  const std::string note = "note: reach (arm_left) was not met in frames 60-60: it is out of reach\n";
  EXPECT_NE(checked.out.find(note), std::string::npos) << checked.out;
  EXPECT_NE(contort_program({"generate", folder / "far.json", "-o", folder / "far.glb"}).out.find(note),
            std::string::npos);
  const Json json = Json::parse(contort_program({"check", folder / "far.json", "--json"}).out);
  ASSERT_EQ(json["unmet"].size(), 1U);
  EXPECT_EQ(json["unmet"][0]["why"], "out_of_reach");
}

}  // namespace
}  // namespace contort
