// SPDX-License-Identifier: Apache-2.0

// Every file in configs/ holds only options that its command has, with values
// that it takes.

#include <gmock/gmock.h>

#include <map>

#include "run_command.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// The options are read and checked before anything else; a file in the place of
// the results' folder ends the command then.
TEST(Configs, AreReadByTheirCommands) {
  const std::map<std::string, std::string> commands = {
      {"cube.toml", "simulate"},
      {"effects_study.toml", "sweep"},
      {"fit.toml", "fit"},
      {"forward_study.toml", "sweep"},
      {"inverse_study.toml", "sweep"},
      {"paper_grid.toml", "synth grid"}};
  const fs::path directory = TestDirectory();
  const std::string file = (directory / "file").string();
  WriteFileBytes(file, "");
  size_t count = 0;
  for (const auto& entry : fs::directory_iterator(INVSIM_CONFIGS)) {
    const std::string name = entry.path().filename().string();
    ASSERT_TRUE(commands.count(name)) << name << ": which command reads it?";
    ++count;
    const std::string line = commands.at(name) + " -q --config '" +
                             entry.path().string() + "' --out " + file;
    const CommandResult result = RunCommand(line);
    EXPECT_EQ(result.exit_code, 2) << line;
    EXPECT_THAT(result.err,
                AnyOf(HasSubstr(file + ": is a file"),
                      HasSubstr("--points is missing")))
        << line;
    // And it is the options that were read.
    EXPECT_THAT(RunCommand(line + " --set no.such_option=1").err,
                HasSubstr("no.such_option"));
  }
  EXPECT_EQ(count, commands.size());
  fs::remove_all(directory);
}

}  // namespace
}  // namespace invsim
