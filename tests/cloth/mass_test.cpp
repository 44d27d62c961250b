// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/mass.h"

#include <gtest/gtest.h>

#include "test_cloth.h"

namespace invsim {
namespace {

TEST(VertexMasses, GivesAThirdOfEachFaceToItsCorners) {
  const Garment garment = Sheet(1, 1, 2.0);  // two faces of 2 m^2
  const Material material{
      "any", 0.3, IsotropicStretch{100.0}, IsotropicBending{1e-5}};
  const VectorXd masses = VertexMasses(garment, material);
  EXPECT_NEAR(masses[0], 0.3 * 4.0 / 3.0, 1e-15);
  EXPECT_NEAR(masses[1], 0.3 * 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(masses[2], 0.3 * 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(masses[3], 0.3 * 4.0 / 3.0, 1e-15);
}

}  // namespace
}  // namespace invsim
