// SPDX-License-Identifier: Apache-2.0

// `invsim simulate` as a user meets it: what it writes, what it refuses, and
// that nothing is lost. The scenes are the smallest there are.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "invsim/body/mannequin.h"
#include "invsim/body/motion.h"
#include "invsim/body/motion_library.h"
#include "invsim/io/npz.h"
#include "invsim/io/obj.h"
#include "invsim/io/pc2.h"
#include "invsim/io/ply.h"
#include "run_command.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// A sheet on a cube, four frames: done in a second.
constexpr char kSmall[] =
    "simulate -q --set input.body=cube --set input.garment=sheet "
    "--motion turn --frames 4 ";

class SimulateTest : public ::testing::Test {
 protected:
  void SetUp() override { directory_ = TestDirectory().string(); }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string Path(const std::string& name) const {
    return directory_ + "/" + name;
  }
  // Expects one line with `text`, and nothing written.
  void ExpectRefused(const std::string& arguments,
                     int exit_code,
                     const std::string& text) {
    const CommandResult result =
        RunCommand(arguments + " --out " + Path("refused"));
    EXPECT_EQ(result.exit_code, exit_code) << arguments << "\n" << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, StartsWith("invsim: "));
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
    EXPECT_FALSE(std::filesystem::exists(Path("refused"))) << arguments;
  }

  std::string directory_;
};

// In its first frames the cube has hardly begun to turn: no drag, and a reason
// wherever one looks.
TEST_F(SimulateTest, AutoSaysWhyAnEffectIsOnOrOff) {
  const CommandResult result = RunCommand(
      kSmall + std::string("--set scene.effects=auto --json --out ") +
      Path("run"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["effects"]["gravity"]["on"], true);
  EXPECT_EQ(json["effects"]["air_drag"]["on"], false);
  for (const auto& [name, effect] : json["effects"].items()) {
    EXPECT_NE(effect["reason"], "") << name;
    for (const char* file : {"run/solver.txt", "run/report.html"})
      EXPECT_THAT(ReadFileBytes(Path(file)), HasSubstr(name)) << file;
  }
  EXPECT_THAT(ReadFileBytes(Path("run/config.resolved.toml")),
              HasSubstr("\"auto\""));
}

TEST_F(SimulateTest, WritesARunFolder) {
  const CommandResult result =
      RunCommand(kSmall + std::string("--json --out ") + Path("run"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["status"], "complete");
  EXPECT_EQ(json["counts"]["frames_done"], 4);
  EXPECT_EQ(json["total"]["steps_missed"], 0);
  EXPECT_LT(json["total"]["penetration_max_mm"], 1);
  EXPECT_EQ(json,
            nlohmann::json::parse(ReadFileBytes(Path("run/report.json"))));

  const PlyMesh cloth = ReadPly(Path("run/cloth/000003.ply"));
  EXPECT_EQ(cloth.vertices.cols(), json["counts"]["cloth_vertices"]);
  EXPECT_TRUE(cloth.vertices.allFinite());
  const PlyMesh body = ReadPly(Path("run/body/000003.ply"));
  EXPECT_EQ(body.vertices.cols(), 8);
  for (const char* file : {"report.html",
                           "solver.txt",
                           "config.resolved.toml",
                           "body.npz",
                           "cloth.pc2"})
    EXPECT_TRUE(std::filesystem::exists(Path("run/") + file)) << file;
  const CommandResult seen = RunCommand("inspect " + Path("run"));
  EXPECT_EQ(seen.exit_code, 0) << seen.err;
  EXPECT_THAT(seen.out, HasSubstr("run folder"));
}

TEST_F(SimulateTest, RefusesAnglesOutOfAllProportion) {
  Motion motion;
  motion.poses.assign(4, PoseVector::Zero());
  motion.translations.assign(4, Vector3d::Zero());
  motion.poses[2][4] = 1e200;
  WriteMotion(Path("m.npz"), motion);
  ExpectRefused(
      "simulate -q --set input.body=cube --set input.garment=sheet "
      "--motion " +
          Path("m.npz"),
      3,
      Path("m.npz") + ": poses of frame 2 holds 1e+200");
}

// A body that is nowhere ends the run, which says so, with a report.
TEST_F(SimulateTest, FailsInTheOpenIfTheBodyIsNotFinite) {
  const CommandResult result = RunCommand(
      "simulate -q --garment tank_top --set input.edge=0.08 --frames 2 --set "
      "'input.shape=[1e308, 1e308]' --out " +
      Path("run"));
  EXPECT_EQ(result.exit_code, 5) << result.err;
  EXPECT_THAT(result.out,
              StartsWith("Failed while dressing, in phase 'settle' ("));
  EXPECT_THAT(result.out, HasSubstr("is not finite), after 0 of 2 frames."));
  EXPECT_TRUE(std::filesystem::exists(Path("run/report.json")));
}

// The embedded motion as archives keep it.
TEST_F(SimulateTest, RefusesAMotionWithZUp) {
  Motion motion = MakeMotion("walk_in_place", 40, 30);
  TurnWorld(YUpFrom(UpAxis::kZ).transpose(), Mannequin(), &motion);
  WriteMotion(Path("z.npz"), motion);
  const std::string line =
      "simulate -q --garment tank_top --set input.edge=0.08 --frames 1 "
      "--set relaxation.settle_seconds=0 --set relaxation.move_seconds=0.001 "
      "--set relaxation.hold_seconds=0 --motion " +
      Path("z.npz");
  ExpectRefused(line,
                3,
                Path("z.npz") +
                    ": the body's up axis is along z in "
                    "40 of 40 frames");
  ExpectRefused(line, 3, "say motion_up=z");
  for (const char* said : {"y", "z"}) {
    const CommandResult result = RunCommand(
        line + " --set input.motion_up=" + said + " --out " + Path(said));
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  // Who lies still is doubted in words; who turns cartwheels or lies down on
  // the way is not.
  Motion still = motion;
  for (PoseVector& pose : still.poses) pose = motion.poses[0];
  WriteMotion(Path("still.npz"), still);
  Motion wheel = MakeMotion("turn", 12, 30);
  for (int t = 0; t < 12; ++t)
    wheel.poses[t].head<3>() = Vector3d(0, 0, 0.5 * t);
  WriteMotion(Path("wheel.npz"), wheel);
  Motion down = MakeMotion("turn", 12, 30);
  for (int t = 0; t < 12; ++t)
    down.poses[t].head<3>() = Vector3d(std::min(0.3 * t, 1.57), 0, 0);
  WriteMotion(Path("down.npz"), down);
  for (const std::string name : {"still", "wheel", "down"}) {
    const CommandResult result =
        RunCommand("synth motion --name " + Path(name + ".npz") + " --out " +
                   Path(name + "_read.npz"));
    EXPECT_EQ(result.exit_code, 0) << name << result.err;
    EXPECT_EQ(result.err.find("z seems to be up") != std::string::npos,
              name == "still")
        << name << result.err;
  }
}

TEST_F(SimulateTest, RefusesABodyThatIsNotInMetresAndYUp) {
  const auto write = [&](const std::string& name, const Matrix3d& a) {
    BodyModelData data = Mannequin().data();
    data.v_template = a * data.v_template;
    const auto turn = [&](VertexRows* directions) {
      for (Eigen::Index v = 0; v < directions->rows() / 3; ++v)
        directions->middleRows<3>(3 * v) =
            (a * directions->middleRows<3>(3 * v)).eval();
    };
    turn(&data.shapedirs);
    if (data.posedirs.size() > 0) turn(&data.posedirs);
    WriteBodyModel(Path(name), BodyModel(data));
  };
  const Matrix3d z_up = YUpFrom(UpAxis::kZ).transpose();
  write("z.npz", z_up);
  write("cm.npz", 100 * Matrix3d::Identity());
  write("mm_z.npz", 1000 * z_up);
  write("down.npz", Vector3d(1, -1, -1).asDiagonal().toDenseMatrix());
  for (const char* command : {"simulate -q", "synth garment"}) {
    const auto expect = [&](const std::string& name, const std::string& text) {
      ExpectRefused(
          std::string(command) + " --garment tank_top --body " + Path(name),
          3,
          text);
    };
    expect("z.npz", Path("z.npz") + ": in the T-pose the head is (");
    expect("z.npz", "so z seems to be up; expected y: turn v_template");
    expect("cm.npz", "the unit seems to be cm; expected metres");
    expect("cm.npz", "by 0.01");
    expect("down.npz", "upside down; expected y up");
    expect("mm_z.npz", "z seems to be up");
  }
}

// Physics on the embedded shirt, body and walk: every step solved, nothing in
// the skin. Coarse cloth, the first third of a second.
TEST_F(SimulateTest, WearsTheShirtThroughAWalk) {
  const CommandResult result = RunCommand(
      "simulate -q --json --motion walk_in_place --garment tshirt --frames 11 "
      "--set input.edge=0.045 --out " +
      Path("run"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["counts"]["frames_done"], 11);
  EXPECT_EQ(json["relaxation"]["at_rest"], true);
  EXPECT_EQ(json["total"]["steps_missed"], 0);
  EXPECT_LT(json["total"]["worst_residual_weights"], 1e-6);
  EXPECT_LT(json["total"]["penetration_max_mm"], 1);
  // It is worn: its middle stays on the chest while the body walks.
  const Points first = ReadPly(Path("run/cloth/000000.ply")).vertices;
  const Points last = ReadPly(Path("run/cloth/000010.ply")).vertices;
  EXPECT_TRUE(last.allFinite());
  EXPECT_LT((last - first).rowwise().mean().norm(), 0.1);
  EXPECT_GT((last - first).colwise().norm().maxCoeff(), 0.01);
}

TEST_F(SimulateTest, OverwritesNothingUnlessForced) {
  std::filesystem::create_directory(Path("run"));
  WriteFileBytes(Path("run/mine.txt"), "mine");
  const std::string line = kSmall + std::string("--out ") + Path("run");
  const CommandResult refused = RunCommand(line);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(RunCommand(line + " --force").exit_code, 2);  // none of ours
  EXPECT_FALSE(std::filesystem::exists(Path("run/report.json")));
  WriteFileBytes(Path("run/config.resolved.toml"), "");
  EXPECT_EQ(RunCommand(line + " --force").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(Path("run/report.json")));
  EXPECT_EQ(ReadFileBytes(Path("run/mine.txt")), "mine");
}

TEST_F(SimulateTest, FlagsComeBeforeSetBeforeFile) {
  const auto resolved = [&](const std::string& more) {
    const CommandResult result = RunCommand(
        kSmall + std::string("--force --out ") + Path("run") + " " + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return ReadFileBytes(Path("run/config.resolved.toml"));
  };
  WriteFileBytes(Path("c.toml"),
                 "[step]\nsubsteps = 3\n[contact]\nfriction = 0.4\n"
                 "thickness = 0.003\n");
  const std::string text = resolved(
      "--config " + Path("c.toml") +
      " --set step.substeps=2 --set contact.friction=0.5 --substeps 1");
  EXPECT_THAT(text, HasSubstr("substeps = 1"));
  EXPECT_THAT(text, HasSubstr("friction = 0.5"));
  EXPECT_THAT(text, HasSubstr("thickness = 0.003"));
  // What was resolved gives the same run.
  const std::string cloth = ReadFileBytes(Path("run/cloth.pc2"));
  const CommandResult again =
      RunCommand("simulate -q --config " + Path("run/config.resolved.toml") +
                 " --out " + Path("again"));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(ReadFileBytes(Path("again/cloth.pc2")), cloth);
}

TEST_F(SimulateTest, RefusesWrongNamesAndOptions) {
  ExpectRefused("simulate --body manequin", 2, "did you mean 'mannequin'?");
  ExpectRefused(
      "simulate --body cube --garment tshrt", 2, "did you mean 'tshirt'?");
  ExpectRefused(
      "simulate --body cube --motion wlak_in_place", 2, "walk_in_place");
  ExpectRefused("simulate --material jerse", 2, "did you mean 'jersey'?");
  ExpectRefused("simulate --substeps 0", 2, "step.substeps = 0");
  ExpectRefused("simulate --friction -1", 2, "contact.friction");
  ExpectRefused(
      "simulate --body cube --garment sheet --set scene.effects=inertia,gravty",
      2,
      "gravity");
  ExpectRefused(
      "simulate --body cube --garment sheet "
      "--set 'scene.effects=[\"gravity\",\"auto\"]'",
      2,
      "'auto' stands alone");
  ExpectRefused(
      "simulate --set relaxation.mvoe_seconds=1", 2, "relaxation.move_seconds");
  WriteFileBytes(Path("c.toml"), "[step]\n\nsubstep = 1\n");
  ExpectRefused("simulate --config " + Path("c.toml"), 2, Path("c.toml:3"));
}

TEST_F(SimulateTest, RefusesBadFiles) {
  ExpectRefused("simulate --body /nowhere/b.npz", 3, "/nowhere/b.npz");
  ExpectRefused(
      "simulate --body cube --motion /nowhere/m.npz", 3, "/nowhere/m.npz");
  ExpectRefused(
      "simulate --body cube --garment /nowhere/g.obj", 3, "/nowhere/g.obj");
  ExpectRefused("simulate --material /nowhere/m.json", 3, "/nowhere/m.json");
  WriteFileBytes(Path("b.npz"), "PK not really");
  ExpectRefused("simulate --body " + Path("b.npz"), 3, Path("b.npz"));
  WriteFileBytes(Path("g.obj"), "");
  ExpectRefused(
      "simulate --body cube --garment " + Path("g.obj"), 3, Path("g.obj"));
  WriteFileBytes(Path("g.obj"), "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n");
  ExpectRefused(
      "simulate --body cube --garment " + Path("g.obj"), 3, Path("g.obj"));
  WriteFileBytes(Path("m.json"), "{\"density\": ");
  ExpectRefused("simulate --material " + Path("m.json"), 3, Path("m.json"));
}

TEST_F(SimulateTest, RefusesAGarmentThatIsNotOnTheBody) {
  const std::string garment = Path("g.obj");
  WriteFileBytes(garment, "v 5 0 0\nv 5.1 0 0\nv 5 0.1 0\nf 1 2 3\n");
  ExpectRefused("simulate --set input.body=cube --garment " + garment,
                3,
                garment + ": its nearest vertex is");
}

TEST_F(SimulateTest, RefusesAMotionOfWrongShapeOrTooShort) {
  const auto motion = [&](int poses, int translations, double value) {
    WriteNpz(Path("m.npz"),
             {{"poses",
               NpyArray::Doubles({poses, 72},
                                 std::vector<double>(72 * poses, value))},
              {"trans",
               NpyArray::Doubles({translations, 3},
                                 std::vector<double>(3 * translations))},
              {"mocap_framerate", NpyArray::Doubles({}, {30})}});
    return "simulate --body cube --motion " + Path("m.npz");
  };
  ExpectRefused(motion(5, 4, 0), 3, "trans");
  ExpectRefused(motion(5, 5, std::nan("")), 3, Path("m.npz"));
  ExpectRefused(
      motion(5, 5, 0) + " --set input.first_frame=9", 2, "only frames 0 to 4");
}

TEST_F(SimulateTest, AnInterruptKeepsTheFramesThereAre) {
  const std::string frame = Path("run/cloth/000002.ply");
  const CommandResult result = RunAndSignal(
      "simulate -q --json --set input.body=cube --set "
      "input.garment=sheet --motion turn --substeps 20 --out " +
          Path("run"),
      "[ -e '" + frame + "' ]",
      "INT");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  const auto json =
      nlohmann::json::parse(ReadFileBytes(Path("run/report.json")));
  EXPECT_EQ(json["status"], "interrupted");
  const int done = json["counts"]["frames_done"];
  EXPECT_GE(done, 3);
  EXPECT_LT(done, json["counts"]["frames_wanted"]);
  char last[32];
  std::snprintf(last, sizeof(last), "run/cloth/%06d.ply", done - 1);
  EXPECT_TRUE(ReadPly(Path(last)).vertices.allFinite());
}

// Two sheets of 576 vertices each, nearer to each other than layers may be.
std::string TwoSheets() {
  constexpr int kSide = 24;
  std::ostringstream obj;
  for (const double height : {0.0, 0.001})
    for (int i = 0; i < kSide * kSide; ++i)
      obj << "v " << 0.02 * (i % kSide - 11.5) << " " << 0.16 + height << " "
          << -0.02 * (i / kSide - 11.5) << "\n";
  for (int layer = 0; layer < 2; ++layer)
    for (int i = 0; i < kSide * (kSide - 1); ++i) {
      if (i % kSide == kSide - 1) continue;
      const int a = 1 + layer * kSide * kSide + i;
      obj << "f " << a << " " << a + 1 << " " << a + 1 + kSide << "\nf " << a
          << " " << a + 1 + kSide << " " << a + kSide << "\n";
    }
  return obj.str();
}

TEST_F(SimulateTest, SelfContactIsTheSameOnOneThreadAndOnTwo) {
  WriteFileBytes(Path("sheets.obj"), TwoSheets());
  const auto cloth = [&](const std::string& threads) {
    const CommandResult result = RunCommand(
        "simulate -q --json --force --set input.body=cube --motion turn "
        "--frames 2 --set relaxation.settle_seconds=0.03 --set "
        "relaxation.move_seconds=0.03 --set relaxation.hold_seconds=0.03 "
        "--set 'scene.effects=[\"inertia\",\"gravity\",\"membrane\","
        "\"self_contact\"]' --garment " +
        Path("sheets.obj") + " --out " + Path("run") + " --threads " + threads);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_GT(json["total"]["cloth_contacts_max"], 1000);
    return ReadFileBytes(Path("run/cloth.pc2"));
  };
  const std::string one = cloth("1");
  EXPECT_EQ(cloth("2"), one);
}

TEST_F(SimulateTest, CountsStepsThatMissTheirTolerance) {
  const CommandResult result =
      RunCommand(kSmall +
                 std::string("--json --set step.friction.newton_iterations=1 "
                             "--set step.friction.admm_iterations=1 "
                             "--set step.friction.retries=0 "
                             "--set step.max_halvings=0 "
                             "--set step.friction.tolerance=1e-9 --out ") +
                 Path("run"));
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_GT(json["total"]["steps_missed"], 0);
  EXPECT_GT(json["total"]["worst_residual_weights"], 1e-9);
}

}  // namespace
}  // namespace invsim
