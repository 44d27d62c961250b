// SPDX-License-Identifier: Apache-2.0
// The effect by itself, without any force; layers at work are in
// sim/self_contact_test.cpp.
#include "invsim/cloth/effects/self_contact.h"

#include <gtest/gtest.h>

#include "../test_cloth.h"
#include "invsim/base/config.h"
#include "invsim/base/error.h"

namespace invsim {
namespace {

class SelfContactOptionsTest : public ::testing::Test {
 protected:
  SelfContactOptionsTest() { table_.AddSection("self_contact", &options_); }
  void Read(const std::string& text) {
    table_.Read(Config::FromText(text, "f.toml"));
  }

  SelfContactOptions options_;
  OptionTable table_;
};

TEST_F(SelfContactOptionsTest, EveryKeySetsItsOwnMember) {
  Read(
      "self_contact.thickness = 0.125\nself_contact.friction = 0.25\n"
      "self_contact.margin = 0.5\nself_contact.recovery_speed = 2.0\n"
      "self_contact.compliance = 4.0\n");
  EXPECT_EQ(options_.thickness, 0.125);
  EXPECT_EQ(options_.friction, 0.25);
  EXPECT_EQ(options_.margin, 0.5);
  EXPECT_EQ(options_.recovery_speed, 2);
  EXPECT_EQ(options_.compliance, 4);
  EXPECT_EQ(table_.keys().size(), 5u);
}

// Layers without a thickness, or that never part, cannot be kept apart.
// Friction may be none.
TEST_F(SelfContactOptionsTest, WhatCannotKeepLayersApartIsRefused) {
  for (const char* bad : {"self_contact.thickness = 0.0",
                          "self_contact.thickness = -0.001",
                          "self_contact.friction = -0.1",
                          "self_contact.margin = 0.0",
                          "self_contact.recovery_speed = 0.0",
                          "self_contact.compliance = 0.0"})
    EXPECT_THROW(Read(bad), UsageError) << bad;
  Read("self_contact.friction = 0.0");
  EXPECT_EQ(options_.friction, 0);
}

TEST(SelfContactEffect, HoldsItsOptionsAndTheGarmentAsMade) {
  const Garment sheet = Sheet(2, 2, 0.1, 0.3);
  const SelfContact effect(sheet, {.thickness = 0.003, .friction = 0.7});
  EXPECT_EQ(effect.options().thickness, 0.003);
  EXPECT_EQ(effect.options().friction, 0.7);
  EXPECT_EQ(effect.made(), sheet.placed);
}

// Its forces are those of the contacts, which the step finds. Beside them the
// cloth is as without it: it couples no vertices and has no energy.
TEST(SelfContactEffect, ExertsNoForceByItself) {
  const Garment sheet = Sheet(3, 2, 0.1);
  SelfContact effect(sheet, {});
  const auto pattern = BindAlone(&effect, 12);
  EXPECT_EQ(pattern->column.size(), 12u);  // the diagonal only
  const ClothState y{RandomPoints(12, 0.001, 1), RandomPoints(12, 1, 2)};
  EXPECT_EQ(ForceOf(effect, y).norm(), 0);
  EXPECT_EQ(effect.Energy(y), 0);
  EXPECT_EQ(StiffnessOf(effect, pattern, y, 1, 1).norm(), 0);
  EXPECT_FALSE(effect.depends_on_velocity());
}

}  // namespace
}  // namespace invsim
