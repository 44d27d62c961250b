// SPDX-License-Identifier: Apache-2.0
// The numbers on the pages of evaluations; which curves there are is in
// evaluation_report_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "invsim/report/chart.h"
#include "invsim/report/evaluation_report.h"

namespace invsim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Distances of the body's vertices frame by frame.
RunEvaluation RunOf(const std::string& name,
                    const std::string& garment,
                    const std::vector<double>& body_mm) {
  RunEvaluation e{name, "the scan", garment, {}};
  for (const double mm : body_mm) {
    FrameMetrics f;
    f.body_v2v = mm;
    e.metrics.frames.push_back(f);
  }
  return e;
}

std::string ChartOver(const std::string& title,
                      const std::vector<ChartSeries>& series) {
  return FormatSvg({title + " [mm]", "frame", {}, series});
}

// Of the frames that a run does not have, or does not know, the others tell.
TEST(EvaluationPage, CurvesAreMeansOverTheRunsOfAGarment) {
  const std::string page = EvaluationsPage({RunOf("a", "shirt", {20, NAN, 10}),
                                            RunOf("b", "dress", {7}),
                                            RunOf("c", "shirt", {40}),
                                            RunOf("d", "shirt", {60, 80, 30})});
  EXPECT_THAT(
      page,
      HasSubstr(ChartOver(
          "body", {{"dress", {7}, {0}}, {"shirt", {40, 80, 20}, {0, 1, 2}}})));
}

TEST(EvaluationPage, WhatNoRunKnowsIsAGap) {
  RunEvaluation run = RunOf("a", "shirt", {20, 10, 30, 40});
  run.metrics.frames[0].joint = 5;
  run.metrics.frames[2].joint = 8;
  EXPECT_THAT(
      EvaluationPage(run),
      HasSubstr(ChartOver("body, joints",
                          {{"body", {20, 10, 30, 40}, {0, 1, 2, 3}},
                           {"joints", {5, NAN, 8, NAN}, {0, 1, 2, 3}}})));
  const std::string page = EvaluationsPage({run, run});
  EXPECT_THAT(page,
              HasSubstr(ChartOver(
                  "joints", {{"shirt", {5, NAN, 8, NAN}, {0, 1, 2, 3}}})));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

// Distances are drawn as the mean of both directions.
TEST(EvaluationPage, EveryDistanceOfARunHasItsCurve) {
  RunEvaluation run = RunOf("a", "shirt", {20});
  FrameMetrics& f = run.metrics.frames[0];
  f.cloth_chamfer = {3, 5};
  f.combined_chamfer = {6, 8};
  f.points_to_surface = 9;
  f.penetration = 0;
  const std::string page = EvaluationPage(run);
  for (const std::string& chart :
       {ChartOver("cloth, combined",
                  {{"cloth", {4}, {0}}, {"combined", {7}, {0}}}),
        ChartOver("points to surface", {{"points to surface", {9}, {0}}}),
        ChartOver("penetration", {{"penetration", {0}, {0}}})})
    EXPECT_THAT(page, HasSubstr(chart));
}

TEST(EvaluationPage, SaysOfEachRunHowFarItIsOff) {
  RunEvaluation dressed = RunOf("runs/b & c", "shirt", {20, 40});
  dressed.metrics.frames[1].cloth_chamfer = {4, 6};
  dressed.metrics.frames[0].penetration = 0.25;
  dressed.metrics.frames[1].penetration = 0.125;
  const std::string page =
      EvaluationsPage({RunOf("runs/a", "shirt", {10}), dressed});
  EXPECT_THAT(page, HasSubstr("<td>runs/a</td><td>body 10 mm</td>"));
  EXPECT_THAT(page,
              HasSubstr("<td>runs/b &amp; c</td>"
                        "<td>body 30, cloth 5, penetration 0.25 mm</td>"));
}

TEST(EvaluationPage, SaysWhatWasHeldAgainstWhat) {
  const std::string page = EvaluationPage(RunOf("a", "shirt", {20, 40}));
  EXPECT_THAT(page, HasSubstr("Distances to the truth, the scan."));
  for (const char* fact : {"<td>garment</td><td>shirt</td>",
                           "<td>frames</td><td>2</td>",
                           "<td>body_v2v_mean_mm</td><td>30</td>"})
    EXPECT_THAT(page, HasSubstr(fact));
}

}  // namespace
}  // namespace invsim
