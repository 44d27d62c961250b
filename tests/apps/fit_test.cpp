// SPDX-License-Identifier: Apache-2.0

// invsim init and invsim fit as a user runs them.

#include <cmath>
#include <fstream>
#include <regex>
#include <utility>
#include <vector>

#include "../../apps/exit_code.h"
#include "fit_command.h"
#include "invsim/base/random.h"
#include "invsim/base/stopwatch.h"
#include "invsim/body/motion.h"
#include "invsim/io/obj.h"
#include "invsim/io/ply.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(FitCommandTest, PresetStandsBelowWhatIsSetByHand) {
  ExpectRefused("fit " + Arguments("--preset quick"),
                kUsage,
                HasSubstr("expected one of draft, balanced, precise"));
  // But for the number of iterations, which is set by hand too.
  std::string arguments = Arguments("--frames 1 --preset draft");
  const std::string iterations = " --set lm.iterations=2 --set fit.dressings=1";
  arguments.erase(arguments.find(iterations), iterations.size());
  const CommandResult result = RunCommand("init " + arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(ReadFileBytes((out() / "config.resolved.toml").string()),
              AllOf(HasSubstr("iterations = 3  # preset draft"),
                    HasSubstr("dressings = 1  # preset draft"),
                    HasSubstr("substeps = 1  # --set"),  // the preset says 2
                    HasSubstr("preset = \"draft\"  # --preset")));
}

TEST_F(FitCommandTest, WritesTheRunFolder) {
  const CommandResult result = RunCommand("fit " + Arguments("--frames 2"));
  // Two iterations do not converge.
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  for (const char* file : {"report.json",
                           "report.html",
                           "solver.txt",
                           "iterations.csv",
                           "config.resolved.toml",
                           "body.npz",
                           "cloth.pc2",
                           "body/000001.ply",
                           "cloth/000001.ply",
                           "checkpoint/evaluations_1.bin"})
    EXPECT_TRUE(fs::is_regular_file(out() / file)) << file;
  const nlohmann::json report = Report();
  EXPECT_EQ(report["schema"], "invsim.fit");
  EXPECT_TRUE(report["usable"]);
  EXPECT_LT(report["optimization"]["final_cost"],
            report["optimization"]["initial_cost"]);
  EXPECT_EQ(report["uncertainty"]["frames"].size(), 2u);
  const Motion body = ReadMotion((out() / "body.npz").string());
  EXPECT_EQ(body.num_frames(), 2);
  // It is the person: every joint within 10 cm.
  const Points found = person_.body().Joints(body.Frame(1));
  const Points truth = person_.body().Joints(Body(1));
  EXPECT_LT((found - truth).colwise().norm().mean(), 0.06);
  EXPECT_NE(ReadPly((out() / "cloth/000000.ply").string()).Find("distance"),
            nullptr);
  EXPECT_THAT(ReadFileBytes((out() / "solver.txt").string()),
              AllOf(HasSubstr("History of one frame"),
                    HasSubstr("Solver Summary"),
                    HasSubstr("points to surface")));

  // Nothing is replaced unasked.
  ExpectRefused("fit " + Arguments("--frames 2"),
                kUsage,
                AllOf(HasSubstr(out().string()), HasSubstr("--force")));

  // What is resumed with more iterations goes on from the same numbers.
  const double cost = report["optimization"]["final_cost"];
  const CommandResult resumed = RunCommand(
      "fit --resume -q --out '" + out().string() + "' --set lm.iterations=3");
  EXPECT_THAT(resumed.exit_code, ::testing::AnyOf(0, kStoppedEarly))
      << resumed.err;
  EXPECT_LE(Report()["optimization"]["final_cost"], cost);
  std::ifstream csv(out() / "iterations.csv");
  std::string line, third;
  for (int k = 0; k < 4 && std::getline(csv, line); ++k) third = line;
  EXPECT_THAT(third, StartsWith("1,2,"));
  EXPECT_NEAR(std::stod(third.substr(6)), cost, 1e-9 * cost);
  ExpectRefused(
      "fit --resume -q --out '" + out().string() + "' --set step.substeps=2",
      kUsage,
      HasSubstr("step.substeps is 2, but was 1"));
}

TEST_F(FitCommandTest, InitStopsBeforeTheInverseSimulation) {
  const CommandResult result = RunCommand("init " + Arguments("--frames 1"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_FALSE(Report().contains("optimization"));
  EXPECT_TRUE(fs::is_regular_file(out() / "cloth/000000.ply"));
  // Its body is a start.
  fs::rename(out() / "body.npz", directory_ / "start.npz");
  ExpectRefused(
      "fit --force " +
          Arguments("--start '" + (directory_ / "start.npz").string() + "'"),
      kInput,
      AllOf(HasSubstr("has 1 frames"), HasSubstr("4")));
}

TEST_F(FitCommandTest, ATimeLimitEndsUsable) {
  const CommandResult result =
      RunCommand("fit " + Arguments("--frames 1 --time-limit 0.01"));
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_EQ(Report()["status"], "time limit");
  EXPECT_TRUE(fs::is_regular_file(out() / "cloth/000000.ply"));
}

TEST_F(FitCommandTest, ItsExitCodeSaysHowItEnded) {
  const std::vector<std::pair<Termination, int>> codes = {
      {Termination::kConverged, 0},
      {Termination::kIterationLimit, 4},
      {Termination::kTimeLimit, 4},
      {Termination::kGivenUp, 4},
      {Termination::kFailed, 5},
      {Termination::kStalled, 6},
      {Termination::kInterrupted, 130}};
  for (const auto& [termination, code] : codes)
    EXPECT_EQ(static_cast<int>(CodeOf(termination)), code) << Name(termination);

  CommandResult result = RunCommand(
      "fit " + Arguments("--frames 1 --set lm.function_tolerance=0.99"));
  EXPECT_EQ(result.exit_code, kOk) << result.err;
  EXPECT_EQ(Report()["status"], "converged");

  result = RunCommand(
      "fit --force " +
      Arguments("--frames 1 "
                "--set 'effects.gravity.acceleration=[0,-1e300,0]'"));
  EXPECT_EQ(result.exit_code, kFailed) << result.err;
  EXPECT_EQ(Report()["status"], "failed");
  EXPECT_FALSE(Report()["usable"]);
}

TEST_F(FitCommandTest, TellsHowFarItIs) {
  std::string arguments = Arguments("--frames 1");
  arguments.erase(arguments.find(" -q"), 3);
  const CommandResult result = RunCommand("fit " + arguments);
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  // Lines in this order; the start counts as an iteration.
  size_t at = 0;
  for (const std::string line :
       {"initialisation 1/[0-9]+  eta [0-9]+:[0-9]+  searched frame 0",
        "initialisation 2/[0-9]+  eta [0-9]+:[0-9]+  all frames, iteration 0",
        "dressing 1/[0-9]+  eta [0-9]+:[0-9]+  settle",
        "iterations 1/3  eta [0-9]+:[0-9]+  cost [0-9.e+]+",
        "iterations 2/3  eta [0-9]+:[0-9]+  cost [0-9.e+]+",
        "iterations 3/3  in [0-9]+:[0-9]+  cost [0-9.e+]+",
        "final simulation 1/1  in [0-9]+:[0-9]+"}) {
    std::smatch match;
    const std::string rest = result.err.substr(at);
    ASSERT_TRUE(std::regex_search(rest, match, std::regex("\n" + line)) ||
                (at == 0 && std::regex_search(rest, match, std::regex(line))))
        << line << " is not in\n"
        << rest;
    at += match.position() + match.length();
  }
}

TEST_F(FitCommandTest, SaysWhatIsMissing) {
  ExpectRefused("fit --body mannequin --garment tank_top",
                kUsage,
                HasSubstr("--points is missing"));
  ExpectRefused("fit --points '" + points().string() + "' --garment tank_top",
                kUsage,
                HasSubstr("--body is missing"));
  ExpectRefused("fit --resume --out '" + out().string() + "'",
                kUsage,
                HasSubstr("no run to resume"));
}

TEST_F(FitCommandTest, RefusesAnEmptyFrame) {
  WriteFrame(1, Points(3, 0));
  ExpectRefused(
      "fit " + Arguments(),
      kInput,
      AllOf(HasSubstr(Frame(1).string()), HasSubstr("expected at least one")));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(FitCommandTest, RefusesASinglePoint) {
  WriteFrame(1, Points::Ones(3, 1));
  ExpectRefused("fit " + Arguments(),
                kInput,
                AllOf(HasSubstr(Frame(1).string() + ": has 1 point"),
                      HasSubstr("at least 50")));
}

TEST_F(FitCommandTest, RefusesPointsThatAreNotFiniteUnlessToldTo) {
  Points cloud = person_.Scan(Body(1), kPoints, 1);
  cloud(1, 7) = NAN;
  WriteFrame(1, cloud);
  ExpectRefused("fit " + Arguments(),
                kInput,
                AllOf(HasSubstr(Frame(1).string()),
                      HasSubstr("1 of 500 points are not finite, the first is "
                                "point 7")));
  const CommandResult result = RunCommand(
      "fit " + Arguments("--frames 2 --set input.drop_non_finite=true"));
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_EQ(Report()["inputs"]["points_dropped"], 1);
}

TEST_F(FitCommandTest, RefusesTheWrongUnit) {
  for (int t = 0; t < 4; ++t)
    WriteFrame(t, 1000 * person_.Scan(Body(t), kPoints, t));
  ExpectRefused("fit " + Arguments(),
                kInput,
                AllOf(HasSubstr(Frame(0).string()), HasSubstr("--units mm")));
  const CommandResult result =
      RunCommand("init " + Arguments("--frames 1 --units mm"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(FitCommandTest, RefusesPointsWithZUp) {
  for (int t = 0; t < 4; ++t) {
    const Points y_up = person_.Scan(Body(t), kPoints, t);
    Points z_up(3, y_up.cols());
    z_up << y_up.row(0), -y_up.row(2), y_up.row(1);
    WriteFrame(t, z_up);
  }
  ExpectRefused("fit " + Arguments(),
                kInput,
                AllOf(HasSubstr(Frame(0).string()), HasSubstr("--up z")));
  const CommandResult result =
      RunCommand("init " + Arguments("--frames 1 --up z"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(FitCommandTest, RefusesAGapInTheSequence) {
  fs::remove(Frame(1));
  ExpectRefused("fit " + Arguments(),
                kInput,
                AllOf(HasSubstr(points().string()), HasSubstr("missing")));
}

TEST_F(FitCommandTest, TakesFramesOfDifferentCounts) {
  WriteFrame(1, person_.Scan(Body(1), 2 * kPoints, 1));
  const CommandResult result = RunCommand("fit " + Arguments("--frames 2"));
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_THAT(result.out, StartsWith("Iteration limit"));
  EXPECT_EQ(Report()["inputs"]["points_per_frame_min"], kPoints);
  EXPECT_EQ(Report()["inputs"]["points_per_frame_max"], 2 * kPoints);
}

// The lower half of the body was not measured.
TEST_F(FitCommandTest, EndsInOrderWithHalfTheBodyMissing) {
  const Points cloud = person_.Scan(Body(0), 2 * kPoints, 0);
  std::vector<int> upper;
  for (int i = 0; i < cloud.cols(); ++i)
    if (cloud(1, i) > cloud.row(1).mean()) upper.push_back(i);
  WriteFrame(0, cloud(Eigen::all, upper));
  const CommandResult result =
      RunCommand("fit " + Arguments("--frames 1 --up y --units m"));
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_TRUE(Report()["usable"]);
  for (const double angle : ReadMotion((out() / "body.npz").string()).poses[0])
    EXPECT_TRUE(std::isfinite(angle));
}

TEST_F(FitCommandTest, FindsThePersonAmongHalfOutliers) {
  Points cloud = person_.Scan(Body(0), 2 * kPoints, 0);
  Random random(2);
  for (int i = 0; i < cloud.cols(); i += 2)
    for (int c = 0; c < 3; ++c) cloud(c, i) += 0.2 * (2 * random.Uniform() - 1);
  WriteFrame(0, cloud);
  const CommandResult result = RunCommand("fit " + Arguments("--frames 1"));
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_TRUE(Report()["usable"]);
  const Motion body = ReadMotion((out() / "body.npz").string());
  const Points found = person_.body().Joints(body.Frame(0));
  EXPECT_LT((found - person_.body().Joints(Body(0))).colwise().norm().mean(),
            0.1);
}

// Smoothness in time needs three frames; with fewer there is a line about it.
TEST_F(FitCommandTest, SaysThatOneFrameIsNotSmoothed) {
  std::string arguments = Arguments("--frames 1");
  arguments.erase(arguments.find(" -q "), 3);
  const CommandResult result = RunCommand("fit " + arguments);
  EXPECT_EQ(result.exit_code, kStoppedEarly) << result.err;
  EXPECT_THAT(result.err, HasSubstr("1 frame: smoothness in time needs three"));
}

TEST_F(FitCommandTest, RefusesAGarmentOfTheWrongSize) {
  const fs::path path = directory_ / "vest.obj";
  ASSERT_EQ(RunCommand("synth garment --name tank_top --edge 0.06 --out '" +
                       path.string() + "'")
                .exit_code,
            0);
  const ObjMesh vest = ReadObj(path.string());
  const auto expect = [&](double scale, const std::string& message) {
    ObjMesh scaled = vest;
    scaled.vertices *= scale;
    WriteObj(path.string(), scaled);
    ExpectRefused("fit --points '" + points().string() +
                      "' --body mannequin --garment '" + path.string() + "'",
                  kInput,
                  AllOf(HasSubstr(path.string()), HasSubstr(message)));
  };
  expect(0.01, "m across, expected 0.02 to 5 m");
  expect(100, "m across, expected 0.02 to 5 m");
  expect(0.6, "vertices are inside the body; expected a garment placed around");
}

// One reflection 20 m away, of 500 points.
TEST_F(FitCommandTest, AStrayPointIsNoReasonToRefuse) {
  Points cloud = person_.Scan(Body(0), kPoints, 0);
  cloud.col(17) = Vector3d(0, 0, 20);
  WriteFrame(0, cloud);
  const CommandResult result = RunCommand("init " + Arguments("--frames 1"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Motion body = ReadMotion((out() / "body.npz").string());
  const Points found = person_.body().Joints(body.Frame(0));
  EXPECT_LT((found - person_.body().Joints(Body(0))).colwise().norm().mean(),
            0.1);
}

TEST_F(FitCommandTest, EveryFrameIsLookedAt) {
  WriteFrame(2, 100 * person_.Scan(Body(2), kPoints, 2));
  ExpectRefused("fit " + Arguments(),
                kInput,
                AllOf(HasSubstr(Frame(2).string()), HasSubstr("--units cm")));
  // Nor is it taken because another frame's unit was said, or a start given.
  Motion start;
  for (int t = 0; t < 4; ++t) {
    start.poses.push_back(Body(t).pose);
    start.translations.push_back(Body(t).translation);
  }
  WriteMotion((directory_ / "start.npz").string(), start);
  ExpectRefused("fit " + Arguments("--units m --start '" +
                                   (directory_ / "start.npz").string() + "'"),
                kInput,
                AllOf(HasSubstr(Frame(2).string()),
                      HasSubstr("no person in m; expected at most 5 m")));
}

TEST_F(FitCommandTest, FiltersLeaveAPersonAndSayWhatTheyTook) {
  const std::string far =
      " --set input.filter.outlier_neighbours=8 "
      "--set input.filter.outlier_deviations=3";
  Points cloud = person_.Scan(Body(0), kPoints, 0);
  for (int k = 0; k < 25; ++k) cloud.col(20 * k) += Vector3d(k - 12, 9 + k, 4);
  WriteFrame(0, cloud);
  ExpectRefused("fit " + Arguments(), kInput, HasSubstr(Frame(0).string()));
  const CommandResult result =
      RunCommand("init " + Arguments("--frames 1" + far));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json inputs = Report()["inputs"];
  EXPECT_GE(inputs["points_filtered"], 20);
  EXPECT_EQ(inputs["points_filtered"].get<int>() +
                inputs["points_per_frame_max"].get<int>(),
            kPoints);
  EXPECT_THAT(ReadFileBytes((out() / "solver.txt").string()),
              HasSubstr("points filtered"));
  ExpectRefused("fit --force " + Arguments("--set input.filter.voxel=10" + far),
                kInput,
                AllOf(HasSubstr(Frame(0).string()),
                      HasSubstr("input.filter.voxel leaves"),
                      HasSubstr("of 500 points, expected at least 50")));
}

TEST_F(FitCommandTest, RefusesAGarmentOfAnotherBody) {
  std::ofstream(directory_ / "far.obj")
      << "v 3 0 0\nv 3.1 0 0\nv 3 0.1 0\nf 1 2 3\n";
  ExpectRefused("fit --points '" + points().string() +
                    "' --body mannequin --garment '" +
                    (directory_ / "far.obj").string() + "'",
                kInput,
                AllOf(HasSubstr("far.obj"), HasSubstr("T-posed body")));
}

TEST_F(FitCommandTest, RefusesAnUnwritableFolder) {
  std::ofstream(directory_ / "file") << "x";
  ExpectRefused("fit --points '" + points().string() +
                    "' --body mannequin --garment tank_top --out '" +
                    (directory_ / "file" / "run").string() + "'",
                kInput,
                HasSubstr("cannot be used for the results"));
}

}  // namespace
}  // namespace invsim
