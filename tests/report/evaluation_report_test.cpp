// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/evaluation_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

RunEvaluation MakeRun(const std::string& name,
                      const std::string& garment,
                      const std::vector<double>& body_mm) {
  RunEvaluation e{name, "truth", garment, {}};
  for (const double mm : body_mm) {
    FrameMetrics f;
    f.body_chamfer = {mm - 1, mm + 1};
    f.body_v2v = 2 * mm;
    e.metrics.frames.push_back(f);
  }
  e.metrics.body_tpose_v2v = 4;
  return e;
}

TEST(EvaluationReport, JsonHasMeansAndFrames) {
  const auto json =
      nlohmann::json::parse(EvaluationJson(MakeRun("r", "shirt", {10, 20})));
  EXPECT_EQ(json["metrics"]["body_chamfer_l1_mm"], 15);
  EXPECT_EQ(json["metrics"]["body_chamfer_estimate_to_truth_mm"], 14);
  EXPECT_EQ(json["metrics"]["body_v2v_mean_mm"], 30);
  EXPECT_EQ(json["metrics"]["body_tpose_v2v_mean_mm"], 4);
  EXPECT_FALSE(json["metrics"].contains("cloth_chamfer_l1_mm"));
  EXPECT_EQ(json["frames"][1]["body_chamfer_l1_mm"], 20);
}

TEST(EvaluationReport, TablePoolsTheRunsOfAGarment) {
  const std::vector<RunEvaluation> runs = {MakeRun("a", "shirt", {10, 20}),
                                           MakeRun("b", "dress", {50}),
                                           MakeRun("c", "shirt", {30})};
  const std::string table = ResultsTable(runs);
  EXPECT_THAT(table, HasSubstr("| shirt | dress | published, other data"));
  EXPECT_THAT(table,
              HasSubstr("| body | 2.00 ± 1.00 | 5.00 ± 0.00 | 3.30 to 3.70 |"));
  EXPECT_THAT(table, HasSubstr("| cloth | - | - | 2.10 to 2.80 |"));
  EXPECT_THAT(table, HasSubstr("another data set"));
  const auto json = nlohmann::json::parse(EvaluationsJson(runs));
  EXPECT_EQ(json["table"].size(), 2u);
  EXPECT_EQ(json["table"][0]["frames"], 3);
  EXPECT_EQ(json["table"][0]["chamfer_l1_mean_mm"], 20);
}

TEST(EvaluationReport, CsvHasARowPerRunAndEmptyCells) {
  RunEvaluation other = MakeRun("b \"2\"", "dress", {5});
  other.metrics.jerk = 7;
  const std::string csv = EvaluationsCsv({MakeRun("a", "shirt", {10}), other});
  EXPECT_THAT(csv, HasSubstr("run,truth,garment,body_v2v_mean_mm"));
  EXPECT_THAT(csv, HasSubstr("\"a\",\"truth\",\"shirt\",20,4,10,9,11,\n"));
  EXPECT_THAT(csv,
              HasSubstr("\"b \"\"2\"\"\",\"truth\",\"dress\",10,4,5,4,6,7\n"));
  EXPECT_THAT(csv, Not(HasSubstr("nan")));
}

// A curve for what is known of the frames, and none for what is not.
TEST(EvaluationReport, PageHasACurvePerKnownQuantity) {
  RunEvaluation run = MakeRun("r<1>", "shirt", {10, 20});
  run.metrics.frames[1].joint = 3;
  const std::string page = EvaluationPage(run);
  EXPECT_THAT(page, HasSubstr("Evaluation of r&lt;1&gt;"));
  EXPECT_THAT(page, HasSubstr(">body<"));
  EXPECT_THAT(page, HasSubstr(">joints<"));
  EXPECT_THAT(page, HasSubstr("body_tpose_v2v_mean_mm"));
  EXPECT_THAT(page, Not(HasSubstr(">cloth<")));
  EXPECT_THAT(page, HasSubstr("<svg"));
}

// Frame 1 is known of one shirt only.
TEST(EvaluationReport, PageOfRunsHasACurvePerGarment) {
  const std::string page = EvaluationsPage({MakeRun("a", "shirt", {10, 20}),
                                            MakeRun("b", "shirt", {30}),
                                            MakeRun("c", "dress", {5})});
  EXPECT_THAT(page, HasSubstr("Evaluation of 3 runs"));
  EXPECT_THAT(page, HasSubstr("body [mm]"));
  EXPECT_THAT(page, HasSubstr(">shirt<"));
  EXPECT_THAT(page, HasSubstr(">dress<"));
  EXPECT_THAT(page, Not(HasSubstr("joints [mm]")));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, HasSubstr("| body | 2.00"));
}

}  // namespace
}  // namespace invsim
