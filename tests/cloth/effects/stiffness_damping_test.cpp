// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/stiffness_damping.h"

#include <gtest/gtest.h>

#include "../test_cloth.h"
#include "invsim/cloth/effect_registry.h"
#include "invsim/cloth/effects/membrane.h"

namespace invsim {
namespace {

class StiffnessDampingTest : public testing::Test {
 protected:
  StiffnessDampingTest() : garment_(Sheet(3, 3, 0.03, 0.2)) {
    std::vector<StiffnessDamping::Term> terms;
    terms.push_back(
        {std::make_unique<Membrane>(garment_, ExampleMaterials()[0].stretch),
         0.02});
    damping_ = std::make_unique<StiffnessDamping>(std::move(terms));
    pattern_ = BindAlone(damping_.get(), garment_.num_vertices());
    y_.x = 1.1 * garment_.placed;
    y_.v = RandomPoints(garment_.num_vertices(), 1.0, 3);
  }

  Garment garment_;
  std::unique_ptr<StiffnessDamping> damping_;
  std::shared_ptr<const BlockPattern> pattern_;
  ClothState y_;
};

TEST_F(StiffnessDampingTest, IsProportionalToStiffness) {
  Membrane membrane(garment_, ExampleMaterials()[0].stretch);
  membrane.Bind(*pattern_);
  const MatrixXd k = StiffnessOf(membrane, pattern_, y_, 1.0, 0.0);
  const MatrixXd d = StiffnessOf(*damping_, pattern_, y_, 0.0, 1.0);
  EXPECT_LE((d - 0.02 * k).norm(), 1e-14 * d.norm());
  const VectorXd expected = -0.02 * k * Stacked(y_.v);
  EXPECT_LE((Stacked(ForceOf(*damping_, y_)) - expected).norm(),
            1e-13 * expected.norm());
}

TEST_F(StiffnessDampingTest, TakesEnergyFromDeformationOnly) {
  EXPECT_LT(ForceOf(*damping_, y_).cwiseProduct(y_.v).sum(), 0.0);
  y_.v.colwise() = Vector3d(1.0, 2.0, -3.0);
  EXPECT_LE(ForceOf(*damping_, y_).norm(), 1e-12);
}

TEST(StiffnessDamping, MakesOnlyTheTermsThatDamp) {
  const Garment garment = Sheet(2, 2, 0.03);
  const auto choice = Effects().Choose("stiffness_damping");
  OptionTable table;
  table.AddSection("stiffness_damping", choice.get());
  table.Read(Config::FromText(
      "stiffness_damping.membrane = 0.0\nstiffness_damping.bending = 0.5",
      "f"));
  const auto effect = choice->Make(garment, ExampleMaterials()[0]);
  ClothState y{garment.placed, garment.placed};  // stretching, staying flat
  EXPECT_LE(ForceOf(*effect, y).norm(), 1e-15);
  y.v.row(2) = garment.placed.row(0).cwiseProduct(garment.placed.row(0));
  EXPECT_GT(ForceOf(*effect, y).norm(), 0.0);
}

}  // namespace
}  // namespace invsim
