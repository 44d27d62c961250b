// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/fit_report.h"

#include <algorithm>
#include <sstream>

#include "fit_report_parts.h"
#include "invsim/base/names.h"
#include "invsim/base/progress.h"

namespace invsim {
namespace {

// A joint is named if in so many of the frames it is undetermined.
constexpr double kMostly = 0.5;

const char* Usable(const FitReport& report) {
  return report.result.usable() ? "usable" : "not usable";
}

// One round after the other.
Chart CostChart(const std::vector<FitRound>& rounds) {
  Chart cost;
  cost.title = "cost";
  cost.x_title = "time of the optimisation [s]";
  cost.log_y = true;
  cost.series = {{"all", {}}, {"data", {}}};
  double before = 0;
  for (const FitRound& round : rounds) {
    if (!round.optimizer) continue;
    for (const IterationRecord& i : round.optimizer->iterations) {
      cost.x.push_back(before + i.seconds);
      cost.series[0].values.push_back(i.cost);
      cost.series[1].values.push_back(i.terms.data);
    }
    before += round.optimizer->seconds;
  }
  return cost;
}

}  // namespace

FrameStats Simulated(const FitReport& report) {
  FrameStats total;
  for (const FrameStats& frame : report.simulated) total.Add(frame);
  return total;
}

std::vector<int> UndeterminedJoints(const Uncertainty& u) {
  std::vector<int> joints;
  for (int j = 1; j < kNumJoints; ++j)
    if (u.undetermined_joints[j] > kMostly) joints.push_back(j);
  return joints;
}

std::string Verdict(const FitReport& report) {
  const FitResult& r = report.result;
  std::ostringstream out;
  std::string name = Name(r.termination);
  name[0] = static_cast<char>(std::toupper(name[0]));
  out << name << ", " << Usable(report);
  if (r.optimizer() && r.initial_cost() > 0)
    out << ": cost " << ShortNumber(r.initial_cost()) << " to "
        << ShortNumber(r.optimizer()->final_cost) << " in " << r.iterations()
        << " iterations";
  out << ". " << r.reason;
  const FrameStats last = Simulated(report);
  if (r.simulated)
    out << (r.reason.empty() || r.reason.back() == '.' ? "" : ".")
        << " In the final simulation " << last.step.missed << " of "
        << last.step.substeps
        << " steps missed the contact tolerance; deepest penetration "
        << ShortNumber(1000 * last.penetration.deepest) << " mm.";
  return out.str();
}

std::vector<std::string> Approximations(const FitReport& report) {
  std::vector<std::string> list;
  if (report.result.optimizer())
    list.push_back(
        report.history == History::kOneFrame
            ? "History of one frame: the derivative of the cloth at a frame is "
              "by the body at that frame alone, the cloth before it held (as "
              "in the paper). Costs are exact."
            : "Carried history: the derivative of the cloth at a frame is by "
              "parameters that change alike in all frames up to it. Costs are "
              "exact.");
  list.push_back(
      "The cloth of the first frame is at rest, led there from the dressed "
      "start.");
  list.push_back(
      "Nearest points, visibility and contact sets are held while "
      "differentiating.");
  if (report.result.stats.fixed_contacts > 0)
    list.push_back(
        "Cloth that met cloth within a step (" +
        std::to_string(report.result.stats.fixed_contacts) +
        " contacts found by sweeping or vertices stopped, over all "
        "linearisations): normals, weights and where it stopped are held "
        "while differentiating.");
  if (report.result.stats.step.missed > 0)
    list.push_back(std::to_string(report.result.stats.step.missed) +
                   " simulation steps missed the contact tolerance and were "
                   "used as they were.");
  return list;
}

std::vector<std::pair<std::string, double>> TimeByPart(
    const FitReport& report) {
  const FitResult& r = report.result;
  std::vector<std::pair<std::string, double>> parts = {
      {"initialisation", r.seconds.init},
      {"dressing", r.seconds.dressing},
      {"simulation", r.stats.simulation_seconds},
      {"sensitivity and blocks", r.stats.sensitivity_seconds},
      {"nearest neighbours", r.stats.neighbour_seconds},
      {"cost", r.stats.block_seconds},
      {"linear solver", r.linear_solver_seconds()},
      {"uncertainty", r.seconds.uncertainty}};
  double known = 0;
  for (const auto& part : parts) known += part.second;
  parts.push_back({"other", std::max(0.0, report.seconds - known)});
  std::stable_sort(
      parts.begin(), parts.end(), [](const auto& a, const auto& b) {
        return a.second > b.second;
      });
  return parts;
}

std::string IterationsCsv(const FitReport& report) {
  std::ostringstream out;
  out.precision(10);
  out << "dressing,iteration,successful,cost,data,smoothness,shape,pose,"
         "overlap,"
         "gradient_max_norm,step_norm,evaluations,abandoned,failed,"
         "linearizations,seconds\n";
  int dressing = 0;
  for (const FitRound& round : report.result.rounds) {
    ++dressing;
    if (!round.optimizer) continue;
    for (const IterationRecord& i : round.optimizer->iterations)
      out << dressing << ',' << i.iteration << ',' << i.successful << ','
          << i.cost << ',' << i.terms.data << ',' << i.terms.smoothness << ','
          << i.terms.shape << ',' << i.terms.pose << ',' << i.terms.overlap
          << ',' << i.gradient_norm << ',' << i.step_norm << ','
          << i.counts.evaluations << ',' << i.counts.abandoned << ','
          << i.counts.failed << ',' << i.counts.linearizations << ','
          << i.seconds << '\n';
  }
  return out.str();
}

std::vector<Chart> FitCharts(const FitReport& report) {
  std::vector<Chart> charts;
  if (report.result.iterations() > 0)
    charts.push_back(CostChart(report.result.rounds));
  if (report.simulated.size() < 2) return charts;
  Chart base;
  base.x_title = "time of the sequence [s]";
  for (size_t t = 0; t < report.simulated.size(); ++t)
    base.x.push_back(t / report.frames_per_second);
  const auto chart = [&](const char* title, const auto& value) {
    Chart c = base;
    c.title = title;
    c.series.push_back({"", {}});
    for (const FrameStats& frame : report.simulated)
      c.series[0].values.push_back(value(frame));
    charts.push_back(c);
  };
  chart("deepest penetration [mm]",
        [](const FrameStats& f) { return 1000 * f.penetration.deepest; });
  chart("worst contact residual [vertex weights]",
        [](const FrameStats& f) { return f.step.worst_residual; });
  charts.back().log_y = true;
  chart("mean speed of the cloth [m/s]",
        [](const FrameStats& f) { return f.mean_speed; });
  return charts;
}

}  // namespace invsim
