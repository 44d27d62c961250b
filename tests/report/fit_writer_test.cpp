// SPDX-License-Identifier: Apache-2.0
// The files at the end of a fit; what they say is in the tests of fit_report,
// and the frames are in frame_writer_test.cpp.
#include "invsim/report/fit_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "invsim/body/motion.h"
#include "invsim/io/file.h"
#include "invsim/sim/scene.h"
#include "sim/test_scene.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

class FitWriterTest : public ::testing::Test {
 protected:
  FitWriterTest()
      : root_(fs::path(testing::TempDir()) /
              (std::string("fit_writer_") +
               testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(root_);
    report_.points = "scan/<points> & more";
    report_.frames_per_second = 12.5;
    report_.frames = 2;
    report_.cloth_vertices = sheet_.num_vertices();
    report_.optimizer = "dogleg";
    report_.effects = {{"gravity", true, "always", false},
                       {"air_drag", false, "too little", false},
                       {"bending", true, "stiff", false}};
    report_.seconds = 61.5;
    FitResult& r = report_.result;
    r.termination = Termination::kIterationLimit;
    r.simulated = true;
    r.stats.step.substeps = 4321;
    r.stats.step.missed = 17;
    const ShapeVector shape = ShapeVector::LinSpaced(-1, 1);
    for (int t = 0; t < 2; ++t)
      r.body.Append({shape,
                     PoseVector::LinSpaced(t, t + 0.5),
                     Vector3d(0.1, 0.2 * t, 0.3)});
    r.body.shape = shape;
  }
  ~FitWriterTest() override { fs::remove_all(root_); }

  // After so many frames of a sheet that lies still.
  void Write(int frames) {
    Simulator simulator(MakeSetup({}, body_, sheet_, material_));
    const RunFolder folder(root_.string(), false);
    FrameWriter writer(folder, sheet_, material_, body_.faces(), 2, 12.5, {});
    const ClothState cloth{sheet_.placed, 0 * sheet_.placed};
    const Points still = body_.Vertices({});
    for (int t = 0; t < frames; ++t) {
      FrameStats stats;
      stats.step.missed = t + 1;
      ClothState moved = cloth;
      StepStats unused;
      simulator.Advance(still, still, 1e-3, &moved, &unused);
      writer.AddFrame({t, still, cloth, simulator, stats});
    }
    WriteFit(folder, &writer, &report_);
  }
  std::string Text(const std::string& name) const {
    return ReadFileBytes((root_ / name).string());
  }

  fs::path root_;
  BodyModel body_ = BallBody();
  Garment sheet_ = SheetAboveBall(3, 0.25);
  Material material_ = PlainCloth();
  FitReport report_;
};

TEST_F(FitWriterTest, TheBodyIsReadBackAsItWasFound) {
  Write(2);
  const Motion motion = ReadMotion((root_ / "body.npz").string());
  EXPECT_EQ(motion.frame_rate, 12.5);
  EXPECT_EQ(motion.shape, report_.result.body.shape);
  EXPECT_EQ(motion.poses, report_.result.body.poses);
  EXPECT_EQ(motion.translations, report_.result.body.translations);
}

// The statistics of the frames written are those of the final simulation.
TEST_F(FitWriterTest, TheReportTakesOverWhatTheFramesShowed) {
  report_.simulated.resize(7);
  Write(2);
  ASSERT_EQ(report_.simulated.size(), 2u);
  EXPECT_EQ(report_.simulated[1].step.missed, 2);
  EXPECT_EQ(Text("report.json"), FitJson(report_));
  EXPECT_EQ(Text("solver.txt"), FitText(report_));
  EXPECT_EQ(Text("iterations.csv"), IterationsCsv(report_));
}

TEST_F(FitWriterTest, ThePageHasTheFactsEscaped) {
  Write(2);
  const std::string page = Text("report.html");
  EXPECT_THAT(page, HasSubstr("<h1>Fit: scan/&lt;points&gt; &amp; more</h1>"));
  EXPECT_THAT(page, Not(HasSubstr("<points>")));
  for (const char* fact : {"<td>frames</td><td>2</td>",
                           "<td>cloth</td><td>16 vertices</td>",
                           "<td>effects</td><td>gravity, bending</td>",
                           "<td>optimiser</td><td>dogleg</td>",
                           "<td>ended</td><td>iteration limit</td>",
                           "<td>simulation steps</td><td>4321</td>",
                           "<td>steps missed</td><td>17</td>",
                           "<td>time</td><td>61.5 s</td>"})
    EXPECT_THAT(page, HasSubstr(fact));
  EXPECT_THAT(page, HasSubstr("<canvas id=\"stage\">"));
  for (const Chart& chart : FitCharts(report_))
    EXPECT_THAT(page, HasSubstr(FormatSvg(chart)));
}

// A fit that failed before its final simulation still says so.
TEST_F(FitWriterTest, WithoutClothThereIsNoViewer) {
  report_.result.termination = Termination::kFailed;
  report_.result.simulated = false;
  Write(0);
  EXPECT_THAT(Text("report.html"), Not(HasSubstr("<canvas")));
  EXPECT_THAT(Text("report.html"), HasSubstr("<p>Failed, not usable"));
  EXPECT_FALSE(fs::exists(root_ / "cloth.pc2"));
  EXPECT_TRUE(fs::exists(root_ / "body.npz"));
}

}  // namespace
}  // namespace invsim
