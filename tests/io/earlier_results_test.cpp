// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/earlier_results.h"

#include <gmock/gmock.h>

#include "invsim/base/error.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class EarlierResultsTest : public testing::Test {
 protected:
  EarlierResultsTest()
      : root_(fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(root_);
    fs::create_directories(root_ / "cloth");
    fs::create_directories(root_ / "checkpoint");
    for (const char* file :
         {kResolvedConfig, "body.npz", "cloth/000000.ply", "checkpoint/a.bin"})
      WriteFileBytes((root_ / file).string(), "x");
  }
  ~EarlierResultsTest() override { fs::remove_all(root_); }

  void Remove(const std::vector<std::string>& inputs) const {
    RemoveEarlierResults(root_,
                         {root_ / "body.npz",
                          root_ / "cloth/000000.ply",
                          root_ / "checkpoint",
                          root_ / "none"},
                         inputs);
  }
  bool AllThere() const {
    return fs::exists(root_ / "body.npz") &&
           fs::exists(root_ / "cloth/000000.ply") &&
           fs::exists(root_ / "checkpoint/a.bin");
  }

  fs::path root_;
};

TEST_F(EarlierResultsTest, AreRemovedAndNothingElse) {
  WriteFileBytes((root_ / "cloth/mine.txt").string(), "x");
  Remove({"mannequin",
          "",
          "/no/such/file",
          (root_ / "cloth/mine.txt").string(),
          root_.parent_path().string()});
  EXPECT_FALSE(fs::exists(root_ / "body.npz"));
  EXPECT_FALSE(fs::exists(root_ / "cloth/000000.ply"));
  EXPECT_FALSE(fs::exists(root_ / "checkpoint"));
  EXPECT_TRUE(fs::exists(root_ / "cloth/mine.txt"));
  EXPECT_TRUE(fs::exists(root_ / kResolvedConfig));
}

TEST_F(EarlierResultsTest, AreOnlyWhereTheOptionsLie) {
  fs::remove(root_ / kResolvedConfig);
  EXPECT_THAT([&] { Remove({}); },
              ThrowsMessage<UsageError>(AllOf(HasSubstr(root_.string()),
                                              HasSubstr(kResolvedConfig))));
  EXPECT_TRUE(AllThere());
}

TEST_F(EarlierResultsTest, StayIfTheyAreToBeRead) {
  fs::create_directory_symlink(root_, root_ / "link");
  for (const char* input : {"body.npz",           // itself
                            "cloth/../body.npz",  // by another name
                            "link/body.npz",
                            "checkpoint/a.bin",  // in what is removed
                            "cloth"}) {          // the folder it lies in
    const std::string path = (root_ / input).string();
    EXPECT_THAT([&] { Remove({path}); },
                ThrowsMessage<UsageError>(AllOf(
                    HasSubstr(path + ": is to be read"), HasSubstr("--force"))))
        << input;
    EXPECT_TRUE(AllThere()) << input;
  }
}

}  // namespace
}  // namespace invsim
