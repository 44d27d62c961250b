// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/fit_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "report/fit_round.h"

namespace invsim {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

FitReport ExampleFit() {
  FitReport report;
  report.points = "scan/points";
  report.body = "mannequin";
  report.result.termination = Termination::kConverged;
  report.result.simulated = true;
  OnlyRound(&report.result).optimizer.emplace();
  report.result.body.shape.setZero();
  return report;
}

TEST(FitReport, NamesWhatWasLeftOutOfTheDerivative) {
  FitReport report = ExampleFit();
  EXPECT_THAT(Approximations(report), Contains(HasSubstr("History of one")));
  report.history = History::kCarried;
  EXPECT_THAT(Approximations(report), Contains(HasSubstr("Carried history")));
}

TEST(FitReport, NamesContactsOfTheClothThatWereHeld) {
  FitReport report = ExampleFit();
  EXPECT_THAT(Approximations(report), Each(Not(HasSubstr("sweeping"))));
  report.result.stats.fixed_contacts = 17;
  EXPECT_THAT(Approximations(report),
              Contains(HasSubstr("17 contacts found by sweeping")));
  EXPECT_THAT(FitText(report), HasSubstr("17 contacts found by sweeping"));
  const auto json = nlohmann::json::parse(FitJson(report));
  EXPECT_EQ(json["approximations"].size(), Approximations(report).size());
}

TEST(FitReport, ListsTheIterationsOfEveryDressing) {
  FitReport report = ExampleFit();
  OptimizerSummary summary;
  summary.seconds = 10;
  summary.iterations.resize(2);
  summary.iterations[1].iteration = 1;
  summary.iterations[1].seconds = 8;
  report.result.rounds = {{{}, summary}, {{}, std::nullopt}, {{}, summary}};
  const std::string csv = IterationsCsv(report);
  EXPECT_THAT(csv, HasSubstr("dressing,iteration,successful,cost"));
  EXPECT_THAT(csv, HasSubstr("\n1,1,1,"));
  EXPECT_THAT(csv, HasSubstr("\n3,0,1,"));
  EXPECT_THAT(csv, Not(HasSubstr("\n2,")));
  const std::vector<Chart> charts = FitCharts(report);
  ASSERT_FALSE(charts.empty());
  EXPECT_EQ(charts[0].x, (std::vector<double>{0, 8, 10, 18}));
}

TEST(FitReport, NamesStepsThatMissed) {
  FitReport report = ExampleFit();
  report.result.stats.step.missed = 3;
  EXPECT_THAT(Approximations(report),
              Contains(HasSubstr("3 simulation steps missed")));
}

TEST(FitReport, SaysWhetherItCanBeUsed) {
  FitReport report = ExampleFit();
  EXPECT_THAT(Verdict(report), HasSubstr("usable"));
  EXPECT_EQ(nlohmann::json::parse(FitJson(report))["usable"], true);
  report.result.termination = Termination::kFailed;
  EXPECT_EQ(nlohmann::json::parse(FitJson(report))["usable"], false);
}

// Paths are bytes; what is not UTF-8 must not end the report.
TEST(FitReport, TakesAnyPath) {
  FitReport report = ExampleFit();
  report.points = "scan\xff";
  EXPECT_TRUE(nlohmann::json::accept(FitJson(report)));
}

}  // namespace
}  // namespace invsim
