// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/material.h"

#include <gtest/gtest.h>

#include <limits>

#include "invsim/base/error.h"
#include "test_cloth.h"

namespace invsim {
namespace {

std::string ErrorOf(const Material& material) {
  try {
    ValidateMaterial(material, "scene.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Material, ExamplesAreValid) {
  for (const Material& material : ExampleMaterials())
    EXPECT_EQ(ErrorOf(material), "no error") << material.name;
}

TEST(Material, EveryBadFigureIsNamed) {
  const Material good = ExampleMaterials()[0];
  Material bad = good;
  bad.density = 0.0;
  EXPECT_EQ(ErrorOf(bad),
            "scene.toml: density is 0, expected a positive number of kg/m^2");
  bad = good;
  bad.density = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(ErrorOf(bad).find("density is nan"), std::string::npos);
  bad = good;
  bad.friction = -0.1;
  EXPECT_NE(ErrorOf(bad).find("friction is -0.1"), std::string::npos);
  bad = good;
  bad.stretch = IsotropicStretch{-5.0, 0.3};
  EXPECT_NE(ErrorOf(bad).find("stretch stiffness is -5"), std::string::npos);
  bad.stretch = IsotropicStretch{5.0, 1.0};
  EXPECT_NE(ErrorOf(bad).find("stretch poisson is 1"), std::string::npos);
  bad.stretch = OrthotropicStretch{100.0, 120.0, 100.0, 10.0};
  EXPECT_NE(ErrorOf(bad).find("stretch c12 is 120"), std::string::npos);
  bad = good;
  bad.bending = IsotropicBending{-1e-6};
  EXPECT_NE(ErrorOf(bad).find("bending stiffness"), std::string::npos);
  MeasuredStretch table = ExampleStretchTable();
  table.table[4][2] = std::numeric_limits<double>::infinity();
  bad = good;
  bad.stretch = table;
  EXPECT_NE(ErrorOf(bad).find("stretching[4][2] is inf"), std::string::npos);
}

}  // namespace
}  // namespace invsim
