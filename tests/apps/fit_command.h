// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_APPS_FIT_COMMAND_H_
#define INVSIM_TESTS_APPS_FIT_COMMAND_H_

// The smallest fits there are, run as a user runs them.

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "fit/dressed_mannequin.h"
#include "invsim/body/motion.h"
#include "invsim/io/ply.h"
#include "run_command.h"

namespace invsim {

// A directory with the points of a mannequin whose trunk is clothed.
class FitCommandTest : public ::testing::Test {
 protected:
  static constexpr int kPoints = 500;
  static constexpr int kOk = 0, kUsage = 2, kInput = 3, kStoppedEarly = 4,
                       kFailed = 5, kInterrupted = 130;

  FitCommandTest() : directory_(TestDirectory()), person_(0.015) {
    std::filesystem::create_directories(points());
    for (int t = 0; t < 4; ++t)
      WriteFrame(t, person_.Scan(Body(t), kPoints, t));
  }
  ~FitCommandTest() override { std::filesystem::remove_all(directory_); }

  std::filesystem::path points() const { return directory_ / "points"; }
  std::filesystem::path out() const { return directory_ / "run"; }
  std::filesystem::path Frame(int t) const {
    char name[32];
    std::snprintf(name, sizeof(name), "%06d.ply", t);
    return points() / name;
  }
  void WriteFrame(int t, const Points& cloud) const {
    PlyMesh mesh;
    mesh.vertices = cloud;
    WritePly(Frame(t).string(), mesh);
  }

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
  std::string Resume() const {
    return "fit --resume -q --out '" + out().string() + "'";
  }
  nlohmann::json Report() const {
    return nlohmann::json::parse(
        ReadFileBytes((out() / "report.json").string()));
  }

  std::filesystem::path directory_;
  DressedMannequin person_;
};

}  // namespace invsim

#endif  // INVSIM_TESTS_APPS_FIT_COMMAND_H_
