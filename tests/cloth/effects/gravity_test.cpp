// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/gravity.h"

#include <gtest/gtest.h>

#include "../test_cloth.h"
#include "invsim/cloth/mass.h"

namespace invsim {
namespace {

TEST(Gravity, PullsTheWeightOfTheCloth) {
  const Garment garment = Sheet(3, 2, 0.1, 0.3);
  const Material material{
      "any", 0.2, IsotropicStretch{100.0}, IsotropicBending{1e-5}};
  const VectorXd masses = VertexMasses(garment, material);
  EXPECT_NEAR(masses.sum(), 0.2 * 0.06, 1e-15);
  const Gravity gravity(masses, {.acceleration = Vector3d(1.0, -2.0, 3.0)});
  const ClothState y{garment.placed, Points::Zero(3, 12)};
  const Points force = ForceOf(gravity, y);
  EXPECT_LE((force.rowwise().sum() - 0.012 * Vector3d(1, -2, 3)).norm(), 1e-15);
  // Raising everything by h costs m g h.
  ClothState up = y;
  up.x.row(1).array() += 0.5;
  EXPECT_NEAR(gravity.Energy(up) - gravity.Energy(y), 0.012 * 2 * 0.5, 1e-15);
}

TEST(Gravity, ReadsItsOptions) {
  GravityOptions options;
  EXPECT_EQ(options.acceleration, Vector3d(0.0, -9.8, 0.0));
  OptionTable table;
  table.AddSection("gravity", &options);
  table.Read(Config::FromText("gravity.acceleration = [0, 0, -1.6]", "f"));
  EXPECT_EQ(options.acceleration, Vector3d(0.0, 0.0, -1.6));
}

}  // namespace
}  // namespace invsim
