// SPDX-License-Identifier: Apache-2.0
#include "harness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace invsim {
namespace {

using ::testing::HasSubstr;

TEST(HarnessTest, MedianOfOddAndEvenNumbers) {
  EXPECT_EQ(Median({3, 1, 2}), 2);
  EXPECT_EQ(Median({4, 1, 3, 2}), 2.5);
  EXPECT_EQ(Median({7}), 7);
}

TEST(HarnessTest, GrowthExponentOfAPowerLaw) {
  std::vector<double> values;
  const std::vector<double> sizes = {1000, 5000, 20000};
  for (double size : sizes) values.push_back(3e-6 * std::pow(size, 1.5));
  EXPECT_NEAR(GrowthExponent(sizes, values), 1.5, 1e-12);
}

TEST(HarnessTest, TimesEveryRepeatAndWarmsUp) {
  const Bench bench("", 5);
  int calls = 0;
  const double seconds = bench.Seconds([&] { ++calls; });
  EXPECT_GE(calls, 6);
  EXPECT_GT(seconds, 0);
  int above = 0;
  int below = 0;
  EXPECT_GT(bench.Ratio([&] { ++above; }, [&] { ++below; }), 0);
  EXPECT_GE(above, 6);
  EXPECT_GE(below, 6);
}

TEST(HarnessTest, FiltersByPartOfTheName) {
  EXPECT_TRUE(Bench("", 1).Wants("step/ratio"));
  EXPECT_TRUE(Bench("step", 1).Wants("step/ratio"));
  EXPECT_FALSE(Bench("io/", 1).Wants("step/ratio"));
}

TEST(HarnessTest, WritesTableAndJson) {
  const std::vector<BenchRow> rows = {{"step/ratio", 1266, 506, 2.5, "ratio"},
                                      {"peak", 0, 0, 123456, "MB"}};
  EXPECT_THAT(BenchTable(rows),
              HasSubstr("step/ratio       1266        506  2.5 ratio\n"));
  EXPECT_THAT(BenchTable(rows),
              HasSubstr("peak                -          -  1.235e+05 MB\n"));
  const auto json = nlohmann::json::parse(BenchJson(rows));
  ASSERT_EQ(json.size(), 2);
  EXPECT_EQ(json[0]["name"], "step/ratio");
  EXPECT_EQ(json[0]["vertices"], 1266);
  EXPECT_EQ(json[0]["contacts"], 506);
  EXPECT_EQ(json[0]["value"], 2.5);
  EXPECT_EQ(json[0]["unit"], "ratio");
}

TEST(HarnessTest, KnowsItsMemory) {
  const double before = PeakMemoryMegabytes();
  EXPECT_GT(before, 1);
  // Touched, so that it is resident.
  const std::vector<char> block(64000000, 'x');
  EXPECT_GE(PeakMemoryMegabytes(), before + 0.5 * block.size() / 1e6);
}

}  // namespace
}  // namespace invsim
