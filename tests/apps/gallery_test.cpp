// SPDX-License-Identifier: Apache-2.0

// `invsim gallery` and `invsim soak` as a user runs them, on one scene each.

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "run_command.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(GalleryCommand, PrintsATableAndWritesAReport) {
  const fs::path directory = TestDirectory();
  const std::string out = (directory / "out").string();
  const std::string line =
      "gallery -q --only geometry/one_triangle --out " + out;
  const CommandResult result = RunCommand(line);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* column :
       {"case", "converged", "residual", "inside", "energy", "slope", "time"})
    EXPECT_THAT(result.out, HasSubstr(column));
  EXPECT_THAT(result.out, HasSubstr("geometry/one_triangle           holds"));
  const auto json = nlohmann::json::parse(ReadFileBytes(out + "/report.json"));
  EXPECT_THAT(json.dump(), HasSubstr("geometry/one_triangle"));
  EXPECT_THAT(ReadFileBytes(out + "/report.html"),
              HasSubstr("geometry/one_triangle"));
  EXPECT_TRUE(fs::exists(out + "/config.resolved.toml"));

  EXPECT_EQ(RunCommand(line).exit_code, 2);  // nothing is replaced unasked
  const CommandResult again = RunCommand(line + " --force --json");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(nlohmann::json::parse(again.out)["schema"], json["schema"]);
  fs::remove_all(directory);
}

TEST(GalleryCommand, NamesACaseIfNoneIsChosen) {
  const CommandResult result = RunCommand("gallery -q --only unicorn");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("no case has 'unicorn' in its name"),
                    HasSubstr("the first is geometry/")));
  EXPECT_EQ(result.out, "");
}

TEST(GalleryCommand, KnowsItsMaps) {
  const CommandResult result = RunCommand("gallery -q --map stifness_dt");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("stiffness_dt"));
}

TEST(GalleryCommand, DrawsAMap) {
  const fs::path directory = TestDirectory();
  const std::string out = (directory / "out").string();
  // Two of its cells: 60 degrees and none left, without friction.
  const CommandResult result = RunCommand(
      "gallery -q --map mu_squeeze --set gallery.every=10 --out " + out);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("friction coefficient"),
                    HasSubstr("(0 of 2 cells)"),
                    Not(HasSubstr("45"))));
  const auto json = nlohmann::json::parse(ReadFileBytes(out + "/report.json"));
  EXPECT_THAT(json.dump(), HasSubstr("mu_squeeze"));
  EXPECT_THAT(ReadFileBytes(out + "/mu_squeeze.svg"), HasSubstr("</svg>"));
  fs::remove_all(directory);
}

TEST(SoakCommand, SaysHowFarItIsOncePerScene) {
  const CommandResult result = RunCommand("soak --seed 3 --scenes 2");
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 2)
      << result.err;
  EXPECT_THAT(result.err, HasSubstr("percent 50/100"));
  EXPECT_THAT(result.err, HasSubstr("percent 100/100"));
}

TEST(SoakCommand, RunsTheSceneOfASeed) {
  const fs::path directory = TestDirectory();
  const std::string out = (directory / "out").string();
  const std::string line = "soak -q --seed 3 --scenes 1";
  const CommandResult result = RunCommand(line + " --out " + out);
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("1, seeds from 3 on"));
  const auto json = nlohmann::json::parse(ReadFileBytes(out + "/report.json"));
  EXPECT_EQ(json["scenes"], 1);
  EXPECT_EQ(json["first_seed"], 3);
  const CommandResult as_json = RunCommand(line + " --json");
  EXPECT_EQ(as_json.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(as_json.out)["first_seed"], 3);
  EXPECT_EQ(RunCommand("soak --scenes -1").exit_code, 2);
  fs::remove_all(directory);
}

}  // namespace
}  // namespace invsim
