// SPDX-License-Identifier: Apache-2.0
// The figures for programs; what the report says in words beside them is in
// fit_report_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "invsim/report/fit_report.h"
#include "report/fit_round.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;

// Every figure another, so that none can stand for another.
FitReport FitWithFigures() {
  FitReport r;
  r.points = "scan/points";
  r.body = "mannequin";
  r.garment = "shirt.obj";
  r.material = "jersey";
  r.frames = 8;
  r.frames_per_second = 30;
  r.fewest_points = 71;
  r.most_points = 93;
  r.points_dropped = 5;
  r.points_filtered = 6;
  r.body_vertices = 1234;
  r.cloth_vertices = 567;
  r.cloth_faces = 1011;
  r.threads = 6;
  r.friction = 0.25;
  r.thickness = 0.0015;
  r.tolerance = 1e-3;
  r.optimizer = "lm";
  r.loss = "huber 5 mm";
  r.effects = {{"gravity", true, "always", false},
               {"air_drag", false, "0.2 % of the weight", false},
               {"friction", true, "mu > 0", true}};
  r.result.termination = Termination::kConverged;
  r.result.simulated = true;
  r.result.body.shape = ShapeVector::LinSpaced(0, 0.9);
  return r;
}

OptimizerSummary SummaryWithFigures() {
  OptimizerSummary s;
  s.termination = Termination::kStalled;
  s.reason = "The last steps failed.";
  s.initial_cost = 31;
  s.final_cost = 12;
  s.counts.evaluations = 23;
  s.counts.abandoned = 6;
  s.counts.failed = 4;
  s.counts.no_derivative = 2;
  s.counts.linearizations = 9;
  s.iterations.resize(3);
  s.iterations.back().terms = {
      .data = 1, .smoothness = 2, .shape = 4, .pose = 8, .overlap = 16};
  return s;
}

nlohmann::json ParsedFit(const FitReport& report) {
  return nlohmann::json::parse(FitJson(report));
}

TEST(FitReportJson, HasTheInputsInTheUnitsOfTheirKeys) {
  const nlohmann::json json = ParsedFit(FitWithFigures())["inputs"];
  EXPECT_EQ(json["points"], "scan/points");
  EXPECT_EQ(json["body"], "mannequin");
  EXPECT_EQ(json["garment"], "shirt.obj");
  EXPECT_EQ(json["material"], "jersey");
  EXPECT_EQ(json["frames"], 8);
  EXPECT_EQ(json["frames_per_second"], 30);
  EXPECT_EQ(json["points_per_frame_min"], 71);
  EXPECT_EQ(json["points_per_frame_max"], 93);
  EXPECT_EQ(json["points_dropped"], 5);
  EXPECT_EQ(json["points_filtered"], 6);
  EXPECT_EQ(json["body_vertices"], 1234);
  EXPECT_EQ(json["cloth_vertices"], 567);
  EXPECT_EQ(json["cloth_faces"], 1011);
  EXPECT_EQ(json["friction"], 0.25);
  EXPECT_DOUBLE_EQ(json["thickness_mm"], 1.5);
  EXPECT_EQ(json["contact_tolerance_weights"], 1e-3);
  EXPECT_EQ(json["optimizer"], "lm");
  EXPECT_EQ(json["loss"], "huber 5 mm");
  EXPECT_EQ(json["threads"], 6);
}

// Those that can be chosen stand among the inputs, all with their reasons.
TEST(FitReportJson, SaysWhichEffectsAreOnAndWhy) {
  const nlohmann::json json = ParsedFit(FitWithFigures());
  EXPECT_EQ(json["inputs"]["effects"], nlohmann::json({"gravity"}));
  EXPECT_EQ(json["effects"]["air_drag"]["on"], false);
  EXPECT_EQ(json["effects"]["air_drag"]["reason"], "0.2 % of the weight");
  EXPECT_EQ(json["effects"]["friction"]["on"], true);
}

TEST(FitReportJson, HasTheShapeFound) {
  const nlohmann::json json = ParsedFit(FitWithFigures())["shape"];
  ASSERT_EQ(json.size(), static_cast<size_t>(kNumShape));
  for (int k = 0; k < kNumShape; ++k) EXPECT_DOUBLE_EQ(json[k], 0.1 * k);
}

TEST(FitReportJson, TellsHowTheOptimisationWent) {
  FitReport report = FitWithFigures();
  EXPECT_FALSE(ParsedFit(report).contains("optimization"));
  OnlyRound(&report.result).optimizer = SummaryWithFigures();
  nlohmann::json json = ParsedFit(report)["optimization"];
  EXPECT_EQ(json["termination"], "stalled");
  EXPECT_EQ(json["reason"], "The last steps failed.");
  EXPECT_EQ(json["iterations"], 2);  // the start is none
  EXPECT_EQ(json["initial_cost"], 31);
  EXPECT_EQ(json["final_cost"], 12);
  EXPECT_EQ(json["evaluations"], 23);
  EXPECT_EQ(json["evaluations_abandoned"], 6);
  EXPECT_EQ(json["evaluations_failed"], 4);
  EXPECT_EQ(json["evaluations_without_derivative"], 2);
  EXPECT_EQ(json["linearizations"], 9);
  EXPECT_EQ(json["cost_by_term"],
            nlohmann::json({{"total", 31},
                            {"data", 1},
                            {"smoothness", 2},
                            {"shape", 4},
                            {"pose", 8},
                            {"overlap", 16}}));
  OnlyRound(&report.result).optimizer->iterations.clear();
  json = ParsedFit(report)["optimization"];
  EXPECT_EQ(json["iterations"], 0);
  EXPECT_FALSE(json.contains("cost_by_term"));
}

// The status is that of the fit, whose optimiser may have ended otherwise.
TEST(FitReportJson, TheStatusIsOfTheWholeFit) {
  FitReport report = FitWithFigures();
  OnlyRound(&report.result).optimizer = SummaryWithFigures();
  report.result.termination = Termination::kTimeLimit;
  const nlohmann::json json = ParsedFit(report);
  EXPECT_EQ(json["status"], "time limit");
  EXPECT_EQ(json["usable"], true);
  EXPECT_EQ(json["verdict"], Verdict(report));
}

TEST(FitReportJson, TellsTheSimulationsApart) {
  FitReport report = FitWithFigures();
  StepStats& all = report.result.stats.step;
  all.substeps = 900;
  all.missed = 7;
  all.halved = 5;
  all.failed = 3;
  all.failures = {{"not finite", 2}, {"no factors", 1}};
  all.worst_residual = 2e-3;
  all.most_contacts = 88;
  all.factorizations = 777;
  all.solves = 1888;
  all.contact_queries = 5000000000;  // more than 32 bits hold
  report.result.stats.neighbour_queries = 123;
  report.simulated.resize(2);
  for (FrameStats& frame : report.simulated) frame.step.substeps = 4;
  const nlohmann::json json = ParsedFit(report);
  const nlohmann::json& simulation = json["simulation"];
  EXPECT_EQ(simulation["steps"], 900);
  EXPECT_EQ(simulation["steps_missed"], 7);
  EXPECT_EQ(simulation["steps_halved"], 5);
  EXPECT_EQ(simulation["steps_failed"], 3);
  EXPECT_EQ(simulation["steps_failed_because"],
            nlohmann::json({{"not finite", 2}, {"no factors", 1}}));
  EXPECT_EQ(simulation["worst_residual_weights"], 2e-3);
  EXPECT_EQ(simulation["most_contacts"], 88);
  EXPECT_EQ(simulation["factorizations"], 777);
  EXPECT_EQ(simulation["solves"], 1888);
  EXPECT_EQ(simulation["contact_queries"], 5000000000);
  EXPECT_EQ(simulation["neighbour_queries"], 123);
  EXPECT_EQ(json["final_simulation"]["steps"], 8);
  EXPECT_FALSE(json["final_simulation"].contains("steps_failed_because"));
}

TEST(FitReportJson, HasTheFramesOfTheFinalSimulation) {
  FitReport report = FitWithFigures();
  report.simulated.resize(3);
  report.simulated[1].step.missed = 2;
  report.simulated[1].step.worst_residual = 0.5;
  report.simulated[1].penetration.deepest = 0.00125;
  report.simulated[2].step.missed = 1;
  report.simulated[2].penetration.deepest_overlap = 0.0025;
  const nlohmann::json json = ParsedFit(report);
  ASSERT_EQ(json["frames"].size(), 3u);
  for (int t = 0; t < 3; ++t) EXPECT_EQ(json["frames"][t]["frame"], t);
  const nlohmann::json& frame = json["frames"][1];
  EXPECT_EQ(frame["steps_missed"], 2);
  EXPECT_EQ(frame["worst_residual_weights"], 0.5);
  EXPECT_DOUBLE_EQ(frame["penetration_max_mm"], 1.25);
  EXPECT_DOUBLE_EQ(
      json["frames"][2]["body_overlap_penetration_max_mm"].get<double>(), 2.5);
  // Together: the sum of what is counted, the worst of what is measured.
  const nlohmann::json& total = json["final_simulation"];
  EXPECT_EQ(total["steps_missed"], 3);
  EXPECT_EQ(total["worst_residual_weights"], 0.5);
  EXPECT_DOUBLE_EQ(total["penetration_max_mm"], 1.25);
  EXPECT_DOUBLE_EQ(total["body_overlap_penetration_max_mm"], 2.5);
}

TEST(FitReportJson, TellsEveryWayOfDressing) {
  FitReport report = FitWithFigures();
  DressingTry refused{DressingWay::kCarried, "folds over", {}};
  DressingTry worn{DressingWay::kGrown, "", RelaxationResult(), 0.5};
  worn.relaxation->frames = 40;
  worn.relaxation->at_rest = true;
  OnlyRound(&report.result).dressing.tries = {refused, worn};
  OnlyRound(&report.result).dressing.worn = 1;
  const nlohmann::json json = ParsedFit(report)["dressings"][0]["tries"];
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(
      json[0],
      nlohmann::json(
          {{"way", "carried"}, {"worn", false}, {"refused", "folds over"}}));
  EXPECT_EQ(json[1],
            nlohmann::json({{"way", "grown"},
                            {"worn", true},
                            {"frames", 40},
                            {"at_rest", true},
                            {"first_frames_cost", 0.5}}));
}

TEST(FitReportJson, TellsWhatEveryDressingGave) {
  FitReport report = FitWithFigures();
  OptimizerSummary other = SummaryWithFigures();
  other.initial_cost = 15;
  other.final_cost = 13;
  report.result.rounds = {{{}, SummaryWithFigures()}, {{}, other}};
  report.result.kept = 0;
  const nlohmann::json json = ParsedFit(report);
  ASSERT_EQ(json["dressings"].size(), 2u);
  EXPECT_EQ(json["dressings"][0]["kept"], true);
  EXPECT_EQ(json["dressings"][1]["kept"], false);
  EXPECT_EQ(json["dressings"][1]["initial_cost"], 15);
  EXPECT_EQ(json["dressings"][1]["final_cost"], 13);
  EXPECT_EQ(json["dressings"][1]["iterations"], 2);
  EXPECT_EQ(json["optimization"]["iterations"], 4);
  EXPECT_EQ(json["optimization"]["evaluations"], 46);
  EXPECT_EQ(json["optimization"]["final_cost"], 12);
}

TEST(FitReportJson, HasTheCostsByDistance) {
  FitReport report = FitWithFigures();
  report.result.costs.cloth_to_points = 1;
  report.result.costs.skin_to_points = 2;
  report.result.costs.points_to_surface = 3;
  EXPECT_EQ(ParsedFit(report)["cost_by_distance"],
            nlohmann::json({{"cloth_to_points", 1},
                            {"skin_to_points", 2},
                            {"points_to_surface", 3}}));
}

Uncertainty UncertaintyWithFigures() {
  Uncertainty u;
  u.shape_covariance.setIdentity();
  u.shape_deviation = ShapeVector::LinSpaced(0.1, 1.0);
  u.shape_directions.setIdentity();
  u.shape_directions.col(1) *= -1;
  u.direction_deviation = ShapeVector::LinSpaced(2.0, 0.2);
  u.undetermined_directions = 2;
  u.pose_deviation = {PoseVector::Constant(std::numbers::pi / 60)};
  u.translation_deviation = {Vector3d(0.001, 0.002, 0.004)};
  u.undetermined_joints.assign(kNumJoints, 0.5);
  u.undetermined_axes.assign(kNumJoints, Vector3d::Zero());
  return u;
}

TEST(FitReportJson, HasTheUncertaintyInDegreesAndMillimetres) {
  FitReport report = FitWithFigures();
  EXPECT_FALSE(ParsedFit(report).contains("uncertainty"));
  report.result.uncertainty = UncertaintyWithFigures();
  const nlohmann::json json = ParsedFit(report)["uncertainty"];
  ASSERT_EQ(json["shape_deviation"].size(), static_cast<size_t>(kNumShape));
  EXPECT_DOUBLE_EQ(json["shape_deviation"][9], 1.0);
  const nlohmann::json& directions = json["shape_undetermined_directions"];
  ASSERT_EQ(directions.size(), 2u);
  EXPECT_EQ(directions[1]["direction"],
            nlohmann::json({0, -1, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(directions[1]["deviation"], 1.8);
  const nlohmann::json& frame = json["frames"][0];
  ASSERT_EQ(frame["pose_deviation_deg"].size(), static_cast<size_t>(kNumPose));
  EXPECT_NEAR(frame["pose_deviation_deg"][7], 3, 1e-12);
  EXPECT_DOUBLE_EQ(frame["translation_deviation_mm"][2], 4);
}

// Just half of the frames is not most of them; and the root is no joint that
// the body bends.
TEST(FitReportJson, NamesJointsThatAreOpenInMostFrames) {
  FitReport report = FitWithFigures();
  report.result.uncertainty = UncertaintyWithFigures();
  std::vector<double>& open = report.result.uncertainty->undetermined_joints;
  const auto names = [&] {
    return ParsedFit(report)["uncertainty"]["joints_undetermined"];
  };
  EXPECT_TRUE(names().empty());
  open[0] = open[4] = open[23] = 0.75;
  EXPECT_THAT(names(), ElementsAre(kJointNames[4], kJointNames[23]));
  report.result.uncertainty->undetermined_axes[23] = Vector3d(0, 0.6, 0.8);
  report.result.uncertainty->undetermined_axes[5] = Vector3d(1, 0, 0);
  EXPECT_EQ(ParsedFit(report)["uncertainty"]["joints_undetermined_axis"],
            nlohmann::json({{kJointNames[23], {0, 0.6, 0.8}}}));
}

TEST(FitReportJson, SaysWhyThereIsNoUncertainty) {
  FitReport report = FitWithFigures();
  report.result.uncertainty.emplace();
  report.result.uncertainty->failure = "singular";
  EXPECT_EQ(ParsedFit(report)["uncertainty"],
            nlohmann::json({{"failure", "singular"}}));
}

TEST(FitReportJson, TheTimesByPartAddUpToTheWhole) {
  FitReport report = FitWithFigures();
  report.seconds = 100;
  report.result.seconds.init = 10;
  report.result.seconds.dressing = 5;
  report.result.seconds.uncertainty = 3;
  report.result.stats.simulation_seconds = 40;
  report.result.stats.sensitivity_seconds = 12;
  report.result.stats.neighbour_seconds = 8;
  report.result.stats.block_seconds = 2;
  OptimizerSummary summary;
  summary.linear_solver_seconds = 6;
  report.result.rounds.resize(2);
  for (FitRound& round : report.result.rounds) round.optimizer = summary;
  const nlohmann::json json = ParsedFit(report);
  EXPECT_EQ(json["wall_seconds"], 100);
  EXPECT_EQ(json["seconds_by_part"]["linear solver"], 12);
  EXPECT_EQ(json["seconds_by_part"]["simulation"], 40);
  EXPECT_EQ(json["seconds_by_part"]["other"], 8);
  double sum = 0;
  for (const auto& part : json["seconds_by_part"]) sum += part.get<double>();
  EXPECT_DOUBLE_EQ(sum, 100);
}

// JSON has no word for what is not a number.
TEST(FitReportJson, StaysJsonWhateverTheNumbersAre) {
  FitReport report = FitWithFigures();
  OnlyRound(&report.result).optimizer = SummaryWithFigures();
  OnlyRound(&report.result).optimizer->final_cost = NAN;
  report.result.stats.step.worst_residual = INFINITY;
  const nlohmann::json json = ParsedFit(report);
  EXPECT_TRUE(json["optimization"]["final_cost"].is_null());
  EXPECT_TRUE(json["simulation"]["worst_residual_weights"].is_null());
}

}  // namespace
}  // namespace invsim
