// SPDX-License-Identifier: Apache-2.0

// `invsim report`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "run_command.h"

namespace invsim {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

TEST(ReportCommandTest, SetsRunsSideBySide) {
  const std::string folder = TestDirectory().string();
  for (const char* substeps : {"2", "3"}) {
    const CommandResult run = RunCommand(
        "simulate -q --frames 1 --set input.edge=0.08 "
        "--set relaxation.move_seconds=0.2 --set relaxation.hold_seconds=0.1 "
        "--substeps " +
        std::string(substeps) + " --out " + folder + "/" + substeps);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const std::string both = folder + "/2 " + folder + "/3";
  const CommandResult text = RunCommand("report " + both);
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, ContainsRegex("step\\.substeps +2 +3\n"));
  EXPECT_THAT(text.out, ContainsRegex("frames +1 +1\n"));
  const auto json =
      nlohmann::json::parse(RunCommand("report --json " + both).out);
  EXPECT_EQ(json["runs"][1]["settings"].size(), 1u);
  const auto report =
      nlohmann::json::parse(ReadFileBytes(folder + "/3/report.json"));
  EXPECT_EQ(json["runs"][1]["figures"]["steps"], report["total"]["steps"]);
  const CommandResult none = RunCommand("report " + folder);
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr(folder + ": holds no report.json"));
}

}  // namespace
}  // namespace invsim
