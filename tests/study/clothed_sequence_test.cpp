// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/clothed_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "invsim/base/error.h"
#include "invsim/body/mannequin.h"
#include "invsim/body/motion_library.h"
#include "invsim/cloth/authored_garment.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/geometry/chamfer.h"
#include "invsim/io/file.h"
#include "invsim/io/obj.h"
#include "invsim/io/point_cloud.h"
#include "invsim/io/point_sequence.h"
#include "invsim/study/truth.h"
#include "invsim/study/visible_surface.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

class ClothedSequenceTest : public ::testing::Test {
 protected:
  ClothedSequenceTest()
      : body_(Mannequin()),
        garment_(AuthoredGarment("tank_top",
                                 {body_.Vertices({}),
                                  body_.faces(),
                                  body_.Joints({}),
                                  body_.data().weights},
                                 {.edge_length = 0.07})),
        material_(FindMaterial("jersey")),
        motion_(MakeMotion("arms_down_and_swing", 3)),
        directory_(fs::path(::testing::TempDir()) / "invsim_clothed_sequence") {
    fs::remove_all(directory_);
    physics_.step.substeps = 1;
    options_.relaxation.settle_seconds = 0.1;
    options_.relaxation.move_seconds = 0.2;
    options_.relaxation.hold_seconds = 0.1;
    options_.measurement.points = 1500;
    options_.measurement.noise = 0.002;
    options_.seed = 5;
    options_.config = "# how it was made\n";
  }
  ~ClothedSequenceTest() override { fs::remove_all(directory_); }

  ClothedSequenceResult Make() {
    return MakeClothedSequence({body_,
                                garment_,
                                material_,
                                motion_,
                                {"mannequin", "swing", "tank_top"}},
                               physics_,
                               options_,
                               directory_.string());
  }
  std::string File(const std::string& name) const {
    return (directory_ / name).string();
  }

  const BodyModel& body_;
  Garment garment_;
  Material material_;
  Motion motion_;
  fs::path directory_;
  SceneOptions physics_;
  ClothedSequenceOptions options_;
};

TEST_F(ClothedSequenceTest, LeavesPointsThatLieOnTheTruth) {
  const ClothedSequenceResult made = Make();
  ASSERT_EQ(made.status(), RunStatus::kComplete);
  EXPECT_EQ(made.sequence.frames, 3);

  const Truth truth = ReadTruth(File("truth.npz"));
  ASSERT_EQ(truth.body.num_frames(), 3);
  ASSERT_EQ(truth.cloth.size(), 3u);
  ASSERT_EQ(truth.cloth_velocities.size(), 3u);
  EXPECT_EQ(truth.body.poses[2], motion_.poses[2]);
  const BodyModel body = ReadBodyModel(File("body_model.npz"));
  const Garment garment = ReadGarment(File("garment.obj"));
  ASSERT_EQ(garment.faces, garment_.faces);
  const PointSequence points = ScanPointSequence(File("points"));
  ASSERT_EQ(points.files.size(), 3u);
  for (int t = 0; t < 3; ++t) {
    ASSERT_EQ(truth.cloth[t].cols(), garment.num_vertices());
    const SurfaceIndex cloth(truth.cloth[t], garment.faces);
    const TriangleMesh seen =
        FindVisibleSurface({body.Vertices(truth.body.Frame(t)), body.faces()},
                           cloth,
                           {.reach = 0.3})
            .mesh;
    // Distance to the surface: noise of 2 mm in three directions.
    const Points p = ReadPoints(points.files[t]);
    EXPECT_EQ(p.cols(), 1500);
    const double mean =
        DistancesToSurface(p, SurfaceIndex(seen.vertices, seen.faces)).mean();
    EXPECT_GT(mean, 0.001);
    EXPECT_LT(mean, 0.004);
  }
}

TEST_F(ClothedSequenceTest, TheSceneSaysWhatMadeIt) {
  ASSERT_EQ(Make().status(), RunStatus::kComplete);
  const auto json = nlohmann::json::parse(ReadFileBytes(File("scene.json")));
  EXPECT_EQ(json["fps"], 30);
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["seed"], 5);
  EXPECT_EQ(json["noise"]["sigma_m"], 0.002);
  EXPECT_EQ(json["garment_vertices"], garment_.num_vertices());
  EXPECT_EQ(ReadFileBytes(File("config.resolved.toml")), options_.config);
}

TEST_F(ClothedSequenceTest, RepeatsItselfAndReplacesOnlyIfForced) {
  ASSERT_EQ(Make().status(), RunStatus::kComplete);
  const Points points = ReadPoints(File("points/000002.ply"));
  const Truth truth = ReadTruth(File("truth.npz"));
  EXPECT_THROW(Make(), UsageError);
  WriteFileBytes(File("points/000009.ply"), "of a longer sequence");
  WriteFileBytes(File("mine.txt"), "kept");
  options_.force = true;
  ASSERT_EQ(Make().status(), RunStatus::kComplete);
  // The simulation repeats itself up to rounding, the measurement exactly.
  constexpr double kRounding = 1e-7;
  EXPECT_LT((ReadPoints(File("points/000002.ply")) - points)
                .lpNorm<Eigen::Infinity>(),
            kRounding);
  const Truth again = ReadTruth(File("truth.npz"));
  for (int t = 0; t < 3; ++t) {
    EXPECT_LT((again.cloth[t] - truth.cloth[t]).lpNorm<Eigen::Infinity>(),
              kRounding);
    EXPECT_LT((again.cloth_velocities[t] - truth.cloth_velocities[t])
                  .lpNorm<Eigen::Infinity>(),
              kRounding);
  }
  EXPECT_FALSE(fs::exists(File("points/000009.ply")));
  EXPECT_TRUE(fs::exists(File("mine.txt")));
}

TEST(WriteGarment, IsReadBackWithItsKindOfRestShape) {
  const std::string path = ::testing::TempDir() + "invsim_write_garment.obj";
  Points v(3, 4);
  v << 0, 0.2, 0.2, 0, 0, 0, 0.2, 0.2, 0, 0, 0.05, 0;
  Faces f(3, 2);
  f << 0, 0, 1, 2, 2, 3;
  Garment garment = GarmentFromRestMesh(v, f);
  for (const bool as_placed : {true, false}) {
    garment.rest_angles_from_placed = as_placed;
    WriteGarment(path, garment);
    const Garment read = ReadGarment(path);
    EXPECT_EQ(read.rest_angles_from_placed, as_placed);
    EXPECT_EQ(read.placed, garment.placed);
    EXPECT_TRUE(read.rest.isApprox(garment.rest));
  }
  fs::remove(path);
}

}  // namespace
}  // namespace invsim
