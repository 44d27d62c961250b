// SPDX-License-Identifier: Apache-2.0

// `invsim synth` of single files: what it writes can be used, and nothing is
// overwritten.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_command.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class SynthTest : public ::testing::Test {
 protected:
  void SetUp() override { directory_ = TestDirectory().string(); }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string Path(const std::string& name) const {
    return directory_ + "/" + name;
  }
  void ExpectRefused(const std::string& arguments, const std::string& text) {
    const CommandResult result =
        RunCommand("synth " + arguments + " --out " + Path("refused"));
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err, StartsWith("invsim: "));
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_FALSE(std::filesystem::exists(Path("refused")));
  }

  std::string directory_;
};

TEST_F(SynthTest, WritesWhatSimulateReads) {
  const CommandResult body = RunCommand("synth body --out " + Path("b.npz"));
  ASSERT_EQ(body.exit_code, 0) << body.err;
  EXPECT_THAT(body.out, HasSubstr(" vertices"));
  const CommandResult motion =
      RunCommand("synth motion --name turn --frames 3 --out " + Path("m.npz"));
  ASSERT_EQ(motion.exit_code, 0) << motion.err;
  EXPECT_EQ(motion.out, Path("m.npz") + ": 3 frames\n");
  const CommandResult garment =
      RunCommand("synth garment --name tank_top --edge 0.06 --body " +
                 Path("b.npz") + " --out " + Path("g.obj"));
  ASSERT_EQ(garment.exit_code, 0) << garment.err;
  for (const char* file : {"b.npz", "m.npz", "g.obj"}) {
    const CommandResult seen = RunCommand("inspect " + Path(file));
    EXPECT_EQ(seen.exit_code, 0) << seen.err;
    EXPECT_THAT(seen.out, HasSubstr("usable: yes"));
  }
  const CommandResult run = RunCommand(
      "simulate -q --body " + Path("b.npz") + " --motion " + Path("m.npz") +
      " --garment " + Path("g.obj") +
      " --set relaxation.settle_seconds=0.05 --set relaxation.move_seconds=0.1"
      " --set relaxation.hold_seconds=0 --out " +
      Path("run"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("Complete: 3 of 3 frames."));
}

TEST_F(SynthTest, OverwritesNothingUnlessForced) {
  WriteFileBytes(Path("m.npz"), "mine");
  const std::string line =
      "synth motion --name squat --frames 2 --out " + Path("m.npz");
  const CommandResult refused = RunCommand(line);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--force"));
  EXPECT_EQ(ReadFileBytes(Path("m.npz")), "mine");
  EXPECT_EQ(RunCommand(line + " --force").exit_code, 0);
  EXPECT_NE(ReadFileBytes(Path("m.npz")), "mine");
}

TEST_F(SynthTest, AGridIsEveryCombinationAndIsTakenUpAgain) {
  const auto grid = [&](const std::string& garments, const std::string& more) {
    return RunCommand(
        "synth grid -q --frames 2 --edge 0.08 --points 500 "
        "--set relaxation.settle_seconds=0 --set relaxation.move_seconds=0.05 "
        "--set relaxation.hold_seconds=0 --set step.substeps=1 "
        "--set 'grid.synth.garment=[" +
        garments +
        "]' "
        "--set 'grid.synth.motion=[\"turn\"]' --out " +
        Path("grid") + " " + more);
  };
  ASSERT_EQ(RunCommand("synth garment --name tank_top --edge 0.08 --out " +
                       Path("vest.obj"))
                .exit_code,
            0);
  // What fails is named, and does not keep the rest from being made.
  const std::string vest = "\"" + Path("vest.obj") + "\"";
  const CommandResult first = grid("\"none.obj\", " + vest, "");
  EXPECT_EQ(first.exit_code, 5);
  EXPECT_THAT(first.out, HasSubstr("none_turn: failed: invsim: none.obj"));
  EXPECT_THAT(first.out, HasSubstr("vest_turn: 2 frames of 500 points"));
  const std::string truth = Path("grid/vest_turn/truth.npz");
  const auto written = std::filesystem::last_write_time(truth);
  // What is there is not made again.
  const CommandResult more = grid("\"tank_top\", " + vest, "");
  EXPECT_EQ(more.exit_code, 0) << more.err << more.out;
  EXPECT_TRUE(std::filesystem::exists(Path("grid/tank_top_turn/truth.npz")));
  EXPECT_EQ(std::filesystem::last_write_time(truth), written);
  const CommandResult other = grid(vest, "--seed 5");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("--force"));
  const CommandResult clash = grid(vest + ", \"vest\"", "");
  EXPECT_EQ(clash.exit_code, 2);
  EXPECT_THAT(clash.err, HasSubstr("two sequences are called 'vest_turn'"));
  EXPECT_THAT(RunCommand("synth grid").err, HasSubstr("[grid]"));
}

TEST_F(SynthTest, RefusesWrongNamesAndOptions) {
  ExpectRefused("bdoy", "did you mean 'body'?");
  ExpectRefused("garment --name tshrt", "did you mean 'tshirt'?");
  ExpectRefused("motion --name skwat", "squat");
  ExpectRefused("garment --edge 0.5", "synth.edge");
  ExpectRefused("motion --frames -1", "synth.frames");
}

}  // namespace
}  // namespace invsim
