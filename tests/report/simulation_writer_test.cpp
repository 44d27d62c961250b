// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/simulation_writer.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "invsim/io/file.h"
#include "invsim/io/pc2.h"
#include "invsim/io/ply.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

class SimulationWriterTest : public testing::Test {
 protected:
  SimulationWriterTest()
      : root_(fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(root_);
  }
  ~SimulationWriterTest() override { fs::remove_all(root_); }

  // The sheet falls onto the ball for `frames` of `wanted` frames.
  SimulationReport Simulate(int frames,
                            int wanted,
                            const FrameWriterOptions& options) {
    Simulator simulator(MakeSetup({}, body_, sheet_, material_));
    const RunFolder folder(root_.string(), false);
    FrameWriter writer(
        folder, sheet_, material_, body_.faces(), wanted, 30, options);
    SimulationReport report;
    report.frames_wanted = wanted;
    report.frames_per_second = 30;
    ClothState state{sheet_.placed, 0 * sheet_.placed};
    const Points still = body_.Vertices({});
    StepStats unused;
    simulator.Advance(still, still, 1 / 30.0, &state, &unused);
    report.sequence = SimulateSequence(
        &simulator,
        [&](int) { return still; },
        frames,
        30,
        &state,
        [&](const SimulatedFrame& f) { writer.AddFrame(f); });
    WriteSimulation(folder, &writer, &report);
    last_ = state;
    force_ = simulator.contact_force();
    return report;
  }

  fs::path root_;
  BodyModel body_ = BallBody();
  Garment sheet_ = SheetAboveBall(5, 0.25);
  Material material_ = PlainCloth();
  ClothState last_;
  Points force_;
};

TEST_F(SimulationWriterTest, WritesEveryFileOfTheRunFolder) {
  Simulate(4, 4, {});
  for (const char* file : {"report.json",
                           "report.html",
                           "solver.txt",
                           "cloth.pc2",
                           "scene.glb",
                           "body/000003.ply",
                           "cloth/000000.ply"})
    EXPECT_TRUE(fs::is_regular_file(root_ / file)) << file;
  EXPECT_FALSE(fs::exists(root_ / "cloth/000004.ply"));
}

TEST_F(SimulationWriterTest, FramesHoldTheStateForcesAndPressure) {
  const SimulationReport report = Simulate(4, 4, {});
  const PlyMesh cloth = ReadPly((root_ / "cloth/000003.ply").string());
  EXPECT_LT((cloth.vertices - last_.x).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((*cloth.Find("vy") - last_.v.row(1).transpose()).norm(), 1e-5);
  EXPECT_LT((*cloth.Find("fy") - force_.row(1).transpose()).norm(), 1e-5);
  const PlyMesh body = ReadPly((root_ / "body/000003.ply").string());
  EXPECT_EQ(body.faces, body_.faces());
  EXPECT_GT(body.Find("pressure")->maxCoeff(), 0);
  EXPECT_GE(body.Find("pressure")->minCoeff(), -1);
  EXPECT_EQ(ReadPc2((root_ / "cloth.pc2").string()).samples.size(), 4u);
  EXPECT_EQ(report.frames.size(), 4u);
  EXPECT_GT(report.stress[3], 0);
}

TEST_F(SimulationWriterTest, KeepsTheFramesDoneAndThinsThosePictured) {
  FrameWriterOptions options;
  options.most_poses = 3;  // of 6: every second
  options.ply = false;
  Simulate(5, 6, options);
  EXPECT_FALSE(fs::exists(root_ / "cloth"));
  EXPECT_EQ(ReadPc2((root_ / "cloth.pc2").string()).samples.size(), 5u);
  const std::string page = ReadFileBytes((root_ / "report.html").string());
  EXPECT_THAT(page, testing::HasSubstr("\"times\":[0.0,0.0666"));
  EXPECT_THAT(page, testing::HasSubstr("0.1333333"));
}

TEST_F(SimulationWriterTest, WithoutAnyFrameStillSaysWhy) {
  const RunFolder folder(root_.string(), false);
  FrameWriter writer(folder, sheet_, material_, body_.faces(), 4, 30, {});
  SimulationReport report;
  report.frames_wanted = 4;
  report.relaxation.status = RunStatus::kFailed;
  WriteSimulation(folder, &writer, &report);
  EXPECT_THAT(ReadFileBytes((root_ / "solver.txt").string()),
              testing::HasSubstr("Failed"));
  EXPECT_TRUE(fs::exists(root_ / "report.html"));
  EXPECT_FALSE(fs::exists(root_ / "cloth.pc2"));
}

}  // namespace
}  // namespace invsim
