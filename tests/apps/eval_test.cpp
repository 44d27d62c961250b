// SPDX-License-Identifier: Apache-2.0

// invsim eval on runs whose errors are known.

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "fit/dressed_mannequin.h"
#include "invsim/io/obj.h"
#include "invsim/io/ply.h"
#include "invsim/study/truth.h"
#include "run_command.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kFrames = 4;

// A mannequin that drifts along x, its trunk clothed, and a run in which body
// and cloth are 1 cm too far to the left.
class EvalCommandTest : public ::testing::Test {
 protected:
  EvalCommandTest() : directory_(TestDirectory()), person_(0.015) {
    const Garment garment = person_.MakeGarment();
    for (int t = 0; t < kFrames; ++t) {
      const Vector3d at(0.002 * t, 0, 0);
      truth_.body.poses.push_back(PoseVector::Zero());
      truth_.body.translations.push_back(at);
      truth_.cloth.push_back(garment.placed.colwise() + at);
    }
    fs::create_directories(directory_ / "truth" / "points");
    WriteTruth((directory_ / "truth" / "truth.npz").string(), truth_);
    WriteObj((directory_ / "truth" / "garment.obj").string(),
             {garment.placed, garment.faces, {}, {}});
    WriteFileBytes((directory_ / "truth" / "scene.json").string(),
                   "{\"garment\": \"vest\", \"body\": \"elsewhere.npz\"}");
    for (int t = 0; t < kFrames; ++t)
      WriteMesh(directory_ / "truth" / "points",
                t,
                person_.Scan(truth_.body.Frame(t), 300, t));
    WriteRun("run", Vector3d(0.01, 0, 0));
  }
  ~EvalCommandTest() override { fs::remove_all(directory_); }

  static void WriteMesh(const fs::path& folder, int t, const Points& points) {
    char name[32];
    std::snprintf(name, sizeof(name), "%06d.ply", t);
    PlyMesh mesh;
    mesh.vertices = points;
    WritePly((folder / name).string(), mesh);
  }

  void WriteRun(const std::string& name, const Vector3d& off) const {
    const fs::path run = directory_ / name;
    fs::create_directories(run / "cloth");
    Motion body = truth_.body;
    for (Vector3d& t : body.translations) t += off;
    WriteMotion((run / "body.npz").string(), body);
    for (int t = 0; t < kFrames; ++t)
      WriteMesh(run / "cloth", t, truth_.cloth[t].colwise() + off);
  }

  CommandResult Eval(const std::string& rest) const {
    return RunCommand("eval --truth '" + (directory_ / "truth").string() +
                      "' " + rest);
  }
  std::string In(const std::string& name) const {
    return "'" + (directory_ / name).string() + "'";
  }

  fs::path directory_;
  DressedMannequin person_;
  Truth truth_;
};

TEST_F(EvalCommandTest, FindsTheErrorsPutIn) {
  const CommandResult result =
      Eval("--body mannequin --json --run " + In("run"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  const auto& m = json["metrics"];
  EXPECT_NEAR(m["body_v2v_mean_mm"], 10, 1e-6);
  EXPECT_NEAR(m["joint_mean_mm"], 10, 1e-6);
  EXPECT_NEAR(m["body_tpose_v2v_mean_mm"], 0, 1e-6);
  EXPECT_NEAR(m["cloth_v2v_mean_mm"], 10, 1e-3);  // 32-bit files
  EXPECT_LT(m["cloth_chamfer_l1_mm"], 10);
  EXPECT_GT(m["combined_chamfer_l1_mm"], 1);
  EXPECT_GT(m["points_to_surface_mean_mm"], 1);
  EXPECT_NEAR(m["joint_acceleration_error_mean_m_per_s2"], 0, 1e-6);
  EXPECT_EQ(json["garment"], "vest");
  EXPECT_EQ(json["frames"].size(), 4u);
}

TEST_F(EvalCommandTest, AFolderOfRunsGivesATableAndFiles) {
  fs::create_directories(directory_ / "runs");
  WriteRun("runs/a", Vector3d(0.01, 0, 0));
  WriteRun("runs/b", Vector3d(0, 0.002, 0));
  const std::string arguments =
      "--body mannequin --run " + In("runs") + " --out " + In("evaluation");
  const CommandResult result = Eval(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("| vest |"));
  EXPECT_THAT(result.out, HasSubstr("published, other data"));
  const auto json = nlohmann::json::parse(
      ReadFileBytes((directory_ / "evaluation/evaluation.json").string()));
  EXPECT_EQ(json["runs"].size(), 2u);
  EXPECT_EQ(json["table"][0]["frames"], 2 * kFrames);
  EXPECT_THAT(
      ReadFileBytes((directory_ / "evaluation/evaluation.csv").string()),
      HasSubstr("body_v2v_mean_mm"));
  EXPECT_THAT(ReadFileBytes((directory_ / "evaluation/report.html").string()),
              HasSubstr("Evaluation of 2 runs"));
  EXPECT_EQ(Eval(arguments).exit_code, 2);
  EXPECT_EQ(Eval(arguments + " --force").exit_code, 0);
}

// The table of what can be evaluated, and what is missing in it by name.
TEST_F(EvalCommandTest, ABrokenRunDoesNotKeepOthersFromTheTable) {
  fs::create_directories(directory_ / "runs");
  WriteRun("runs/good", Vector3d(0.01, 0, 0));
  WriteRun("runs/broken", Vector3d(0, 0.002, 0));
  WriteFileBytes((directory_ / "runs/broken/body.npz").string(), "PK");
  fs::create_directories(directory_ / "runs/empty");
  const std::string arguments = "--body mannequin --run " + In("runs");
  const CommandResult result = Eval(arguments);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr("| vest |"));
  EXPECT_THAT(result.err, HasSubstr("runs/broken/body.npz"));
  EXPECT_THAT(result.err, HasSubstr("runs/empty: left out, holds no body.npz"));
  fs::remove_all(directory_ / "runs/good");
  const CommandResult none = Eval(arguments);
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_EQ(none.out, "");
}

TEST_F(EvalCommandTest, NamesTheKeyOfAnotherType) {
  const std::string scene = (directory_ / "truth/scene.json").string();
  const std::string report = (directory_ / "run/report.json").string();
  const auto expect = [&](const std::string& path,
                          const std::string& text,
                          const std::string& message) {
    WriteFileBytes(path, text);
    const CommandResult result = Eval("--run " + In("run"));
    EXPECT_EQ(result.exit_code, 3) << text;
    EXPECT_THAT(result.err, HasSubstr(path + ": " + message));
    EXPECT_EQ(result.out, "");
  };
  expect(scene, "{\"body\": 5}", "body: expected a text, found a number");
  expect(scene, "{\"garment\": [1]}", "garment: expected a text, found a list");
  expect(scene, "[]", "expected a JSON object");
  WriteFileBytes(scene, "{\"garment\": \"vest\"}");
  const std::string more = "--body mannequin --run " + In("run");
  WriteFileBytes(report, "{\"inputs\": {\"friction\": \"high\"}}");
  const CommandResult result = Eval(more);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(
      result.err,
      HasSubstr(report + ": inputs.friction: expected a number, found a text"));
}

TEST_F(EvalCommandTest, SaysWhatDoesNotFit) {
  const auto expect =
      [&](const std::string& arguments, int code, const std::string& message) {
        const CommandResult result = Eval(arguments);
        EXPECT_EQ(result.exit_code, code) << arguments;
        EXPECT_THAT(result.err, HasSubstr(message));
        EXPECT_EQ(result.out, "");
      };
  expect("--run " + In("run"), 2, "holds no body elsewhere.npz");
  expect("--body mannequin --run " + In("missing"), 3, "does not exist");
  expect("--body mannequin --run " + In("truth"), 3, "body.npz");
  WriteMesh(directory_ / "run" / "cloth", 2, Points::Zero(3, 5));
  expect("--body mannequin --run " + In("run"), 3, "frame 2");
  truth_.body.poses.pop_back();
  truth_.body.translations.pop_back();
  WriteMotion((directory_ / "run" / "body.npz").string(), truth_.body);
  expect("--body mannequin --run " + In("run"), 3, "3 frames, expected 4");
}

}  // namespace
}  // namespace invsim
