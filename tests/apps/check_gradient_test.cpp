// SPDX-License-Identifier: Apache-2.0

// `invsim check-gradient` on the smallest scene there is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_command.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;

const std::string kCube = "--config " INVSIM_CONFIGS "/cube.toml ";

TEST(CheckGradientTest, ReportsTheErrorOfEveryParameterThatMovesTheCloth) {
  const std::string out = (TestDirectory() / "check").string();
  const CommandResult result =
      RunCommand("check-gradient --json " + kCube + "--out " + out);
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["columns"], 6);  // root rotation and translation
  EXPECT_EQ(json["columns_without_influence"], 79);
  EXPECT_LT(json["largest_relative_error"], 1e-6);
  EXPECT_GT(json["contacts"], 0);
  EXPECT_EQ(json["parameters"].size(), 6u);
  EXPECT_EQ(json["sweep"].size(), 5u);
  EXPECT_EQ(json, nlohmann::json::parse(ReadFileBytes(out + "/report.json")));
  const CommandResult again =
      RunCommand("check-gradient " + kCube + "--out " + out);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--force"));
}

TEST(CheckGradientTest, PrintsATableAndFailsWhatIsNotGoodEnough) {
  const CommandResult result = RunCommand("check-gradient " + kCube +
                                          "--set check.largest_error=1e-300");
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.out, HasSubstr("translation"));
  EXPECT_THAT(result.out, HasSubstr("smallest"));
  EXPECT_THAT(result.out, HasSubstr("79 parameters do not move the cloth"));
}

TEST(CheckGradientTest, RefusesAFrameThatIsNotThere) {
  const CommandResult result =
      RunCommand("check-gradient " + kCube + "--frame 0");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("check.frame = 0"));
}

}  // namespace
}  // namespace invsim
