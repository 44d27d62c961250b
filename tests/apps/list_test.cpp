// SPDX-License-Identifier: Apache-2.0

// `invsim list`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "run_command.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;

std::set<std::string> Names(const std::string& kind) {
  const CommandResult result = RunCommand("list --json " + kind);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::set<std::string> names;
  for (const auto& item : nlohmann::json::parse(result.out)) {
    EXPECT_FALSE(item["doc"].get<std::string>().empty()) << item["name"];
    names.insert(item["name"]);
  }
  return names;
}

TEST(ListCommandTest, NamesAllThereIs) {
  EXPECT_THAT(Names("effects"),
              IsSupersetOf({"inertia",
                            "gravity",
                            "membrane",
                            "bending",
                            "stiffness_damping",
                            "mass_damping",
                            "air_drag",
                            "self_contact"}));
  EXPECT_THAT(Names("materials"),
              IsSupersetOf({"cotton", "denim", "jersey", "silk"}));
  EXPECT_EQ(
      Names("garments"),
      (std::set<std::string>{
          "tshirt", "long_sleeved_shirt", "tank_top", "dress", "trousers"}));
  EXPECT_THAT(Names("motions"), IsSupersetOf({"walk_in_place", "squat"}));
  EXPECT_EQ(Names("presets"),
            (std::set<std::string>{"draft", "balanced", "precise"}));
  EXPECT_THAT(Names("options"), IsSupersetOf({"fit", "simulate", "sweep"}));
  EXPECT_THAT(RunCommand("list options").out,
              HasSubstr("fit.dressings = 2  (an integer >= 1)"));
  EXPECT_EQ(Names("losses"),
            (std::set<std::string>{"trivial",
                                   "huber",
                                   "soft_l1",
                                   "cauchy",
                                   "tukey",
                                   "arctan",
                                   "tolerant"}));
}

TEST(ListCommandTest, ShowsTheOptionsOfAnEffect) {
  const CommandResult result = RunCommand("list effects");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("effects.air_drag."));
}

TEST(ListCommandTest, RefusesWhatItDoesNotKnow) {
  const CommandResult result = RunCommand("list efects");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, StartsWith("invsim: unknown list 'efects'"));
  EXPECT_THAT(result.err, HasSubstr("effects"));
}

}  // namespace
}  // namespace invsim
