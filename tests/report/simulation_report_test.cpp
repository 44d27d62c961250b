// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/simulation_report.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

SimulationReport ExampleSimulation() {
  SimulationReport r;
  r.body = "b.npz";
  r.garment = "g\xff.obj";  // no UTF-8
  r.material = "jersey";
  r.effects = {{"inertia", true, "listed"},
               {"air_drag", false, "0.3 % of the cloth's weight"},
               {"friction", true, "coefficient 0.3", true}};
  r.frames_wanted = 3;
  r.frames_per_second = 30;
  r.tolerance = 1e-6;
  r.thickness = 0.002;
  r.threads = 1;
  r.relaxation.at_rest = true;
  r.relaxation.rest_speed = 0.008;
  r.relaxation.frames = 40;
  r.relaxation.stats.step.substeps = 160;
  r.frames.resize(3);
  r.frames[1].step.substeps = 4;
  r.frames[2].step.substeps = 6;
  r.frames[2].step.slip_solves = 1;
  r.frames[1].step.yield_solves = 2;
  r.frames[2].step.missed = 2;
  r.frames[2].step.worst_residual = 3e-5;
  r.frames[2].penetration.deepest = 0.0004;
  r.stress = {1, 2, 3};
  for (const FrameStats& f : r.frames) r.sequence.stats.Add(f);
  r.sequence.frames = 3;
  return r;
}

TEST(SimulationReport, CountsMissedStepsInTheVerdict) {
  SimulationReport r = ExampleSimulation();
  EXPECT_EQ(MissedSteps(r), 2);
  EXPECT_THAT(Verdict(r),
              AllOf(HasSubstr("Complete: 3 of 3 frames"),
                    HasSubstr("2 of 170 steps missed"),
                    HasSubstr("3e-05"),
                    HasSubstr("0.4 mm")));
  r.sequence.stats.step.missed = 0;
  EXPECT_THAT(Verdict(r), HasSubstr("Every one of 170 steps"));
}

TEST(SimulationReport, StatusIsOfTheFirstPartThatDidNotComplete) {
  SimulationReport r = ExampleSimulation();
  EXPECT_EQ(Status(r), RunStatus::kComplete);
  r.sequence.status = RunStatus::kInterrupted;
  EXPECT_EQ(Status(r), RunStatus::kInterrupted);
  r.relaxation.status = RunStatus::kFailed;
  EXPECT_EQ(Status(r), RunStatus::kFailed);
  EXPECT_THAT(Verdict(r), HasSubstr("Failed"));
}

TEST(SimulationReport, AFailureIsNamedAndItsStepsMeetNoTolerance) {
  SimulationReport r = ExampleSimulation();
  r.sequence.status = RunStatus::kFailed;
  r.sequence.frames = 2;
  StepStats& step = r.sequence.stats.step;
  step.missed = 0;
  step.failed = 1;
  step.failures["the body is not finite"] = 1;
  step.worst_residual = std::numeric_limits<double>::infinity();
  EXPECT_THAT(Verdict(r),
              AllOf(HasSubstr("Failed in frame 2 (the body is not finite), "
                              "after 2 of 3 frames."),
                    HasSubstr("1 step had no result, the others met"),
                    Not(HasSubstr("Every one")),
                    Not(HasSubstr("inf"))));
  step.missed = 3;
  EXPECT_THAT(Verdict(r), HasSubstr("3 of 170 steps missed"));
  EXPECT_THAT(SimulationText(r), HasSubstr("without a result      1"));
  const auto json = nlohmann::json::parse(SimulationJson(r));
  EXPECT_EQ(json["sequence"]["steps_failed_because"]["the body is not finite"],
            1);
  r.relaxation.status = RunStatus::kFailed;
  EXPECT_THAT(Verdict(r), HasSubstr("Failed while dressing, in phase '"));
}

TEST(SimulationReport, JsonIsVersionedAndHoldsEveryFrame) {
  const nlohmann::json json =
      nlohmann::json::parse(SimulationJson(ExampleSimulation()));
  EXPECT_EQ(json["schema"], "invsim.simulation");
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["status"], "complete");
  EXPECT_EQ(json["usable"], true);
  EXPECT_EQ(json["inputs"]["thickness_mm"], 2.0);
  EXPECT_EQ(json["inputs"]["effects"], nlohmann::json::array({"inertia"}));
  EXPECT_EQ(json["effects"]["air_drag"]["on"], false);
  EXPECT_EQ(json["effects"]["friction"]["reason"], "coefficient 0.3");
  EXPECT_EQ(json["counts"]["frames_done"], 3);
  EXPECT_EQ(json["total"]["steps"], 170);
  EXPECT_EQ(json["total"]["steps_missed"], 2);
  EXPECT_EQ(json["sequence"]["steps"], 10);
  EXPECT_EQ(json["sequence"]["slip_solves"], 1);
  EXPECT_EQ(json["sequence"]["yield_solves"], 2);
  EXPECT_EQ(json["relaxation"]["at_rest"], true);
  ASSERT_EQ(json["frames"].size(), 3u);
  EXPECT_EQ(json["frames"][2]["frame"], 2);
  EXPECT_EQ(json["frames"][2]["penetration_max_mm"], 0.4);
  EXPECT_EQ(json["frames"][1]["stress_p99_n_per_m"], 2.0);
}

TEST(SimulationReport, TextSaysWhatHappenedInBothParts) {
  const std::string text = SimulationText(ExampleSimulation());
  EXPECT_THAT(text,
              AllOf(HasSubstr("Relaxation: 40 frames, at rest"),
                    HasSubstr("mean speed 0.8 cm/s"),
                    HasSubstr("Sequence: 3 of 3 frames, complete"),
                    HasSubstr("inertia             on   listed"),
                    HasSubstr("air_drag            off  0.3 % of the")));
}

TEST(SimulationReport, ChartsHaveOneValuePerFrame) {
  for (const Chart& chart : SimulationCharts(ExampleSimulation())) {
    EXPECT_EQ(chart.x.size(), 3u) << chart.title;
    for (const ChartSeries& s : chart.series)
      EXPECT_EQ(s.values.size(), 3u) << chart.title;
  }
}

}  // namespace
}  // namespace invsim
