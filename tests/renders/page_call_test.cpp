// Files that a page loads: they are read back unchanged, and no content can end a script.
#include "renders/page_call.h"

#include <gtest/gtest.h>

#include "model/core/json_fields.h"
#include "renders/strip_views.h"

namespace contort {
namespace {

TEST(PageCall, IsReadBack) {
  for (const std::string stamp : {"", "0123456789abcdef"})
    for (const std::string name : {"a", "\"</script>", ""}) {
      const std::string script = page_call("contortCase", name, "{\"a\":1}", stamp);
      EXPECT_EQ(data_of_page_call("contortCase", name, script), "{\"a\":1}");
      EXPECT_EQ(stamp_of_page_call(script), stamp);
      EXPECT_EQ(data_of_page_call("contortStrip", name, script), "") << "another function";
      EXPECT_EQ(data_of_page_call("contortCase", name + "b", script), "") << "another name";
      EXPECT_EQ(script.find("</script"), std::string::npos);
    }
  for (const char* bad : {"", "x", "// made of ", "// made of a", "// made of a\n", "contortCase(\"a\", "})
    EXPECT_EQ(data_of_page_call("contortCase", "a", bad), "") << bad;
  EXPECT_EQ(stamp_of_page_call("// made of a"), "") << "a line that is not whole";
}

TEST(StripViews, HaveEachTile) {
  StripTile tile{7, {}, 2, 58, 320, 216};
  tile.camera.eye_m = {1, 2, 3}, tile.camera.center_m = {0, 1, 0};
  const auto json = json_fields::parse_document(strip_views_json({tile}));
  ASSERT_TRUE(json.ok());
  EXPECT_EQ((*json)["format"], "contort.strip/1");
  const auto& one = (*json)["tiles"][0];
  EXPECT_EQ(one["frame"], 7);
  EXPECT_EQ(one["eye"], json_fields::Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(one["target"], json_fields::Json({0.0, 1.0, 0.0}));
  EXPECT_EQ(one["box"], json_fields::Json({2, 58, 320, 216}));
}

}  // namespace
}  // namespace contort
