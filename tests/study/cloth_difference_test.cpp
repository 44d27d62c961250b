// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/cloth_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "invsim/base/error.h"
#include "invsim/io/ply.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

class ClothDifferenceTest : public ::testing::Test {
 protected:
  ClothDifferenceTest()
      : directory_(fs::path(::testing::TempDir()) / "invsim_difference") {
    fs::remove_all(directory_);
  }
  ~ClothDifferenceTest() override { fs::remove_all(directory_); }

  std::string Run(const std::string& name) const {
    return (directory_ / name).string();
  }
  // Two vertices a frame, at these heights in metres.
  void Write(const std::string& name,
             int frame,
             double first,
             double second) const {
    fs::create_directories(directory_ / name / "cloth");
    char file[32];
    std::snprintf(file, sizeof(file), "%06d.ply", frame);
    PlyMesh mesh;
    mesh.vertices = Points::Zero(3, 2);
    mesh.vertices.row(1) << first, second;
    WritePly((directory_ / name / "cloth" / file).string(), mesh);
  }

  fs::path directory_;
};

TEST_F(ClothDifferenceTest, OfKnownDistances) {
  for (int t = 0; t < 2; ++t) Write("reference", t, 0, 0);
  Write("run", 0, 0, 0);
  Write("run", 1, 0.003, 0.004);
  const ClothDifference d = CompareClothFolders(Run("run"), Run("reference"));
  ASSERT_EQ(d.rms_mm.size(), 2u);
  EXPECT_EQ(d.rms_mm[0], 0);
  EXPECT_NEAR(d.rms_mm[1], std::sqrt(12.5), 1e-5);
  EXPECT_NEAR(d.total_rms_mm(), 2.5, 1e-5);
  EXPECT_NEAR(d.mean_mm, 3.5 / 2, 1e-5);
  EXPECT_NEAR(d.max_mm, 4, 1e-5);
}

TEST_F(ClothDifferenceTest, RefusesWhatDoesNotMatch) {
  for (int t = 0; t < 2; ++t) Write("reference", t, 0, 0);
  Write("run", 0, 0, 0);
  EXPECT_THROW(CompareClothFolders(Run("run"), Run("reference")), InputError);
  EXPECT_THROW(CompareClothFolders(Run("none"), Run("reference")), InputError);
}

}  // namespace
}  // namespace invsim
