// SPDX-License-Identifier: Apache-2.0

// What every command has in common, shown on `inspect`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "run_command.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class CommandLineTest : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = TestDirectory().string();
    points_ = directory_ + "/p.xyz";
    WriteFileBytes(points_, "0 0 0\n0.5 1.7 0.3\n");
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  static void ExpectFailure(const std::string& arguments,
                            int code,
                            const std::string& message) {
    const CommandResult result = RunCommand(arguments);
    EXPECT_EQ(result.exit_code, code) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_THAT(result.err, AllOf(StartsWith("invsim: "), HasSubstr(message)));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1)
        << result.err;
  }

  std::string directory_;
  std::string points_;
};

TEST_F(CommandLineTest, PrintsHelpAndVersions) {
  for (const char* arguments : {"--help", "-h", "inspect --help"}) {
    const CommandResult help = RunCommand(arguments);
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("inspect"));
    EXPECT_EQ(help.err, "");
  }
  const CommandResult version = RunCommand("--version");
  EXPECT_EQ(version.exit_code, 0);
  for (const char* name :
       {"invsim ", "Ceres ", "Eigen ", "SuiteSparse ", "BLAS OpenBLAS "}) {
    EXPECT_THAT(version.out, HasSubstr(name));
  }
}

TEST_F(CommandLineTest, EveryCommandTakesTheCommonFlags) {
  WriteFileBytes(directory_ + "/c.toml", "[run]\nthreads = 2\n");
  const CommandResult result = RunCommand(
      "inspect --config " + directory_ + "/c.toml --set run.seed=3 " +
      "--out " + directory_ + " --seed 7 --threads 1 -vv " + points_);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(RunCommand("inspect -q " + points_).exit_code, 0);
  // --set takes one word, so that the path is not swallowed.
  EXPECT_EQ(
      RunCommand("inspect --set run.seed=1 --set run.threads=1 " + points_)
          .exit_code,
      0);
}

TEST_F(CommandLineTest, UsageErrorsEndWithTwo) {
  ExpectFailure("", 2, "no command: expected one of ");
  ExpectFailure(
      "inspekt x", 2, "unknown command 'inspekt'; did you mean 'inspect'?");
  ExpectFailure("inspect", 2, "PATH is required");
  ExpectFailure("inspect --frobnicate " + points_, 2, "--frobnicate");
  ExpectFailure("inspect a b", 2, "b");
  ExpectFailure("inspect -q -v " + points_, 2, "excludes");
  ExpectFailure("inspect --threads many " + points_, 2, "--threads");
  ExpectFailure("inspect --threads -1 " + points_, 2, "run.threads");
  ExpectFailure("inspect --seed 1.5 " + points_, 2, "run.seed");
  ExpectFailure("inspect --set seed " + points_, 2, "--set");
  ExpectFailure("inspect --set run.sed=1 " + points_, 2, "run.seed");
  ExpectFailure(
      "inspect --config /nowhere.toml " + points_, 2, "/nowhere.toml");
}

TEST_F(CommandLineTest, ConfigurationErrorsNameFileAndLine) {
  const std::string file = directory_ + "/c.toml";
  WriteFileBytes(file, "[run]\nseed = 1\nthread = 2\n");
  ExpectFailure("inspect --config " + file + " " + points_, 2, file + ":3");
  WriteFileBytes(file, "[run\n");
  ExpectFailure("inspect --config " + file + " " + points_, 2, file + ":1");
}

TEST_F(CommandLineTest, InputErrorsEndWithThree) {
  ExpectFailure("inspect /nowhere.ply",
                3,
                "invsim: /nowhere.ply: cannot be opened: No such file");
  WriteFileBytes(points_, "0 0\n");
  ExpectFailure("inspect " + points_,
                3,
                points_ + ":1: the line ends: expected a number (z)");
}

TEST_F(CommandLineTest, OutputThatCannotBeWrittenIsNoSuccess) {
  const std::string line =
      "'" INVSIM_COMMAND "' inspect " + points_ + " >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 1);
}

}  // namespace
}  // namespace invsim
