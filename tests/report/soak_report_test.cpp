// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/soak_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace invsim {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

SoakFailure SoakFailureOf(std::uint64_t seed,
                          const std::vector<std::string>& limits) {
  SoakFailure failure{seed, "scene of " + std::to_string(seed), {}};
  for (const std::string& limit : limits)
    failure.broken.push_back({limit, limit + " by too much"});
  return failure;
}

// Every figure another, so that none can stand for another.
SoakResult ExampleSoak() {
  SoakResult r;
  r.first_seed = 700;
  r.scenes = 40;
  r.frames = 310;
  r.step.substeps = 1600;
  r.step.missed = 4;
  r.step.halved = 9;
  r.step.failed = 1;
  r.step.worst_residual = 3e-5;
  r.scenes_missed = 2;
  r.scenes_halved = 3;
  r.penetration = 0.00075;
  r.energy = 2e-3;
  r.derivative = 4e-8;
  r.derivatives = 5;
  r.columns = 35;
  r.switched = 6;
  r.seconds = 81;
  return r;
}

nlohmann::json ParsedSoak(const SoakResult& r) {
  return nlohmann::json::parse(SoakJson(r));
}

TEST(SoakReport, ALineHasEachFigure) {
  const std::string text = SoakText(ExampleSoak());
  for (const char* line :
       {"scenes +40, seeds from 700 on\n",
        "frames +310\n",
        "steps +1600\n",
        "steps converged +99.7500 %\n",  // 1596 of 1600
        "missed +4 in 2 scenes\n",
        "halved +9 in 3 scenes\n",
        "worst residual +3e-05 weights\n",
        "worst penetration +0.75 mm\n",
        "worst energy breach +0.002\n",
        "derivatives +5 scenes, 35 columns .6 switched., worst 4.0e-08\n",
        "time +81 s\n",
        "failing scenes +0\n"})
    EXPECT_THAT(text, ContainsRegex(line));
}

TEST(SoakReport, ProgramsGetTheSameFigures) {
  const nlohmann::json json = ParsedSoak(ExampleSoak());
  EXPECT_EQ(json["first_seed"], 700);
  EXPECT_EQ(json["scenes"], 40);
  EXPECT_EQ(json["frames"], 310);
  EXPECT_EQ(json["substeps"], 1600);
  EXPECT_EQ(json["substeps_missed"], 4);
  EXPECT_EQ(json["substeps_halved"], 9);
  EXPECT_EQ(json["substeps_failed"], 1);
  EXPECT_EQ(json["scenes_with_missed_steps"], 2);
  EXPECT_EQ(json["scenes_with_halved_steps"], 3);
  EXPECT_EQ(json["worst_residual_weights"], 3e-5);
  EXPECT_DOUBLE_EQ(json["penetration_max_mm"], 0.75);
  EXPECT_EQ(json["energy_gain_relative"], 2e-3);
  EXPECT_EQ(json["derivative_scenes"], 5);
  EXPECT_EQ(json["derivative_columns"], 35);
  EXPECT_EQ(json["derivative_columns_switched"], 6);
  EXPECT_EQ(json["derivative_relative_error"], 4e-8);
  EXPECT_EQ(json["seconds"], 81);
  EXPECT_EQ(json["failures"], nlohmann::json::array());
  EXPECT_EQ(json["failing_seeds"], nlohmann::json::object());
  EXPECT_EQ(json["borders"], nlohmann::json::object());
}

// A seed is all that is needed to see a failure again.
TEST(SoakReport, FailuresAreSortedByLimitWithTheirSeeds) {
  SoakResult r = ExampleSoak();
  r.failures = {SoakFailureOf(705, {"penetration"}),
                SoakFailureOf(711, {"energy", "penetration"})};
  const std::string text = SoakText(r);
  EXPECT_THAT(text, ContainsRegex("failing scenes +2\n"));
  EXPECT_THAT(text, ContainsRegex("energy +1 scenes .2.5 %., seeds 711\n"));
  EXPECT_THAT(text,
              ContainsRegex("penetration +2 scenes .5 %., seeds 705 711\n"));
  EXPECT_THAT(text,
              HasSubstr("seed 705: penetration by too much; \n"
                        "    scene of 705\n"));
  const nlohmann::json json = ParsedSoak(r);
  EXPECT_EQ(json["failing_seeds"]["energy"], nlohmann::json({711}));
  EXPECT_EQ(json["failing_seeds"]["penetration"], nlohmann::json({705, 711}));
  ASSERT_EQ(json["failures"].size(), 2u);
  EXPECT_EQ(json["failures"][1]["seed"], 711);
  EXPECT_EQ(json["failures"][1]["scene"], "scene of 711");
  EXPECT_EQ(json["failures"][1]["broken"],
            nlohmann::json({"energy by too much", "penetration by too much"}));
}

// What is beyond a border is told, but among no failures.
TEST(SoakReport, BordersStandByThemselves) {
  SoakResult r = ExampleSoak();
  r.borders["stiffer than 1e4"] = {701, 733};
  const std::string text = SoakText(r);
  EXPECT_THAT(text, ContainsRegex("failing scenes +0\n"));
  EXPECT_THAT(text,
              ContainsRegex("border: stiffer than 1e4\n +2 scenes .5 %., "
                            "seeds 701 733\n"));
  const nlohmann::json json = ParsedSoak(r);
  EXPECT_EQ(json["borders"]["stiffer than 1e4"], nlohmann::json({701, 733}));
  EXPECT_TRUE(json["failing_seeds"].empty());
}

// People see the first of a flood; programs get all of it.
TEST(SoakReport, TheTextEndsWhereTheFloodBegins) {
  for (const int failing : {12, 13, 20, 23}) {
    SoakResult r = ExampleSoak();
    for (int k = 0; k < failing; ++k)
      r.failures.push_back(SoakFailureOf(700 + k, {"energy"}));
    const std::string text = SoakText(r);
    EXPECT_EQ(ParsedSoak(r)["failures"].size(), r.failures.size());
    EXPECT_EQ(ParsedSoak(r)["failing_seeds"]["energy"].size(),
              r.failures.size());
    EXPECT_THAT(text, HasSubstr(failing > 12 ? " 711 ...\n" : " 711\n"));
    const int last = std::min(failing, 20) - 1;
    EXPECT_THAT(text,
                HasSubstr("scene of " + std::to_string(700 + last) + "\n"));
    EXPECT_THAT(text, Not(HasSubstr("seed 720:")));
    if (failing > 20)
      EXPECT_THAT(text, HasSubstr("and 3 more\n"));
    else
      EXPECT_THAT(text, Not(HasSubstr(" more\n")));
  }
}

// Seeds are of 64 bits, of which a double holds 53.
TEST(SoakReport, LargeSeedsAreExact) {
  const std::uint64_t seed = 18446744073709551615u;
  SoakResult r = ExampleSoak();
  r.first_seed = seed;
  r.failures = {SoakFailureOf(seed, {"energy"})};
  const std::string text = SoakText(r);
  EXPECT_THAT(text, HasSubstr("seeds from 18446744073709551615 on"));
  EXPECT_THAT(text, HasSubstr("seed 18446744073709551615:"));
  EXPECT_EQ(ParsedSoak(r)["first_seed"].get<std::uint64_t>(), seed);
  EXPECT_EQ(ParsedSoak(r)["failures"][0]["seed"].get<std::uint64_t>(), seed);
}

// A soak that is stopped at once has no share of anything.
TEST(SoakReport, NothingDoneIsNoDivisionByZero) {
  const std::string text = SoakText({});
  EXPECT_THAT(text, ContainsRegex("steps converged +0.0000 %"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace invsim
