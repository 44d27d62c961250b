// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/comparison_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "invsim/io/file.h"

namespace invsim {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

// Ten steps and two seconds per iteration.
ComparisonRun RunOfOptimizer(const std::string& name,
                             const std::vector<double>& costs,
                             const std::vector<double>& errors = {}) {
  ComparisonRun run;
  run.optimizer = name;
  run.summary.termination = Termination::kIterationLimit;
  run.summary.reason = "Reason of " + name + ".";
  run.summary.details = "Details of " + name + ".";
  run.summary.counts.evaluations = 17;
  run.summary.counts.failed = 3;
  run.summary.counts.linearizations = 11;
  for (int k = 0; k < static_cast<int>(costs.size()); ++k) {
    ComparisonPoint point = {k, 10 * k, 2.0 * k, costs[k]};
    if (!errors.empty()) point.body_error = errors[k];
    run.points.push_back(point);
  }
  return run;
}

// The costs say other than the errors, so that one cannot stand for the other.
std::vector<ComparisonRun> KnownTruth() {
  return {RunOfOptimizer("lm", {9, 1}, {0.03, 0.0125}),
          RunOfOptimizer("gradient_descent", {9, 8, 2}, {0.03, 0.02, 0.025}),
          RunOfOptimizer("lbfgs", {9, 0.5}, {0.03, 0.0225})};
}

nlohmann::json ParsedComparison(const std::vector<ComparisonRun>& runs) {
  return nlohmann::json::parse(ComparisonJson(runs));
}

// The words of the line that begins with `name`.
std::vector<std::string> ComparisonLine(const std::vector<ComparisonRun>& runs,
                                        const std::string& name) {
  std::istringstream text(ComparisonText(runs));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::vector<std::string> all;
    for (std::string word; words >> word;) all.push_back(word);
    if (!all.empty() && all[0] == name) return all;
  }
  ADD_FAILURE() << "no line of " << name;
  return {};
}

// Iterations, evaluations, steps, seconds, cost, error in mm, steps to the
// baseline, how it ended.
TEST(ComparisonReport, ALinePerOptimiserHasWhereItEnded) {
  EXPECT_THAT(ComparisonLine(KnownTruth(), "gradient_descent"),
              ElementsAre("gradient_descent",
                          "2",
                          "17",
                          "20",
                          "4",
                          "2",
                          "25",
                          "10",
                          "iteration",
                          "limit"));
}

// The best that gradient descent had on its way, not what it ended with.
TEST(ComparisonReport, TheBaselineIsTheBestErrorOfGradientDescent) {
  const std::vector<ComparisonRun> runs = KnownTruth();
  EXPECT_EQ(ComparisonLine(runs, "lm")[7], "10");
  EXPECT_EQ(ComparisonLine(runs, "lbfgs")[7], "never");
  EXPECT_THAT(
      ComparisonText(runs),
      HasSubstr("Baseline: the best body error of gradient_descent.\n"));
  const nlohmann::json json = ParsedComparison(runs);
  EXPECT_EQ(json["baseline"], "gradient_descent");
  EXPECT_EQ(json["runs"][0]["steps_to_best_of_baseline"], 10);
  EXPECT_TRUE(json["runs"][2]["steps_to_best_of_baseline"].is_null());
}

TEST(ComparisonReport, WithoutATruthTheCostDecides) {
  const std::vector<ComparisonRun> runs = {
      RunOfOptimizer("lbfgs", {9, 8, 3.5, 1}), RunOfOptimizer("lm", {9, 4})};
  EXPECT_THAT(ComparisonText(runs),
              HasSubstr("Baseline: the best cost of lm.\n"));
  EXPECT_EQ(ComparisonLine(runs, "lbfgs")[6], "-");
  EXPECT_EQ(ComparisonLine(runs, "lbfgs")[7], "20");
  const nlohmann::json json = ParsedComparison(runs);
  EXPECT_EQ(json["baseline"], "lm");
  EXPECT_TRUE(json["runs"][0]["iterations"][0]["body_v2v_mean_mm"].is_null());
}

TEST(ComparisonReport, ProgramsGetEveryIteration) {
  const nlohmann::json json = ParsedComparison(KnownTruth());
  const nlohmann::json& run = json["runs"][1];
  EXPECT_EQ(run["optimizer"], "gradient_descent");
  EXPECT_EQ(run["termination"], "iteration limit");
  EXPECT_EQ(run["reason"], "Reason of gradient_descent.");
  EXPECT_EQ(run["evaluations"], 17);
  EXPECT_EQ(run["evaluations_failed"], 3);
  EXPECT_EQ(run["linearizations"], 11);
  ASSERT_EQ(run["iterations"].size(), 3u);
  const nlohmann::json& point = run["iterations"][2];
  EXPECT_EQ(point["iteration"], 2);
  EXPECT_EQ(point["steps"], 20);
  EXPECT_EQ(point["seconds"], 4);
  EXPECT_EQ(point["cost"], 2);
  EXPECT_DOUBLE_EQ(point["body_v2v_mean_mm"], 25);
}

TEST(ComparisonReport, SpreadsheetsGetALinePerIteration) {
  EXPECT_EQ(ComparisonCsv({RunOfOptimizer("lm", {9, 0.123456789}),
                           RunOfOptimizer("lbfgs", {9}, {0.03125})}),
            "optimizer,iteration,steps,seconds,cost,body_v2v_mean_mm\n"
            "lm,0,0,0,9,\n"
            "lm,1,10,2,0.123456789,\n"
            "lbfgs,0,0,0,9,31.25\n");
}

TEST(ComparisonReport, ChartsShowCostAndErrorOverTimeAndSteps) {
  const std::vector<Chart> charts = ComparisonCharts(KnownTruth());
  ASSERT_EQ(charts.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(charts[k].title, k < 2 ? "cost" : "body error [mm]");
    EXPECT_EQ(charts[k].x_title, k % 2 ? "simulation steps" : "time [s]");
    ASSERT_EQ(charts[k].series.size(), 3u);
    const ChartSeries& series = charts[k].series[1];
    EXPECT_EQ(series.name, "gradient_descent");
    if (k % 2)
      EXPECT_THAT(series.x, ElementsAre(0, 10, 20));
    else
      EXPECT_THAT(series.x, ElementsAre(0, 2, 4));
    if (k < 2)
      EXPECT_THAT(series.values, ElementsAre(9, 8, 2));
    else
      EXPECT_THAT(series.values, ElementsAre(30, 20, 25));
  }
}

TEST(ComparisonReport, WithoutATruthThereIsNoChartOfErrors) {
  const std::vector<Chart> charts =
      ComparisonCharts({RunOfOptimizer("lm", {9, 4})});
  ASSERT_EQ(charts.size(), 2u);
  for (const Chart& chart : charts) EXPECT_EQ(chart.title, "cost");
}

// A start that cannot be simulated, or a stop before the first iteration.
TEST(ComparisonReport, ARunWithoutIterationsSaysSo) {
  const std::vector<ComparisonRun> runs = {
      RunOfOptimizer("lm", {}), RunOfOptimizer("gradient_descent", {9, 4})};
  EXPECT_THAT(ComparisonText(runs), ContainsRegex("\nlm +no iteration\n"));
  EXPECT_EQ(ComparisonLine(runs, "gradient_descent")[7], "10");
  EXPECT_TRUE(
      ParsedComparison(runs)["runs"][0]["steps_to_best_of_baseline"].is_null());
}

// Nothing is held against a baseline that there is not.
TEST(ComparisonReport, ABaselineWithoutIterationsHasNoBest) {
  const std::vector<ComparisonRun> runs = {
      RunOfOptimizer("lm", {9, 4}), RunOfOptimizer("gradient_descent", {})};
  const nlohmann::json json = ParsedComparison(runs);
  EXPECT_FALSE(json["runs"][0].contains("steps_to_best_of_baseline"));
  EXPECT_EQ(ComparisonLine(runs, "lm")[7], "-");
  EXPECT_THAT(ComparisonText(runs), Not(HasSubstr("Baseline")));
}

TEST(ComparisonReport, ComparingNothingIsNoError) {
  EXPECT_THAT(ComparisonText({}), Not(HasSubstr("Baseline")));
  EXPECT_EQ(ParsedComparison({})["runs"], nlohmann::json::array());
  for (const Chart& chart : ComparisonCharts({}))
    EXPECT_THAT(FormatSvg(chart), Not(HasSubstr("nan")));
}

TEST(ComparisonReport, TheFolderHoldsAllFormsOfIt) {
  const fs::path root = fs::path(testing::TempDir()) / "comparison_folder";
  fs::remove_all(root);
  const std::vector<ComparisonRun> runs = KnownTruth();
  WriteComparison(RunFolder(root.string(), false), runs);
  const auto text = [&](const char* name) {
    return ReadFileBytes((root / name).string());
  };
  EXPECT_EQ(text("report.json"), ComparisonJson(runs));
  EXPECT_EQ(text("comparison.csv"), ComparisonCsv(runs));
  EXPECT_EQ(text("comparison.svg"), StandaloneSvg(ComparisonCharts(runs)));
  for (const Chart& chart : ComparisonCharts(runs))
    EXPECT_THAT(text("report.html"), HasSubstr(FormatSvg(chart)));
  EXPECT_THAT(text("report.html"), HasSubstr(ComparisonText(runs)));
  EXPECT_THAT(text("solver.txt"), HasSubstr(ComparisonText(runs)));
  EXPECT_THAT(text("solver.txt"),
              HasSubstr("\nlbfgs: Reason of lbfgs.\nDetails of lbfgs.\n"));
  fs::remove_all(root);
}

}  // namespace
}  // namespace invsim
