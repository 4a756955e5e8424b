#include "model/core/own_folder.h"

#include <gtest/gtest.h>

#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

TEST(OwnFolder, ANewAnEmptyAndAnOwnOneAreFine) {
  const TempFolder folder;
  EXPECT_TRUE(check_own_folder(folder / "new", false, "a corpus").ok());
  EXPECT_TRUE(check_own_folder(folder.path(), false, "a corpus").ok());
  spill(folder / ".gitkeep", "");
  EXPECT_TRUE(check_own_folder(folder.path(), false, "a corpus").ok()) << "hidden files are not the user's work";
  spill(folder / "mine.txt", "");
  EXPECT_TRUE(check_own_folder(folder.path(), true, "a corpus").ok());
}

TEST(OwnFolder, OneOfOtherFilesIsRefusedWithWhatIsThere) {
  const TempFolder folder;
  for (const char* name : {"a.cpp", "b.cpp", "c.cpp", "d.cpp"}) spill(folder / name, "");
  const Result<Done> own = check_own_folder(folder.path(), false, "a corpus");
  ASSERT_FALSE(own.ok());
  EXPECT_EQ(own.issue().code, "folder.other_files");
  EXPECT_EQ(own.issue().text, folder.path() +
                                  " is not a corpus and holds other files (a.cpp, b.cpp, c.cpp and 1 more), "
                                  "which stay as they are: name a new folder, an empty one or a corpus");
}

}  // namespace
}  // namespace contort
