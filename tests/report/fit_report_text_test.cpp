// SPDX-License-Identifier: Apache-2.0
// The figures for people; what is said beside them is in fit_report_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "invsim/report/fit_report.h"
#include "report/fit_round.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

FitReport FitInWords() {
  FitReport r;
  r.points = "scan/points";
  r.body = "mannequin";
  r.garment = "shirt.obj";
  r.material = "jersey";
  r.optimizer = "dogleg";
  r.result.termination = Termination::kConverged;
  r.result.simulated = true;
  r.result.reason = "The cost changes no more.";
  r.result.body.shape.setZero();
  return r;
}

constexpr int kValueColumn = 28;

// What stands on the lines of a name, under a heading that begins so.
std::vector<std::string> ValuesUnder(const FitReport& report,
                                     const std::string& heading,
                                     const std::string& name) {
  std::istringstream text(FitText(report));
  std::vector<std::string> values;
  std::string start = "  " + name;
  start.resize(kValueColumn, ' ');
  bool under = false;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line[0] != ' ') under = line.rfind(heading, 0) == 0;
    if (under && line.rfind(start, 0) == 0)
      values.push_back(line.substr(line.find_first_not_of(' ', kValueColumn)));
  }
  return values;
}

TEST(FitReportText, BeginsWithTheVerdict) {
  const FitReport report = FitInWords();
  EXPECT_EQ(FitText(report).rfind(Verdict(report) + "\n\n", 0), 0u);
}

TEST(FitReportText, NamesTheInputs) {
  FitReport r = FitInWords();
  r.frames = 8;
  r.frames_per_second = 30;
  r.fewest_points = 71;
  r.most_points = 93;
  r.points_dropped = 5;
  r.points_filtered = 6;
  r.body_vertices = 1234;
  r.cloth_vertices = 567;
  r.friction = 0.25;
  r.thickness = 0.0015;
  r.loss = "huber 5 mm";
  r.threads = 6;
  const auto value = [&](const char* name) {
    return ValuesUnder(r, "Input", name);
  };
  EXPECT_THAT(value("points"),
              ElementsAre("scan/points, 8 frames at 30 per second, "
                          "71 to 93 points used of each"));
  EXPECT_THAT(value("points dropped"), ElementsAre("5 (not finite)"));
  EXPECT_THAT(value("points filtered"), ElementsAre("6"));
  EXPECT_THAT(value("body"), ElementsAre("mannequin, 1234 vertices"));
  EXPECT_THAT(value("garment"), ElementsAre("shirt.obj, 567 vertices"));
  EXPECT_THAT(value("material"),
              ElementsAre("jersey, friction 0.25, kept 1.5 mm from the body"));
  EXPECT_THAT(value("loss"), ElementsAre("huber 5 mm"));
  EXPECT_THAT(value("threads"), ElementsAre("6"));
}

TEST(FitReportText, SaysHowTheOptimiserEnded) {
  FitReport report = FitInWords();
  EXPECT_THAT(FitText(report), Not(HasSubstr("Optimisation by")));
  OptimizerSummary& s = OnlyRound(&report.result).optimizer.emplace();
  s.termination = Termination::kStalled;
  s.reason = "The last steps failed.";
  s.initial_cost = 31;
  s.final_cost = 12;
  s.counts.evaluations = 23;
  s.counts.abandoned = 6;
  s.counts.linearizations = 9;
  s.iterations.resize(3);
  s.iterations.back().terms = {
      .data = 1, .smoothness = 2, .shape = 4, .pose = 8, .overlap = 16};
  report.result.costs.cloth_to_points = 0.5;
  report.result.costs.skin_to_points = 0.375;
  report.result.costs.points_to_surface = 0.125;
  s.details = "Of 3 residual blocks.";
  const auto ended = [&](const char* name) {
    return ValuesUnder(report, "Optimisation by dogleg", name);
  };
  EXPECT_THAT(ended("ended"), ElementsAre("stalled: The last steps failed."));
  EXPECT_THAT(ended("cost"), ElementsAre("31 to 12"));
  EXPECT_THAT(ended("iterations"), ElementsAre("2"));  // the start is none
  EXPECT_THAT(ended("evaluations"), ElementsAre("23"));
  EXPECT_THAT(ended("  given up as worse"), ElementsAre("6"));
  EXPECT_THAT(ended("linearisations"), ElementsAre("9"));
  const auto cost = [&](const char* name) {
    return ValuesUnder(report, "Cost by term", name);
  };
  EXPECT_THAT(cost("data"), ElementsAre("1"));
  EXPECT_THAT(cost("  cloth to points"), ElementsAre("0.5"));
  EXPECT_THAT(cost("  skin to points"), ElementsAre("0.375"));
  EXPECT_THAT(cost("  points to surface"), ElementsAre("0.125"));
  EXPECT_THAT(cost("smoothness"), ElementsAre("2"));
  EXPECT_THAT(cost("shape prior"), ElementsAre("4"));
  EXPECT_THAT(cost("pose prior"), ElementsAre("8"));
  EXPECT_THAT(cost("overlap of body parts"), ElementsAre("16"));
  EXPECT_THAT(FitText(report),
              HasSubstr("\nCeres's own report\nOf 3 residual blocks.\n"));
}

TEST(FitReportText, SaysWhatCouldNotBeEvaluated) {
  FitReport report = FitInWords();
  ObjectiveCounts& counts =
      OnlyRound(&report.result).optimizer.emplace().counts;
  const auto failed = [&] {
    return ValuesUnder(report, "Optimisation by", "  failed");
  };
  EXPECT_THAT(failed(), ElementsAre("0"));
  counts.failed = 5;
  counts.no_derivative = 2;
  EXPECT_THAT(failed(), ElementsAre("5 (no derivative at 2 of them)"));
}

TEST(FitReportText, SaysWhatWasRecalledOnlyIfAnythingWas) {
  FitReport report = FitInWords();
  OnlyRound(&report.result).optimizer.emplace();
  const auto recalled = [&] {
    return ValuesUnder(report, "Optimisation by", "answers from checkpoint");
  };
  EXPECT_THAT(recalled(), IsEmpty());
  report.result.recalled = 7;
  EXPECT_THAT(recalled(), ElementsAre("7"));
}

TEST(FitReportText, GivesTheCausesOfFailedSteps) {
  FitReport report = FitInWords();
  StepStats& step = report.result.stats.step;
  const auto failed = [&] {
    return ValuesUnder(report, "Simulation, all", "failed");
  };
  EXPECT_THAT(failed(), ElementsAre("0"));
  step.failed = 2;
  step.failures = {{"the force is not finite", 2}};
  EXPECT_THAT(failed(), ElementsAre("2 (the force is not finite)"));
  step.failed = 5;
  step.failures["no factors"] = 3;
  EXPECT_THAT(failed(),
              ElementsAre("5 (3: no factors, 2: the force is not finite)"));
}

TEST(FitReportText, TellsTheSimulationsApart) {
  FitReport report = FitInWords();
  report.result.stats.frames = 64;
  report.result.stats.neighbour_queries = 123;
  StepStats& all = report.result.stats.step;
  all.substeps = 900;
  all.missed = 7;
  all.halved = 5;
  all.worst_residual = 2e-3;
  all.factorizations = 777;
  all.solves = 1888;
  all.contact_queries = 5555;
  report.simulated.resize(2);
  for (FrameStats& frame : report.simulated) frame.step.substeps = 4;
  report.simulated[0].penetration.deepest = 0.00125;
  report.simulated[1].penetration.deepest_overlap = 0.0025;
  report.simulated[1].step.missed = 1;
  const auto before = [&](const char* name) {
    return ValuesUnder(report, "Simulation, all", name);
  };
  EXPECT_THAT(before("frames"), ElementsAre("64"));
  EXPECT_THAT(before("steps"), ElementsAre("900"));
  EXPECT_THAT(before("missed the tolerance"), ElementsAre("7"));
  EXPECT_THAT(before("halved"), ElementsAre("5"));
  EXPECT_THAT(before("worst residual"),
              ElementsAre("0.002 of a vertex's weight"));
  EXPECT_THAT(before("factorisations"), ElementsAre("777"));
  EXPECT_THAT(before("solves"), ElementsAre("1888"));
  EXPECT_THAT(before("contact queries"), ElementsAre("5555"));
  EXPECT_THAT(before("nearest neighbours sought"), ElementsAre("123"));
  const auto last = [&](const char* name) {
    return ValuesUnder(report, "Simulation at the solution", name);
  };
  EXPECT_THAT(last("steps"), ElementsAre("8"));
  EXPECT_THAT(last("missed the tolerance"), ElementsAre("1"));
  EXPECT_THAT(last("penetration"), ElementsAre("1.25 mm"));
  EXPECT_THAT(last("where skin crosses skin"), ElementsAre("2.5 mm"));
}

TEST(FitReportText, TellsHowTheGarmentWasPutOn) {
  FitReport report = FitInWords();
  DressingTry refused{DressingWay::kCarried, "folds over", {}};
  DressingTry worn{DressingWay::kGrown, "", RelaxationResult(), 0.5};
  worn.relaxation->frames = 40;
  worn.relaxation->rest_speed = 0.0125;
  OnlyRound(&report.result).dressing.tries = {refused, worn};
  OnlyRound(&report.result).dressing.worn = 1;
  const auto line = [&](const char* name) {
    return ValuesUnder(report, "Dressing 1", name);
  };
  EXPECT_THAT(line("garment carried"), ElementsAre("folds over"));
  EXPECT_THAT(line("garment grown"),
              ElementsAre("40 frames, not at rest (mean speed 1.25 cm/s), "
                          "first frames cost 0.5"));
  EXPECT_THAT(line("worn"), ElementsAre("grown"));

  RelaxationResult& r = *OnlyRound(&report.result).dressing.tries[1].relaxation;
  r.at_rest = true;
  EXPECT_THAT(line("garment grown")[0], HasSubstr("40 frames, at rest ("));
  r.status = RunStatus::kFailed;
  r.stats.step.failed = 1;
  r.stats.step.failures = {{"not finite", 1}};
  OnlyRound(&report.result).dressing.worn = -1;
  EXPECT_THAT(
      line("garment grown"),
      ElementsAre("failed after 40 frames; failed steps: 1 (not finite)"));
  EXPECT_THAT(line("worn"), IsEmpty());
}

TEST(FitReportText, TellsWhatEveryDressingGave) {
  FitReport report = FitInWords();
  OptimizerSummary first, second;
  first.initial_cost = 31;
  first.final_cost = 12;
  first.iterations.resize(3);
  first.termination = Termination::kConverged;
  first.counts.evaluations = 5;
  second = first;
  second.initial_cost = 14;
  second.final_cost = 11;
  second.iterations.resize(5);
  report.result.rounds = {{{}, first}, {{}, second}};
  report.result.kept = 1;
  const auto line = [&](const char* part, const char* name) {
    return ValuesUnder(report, part, name);
  };
  EXPECT_THAT(line("Dressing 1, on the body of the init", "fit from there"),
              ElementsAre("cost 31 to 12 in 2 iterations, converged"));
  EXPECT_THAT(line("Dressing 2, on the body found", "fit from there"),
              ElementsAre("cost 14 to 11 in 4 iterations, converged"));
  EXPECT_THAT(FitText(report), HasSubstr("\nKept: dressing 2\n"));
  // Together.
  EXPECT_THAT(Verdict(report), HasSubstr("cost 31 to 11 in 6 iterations"));
  EXPECT_THAT(line("Optimisation by", "evaluations"), ElementsAre("10"));
  report.result.kept = 0;
  EXPECT_THAT(Verdict(report), HasSubstr("cost 31 to 12 in 6 iterations"));
}

TEST(FitReportText, SaysWhereTheBodyCameFrom) {
  FitReport report = FitInWords();
  EXPECT_THAT(ValuesUnder(report, "Initialisation", "body"),
              ElementsAre("as given, or found in the checkpoint"));
  report.result.init.emplace();
  report.result.init->anchor = 17;
  report.result.init->refinement.reason = "Converged.";
  EXPECT_THAT(ValuesUnder(report, "Initialisation", "tracking began at"),
              ElementsAre("frame 17"));
  EXPECT_THAT(ValuesUnder(report, "Initialisation", "refinement"),
              ElementsAre("Converged."));
}

// Means over frames and coordinates, in degrees and mm.
TEST(FitReportText, TellsHowUncertainItIs) {
  FitReport report = FitInWords();
  EXPECT_THAT(FitText(report), Not(HasSubstr("Uncertainty")));
  Uncertainty& u = report.result.uncertainty.emplace();
  u.shape_deviation = ShapeVector::LinSpaced(0.5, 5);
  u.shape_directions.setIdentity();
  u.direction_deviation.setConstant(0.875);
  u.undetermined_directions = 1;
  u.pose_deviation = {PoseVector::Constant(std::numbers::pi / 180),
                      PoseVector::Constant(std::numbers::pi / 60)};
  u.translation_deviation = {Vector3d(0.001, 0.002, 0.003),
                             Vector3d::Constant(0.004)};
  u.undetermined_joints.assign(kNumJoints, 0.0);
  u.undetermined_axes.assign(kNumJoints, Vector3d::Zero());
  const auto line = [&](const char* name) {
    return ValuesUnder(report, "Uncertainty", name);
  };
  EXPECT_THAT(line("shape"), ElementsAre("0.5 1 1.5 2 2.5 3 3.5 4 4.5 5"));
  EXPECT_THAT(line("pose, mean"), ElementsAre("2 degrees"));
  EXPECT_THAT(line("translation, mean"), ElementsAre("3 mm"));
  const std::string direction =
      "shape along (1 0 0 0 0 0 0 0 0 0): deviation 0.875";
  EXPECT_THAT(line("not determined"), ElementsAre(direction));
  u.undetermined_joints[4] = u.undetermined_joints[5] = 1;
  EXPECT_THAT(line("not determined"),
              ElementsAre(direction,
                          std::string("rotation of ") + kJointNames[4] + ", " +
                              kJointNames[5]));
  u.undetermined_axes[4] = Vector3d(0.1, -0.99, 0);
  u.undetermined_axes[5] = Vector3d(0, 0.6, 0.8);
  EXPECT_THAT(
      line("not determined"),
      ElementsAre(direction,
                  std::string("rotation of ") + kJointNames[4] + " about y, " +
                      kJointNames[5] + " about (0 0.6 0.8)"));
}

TEST(FitReportText, SaysWhyTheUncertaintyIsNotKnown) {
  FitReport report = FitInWords();
  report.result.uncertainty.emplace().failure = "It is singular.";
  EXPECT_THAT(FitText(report), HasSubstr("\n  It is singular.\n"));
  EXPECT_THAT(ValuesUnder(report, "Uncertainty", "shape"), IsEmpty());
}

TEST(FitReportText, ListsTheTimesLargestFirst) {
  FitReport report = FitInWords();
  report.seconds = 100;
  report.result.seconds.init = 10;
  report.result.stats.simulation_seconds = 65;
  const std::string text = FitText(report);
  EXPECT_THAT(text, HasSubstr("\nTime: 1:40\n"));
  EXPECT_THAT(ValuesUnder(report, "Time", "simulation"), ElementsAre("65 s"));
  EXPECT_THAT(ValuesUnder(report, "Time", "other"), ElementsAre("25 s"));
  const size_t time = text.find("\nTime");
  EXPECT_LT(text.find("  simulation", time), text.find("  other", time));
  EXPECT_LT(text.find("  other", time), text.find("  initialisation", time));
}

// A fit that ended before it had done anything.
TEST(FitReportText, OfNothingDoneHasNoNumberThatIsNone) {
  FitReport report;
  report.result.body.shape.setZero();
  OnlyRound(&report.result).optimizer.emplace();
  const std::string text = FitText(report);
  EXPECT_THAT(text, HasSubstr("Failed, not usable"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace invsim
