// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/run_folder.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "invsim/base/error.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class RunFolderTest : public testing::Test {
 protected:
  RunFolderTest()
      : root_(fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  ~RunFolderTest() override { fs::remove_all(root_); }

  fs::path root_;
};

TEST_F(RunFolderTest, MakesFoldersAndNumberedFrames) {
  const RunFolder run((root_ / "a/b").string(), false);
  run.Write("report.json", "{}");
  WriteFileBytes(run.Frame("cloth", 12), "ply");
  EXPECT_EQ(ReadFileBytes((root_ / "a/b/report.json").string()), "{}");
  EXPECT_TRUE(fs::exists(root_ / "a/b/cloth/000012.ply"));
}

TEST_F(RunFolderTest, TakesAnEmptyFolderButNoFullOne) {
  EXPECT_NO_THROW(RunFolder(root_.string(), false));
  WriteFileBytes((root_ / "mine.txt").string(), "keep");
  try {
    const RunFolder run(root_.string(), false);
    FAIL() << "wrote into a folder with files";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr(root_.string()), HasSubstr("--force")));
  }
  EXPECT_EQ(ReadFileBytes((root_ / "mine.txt").string()), "keep");
}

TEST_F(RunFolderTest, ForceRemovesTheEarlierRunAndNothingElse) {
  {
    const RunFolder first(root_.string(), false);
    first.Write("config.resolved.toml", "");
    first.Write("report.json", "old");
    WriteFileBytes(first.Frame("cloth", 99), "old");
    WriteFileBytes(first.File("cloth/notes.txt"), "keep");
    WriteFileBytes(first.File("mine.txt"), "keep");
  }
  const RunFolder second(root_.string(), true);
  EXPECT_FALSE(fs::exists(root_ / "report.json"));
  EXPECT_FALSE(fs::exists(root_ / "cloth/000099.ply"));
  EXPECT_TRUE(fs::exists(root_ / "cloth/notes.txt"));
  EXPECT_TRUE(fs::exists(root_ / "mine.txt"));
}

TEST_F(RunFolderTest, ForceRemovesNeitherInputsNorWhatIsNoRun) {
  const auto file = [&](const char* name) { return (root_ / name).string(); };
  fs::create_directories(root_ / "cloth");
  WriteFileBytes(file("cloth/000000.ply"), "points");
  WriteFileBytes(file("body.npz"), "model");
  const auto refused = [&](const std::string& why,
                           const std::vector<std::string>& inputs) {
    EXPECT_THAT([&] { RunFolder(root_.string(), true, inputs); },
                ThrowsMessage<UsageError>(HasSubstr(why)));
  };
  refused("not a folder of earlier results", {});
  WriteFileBytes(file("config.resolved.toml"), "");
  for (const char* input : {"cloth", "cloth/000000.ply", "body.npz"})
    refused("is to be read", {file(input)});
  EXPECT_TRUE(fs::exists(file("cloth/000000.ply")));
  EXPECT_TRUE(fs::exists(file("body.npz")));
  EXPECT_NO_THROW(RunFolder(root_.string(), true, {file("mine.obj")}));
}

TEST_F(RunFolderTest, RefusesAFileAndWhatLiesUnderOne) {
  const std::string file = (root_ / "file").string();
  WriteFileBytes(file, "x");
  EXPECT_THROW(RunFolder(file, true), UsageError);
  EXPECT_THROW(RunFolder(file + "/below", true), InputError);
  EXPECT_EQ(ReadFileBytes(file), "x");
}

}  // namespace
}  // namespace invsim
