// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/point_sequence.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "error_matcher.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

class PointSequenceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ =
        std::filesystem::path(::testing::TempDir()) /
        ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  void Add(const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
      WriteFileBytes((directory_ / name).string(), "0 0 0\n");
    }
  }
  void ExpectRefused(const std::string& message) const {
    EXPECT_THAT([&] { ScanPointSequence(directory_.string()); },
                ThrowsInputError(message));
  }

  std::filesystem::path directory_;
};

TEST_F(PointSequenceTest, SortsByNumberAndPassesOverTheRest) {
  Add({"scan_10.xyz", "scan_8.xyz", "scan_9.xyz", ".scan_7.xyz", "scan.json"});
  std::filesystem::create_directory(directory_ / "scan_11.xyz");
  const PointSequence sequence = ScanPointSequence(directory_.string());
  EXPECT_EQ(sequence.directory, directory_.string());
  EXPECT_EQ(sequence.first, 8);
  EXPECT_EQ(sequence.step, 1);
  ASSERT_EQ(sequence.files.size(), 3);
  EXPECT_EQ(sequence.files[0], (directory_ / "scan_8.xyz").string());
  EXPECT_EQ(sequence.files[2], (directory_ / "scan_10.xyz").string());
}

TEST_F(PointSequenceTest, TakesEverySecondFrameAndASingleOne) {
  Add({"v2_000004.left.PLY"});
  PointSequence sequence = ScanPointSequence(directory_.string());
  EXPECT_EQ(sequence.first, 4);
  EXPECT_EQ(sequence.step, 1);
  Add({"v2_000006.left.PLY", "v2_000008.left.PLY"});
  sequence = ScanPointSequence(directory_.string());
  EXPECT_EQ(sequence.step, 2);
  EXPECT_EQ(sequence.files.size(), 3);
}

TEST_F(PointSequenceTest, NamesTheMissingFrame) {
  Add({"000098.ply", "000099.ply", "000101.ply", "000102.ply"});
  ExpectRefused(directory_.string() +
                ": frame 100 is missing: expected '000100.ply' between "
                "'000099.ply' and '000101.ply'");
}

TEST_F(PointSequenceTest, NamesTheEmptyFile) {
  Add({"0.xyz", "1.xyz"});
  WriteFileBytes((directory_ / "2.xyz").string(), "");
  ExpectRefused((directory_ / "2.xyz").string() + ": empty");
}

TEST_F(PointSequenceTest, RefusesMixedNames) {
  Add({"0.xyz", "1.ply"});
  ExpectRefused(": '0.xyz' and '1.ply': expected names that differ in the");
}

TEST_F(PointSequenceTest, RefusesANumberTwice) {
  Add({"01.ply", "1.ply"});
  ExpectRefused(": '01.ply' and '1.ply': expected each frame number once");
}

TEST_F(PointSequenceTest, RefusesANameWithoutNumber) {
  Add({"body.ply"});
  ExpectRefused(": 'body.ply': expected a frame number in the name");
}

TEST_F(PointSequenceTest, RefusesANumberTooLarge) {
  Add({"99999999999999999999.ply"});
  ExpectRefused("expected a frame number in the name");
}

TEST_F(PointSequenceTest, RefusesADirectoryWithoutClouds) {
  Add({"notes.md"});
  ExpectRefused(": no point cloud: expected files ply, pcd,");
  EXPECT_THAT([] { ScanPointSequence("/nowhere"); },
              ThrowsInputError("/nowhere: No such file or directory: expected "
                               "a directory of point clouds"));
}

}  // namespace
}  // namespace invsim
