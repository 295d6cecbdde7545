#include "tools/staged_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

namespace armcal::staged_files_test {

namespace fs = std::filesystem;

// A folder with an older result, a file of the user's and one of his links.
class StagedFilesTest : public testing::Test {
 protected:
  using Texts = std::map<std::string, std::string>;

  StagedFilesTest() {
    fs::remove_all(folder_.parent_path());
    fs::create_directories(folder_);
    Write(folder_ / "a", "old a");
    Write(folder_ / "mine", "mine");
    Write(folder_.parent_path() / "far", "old b");
    fs::create_symlink("../far", folder_ / "b");
  }

  static void Write(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
  }
  // What can be opened.
  Texts Found() const {
    Texts found;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (!fs::is_regular_file(entry.path())) continue;
      std::ifstream file(entry.path());
      std::getline(file, found[entry.path().filename()]);
    }
    return found;
  }
  StagedFiles Written() const {
    StagedFiles staged(folder_, {"a", "b", "c"});
    for (const char* name : {"a", "b", "c"}) {
      Write(staged.Path(name), std::string("new ") + name);
    }
    return staged;
  }
  // Nothing hidden, and results are no links; the user's may be.
  void ExpectPlain(const std::vector<std::string>& names) const {
    for (const auto& entry : fs::directory_iterator(folder_)) {
      EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
    }
    for (const std::string& name : names) {
      EXPECT_FALSE(fs::is_symlink(folder_ / name)) << name;
    }
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) /
      testing::UnitTest::GetInstance()->current_test_info()->name() / "out";
  const Texts old_ = {{"a", "old a"}, {"b", "old b"}, {"mine", "mine"}};
  const Texts new_ = {
      {"a", "new a"}, {"b", "new b"}, {"c", "new c"}, {"mine", "mine"}};
};

TEST_F(StagedFilesTest, TakeTheirPlacesAtOneMoment) {
  StagedFiles staged = Written();
  EXPECT_EQ(Found(), old_);
  staged.Link();
  EXPECT_EQ(Found(), old_);
  staged.Switch();
  EXPECT_EQ(Found(), new_);
  staged.Settle();
  EXPECT_EQ(Found(), new_);
  ExpectPlain({"a", "b", "c"});
}

TEST_F(StagedFilesTest, AreUndoneBeforeThat) {
  StagedFiles staged = Written();
  staged.Link();
  staged.Settle();
  EXPECT_EQ(Found(), old_);
  ExpectPlain({"a"});
}

TEST_F(StagedFilesTest, AreSettledAfterKills) {
  Written();
  StagedFiles::Recover(folder_);
  EXPECT_EQ(Found(), old_);
  Written().Link();
  StagedFiles::Recover(folder_);
  EXPECT_EQ(Found(), old_);
  ExpectPlain({"a"});
  StagedFiles staged = Written();
  staged.Link();
  staged.Switch();
  StagedFiles::Recover(folder_);
  EXPECT_EQ(Found(), new_);
  ExpectPlain({"a", "b", "c"});
}

// Where a folder stands in a file's place nothing is done.
TEST_F(StagedFilesTest, DoNotReplaceFolders) {
  fs::create_directory(folder_ / "c");
  StagedFiles staged = Written();
  EXPECT_THROW(staged.Link(), fs::filesystem_error);
  staged.Settle();
  EXPECT_EQ(Found(), old_);
  ExpectPlain({"a"});
}

}  // namespace armcal::staged_files_test
