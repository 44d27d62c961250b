// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "run_command.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;

// The whole way, on as few frames as there can be.
TEST(DemoCommand, GetsNearerToTheTruthAndSaysSo) {
  const std::string out = (TestDirectory() / "demo").string();
  const CommandResult result =
      RunCommand("demo -q --frames 2 --out '" + out + "'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("$ invsim fit --points"));
  EXPECT_THAT(result.out, HasSubstr(out + "/fit/report.html"));
  EXPECT_TRUE(std::filesystem::exists(out + "/fit/report.html"));
  const size_t row = result.out.find("body (all vertices, all frames)");
  ASSERT_NE(row, std::string::npos) << result.out;
  std::istringstream numbers(result.out.substr(
      row + std::string("body (all vertices, all frames)").size()));
  double before = 0, after = 0;
  numbers >> before >> after;
  EXPECT_GT(before, 20);
  EXPECT_LT(after, 0.5 * before);

  // Nothing is replaced unasked.
  const CommandResult again = RunCommand("demo -q --out '" + out + "'");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--force"));
}

}  // namespace
}  // namespace invsim
