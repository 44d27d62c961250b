// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

SweepPlan PlanOf(const std::string& toml, Config* rest = nullptr) {
  Config config = Config::FromText(toml, "s.toml");
  const SweepPlan plan = TakeSweepPlan(&config);
  if (rest) *rest = config;
  return plan;
}

TEST(SweepPlan, IsEveryCombinationAndTheList) {
  Config rest;
  const SweepPlan plan = PlanOf(
      "[sweep]\nrepeats = 2\n"
      "[base]\ninput.garment = \"dress\"\n"
      "[reference]\nstep.substeps = 64\n"
      "[grid]\nstep.substeps = [1, 2]\ncontact.friction = [0.1, 0.3]\n"
      "[list.few]\nscene.effects = [\"gravity\", \"inertia\"]\n"
      "step.substeps = 3\n",
      &rest);
  EXPECT_THAT(plan.base, ElementsAre(Pair("input.garment", "\"dress\"")));
  EXPECT_TRUE(plan.has_reference);
  EXPECT_THAT(plan.reference.options, ElementsAre(Pair("step.substeps", "64")));
  ASSERT_EQ(plan.settings.size(), 5u);
  EXPECT_EQ(plan.settings[0].name, "friction=0.1,substeps=1");
  EXPECT_EQ(plan.settings[3].name, "friction=0.3,substeps=2");
  EXPECT_THAT(
      plan.settings[3].options,
      ElementsAre(Pair("contact.friction", "0.3"), Pair("step.substeps", "2")));
  EXPECT_EQ(plan.settings[4].name, "few");
  EXPECT_THAT(plan.settings[4].options,
              ElementsAre(Pair("scene.effects", "[\"gravity\", \"inertia\"]"),
                          Pair("step.substeps", "3")));
  // What is left is the command's own.
  ASSERT_EQ(rest.entries().size(), 1u);
  EXPECT_EQ(rest.entries().begin()->first, "sweep.repeats");
}

TEST(SweepPlan, NamesMayBeFolders) {
  const SweepPlan plan =
      PlanOf("[grid]\ninput.garment = [\"a/b c.obj\", \"tshirt\"]\n");
  EXPECT_EQ(plan.settings[0].name, "garment=a_b_c.obj");
  EXPECT_FALSE(plan.has_reference);
}

TEST(SweepPlan, TriesSwitchesAndLists) {
  const SweepPlan plan = PlanOf(
      "[grid]\nfit.uncertainty = [true, false]\n"
      "scene.effects = [\"auto\", [\"inertia\", \"gravity\"]]\n");
  ASSERT_EQ(plan.settings.size(), 4u);
  EXPECT_EQ(plan.settings[0].name, "uncertainty=true,effects=auto");
  EXPECT_EQ(plan.settings[3].name, "uncertainty=false,effects=inertia+gravity");
  EXPECT_THAT(plan.settings[3].options,
              ElementsAre(Pair("fit.uncertainty", "false"),
                          Pair("scene.effects", "[\"inertia\", \"gravity\"]")));
}

TEST(SweepPlan, SaysWhatIsWrongAndWhere) {
  const auto message = [](const std::string& toml) -> std::string {
    try {
      PlanOf(toml);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message("[grid]\nstep.substeps = 3\n"),
              testing::AllOf(HasSubstr("s.toml:2"), HasSubstr("a list")));
  EXPECT_THAT(message("[base]\nstep.substeps = 3\n"),
              HasSubstr("nothing to try"));
  EXPECT_THAT(message("[list]\nsubsteps = 3\n"), HasSubstr("list.NAME"));
  EXPECT_THAT(message("[grid]\na = [\"x/\", \"x_\"]\n"),
              HasSubstr("two settings are called 'a=x_'"));
}

TEST(SpreadOf, IsMedianLeastAndLargest) {
  const SweepSpread odd = SpreadOf({5, 1, 3});
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.least, 1);
  EXPECT_EQ(odd.largest, 5);
  EXPECT_EQ(SpreadOf({4, 1, 2, 100}).median, 3);
}

TEST(SweepResult, KeepsTheSpreadOfNumbersThatDiffer) {
  SweepResult r;
  r.Add("error", {3, 1, 8});
  r.Add("steps", {4, 4, 4});
  r.Add("none", {});
  EXPECT_THAT(r.values,
              ElementsAre(Pair("error", 3),
                          Pair("error_least", 1),
                          Pair("error_largest", 8),
                          Pair("steps", 4)));
}

SweepResult Result(const std::string& name,
                   double error,
                   double cost,
                   bool usable = true) {
  SweepResult r;
  r.setting.name = name;
  r.usable = usable;
  r.error = error;
  r.cost = {cost, cost, cost};
  return r;
}

TEST(SweepPlan, RefusesAValueInThePlaceOfASection) {
  for (const std::string part : {"base", "reference", "grid"})
    EXPECT_THAT([&] { PlanOf(part + " = 1\n"); },
                ::testing::ThrowsMessage<UsageError>(
                    HasSubstr("s.toml:1:1: " + part + " is a section")));
}

TEST(SweepPlan, TellsOptionsThatEndAlikeApart) {
  const SweepPlan plan = PlanOf(
      "[grid]\nstep.newton_iterations = [1]\n"
      "friction.newton_iterations = [30]\nstep.substeps = [2]\n");
  EXPECT_EQ(
      plan.settings[0].name,
      "friction.newton_iterations=30,step.newton_iterations=1,substeps=2");
}

TEST(SweepPlan, KnowsWhereEveryOptionWasWritten) {
  const SweepPlan plan = PlanOf(
      "[base]\na.b = 1\n[reference]\na.b = 2\n"
      "[grid]\nc.d = [3]\n[list.x]\nc.d = 4\n");
  EXPECT_EQ(ConfigOf(plan, plan.settings[0]).entries().at("a.b").origin,
            "s.toml:2:3");
  EXPECT_EQ(ConfigOf(plan, plan.settings[0]).entries().at("c.d").origin,
            "s.toml:6:3");
  EXPECT_EQ(ConfigOf(plan, plan.settings[1]).entries().at("c.d").origin,
            "s.toml:8:3");
  EXPECT_EQ(ConfigOf(plan, plan.reference).entries().at("a.b").origin,
            "s.toml:4:3");
}

TEST(MarkPareto, KeepsWhatNothingBeats) {
  std::vector<SweepResult> results = {Result("cheap", 10, 1),
                                      Result("good", 1, 10),
                                      Result("middle", 3, 3),
                                      Result("beaten", 4, 4),
                                      Result("as good, dearer", 3, 5),
                                      Result("same", 3, 3),
                                      Result("failed", 0, 0, false)};
  MarkPareto(&results);
  std::vector<std::string> front;
  for (const SweepResult& r : results)
    if (r.pareto) front.push_back(r.setting.name);
  EXPECT_THAT(front, ElementsAre("cheap", "good", "middle", "same"));
}

TEST(SweepVerdict, NamesTheCheapestThatIsNearlyAsGood) {
  const std::vector<SweepResult> results = {Result("best", 1, 60),
                                            Result("nearly", 1.04, 10),
                                            Result("also", 1.01, 20),
                                            Result("poor", 1.2, 1),
                                            Result("failed", 0.5, 1, false)};
  EXPECT_EQ(SweepVerdict(results, 0.05),
            "within 5 % of the best error (1, best) at 1/6 of the cost: "
            "nearly");
  EXPECT_THAT(SweepVerdict(results, 0.05, "time"), HasSubstr("of the time: "));
  EXPECT_THAT(SweepVerdict(results, 0.001),
              HasSubstr("nothing surely cheaper"));
  EXPECT_EQ(SweepVerdict({results.back()}, 0.05), "no setting succeeded");
}

TEST(SweepVerdict, OfEqualErrorsTheCheapestIsTheBest) {
  const std::vector<SweepResult> results = {Result("dear", 1, 60),
                                            Result("cheap", 1, 40)};
  EXPECT_EQ(SweepVerdict(results, 0.05),
            "best error 1: cheap; nothing surely cheaper comes within 5 %");
}

// The machine's noise is no saving.
TEST(SweepVerdict, CheaperIsWhatWasCheaperInEveryRepeat) {
  std::vector<SweepResult> results = {Result("best", 1, 60),
                                      Result("nearly", 1.01, 40)};
  results[0].cost.least = 45;
  results[1].cost.largest = 50;
  EXPECT_THAT(SweepVerdict(results, 0.05), HasSubstr("nothing surely cheaper"));
  results[1].cost.largest = 44;
  EXPECT_THAT(SweepVerdict(results, 0.05), HasSubstr(": nearly"));
}

TEST(SweepVerdict, SpeaksOfAPresetAsItIsAskedFor) {
  std::vector<SweepResult> results = {Result("slow", 1, 60),
                                      Result("usual", 1.04, 10)};
  results[1].setting.options = {{"fit.preset", "\"balanced\""}};
  EXPECT_EQ(SweepVerdict(results, 0.05, "time"),
            "within 5 % of the best error (1, slow) at 1/6 of the time: "
            "--preset balanced");
  // With another option beside it, it is no longer the preset.
  results[1].setting.options.emplace_back("step.substeps", "2");
  EXPECT_THAT(SweepVerdict(results, 0.05), HasSubstr(": usual"));
}

}  // namespace
}  // namespace invsim
