// SPDX-License-Identifier: Apache-2.0
#include "../../src/fit/prospects.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace invsim {
namespace {

// After costs that follow each other.
bool Good(double kept, const std::vector<double>& costs) {
  Prospects prospects(kept);
  for (size_t i = 0; i < costs.size(); ++i) {
    IterationRecord record;
    record.iteration = static_cast<int>(i);
    record.cost = costs[i];
    prospects.Update(record);
  }
  return prospects.good();
}

TEST(Prospects, AreOfTheFirstStepThatHelps) {
  EXPECT_TRUE(Good(6, {20}));
  EXPECT_TRUE(Good(6, {20, 20, 20}));
  EXPECT_FALSE(Good(6, {20, 20, 15}));
  EXPECT_TRUE(Good(6, {20, 12}));
  EXPECT_FALSE(Good(6, {20, 13}));  // to 6: not below
  EXPECT_TRUE(Good(6, {20, 12, 11.9, 11.8}));
}

TEST(Prospects, AreGoodWhereNothingIsToBeBeaten) {
  EXPECT_TRUE(Good(std::numeric_limits<double>::infinity(), {20, 19.9}));
  Prospects prospects(6.5);
  EXPECT_EQ(prospects.reason(),
            "Its first step did not come near the cost of what is kept, 6.5.");
}

}  // namespace
}  // namespace invsim
