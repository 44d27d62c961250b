// SPDX-License-Identifier: Apache-2.0
#include "../../src/algebra/cholmod_analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <thread>
#include <vector>

#include "algebra/random_matrix.h"

namespace invsim {
namespace {

TEST(CholmodAnalysis, LowerHoldsTheLowerTriangle) {
  const BlockMatrix a = RandomMatrix(4, 0, 1);
  CholmodAnalysis analysis(a.shared_pattern());
  ASSERT_TRUE(analysis.Load(a));
  const MatrixXd dense = Dense(a);
  MatrixXd lower = MatrixXd::Zero(dense.rows(), dense.cols());
  const auto* start = static_cast<const int*>(analysis.lower()->p);
  const auto* row = static_cast<const int*>(analysis.lower()->i);
  const auto* value = static_cast<const double*>(analysis.lower()->x);
  for (int j = 0; j < lower.cols(); ++j)
    for (int k = start[j]; k < start[j + 1]; ++k) lower(row[k], j) = value[k];
  EXPECT_EQ(lower, MatrixXd(dense.triangularView<Eigen::Lower>()));
}

TEST(CholmodAnalysis, OrdersEveryUnknownOnce) {
  const BlockMatrix a = RandomMatrix(6, 0, 2);
  const CholmodAnalysis analysis(a.shared_pattern());
  const auto* order = static_cast<const int*>(analysis.factor()->Perm);
  const int n = static_cast<int>(analysis.factor()->n);
  EXPECT_EQ(n, 3 * 36);
  EXPECT_EQ(std::set<int>(order, order + n).size(), static_cast<size_t>(n));
  EXPECT_TRUE(analysis.factor()->is_super);
}

TEST(CholmodAnalysis, RefusesWhatIsNotFinite) {
  BlockMatrix a = RandomMatrix(3, 0, 3);
  CholmodAnalysis analysis(a.shared_pattern());
  a.diagonal(4)(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(analysis.Load(a));
}

// The last bits of every solution depend on the order of the unknowns.
TEST(CholmodAnalysis, OrdersAlikeWhateverOtherThreadsDo) {
  const auto pattern = GridPattern(24);
  const auto order = [&] {
    const CholmodAnalysis analysis(pattern);
    const auto* first = static_cast<const int*>(analysis.factor()->Perm);
    return std::vector<int>(first, first + analysis.factor()->n);
  };
  const std::vector<int> alone = order();
  constexpr int kTimes = 25;
  int different[2] = {0, 0};
  {
    std::vector<std::jthread> threads;
    for (int& count : different)
      threads.emplace_back([&] {
        for (int i = 0; i < kTimes; ++i) count += order() != alone;
      });
  }
  EXPECT_EQ(different[0], 0);
  EXPECT_EQ(different[1], 0);
}

}  // namespace
}  // namespace invsim
