// SPDX-License-Identifier: Apache-2.0

// invsim init and invsim fit as a user runs them.

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "fit/dressed_mannequin.h"
#include "invsim/base/random.h"
#include "invsim/base/stopwatch.h"
#include "invsim/body/motion.h"
#include "invsim/io/ply.h"
#include "run_command.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kInput = 3, kUsage = 2, kStoppedEarly = 4, kInterrupted = 130;
constexpr int kPoints = 500;

void WritePoints(const fs::path& path, const Points& points) {
  PlyMesh mesh;
  mesh.vertices = points;
  WritePly(path.string(), mesh);
}

// A directory with the points of a mannequin whose trunk is clothed.
class FitCommandTest : public ::testing::Test {
 protected:
  FitCommandTest() : directory_(TestDirectory()), person_(0.015) {
    fs::create_directories(points());
    for (int t = 0; t < 4; ++t)
      WriteFrame(t, person_.Scan(Body(t), kPoints, t));
  }
  ~FitCommandTest() override { fs::remove_all(directory_); }

  fs::path points() const { return directory_ / "points"; }
  fs::path out() const { return directory_ / "run"; }
  fs::path Frame(int t) const {
    char name[32];
    std::snprintf(name, sizeof(name), "%06d.ply", t);
    return points() / name;
  }
  void WriteFrame(int t, const Points& cloud) { WritePoints(Frame(t), cloud); }

  static BodyParameters Body(int t) {
    BodyParameters p;
    p.pose[3 * 16 + 2] = -0.9 + 0.02 * t;  // arms down
    p.pose[3 * 17 + 2] = 0.9;
    p.translation = Vector3d(0.01 * t, 0.02, 0);
    return p;
  }

  // As small as it can be.
  std::string Arguments(const std::string& more = "") const {
    return "--points '" + points().string() +
           "' --body mannequin --garment tank_top --out '" + out().string() +
           "' -q --set input.edge=0.06 --set step.substeps=1"
           " --set init.headings=2 --set init.anchors=1"
           " --set init.iterations=3 --set relaxation.settle_seconds=0.1"
           " --set relaxation.move_seconds=0.3"
           " --set relaxation.hold_seconds=0.1 --set lm.iterations=2"
           " --set fit.dressings=1"
           // Of two steps none is to be refused as too long.
           " --set lm.radius=1 " +
           more;
  }
  void ExpectRefused(const std::string& command,
                     int code,
                     const ::testing::Matcher<std::string>& message) {
    const CommandResult result = RunCommand(command);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_THAT(result.err, message);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1)
        << result.err;
    EXPECT_EQ(result.out, "");
  }
  nlohmann::json Report() const {
    return nlohmann::json::parse(
        ReadFileBytes((out() / "report.json").string()));
  }

  fs::path directory_;
  DressedMannequin person_;
};

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

TEST_F(FitCommandTest, AnInterruptLeavesACheckpoint) {
  const CommandResult result =
      RunCommand("fit " +
                 Arguments("--set lm.iterations=200 "
                           "--set lm.function_tolerance=0 "
                           "--set lm.refused_steps=0") +
                 " & pid=$!; sleep 1; kill -INT $pid; wait $pid");
  EXPECT_EQ(result.exit_code, kInterrupted) << result.err;
  EXPECT_TRUE(fs::is_directory(out() / "checkpoint"));
  EXPECT_FALSE(fs::exists(out() / "report.json"));
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
  ExpectRefused("fit " + Arguments(), kInput, HasSubstr(Frame(1).string()));
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
  ExpectRefused("fit " + Arguments(), kInput, HasSubstr(Frame(1).string()));
  const CommandResult result = RunCommand(
      "init " + Arguments("--frames 2 --set input.drop_non_finite=true"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
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
  const CommandResult result = RunCommand("init " + Arguments("--frames 2"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
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
      RunCommand("init " + Arguments("--frames 1 --up y --units m"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const double angle : ReadMotion((out() / "body.npz").string()).poses[0])
    EXPECT_TRUE(std::isfinite(angle));
}

TEST_F(FitCommandTest, FindsThePersonAmongHalfOutliers) {
  Points cloud = person_.Scan(Body(0), 2 * kPoints, 0);
  Random random(2);
  for (int i = 0; i < cloud.cols(); i += 2)
    for (int c = 0; c < 3; ++c) cloud(c, i) += 0.2 * (2 * random.Uniform() - 1);
  WriteFrame(0, cloud);
  const CommandResult result = RunCommand("init " + Arguments("--frames 1"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Motion body = ReadMotion((out() / "body.npz").string());
  const Points found = person_.body().Joints(body.Frame(0));
  EXPECT_LT((found - person_.body().Joints(Body(0))).colwise().norm().mean(),
            0.1);
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

// Body and cloth of a run.
struct Outcome {
  explicit Outcome(const fs::path& run)
      : body(ReadMotion((run / "body.npz").string())),
        cloth(ReadPly((run / "cloth/000001.ply").string()).vertices) {}
  Motion body;
  Points cloth;
};

// To the last bit.
void ExpectSame(const Outcome& a, const Outcome& b, const std::string& what) {
  for (int t = 0; t < a.body.num_frames(); ++t) {
    const BodyParameters p = a.body.Frame(t), q = b.body.Frame(t);
    EXPECT_EQ(p.shape, q.shape) << what;
    EXPECT_EQ(p.pose, q.pose) << what;
    EXPECT_EQ(p.translation, q.translation) << what;
  }
  EXPECT_EQ(a.cloth, b.cloth) << what;
}

// The same numbers in every run, on one thread and on two.
TEST_F(FitCommandTest, RepeatsItself) {
  const auto run = [&](const std::string& threads) {
    EXPECT_EQ(
        RunCommand("fit --force " + Arguments("--frames 2 --set fit.dressings=2"
                                              " --threads " +
                                              threads))
            .exit_code,
        kStoppedEarly);
    // All of the report but times and the threads asked for.
    std::map<std::string, nlohmann::json> numbers;
    const nlohmann::json report = Report().flatten();
    for (const auto& [key, value] : report.items())
      if (key.find("seconds") == std::string::npos && key != "/inputs/threads")
        numbers[key] = value;
    EXPECT_GT(numbers.size(), 50u);
    return std::make_pair(Outcome(out()), numbers);
  };
  const auto [one, report] = run("1");
  for (const std::string threads : {"1", "2", "2"}) {
    const auto [again, report_again] = run(threads);
    ExpectSame(one, again, threads + " threads");
    for (const auto& [key, value] : report)
      EXPECT_EQ(value, report_again.at(key)) << key << ", " << threads;
  }
}

// Whenever a fit is killed, what it left is enough to end alike.
// INVSIM_KILLS=50 for more kills than the suite has time for.
TEST_F(FitCommandTest, GoesOnAfterBeingKilled) {
  const char* asked = std::getenv("INVSIM_KILLS");
  const int kills = asked ? std::atoi(asked) : 4;
  // Also while it is dressed, and optimised, for the second time.
  const std::string arguments = Arguments("--frames 2 --set fit.dressings=2");
  const Stopwatch watch;
  ASSERT_EQ(RunCommand("fit " + arguments).exit_code, kStoppedEarly);
  const double whole = watch.seconds();
  const Outcome expected(out());
  Random random(11);
  int resumed = 0;
  for (int k = 0; k < kills; ++k) {
    fs::remove_all(out());
    const std::string at = std::to_string(random.Uniform(0.1, 0.95) * whole);
    const std::string line = "timeout -s KILL " + at +
                             " '" INVSIM_COMMAND "' fit " + arguments +
                             " >/dev/null 2>&1";
    static_cast<void>(std::system(line.c_str()));
    CommandResult result =
        RunCommand("fit --resume -q --out '" + out().string() + "'");
    if (result.exit_code == kUsage) {  // killed before there was anything
      EXPECT_THAT(result.err, HasSubstr("no run to resume"));
      result = RunCommand("fit --force " + arguments);
    } else {
      ++resumed;
    }
    ASSERT_EQ(result.exit_code, kStoppedEarly)
        << "killed at " << at << " s: " << result.err;
    ExpectSame(Outcome(out()), expected, "killed at " + at + " s");
  }
  EXPECT_GT(resumed, 0);
}

// Files that may not grow stand for a full disk.
TEST_F(FitCommandTest, KeepsTheCheckpointWhenTheDiskIsFull) {
  const std::string arguments = Arguments("--frames 2");
  ASSERT_EQ(RunCommand("fit " + arguments).exit_code, kStoppedEarly);
  const Outcome expected(out());
  fs::remove_all(out());
  const fs::path log = directory_ / "log";
  // The checkpoint's files are small, the results larger; ulimit counts
  // blocks of 512 bytes.
  const std::string line = "trap '' XFSZ; ulimit -f 48; '" INVSIM_COMMAND
                           "' fit " +
                           arguments + " >/dev/null 2>'" + log.string() + "'";
  const int status = std::system(line.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), kInput);
  const std::string message = ReadFileBytes(log.string());
  EXPECT_THAT(message, HasSubstr(out().string()));
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  const CommandResult resumed =
      RunCommand("fit --resume -q --out '" + out().string() + "'");
  EXPECT_EQ(resumed.exit_code, kStoppedEarly) << resumed.err;
  ExpectSame(Outcome(out()), expected, "disk full");
}

}  // namespace
}  // namespace invsim
