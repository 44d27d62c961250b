// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/mass_damping.h"

#include <gtest/gtest.h>

#include "../test_cloth.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

TEST(MassDamping, OpposesMomentum) {
  const VectorXd masses = Eigen::Vector3d(1.0, 2.0, 4.0);
  const MassDamping damping(masses, {.rate = 0.5});
  ClothState y{Points::Zero(3, 3), Points::Ones(3, 3)};
  const Points force = ForceOf(damping, y);
  EXPECT_EQ(force.col(0), Vector3d::Constant(-0.5));
  EXPECT_EQ(force.col(2), Vector3d::Constant(-2.0));
}

TEST(MassDamping, RefusesANegativeRate) {
  MassDampingOptions options;
  OptionTable table;
  table.AddSection("mass_damping", &options);
  EXPECT_THROW(table.Read(Config::FromText("mass_damping.rate = -1", "f")),
               UsageError);
}

}  // namespace
}  // namespace invsim
