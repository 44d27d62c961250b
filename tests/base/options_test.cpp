// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "invsim/base/error.h"

namespace invsim {

enum class Solver { kDirect, kKrylov };

struct InnerOptions {
  double tolerance = 1e-8;
  Solver solver = Solver::kKrylov;
};

struct OuterOptions {
  int substeps = 3;
  bool warm = true;
  std::int64_t seed = 7;
  double friction = 0.3;
  std::string material = "cotton";
  Vector3d gravity = Vector3d(0, -9.81, 0);
  std::vector<int> pins;
  std::vector<double> times = {0, 0.5};
  std::vector<std::string> effects = {"membrane"};
  InnerOptions inner;
};

void Describe(OptionTable* table, InnerOptions* o) {
  table->Add("tolerance",
             &o->tolerance,
             {.doc = "stop below", .unit = "N", .above = 0, .below = 1});
  table->Add("solver",
             &o->solver,
             {{"direct", Solver::kDirect}, {"krylov", Solver::kKrylov}},
             {.doc = "linear solver"});
}

void Describe(OptionTable* table, OuterOptions* o) {
  table->Add("substeps", &o->substeps, {.doc = "per frame", .at_least = 1});
  table->Add("warm", &o->warm, {.doc = "warm start"});
  table->Add("seed", &o->seed, {.doc = "of everything random"});
  table->Add("friction", &o->friction, {.at_least = 0, .at_most = 2});
  table->Add(
      "material", &o->material, {.choices = {"cotton", "denim", "silk"}});
  table->Add("gravity", &o->gravity, {.unit = "m/s^2"});
  table->Add("pins", &o->pins, {.at_least = 0});
  table->Add("times", &o->times, {.unit = "s"});
  table->Add("effects", &o->effects, {.choices = {"membrane", "bending"}});
  table->AddSection("inner", &o->inner);
}

namespace {

using testing::EndsWith;
using testing::HasSubstr;

class OptionsTest : public testing::Test {
 protected:
  OptionsTest() { table_.AddSection("scene", &options_); }

  void Read(const std::string& toml) {
    table_.Read(Config::FromText(toml, "f.toml"));
  }
  std::string ErrorOf(const std::string& toml) {
    try {
      Read(toml);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no error";
  }

  OuterOptions options_;
  OptionTable table_;
};

TEST_F(OptionsTest, ReadsEveryType) {
  Read(
      "[scene]\n"
      "substeps = 5\nwarm = false\nseed = 12345678901\nfriction = 1\n"
      "material = 'silk'\ngravity = [0, 0, -1]\npins = [3, 4]\n"
      "times = [1, 2.5]\neffects = []\n"
      "[scene.inner]\ntolerance = 1e-3\nsolver = 'direct'\n");
  EXPECT_EQ(options_.substeps, 5);
  EXPECT_FALSE(options_.warm);
  EXPECT_EQ(options_.seed, 12345678901);
  EXPECT_EQ(options_.friction, 1.0);
  EXPECT_EQ(options_.material, "silk");
  EXPECT_EQ(options_.gravity, Vector3d(0, 0, -1));
  EXPECT_EQ(options_.pins, (std::vector<int>{3, 4}));
  EXPECT_EQ(options_.times, (std::vector<double>{1, 2.5}));
  EXPECT_TRUE(options_.effects.empty());
  EXPECT_EQ(options_.inner.tolerance, 1e-3);
  EXPECT_EQ(options_.inner.solver, Solver::kDirect);
}

TEST_F(OptionsTest, WhatIsNotNamedKeepsItsDefault) {
  Read("scene.substeps = 4");
  EXPECT_EQ(options_.friction, 0.3);
  EXPECT_EQ(options_.inner.solver, Solver::kKrylov);
}

TEST_F(OptionsTest, UnknownKeyNamesPlaceAndNearest) {
  EXPECT_EQ(ErrorOf("[scene]\n\nsubstep = 4"),
            "f.toml:3:1: unknown option 'scene.substep'; did you mean "
            "'scene.substeps'?");
  EXPECT_EQ(ErrorOf("tolerance = 4"),
            "f.toml:1:1: unknown option 'tolerance'; did you mean "
            "'scene.inner.tolerance'?");
  EXPECT_EQ(ErrorOf("wavelength = 4"),
            "f.toml:1:1: unknown option 'wavelength'; `invsim list options` "
            "names them all");
  EXPECT_EQ(ErrorOf("scene = 4"),
            "f.toml:1:1: 'scene' is a section, not an option; expected "
            "scene.<option>");
}

TEST_F(OptionsTest, UnknownEmptySectionIsAnError) {
  EXPECT_EQ(ErrorOf("[scene.iner]"),
            "f.toml:1:8: unknown section 'scene.iner'; did you mean "
            "'scene.inner'?");
  EXPECT_EQ(ErrorOf("[scene.inner]"), "no error");
}

TEST_F(OptionsTest, BadValueNamesKeyValueAndConstraint) {
  EXPECT_EQ(ErrorOf("scene.substeps = 0"),
            "f.toml:1:7: scene.substeps = 0: expected an integer >= 1");
  EXPECT_EQ(ErrorOf("scene.substeps = 2.5"),
            "f.toml:1:7: scene.substeps = 2.5: expected an integer >= 1");
  EXPECT_EQ(ErrorOf("scene.substeps = 3000000000"),
            "f.toml:1:7: scene.substeps = 3000000000: expected an integer "
            ">= 1");
  EXPECT_EQ(ErrorOf("scene.friction = 2.5"),
            "f.toml:1:7: scene.friction = 2.5: expected a number >= 0 and "
            "<= 2");
  EXPECT_EQ(ErrorOf("scene.inner.tolerance = 0"),
            "f.toml:1:13: scene.inner.tolerance = 0: expected a number > 0 "
            "and < 1 [N]");
  EXPECT_EQ(ErrorOf("scene.material = 'coton'"),
            "f.toml:1:7: scene.material = \"coton\": expected one of cotton, "
            "denim, silk; did you mean 'cotton'?");
  EXPECT_EQ(ErrorOf("scene.inner.solver = 'lu'"),
            "f.toml:1:13: scene.inner.solver = \"lu\": expected one of "
            "direct, krylov");
  EXPECT_EQ(options_.substeps, 3) << "a refused value is not kept";
}

TEST_F(OptionsTest, WrongTypesAreRefused) {
  for (const char* line : {"warm = 1",
                           "seed = 'x'",
                           "friction = true",
                           "friction = nan",
                           "friction = inf",
                           "material = 3",
                           "gravity = [1, 2]",
                           "pins = [-1]",
                           "pins = [0.5]",
                           "pins = 3",
                           "times = [inf]",
                           "times = ['a']",
                           "effects = ['wind']",
                           "effects = 'wind'",
                           "effects = true",
                           "effects = [true, false]",
                           "effects = [['wind'], ['membrane']]",
                           "inner.solver = 0"}) {
    EXPECT_THAT(ErrorOf("scene." + std::string(line)), HasSubstr(": expected "))
        << line;
  }
}

TEST_F(OptionsTest, AListOfTextsMayBeGivenAsOne) {
  table_.Read(Config::FromText("scene.effects = 'membrane'", "a.toml"));
  EXPECT_EQ(options_.effects, std::vector<std::string>{"membrane"});
}

// If it is one of names, which have no commas.
TEST_F(OptionsTest, AListOfNamesMayBeGivenWithCommas) {
  Config config;
  config.Set("scene.effects", "bending, membrane", "--set");
  table_.Read(config);
  EXPECT_EQ(options_.effects,
            (std::vector<std::string>{"bending", "membrane"}));
  EXPECT_THAT(ErrorOf("scene.effects = 'membrane,bendin'"),
              testing::AllOf(HasSubstr("each one of membrane, bending"),
                             testing::Not(HasSubstr("did you mean"))));
}

TEST_F(OptionsTest, CommandLineTextNeedsNoQuotes) {
  std::string name = "a";
  OptionTable table;
  table.Add("name", &name, {});
  Config config;
  config.Assign("name=12", "--set");
  table.Read(config);
  EXPECT_EQ(name, "12");
  EXPECT_THROW(table.Read(Config::FromText("name = 12", "f")), UsageError);
}

TEST_F(OptionsTest, ResolvedTomlReadsBackTheSame) {
  OptionTable table;
  double scale = 1.0 / 3.0;
  table.AddSection("scene", &options_);
  table.Add("scale", &scale, {});  // without a section, registered last
  Config config;
  config.Assign("scene.inner.tolerance=0.1", "--set");
  config.Assign("scene.pins=[1, 2]", "--set");
  table.Read(config);
  const std::string toml = ResolvedToml(table);

  OuterOptions other;
  double other_scale = 0;
  OptionTable other_table;
  other_table.AddSection("scene", &other);
  other_table.Add("scale", &other_scale, {});
  other_table.Read(Config::FromText(toml, "resolved"));
  EXPECT_EQ(other_scale, scale);
  ASSERT_EQ(table.options().size(), other_table.options().size());
  for (size_t i = 0; i < table.options().size(); ++i)
    EXPECT_EQ(table.options()[i].get(), other_table.options()[i].get())
        << table.options()[i].key;
  EXPECT_THAT(toml, HasSubstr("tolerance = 0.1  # N, --set\n"));
  EXPECT_THAT(toml, HasSubstr("substeps = 3  # default\n"));
}

TEST_F(OptionsTest, TextListsKeyDefaultAndMeaning) {
  Read("scene.substeps = 9");
  const std::string text = OptionsText(table_);
  EXPECT_THAT(text,
              HasSubstr("scene.substeps = 3  (an integer >= 1)\n"
                        "    per frame\n"));
  EXPECT_THAT(text,
              HasSubstr("scene.inner.solver = \"krylov\"  (one of direct, "
                        "krylov)\n    linear solver\n"));
}

TEST_F(OptionsTest, ProgrammingErrorsAreCaught) {
  int value = 0;
  OptionTable table;
  table.Add("value", &value, {});
  EXPECT_THROW(table.Add("value", &value, {}), std::logic_error);
  EXPECT_THROW(table.Add("other", &value, {.at_least = 1}), std::logic_error);
}

}  // namespace
}  // namespace invsim
