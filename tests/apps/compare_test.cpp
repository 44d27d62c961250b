// SPDX-License-Identifier: Apache-2.0

// invsim compare as a user runs it.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "fit/dressed_mannequin.h"
#include "invsim/body/motion.h"
#include "invsim/io/ply.h"
#include "run_command.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A directory with two frames of a mannequin whose trunk is clothed, its true
// motion, and a start a little off that.
class CompareCommandTest : public ::testing::Test {
 protected:
  CompareCommandTest() : directory_(TestDirectory()), person_(0.015) {
    fs::create_directories(directory_ / "points");
    Motion truth;
    for (int t = 0; t < 2; ++t) {
      PlyMesh cloud;
      cloud.vertices = person_.Scan(Body(t), 500, t);
      WritePly((directory_ / "points" / ("00000" + std::to_string(t) + ".ply"))
                   .string(),
               cloud);
      truth.poses.push_back(Body(t).pose);
      truth.translations.push_back(Body(t).translation);
    }
    WriteMotion(Path("truth.npz"), truth);
    for (Vector3d& t : truth.translations) t.x() += 0.01;
    WriteMotion(Path("start.npz"), truth);
  }
  ~CompareCommandTest() override { fs::remove_all(directory_); }

  static BodyParameters Body(int t) {
    BodyParameters p;
    p.pose[3 * 16 + 2] = -0.9;  // arms down
    p.pose[3 * 17 + 2] = 0.9;
    p.translation = Vector3d(0.01 * t, 0.02, 0);
    return p;
  }
  std::string Path(const char* name) const {
    return (directory_ / name).string();
  }
  // As small as it can be.
  CommandResult Compare(const std::string& more) const {
    return RunCommand("compare --points '" + Path("points") +
                      "' --body mannequin --garment tank_top --start '" +
                      Path("start.npz") + "' --out '" + Path("run") +
                      "' -q --set input.edge=0.06 --set step.substeps=1"
                      " --set relaxation.settle_seconds=0.1"
                      " --set relaxation.move_seconds=0.3"
                      " --set relaxation.hold_seconds=0.1 " +
                      more);
  }
  std::string File(const char* name) const {
    return ReadFileBytes((directory_ / "run" / name).string());
  }

  fs::path directory_;
  DressedMannequin person_;
};

// Loose enough for one step to be all.
constexpr char kConverging[] =
    " --set lm.function_tolerance=1 --set dogleg.function_tolerance=1";

TEST_F(CompareCommandTest, WritesItsFiles) {
  const CommandResult result = Compare("--optimizers lm,dogleg --truth '" +
                                       Path("truth.npz") + "'" + kConverging);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("lm "), HasSubstr("dogleg "), HasSubstr("body")));
  const auto report = nlohmann::json::parse(File("report.json"));
  ASSERT_EQ(report["runs"].size(), 2u);
  EXPECT_EQ(report["runs"][1]["optimizer"], "dogleg");
  for (const auto& run : report["runs"]) {
    EXPECT_NEAR(run["iterations"][0]["body_v2v_mean_mm"], 10, 1e-3);
    EXPECT_EQ(run["iterations"][0]["cost"],
              report["runs"][0]["iterations"][0]["cost"]);
  }
  EXPECT_THAT(File("comparison.svg"),
              AllOf(HasSubstr(">cost<"),
                    HasSubstr(">body error [mm]<"),
                    HasSubstr(">simulation steps<"),
                    HasSubstr(">time [s]<")));
  for (const char* file :
       {"report.html", "comparison.csv", "solver.txt", "config.resolved.toml"})
    EXPECT_FALSE(File(file).empty()) << file;

  // Nothing is replaced unasked; and without a truth there is no error.
  const std::string again = "--optimizers lm" + std::string(kConverging);
  const CommandResult refused = Compare(again);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(Compare(again + " --force").exit_code, 0);
  EXPECT_THAT(File("comparison.svg"), Not(HasSubstr("body error")));
}

// That of the run that went worst.
TEST_F(CompareCommandTest, ItsExitCodeTellsHowTheRunsEnded) {
  const CommandResult stopped =
      Compare("--optimizers lm,dogleg" + std::string(kConverging) +
              " --set dogleg.iterations=0");
  EXPECT_EQ(stopped.exit_code, 4) << stopped.err;
  // There is no cloth in a storm like that.
  const CommandResult failed =
      Compare("--force --optimizers lm,dogleg" + std::string(kConverging) +
              " --set effects.gravity.acceleration=[0,1e300,0]");
  EXPECT_EQ(failed.exit_code, 5) << failed.err;
}

TEST_F(CompareCommandTest, RefusesWhatItCannotCompare) {
  for (const char* list : {"lm,doglegs", "'[]'"}) {
    const CommandResult result = Compare(std::string("--optimizers ") + list);
    EXPECT_EQ(result.exit_code, 2) << list;
    EXPECT_THAT(
        result.err,
        AllOf(HasSubstr("gradient_descent"), Not(HasSubstr("did you mean"))));
  }
  Motion little;
  little.poses.push_back(Body(0).pose);
  little.translations.push_back(Body(0).translation);
  WriteMotion(Path("little.npz"), little);
  const CommandResult result = Compare("--truth '" + Path("little.npz") + "'");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("little.npz"), HasSubstr("expected at least 2")));
}

}  // namespace
}  // namespace invsim
