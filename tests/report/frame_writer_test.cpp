// SPDX-License-Identifier: Apache-2.0
// Beyond what simulation_writer_test.cpp shows of a whole run.
#include "invsim/report/frame_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "invsim/base/config.h"
#include "invsim/base/error.h"
#include "invsim/base/options.h"
#include "invsim/io/file.h"
#include "invsim/io/pc2.h"
#include "invsim/io/ply.h"
#include "invsim/sim/fields.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

// The JSON of a GLB file.
nlohmann::json SceneJson(const std::string& bytes) {
  std::uint32_t size;
  std::memcpy(&size, bytes.data() + 12, sizeof(size));
  return nlohmann::json::parse(bytes.substr(20, size));
}

class FrameWriterTest : public ::testing::Test {
 protected:
  FrameWriterTest()
      : root_(fs::path(testing::TempDir()) /
              (std::string("frame_writer_") +
               testing::UnitTest::GetInstance()->current_test_info()->name())),
        simulator_(MakeSetup({}, body_, sheet_, material_)) {
    fs::remove_all(root_);
    folder_.emplace(root_.string(), false);
    ClothState state = Cloth(0);
    StepStats unused;
    simulator_.Advance(still_, still_, 1e-3, &state, &unused);
  }
  ~FrameWriterTest() override { fs::remove_all(root_); }

  FrameWriter Writer(int frames_wanted, const FrameWriterOptions& options) {
    return {*folder_,
            sheet_,
            material_,
            body_.faces(),
            frames_wanted,
            kRate,
            options};
  }
  // Stretched by a hundredth more in each frame, and that much higher.
  ClothState Cloth(int frame) const {
    ClothState state{sheet_.placed, 0 * sheet_.placed};
    state.x *= 1 + 0.01 * frame;
    return state;
  }
  void Add(FrameWriter* writer, int frame, const Points* measured = nullptr) {
    const ClothState state = Cloth(frame);
    FrameStats stats;
    stats.step.substeps = 100 + frame;
    writer->AddFrame({frame, still_, state, simulator_, stats}, measured);
  }

  static constexpr double kRate = 25;
  fs::path root_;
  std::optional<RunFolder> folder_;
  BodyModel body_ = BallBody();
  Garment sheet_ = SheetAboveBall(3, 0.25);
  Material material_ = PlainCloth();
  Points still_ = body_.Vertices({});
  Simulator simulator_;
};

TEST_F(FrameWriterTest, KeepsWhatEachFrameTook) {
  FrameWriter writer = Writer(3, {.ply = false});
  for (int t = 0; t < 3; ++t) Add(&writer, t);
  ASSERT_EQ(writer.stats().size(), 3u);
  for (int t = 0; t < 3; ++t)
    EXPECT_EQ(writer.stats()[t].step.substeps, 100 + t);
}

// The same stretch everywhere is the same stress everywhere: the 99th
// percentile is that of any vertex.
TEST_F(FrameWriterTest, StressIsThatOfTheCloth) {
  FrameWriter writer = Writer(3, {.ply = false});
  for (int t = 0; t < 3; ++t) Add(&writer, t);
  ASSERT_EQ(writer.stress().size(), 3u);
  EXPECT_NEAR(writer.stress()[0], 0, 1e-9);
  for (int t = 1; t < 3; ++t) {
    const VectorXd stress =
        MeasureCloth(sheet_, material_.stretch, Cloth(t).x).stress;
    EXPECT_GT(stress.minCoeff(), 1);
    EXPECT_NEAR(writer.stress()[t], stress.mean(), 1e-9 * stress.mean());
  }
}

// Points 3 mm above each vertex.
TEST_F(FrameWriterTest, DistancesToThePointsAreKnown) {
  Points measured = Cloth(1).x;
  measured.row(1).array() += 0.003;
  FrameWriter writer = Writer(2, {});
  Add(&writer, 1, &measured);
  const PlyMesh cloth = ReadPly((root_ / "cloth/000001.ply").string());
  const VectorXd* distance = cloth.Find("distance");
  ASSERT_TRUE(distance);
  EXPECT_LT((distance->array() - 0.003).abs().maxCoeff(), 1e-7);
  WebPage page;
  writer.AddViewer(&page);
  EXPECT_EQ(page.meshes[0].quantity, "distance to the points [mm]");
  EXPECT_LT((page.meshes[0].values[0].array() - 3).abs().maxCoeff(), 1e-9);
}

// And to the nearest of them, not to that of its own number.
TEST_F(FrameWriterTest, DistancesAreToTheNearestPoint) {
  Points measured(3, 2);
  measured << Vector3d(100, 0, 0), Cloth(0).x.col(5);
  FrameWriter writer = Writer(2, {.ply = false});
  Add(&writer, 0, &measured);
  WebPage page;
  writer.AddViewer(&page);
  const VectorXd& mm = page.meshes[0].values[0];
  for (int i = 0; i < mm.size(); ++i)
    EXPECT_NEAR(
        mm[i], 1e3 * (Cloth(0).x.col(i) - measured.col(1)).norm(), 1e-9);
}

TEST_F(FrameWriterTest, WithoutPointsTheStressIsPictured) {
  FrameWriter writer = Writer(2, {});
  Add(&writer, 1);
  EXPECT_FALSE(ReadPly((root_ / "cloth/000001.ply").string()).Find("distance"));
  WebPage page;
  writer.AddViewer(&page);
  ASSERT_EQ(page.meshes.size(), 2u);
  EXPECT_EQ(page.meshes[0].name, "cloth");
  EXPECT_EQ(page.meshes[0].quantity, "stress [N/m]");
  EXPECT_EQ(page.meshes[0].faces, sheet_.faces);
  EXPECT_EQ(page.meshes[0].values[0],
            MeasureCloth(sheet_, material_.stretch, Cloth(1).x).stress);
  EXPECT_EQ(page.meshes[1].name, "body");
  EXPECT_EQ(page.meshes[1].faces, body_.faces());
  EXPECT_EQ(page.meshes[1].frames[0], still_);
}

// Never more than asked for, evenly, at the times at which they were.
TEST_F(FrameWriterTest, ALongSequenceIsPicturedThinned) {
  for (const auto& [wanted, every] :
       std::vector<std::pair<int, int>>{{3, 1}, {4, 2}, {6, 2}, {7, 3}}) {
    FrameWriter writer = Writer(wanted, {.ply = false, .most_poses = 3});
    for (int t = 0; t < wanted; ++t) Add(&writer, t);
    WebPage page;
    writer.AddViewer(&page);
    ASSERT_LE(page.times.size(), 3u) << wanted;
    ASSERT_EQ(page.meshes[0].frames.size(), page.times.size());
    ASSERT_EQ(page.meshes[1].values.size(), page.times.size());
    EXPECT_EQ(page.times.size(), static_cast<size_t>((wanted - 1) / every + 1));
    for (size_t k = 0; k < page.times.size(); ++k) {
      EXPECT_DOUBLE_EQ(page.times[k], k * every / kRate);
      EXPECT_EQ(page.meshes[0].frames[k], Cloth(static_cast<int>(k) * every).x);
    }
  }
}

// The film lasts as long as the motion did, all frames or some.
TEST_F(FrameWriterTest, TheSceneLastsAsLongAsTheSequence) {
  for (const int poses : {3, 7}) {
    FrameWriter writer = Writer(7, {.ply = false, .most_poses = poses});
    for (int t = 0; t < 7; ++t) Add(&writer, t);
    writer.WriteSequence();
    EXPECT_EQ(ReadPc2((root_ / "cloth.pc2").string()).samples.size(), 7u);
    const nlohmann::json scene =
        SceneJson(ReadFileBytes((root_ / "scene.glb").string()));
    const int times = scene["animations"][0]["samplers"][0]["input"].get<int>();
    EXPECT_NEAR(scene["accessors"][times]["max"][0], 6 / kRate, 1e-6);
  }
}

// The formats' colours differ: what a screen shows is to be the same.
TEST_F(FrameWriterTest, TheSceneHasThePagesColours) {
  FrameWriter writer = Writer(2, {.ply = false});
  Add(&writer, 0);
  Add(&writer, 1);
  writer.WriteSequence();
  WebPage page;
  writer.AddViewer(&page);
  const nlohmann::json scene =
      SceneJson(ReadFileBytes((root_ / "scene.glb").string()));
  ASSERT_EQ(scene["meshes"].size(), 2u);
  for (const nlohmann::json& mesh : scene["meshes"]) {
    const PageMesh& shown = page.meshes[mesh["name"] == "cloth" ? 0 : 1];
    EXPECT_EQ(mesh["name"], shown.name);
    const int material = mesh["primitives"][0]["material"].get<int>();
    const nlohmann::json& linear =
        scene["materials"][material]["pbrMetallicRoughness"]["baseColorFactor"];
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(linear[k], std::pow(shown.color[k], 2.2), 1e-6);
  }
}

TEST_F(FrameWriterTest, OptionsAreNamedAndBounded) {
  FrameWriterOptions options;
  OptionTable table;
  Describe(&table, &options);
  table.Read(Config::FromText("ply = false\nmost_poses = 2", "f.toml"));
  EXPECT_FALSE(options.ply);
  EXPECT_EQ(options.most_poses, 2);
  // Of one frame nothing can be seen to move.
  EXPECT_THROW(table.Read(Config::FromText("most_poses = 1", "f.toml")),
               UsageError);
}

TEST_F(FrameWriterTest, NoFrameIsNoFileAndNoViewer) {
  FrameWriter writer = Writer(4, {});
  writer.WriteSequence();
  WebPage page;
  writer.AddViewer(&page);
  EXPECT_TRUE(page.meshes.empty());
  EXPECT_TRUE(fs::is_empty(root_));
}

}  // namespace
}  // namespace invsim
