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
  // A right triangle a frame, two of its corners at these heights in metres.
  void Write(const std::string& name,
             int frame,
             double first,
             double second) const {
    fs::create_directories(directory_ / name / "cloth");
    char file[32];
    std::snprintf(file, sizeof(file), "%06d.ply", frame);
    PlyMesh mesh;
    mesh.vertices = Points::Zero(3, 3);
    mesh.vertices.row(0) << 0, 1, 0;
    mesh.vertices.row(1) << first, second, 0;
    mesh.vertices.row(2) << 0, 0, 1;
    mesh.faces.resize(3, 1);
    mesh.faces << 0, 1, 2;
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
  EXPECT_NEAR(d.rms_mm[1], std::sqrt(25 / 3.0), 1e-5);
  EXPECT_NEAR(d.total_rms_mm(), std::sqrt(25 / 6.0), 1e-5);
  EXPECT_NEAR(d.mean_mm, 7 / 6.0, 1e-5);
  EXPECT_NEAR(d.max_mm, 4, 1e-5);
  EXPECT_EQ(d.surface_mm[0], 0);
}

// A square of two triangles, and the same of four, 2 mm above it: no vertex
// belongs to another, but the surfaces are 2 mm apart.
TEST_F(ClothDifferenceTest, OfOtherMeshesIsThatOfTheirSurfaces) {
  fs::create_directories(directory_ / "coarse/cloth");
  fs::create_directories(directory_ / "fine/cloth");
  PlyMesh coarse, fine;
  coarse.vertices.resize(3, 4);
  coarse.vertices << 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1;
  coarse.faces.resize(3, 2);
  coarse.faces << 0, 0, 1, 2, 2, 3;
  fine.vertices.resize(3, 5);
  fine.vertices << coarse.vertices, Vector3d(0.5, 0, 0.5);
  fine.vertices.row(1).setConstant(0.002);
  fine.faces.resize(3, 4);
  fine.faces << 0, 1, 2, 3, 1, 2, 3, 0, 4, 4, 4, 4;
  WritePly(Run("coarse/cloth/000000.ply"), coarse);
  WritePly(Run("fine/cloth/000000.ply"), fine);
  const ClothDifference d = CompareClothFolders(Run("fine"), Run("coarse"));
  EXPECT_FALSE(d.vertex_by_vertex());
  ASSERT_EQ(d.surface_mm.size(), 1u);
  EXPECT_NEAR(d.mean_surface_mm(), 2, 1e-5);
}

// As many vertices, but other ones.
TEST_F(ClothDifferenceTest, ComparesVerticesOnlyOfTheSameFaces) {
  Write("reference", 0, 0, 0);
  Write("run", 0, 0.003, 0.004);
  PlyMesh other = ReadPly(Run("run/cloth/000000.ply"));
  other.faces << 1, 2, 0;
  WritePly(Run("run/cloth/000000.ply"), other);
  const ClothDifference d = CompareClothFolders(Run("run"), Run("reference"));
  EXPECT_FALSE(d.vertex_by_vertex());
  EXPECT_GT(d.mean_surface_mm(), 1);
}

TEST_F(ClothDifferenceTest, RefusesWhatDoesNotMatch) {
  for (int t = 0; t < 2; ++t) Write("reference", t, 0, 0);
  Write("run", 0, 0, 0);
  EXPECT_THROW(CompareClothFolders(Run("run"), Run("reference")), InputError);
  EXPECT_THROW(CompareClothFolders(Run("none"), Run("reference")), InputError);
}

}  // namespace
}  // namespace invsim
