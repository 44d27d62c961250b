// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace invsim {
namespace {

constexpr int kSamples = 200000;

TEST(RandomTest, SeedFixesTheSequence) {
  // From a second program of the same recipe in another language. If these
  // numbers change, so does every synthetic data set.
  Random random(1, 2);
  EXPECT_EQ(random.Bits(), 13502186381601466101u);
  EXPECT_EQ(random.Bits(), 14010220477554852104u);
  EXPECT_EQ(random.Bits(), 6828232781586495118u);
}

TEST(RandomTest, StreamsAndSeedsDiffer) {
  std::set<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (std::uint64_t stream = 0; stream < 20; ++stream)
      firsts.insert(Random(seed, stream).Bits());
  EXPECT_EQ(firsts.size(), 400u);
}

TEST(RandomTest, UniformHasTheMomentsOfTheUniform) {
  Random random(3);
  double sum = 0, squares = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = random.Uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    sum += x;
    squares += x * x;
  }
  // Four standard deviations of each mean.
  EXPECT_NEAR(sum / kSamples, 0.5, 4 * std::sqrt(1.0 / 12 / kSamples));
  EXPECT_NEAR(squares / kSamples, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / kSamples));
}

TEST(RandomTest, UniformRange) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.Uniform(-2, 5);
    ASSERT_GE(x, -2);
    ASSERT_LT(x, 5);
  }
}

TEST(RandomTest, IndexIsFair) {
  Random random(4);
  constexpr int kSides = 7;
  std::vector<int> counts(kSides);
  for (int i = 0; i < kSamples; ++i) ++counts[random.Index(kSides)];
  double chi_squared = 0;
  const double expected = static_cast<double>(kSamples) / kSides;
  for (const int count : counts)
    chi_squared += (count - expected) * (count - expected) / expected;
  EXPECT_LT(chi_squared, 22.5);  // 0.1 % level, 6 degrees of freedom
  EXPECT_EQ(random.Index(1), 0);
}

TEST(RandomTest, NormalHasTheMomentsOfTheNormal) {
  Random random(5);
  double sum = 0, squares = 0, fourths = 0, products = 0, last = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = random.Normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    products += x * last;  // the pairs of the polar method are independent
    last = x;
  }
  const double deviation = 4 / std::sqrt(kSamples);
  EXPECT_NEAR(sum / kSamples, 0, deviation);
  EXPECT_NEAR(squares / kSamples, 1, deviation * std::sqrt(2));
  EXPECT_NEAR(fourths / kSamples, 3, deviation * std::sqrt(96));
  EXPECT_NEAR(products / kSamples, 0, deviation);
}

}  // namespace
}  // namespace invsim
