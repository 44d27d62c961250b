// SPDX-License-Identifier: Apache-2.0

// What --force replaces, and what commands never replace: files that are not
// results of ours, and those that they read.

#include <gmock/gmock.h>

#include "run_command.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr char kResolved[] = "config.resolved.toml";
constexpr char kSmallRun[] =
    " -q --garment tank_top --set input.edge=0.08 --frames 1"
    " --set step.substeps=1 --set relaxation.settle_seconds=0"
    " --set relaxation.move_seconds=0.001 --set relaxation.hold_seconds=0 ";
constexpr char kSmallSequence[] =
    " -q --garment tank_top --edge 0.08 --frames 1 --points 100"
    " --set step.substeps=1 --set relaxation.settle_seconds=0"
    " --set relaxation.move_seconds=0.001 --set relaxation.hold_seconds=0 ";

class ForceTest : public ::testing::Test {
 protected:
  ForceTest() : directory_(TestDirectory()) {}
  ~ForceTest() override { fs::remove_all(directory_); }

  std::string Path(const std::string& name) const {
    return (directory_ / name).string();
  }
  // A file of the user's.
  void Put(const std::string& name) const {
    fs::create_directories((directory_ / name).parent_path());
    WriteFileBytes(Path(name), "mine");
  }
  void ExpectKept(const std::string& name) const {
    ASSERT_TRUE(fs::exists(directory_ / name)) << name;
    EXPECT_EQ(ReadFileBytes(Path(name)), "mine") << name;
  }
  void ExpectRefused(const std::string& line,
                     const ::testing::Matcher<std::string>& message) const {
    const CommandResult result = RunCommand(line);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, message);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1)
        << result.err;
  }

  fs::path directory_;
};

TEST_F(ForceTest, DemoKeepsFoldersThatAreNotItsOwn) {
  for (const char* file : {"out/sequence/a.txt", "out/fit/b.txt"}) Put(file);
  ExpectRefused("demo -q --force --out " + Path("out"),
                AllOf(HasSubstr(Path("out")), HasSubstr(kResolved)));
  for (const char* file : {"out/sequence/a.txt", "out/fit/b.txt"})
    ExpectKept(file);
  // Nor if the folder above is its own.
  Put(std::string("out/") + kResolved);
  const CommandResult result =
      RunCommand("demo -q --force --frames 2 --out " + Path("out"));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr(Path("out/sequence") + ": is not"));
  for (const char* file : {"out/sequence/a.txt", "out/fit/b.txt"})
    ExpectKept(file);
}

TEST_F(ForceTest, ARunKeepsAFolderThatIsNoRun) {
  for (const char* file : {"out/body.npz",
                           "out/report.html",
                           "out/body/000000.ply",
                           "out/checkpoint/a"})
    Put(file);
  ExpectRefused(
      "simulate --force" + std::string(kSmallRun) + "--out " + Path("out"),
      AllOf(HasSubstr(Path("out")), HasSubstr(kResolved)));
  for (const char* file : {"out/body.npz",
                           "out/report.html",
                           "out/body/000000.ply",
                           "out/checkpoint/a"})
    ExpectKept(file);
}

TEST_F(ForceTest, ARunKeepsWhatItReads) {
  const std::string line =
      "simulate" + std::string(kSmallRun) + "--out " + Path("out");
  ASSERT_EQ(RunCommand(line).exit_code, 0);
  const std::string body = Path("out/body.npz");
  const std::string motion = ReadFileBytes(body);
  ExpectRefused(line + " --force --motion " + body,
                AllOf(HasSubstr(body + ": is to be read")));
  ExpectRefused(line + " --force --config " + Path("out/config.resolved.toml"),
                HasSubstr("is to be read"));
  EXPECT_EQ(ReadFileBytes(body), motion);
  fs::copy(body, Path("motion.npz"));
  EXPECT_EQ(
      RunCommand(line + " --force --motion " + Path("motion.npz")).exit_code,
      0);
}

// The user's own body model beside the points, as init names its result.
TEST_F(ForceTest, InitKeepsTheBodyItReads) {
  ASSERT_EQ(RunCommand("synth sequence" + std::string(kSmallSequence) +
                       "--out " + Path("seq"))
                .exit_code,
            0);
  fs::rename(Path("seq/body_model.npz"), Path("seq/body.npz"));
  const std::string body = ReadFileBytes(Path("seq/body.npz"));
  const std::string line =
      "init" + std::string(kSmallRun) + "--points " + Path("seq/points") +
      " --body " + Path("seq/body.npz") + " --force --out " + Path("seq");
  ExpectRefused(line, HasSubstr("seq/body.npz: is to be read"));
  fs::remove(Path("seq/config.resolved.toml"));
  ExpectRefused(line, HasSubstr(kResolved));
  EXPECT_EQ(ReadFileBytes(Path("seq/body.npz")), body);
}

TEST_F(ForceTest, ASequenceKeepsWhatItIsMadeFrom) {
  const std::string line =
      "synth sequence" + std::string(kSmallSequence) + "--out " + Path("seq");
  ASSERT_EQ(RunCommand(line).exit_code, 0);
  const std::string body = Path("seq/body_model.npz");
  ExpectRefused(line + " --force --body " + body,
                HasSubstr(body + ": is to be read"));
  EXPECT_TRUE(fs::exists(body));
  Put("mine/points/000000.ply");
  Put("mine/truth.npz");
  ExpectRefused("synth sequence" + std::string(kSmallSequence) +
                    "--force --out " + Path("mine"),
                AllOf(HasSubstr(Path("mine")), HasSubstr(kResolved)));
  ExpectKept("mine/points/000000.ply");
  ExpectKept("mine/truth.npz");
}

TEST_F(ForceTest, AGridKeepsFoldersOfTheNamesOfItsSequences) {
  const std::string line = "synth grid" + std::string(kSmallSequence) +
                           "--set 'grid.synth.motion=[\"turn\"]' --out " +
                           directory_.string();
  Put("turn/a.txt");
  for (const char* force : {"", " --force"}) {
    const CommandResult result = RunCommand(line + force);
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_THAT(result.out, HasSubstr(Path("turn") + ": is not a folder of"));
    ExpectKept("turn/a.txt");
  }
  fs::remove_all(Path("turn"));
  for (const char* file : {"turn.log", "turn.json"}) {
    fs::remove(Path("turn.log"));
    Put(file);
    for (const char* force : {"", " --force"}) {
      const CommandResult result = RunCommand(line + force);
      EXPECT_NE(result.exit_code, 0) << result.err;
      EXPECT_THAT(result.err, HasSubstr(Path(file)));
      ExpectKept(file);
    }
  }
}

TEST_F(ForceTest, ASweepKeepsFilesOfItsNames) {
  WriteFileBytes(Path("s.toml"),
                 "[sweep]\ncommand = \"simulate\"\n[base]\n"
                 "input.garment = \"none.obj\"\n[reference]\n"
                 "step.substeps = 1\n[grid]\nstep.substeps = [1, 2]\n");
  Put("sweep.csv");
  ExpectRefused(
      "sweep --config " + Path("s.toml") + " --out " + directory_.string(),
      HasSubstr("sweep.csv: is of no sweep here"));
  ExpectKept("sweep.csv");
}

TEST_F(ForceTest, AnEvaluationKeepsAReportOfSomethingElse) {
  ASSERT_EQ(RunCommand("synth sequence" + std::string(kSmallSequence) +
                       "--out " + Path("seq"))
                .exit_code,
            0);
  ASSERT_EQ(
      RunCommand("simulate" + std::string(kSmallRun) + "--out " + Path("run"))
          .exit_code,
      0);
  const std::string page = ReadFileBytes(Path("run/report.html"));
  const std::string line =
      "eval --run " + Path("run") + " --truth " + Path("seq") + " --force";
  ExpectRefused(line + " --out " + Path("run"),
                HasSubstr("holds a report.html of something else"));
  EXPECT_EQ(ReadFileBytes(Path("run/report.html")), page);
  for (int k = 0; k < 2; ++k)
    EXPECT_EQ(RunCommand(line + " --out " + Path("evaluation")).exit_code, 0);
}

}  // namespace
}  // namespace invsim
