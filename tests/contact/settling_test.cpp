// SPDX-License-Identifier: Apache-2.0
#include "../../src/contact/settling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace invsim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

std::vector<ContactMode> AllSliding(int n) {
  return std::vector<ContactMode>(n, ContactMode::kSlide);
}

// A residual of 10^-(k/4) in iteration k falls by four iterations a digit.
void AddSteady(int iterations, Settling* settling) {
  for (int k = 0; k < iterations; ++k)
    settling->Add(std::pow(10.0, -k / 4.0), AllSliding(10));
}

TEST(SettlingTest, TellsTheIterationsToCome) {
  Settling settling;
  AddSteady(13, &settling);  // the last is 1e-3
  EXPECT_NEAR(settling.IterationsLeft(1e-6), 12, 1e-9);
  EXPECT_EQ(settling.IterationsLeft(1e-2), 0);
}

TEST(SettlingTest, NeedsSomeIterationsToTell) {
  Settling settling;
  AddSteady(4, &settling);
  EXPECT_FALSE(settling.ModesRest());
  EXPECT_EQ(settling.IterationsLeft(1e-6), kNever);
}

TEST(SettlingTest, AResidualThatDoesNotFallNeverArrives) {
  Settling settling;
  for (int k = 0; k < 20; ++k) settling.Add(1, AllSliding(10));
  EXPECT_TRUE(settling.ModesRest());
  EXPECT_EQ(settling.IterationsLeft(1e-6), kNever);
}

TEST(SettlingTest, OneModeOfAThousandMayChangeButNotOneOfTen) {
  for (int contacts : {1000, 10}) {
    Settling settling;
    std::vector<ContactMode> modes = AllSliding(contacts);
    for (int k = 0; k < 20; ++k) {
      modes[0] = k % 2 ? ContactMode::kStick : ContactMode::kSlide;
      settling.Add(std::pow(0.5, k), modes);
    }
    EXPECT_EQ(settling.ModesRest(), contacts == 1000);
  }
}

TEST(SettlingTest, ModesThatRestedMayChangeAgain) {
  Settling settling;
  AddSteady(20, &settling);
  EXPECT_TRUE(settling.ModesRest());
  settling.Add(1e-6, std::vector<ContactMode>(10, ContactMode::kOpen));
  EXPECT_FALSE(settling.ModesRest());
}

}  // namespace
}  // namespace invsim
