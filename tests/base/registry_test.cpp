// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/registry.h"

#include <gtest/gtest.h>

namespace invsim {

struct Spring {
  double force;
};

struct LinearOptions {
  double stiffness = 2;
};

void Describe(OptionTable* table, LinearOptions* o) {
  table->Add("stiffness", &o->stiffness, {.unit = "N/m", .at_least = 0});
}

namespace {

using SpringRegistry = Registry<Spring, const double&>;

std::unique_ptr<Spring> MakeLinear(const LinearOptions& options,
                                   const double& length) {
  return std::make_unique<Spring>(Spring{options.stiffness * length});
}

SpringRegistry Springs() {
  SpringRegistry springs("spring");
  springs.Add<LinearOptions>("linear", "k x", MakeLinear);
  springs.Add<NoOptions>("unit", "x", [](const NoOptions&, const double& x) {
    return std::make_unique<Spring>(Spring{x});
  });
  return springs;
}

TEST(RegistryTest, MakesWithDefaults) {
  EXPECT_EQ(Springs().Choose("linear")->Make(3)->force, 6);
  EXPECT_EQ(Springs().Choose("unit")->Make(3)->force, 3);
}

TEST(RegistryTest, OptionsAreReadBeforeMaking) {
  const auto linear = Springs().Choose("linear");
  const auto unit = Springs().Choose("unit");
  OptionTable table;
  table.AddSection("linear", linear.get());
  table.AddSection("unit", unit.get());
  EXPECT_EQ(table.keys(), std::vector<std::string>{"linear.stiffness"});
  table.Read(Config::FromText("linear.stiffness = 5", "f.toml"));
  EXPECT_EQ(linear->Make(3)->force, 15);
  EXPECT_EQ(Springs().Choose("linear")->Make(3)->force, 6)
      << "choices do not share options";
}

TEST(RegistryTest, UnknownNameSuggestsTheNearest) {
  try {
    Springs().Choose("liner");
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "unknown spring 'liner'; did you mean 'linear'?");
  }
}

TEST(RegistryTest, ListsInOrderAndRefusesTwins) {
  SpringRegistry springs = Springs();
  EXPECT_EQ(springs.names(), (std::vector<std::string>{"linear", "unit"}));
  EXPECT_EQ(springs.entries()[0].doc, "k x");
  EXPECT_THROW(springs.Add<LinearOptions>("unit", "", MakeLinear),
               std::logic_error);
}

}  // namespace
}  // namespace invsim
