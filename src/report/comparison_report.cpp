// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/comparison_report.h"

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "invsim/report/web_page.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

const ComparisonRun* Baseline(const std::vector<ComparisonRun>& runs) {
  for (const ComparisonRun& run : runs)
    if (run.optimizer == "gradient_descent") return &run;
  return runs.empty() ? nullptr : &runs.back();
}

// Whether there is anything of it to be reached.
bool HasBest(const ComparisonRun* baseline) {
  return baseline && !baseline->points.empty();
}

std::string Millimetres(double metres) {
  return std::isnan(metres) ? "-" : ShortNumber(1000 * metres);
}

Json Number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json RunJson(const ComparisonRun& run, const ComparisonRun* baseline) {
  Json json;
  json["optimizer"] = run.optimizer;
  json["termination"] = Name(run.summary.termination);
  json["reason"] = run.summary.reason;
  json["evaluations"] = run.summary.counts.evaluations;
  json["evaluations_failed"] = run.summary.counts.failed;
  json["linearizations"] = run.summary.counts.linearizations;
  if (HasBest(baseline)) {
    const std::optional<long> steps = StepsToReach(run, Best(*baseline));
    json["steps_to_best_of_baseline"] = steps ? Json(*steps) : Json();
  }
  json["iterations"] = Json::array();
  for (const ComparisonPoint& p : run.points) {
    Json point;
    point["iteration"] = p.iteration;
    point["steps"] = p.steps;
    point["seconds"] = p.seconds;
    point["cost"] = p.cost;
    point["body_v2v_mean_mm"] = Number(1000 * p.body_error);
    json["iterations"].push_back(std::move(point));
  }
  return json;
}

Chart Against(const std::vector<ComparisonRun>& runs,
              const std::string& title,
              const std::string& x_title,
              double (*x)(const ComparisonPoint&),
              double (*y)(const ComparisonPoint&)) {
  Chart chart;
  chart.title = title;
  chart.x_title = x_title;
  chart.log_x = true;
  for (const ComparisonRun& run : runs) {
    ChartSeries series;
    series.name = run.optimizer;
    for (const ComparisonPoint& point : run.points) {
      series.x.push_back(x(point));
      series.values.push_back(y(point));
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace

std::string ComparisonText(const std::vector<ComparisonRun>& runs) {
  const ComparisonRun* baseline = Baseline(runs);
  std::ostringstream out;
  const auto cell = [&](const std::string& text, int width) {
    out << std::setw(width) << text;
  };
  out << std::left << std::setw(18) << "optimiser" << std::right;
  for (const char* title : {"iterations",
                            "evals",
                            "steps",
                            "seconds",
                            "cost",
                            "body mm",
                            "steps to baseline"})
    cell(title, title[0] == 's' && title[5] == ' ' ? 19 : 12);
  out << "  ended\n";
  for (const ComparisonRun& run : runs) {
    if (run.points.empty()) {
      out << std::left << std::setw(18) << run.optimizer << std::right
          << "  no iteration\n";
      continue;
    }
    const ComparisonPoint& last = run.points.back();
    out << std::left << std::setw(18) << run.optimizer << std::right;
    cell(std::to_string(last.iteration), 12);
    cell(std::to_string(run.summary.counts.evaluations), 12);
    cell(std::to_string(last.steps), 12);
    cell(ShortNumber(last.seconds), 12);
    cell(ShortNumber(last.cost), 12);
    cell(Millimetres(last.body_error), 12);
    if (HasBest(baseline)) {
      const std::optional<long> steps = StepsToReach(run, Best(*baseline));
      cell(steps ? std::to_string(*steps) : "never", 19);
    } else {
      cell("-", 19);
    }
    out << "  " << Name(run.summary.termination) << "\n";
  }
  if (HasBest(baseline))
    out << "Baseline: the best "
        << (std::isnan(baseline->points[0].body_error) ? "cost" : "body error")
        << " of " << baseline->optimizer << ".\n";
  return out.str();
}

std::string ComparisonJson(const std::vector<ComparisonRun>& runs) {
  Json json;
  json["schema"] = "invsim.comparison";
  json["schema_version"] = kComparisonSchemaVersion;
  const ComparisonRun* baseline = Baseline(runs);
  if (baseline) json["baseline"] = baseline->optimizer;
  json["runs"] = Json::array();
  for (const ComparisonRun& run : runs)
    json["runs"].push_back(RunJson(run, baseline));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string ComparisonCsv(const std::vector<ComparisonRun>& runs) {
  std::ostringstream out;
  out.precision(10);
  out << "optimizer,iteration,steps,seconds,cost,body_v2v_mean_mm\n";
  for (const ComparisonRun& run : runs)
    for (const ComparisonPoint& p : run.points) {
      out << run.optimizer << ',' << p.iteration << ',' << p.steps << ','
          << p.seconds << ',' << p.cost << ',';
      if (!std::isnan(p.body_error)) out << 1000 * p.body_error;
      out << '\n';
    }
  return out.str();
}

std::vector<Chart> ComparisonCharts(const std::vector<ComparisonRun>& runs) {
  const auto steps = [](const ComparisonPoint& p) {
    return static_cast<double>(p.steps);
  };
  const auto seconds = [](const ComparisonPoint& p) { return p.seconds; };
  const auto cost = [](const ComparisonPoint& p) { return p.cost; };
  const auto error = [](const ComparisonPoint& p) {
    return 1000 * p.body_error;
  };
  std::vector<Chart> charts = {
      Against(runs, "cost", "time [s]", seconds, cost),
      Against(runs, "cost", "simulation steps", steps, cost)};
  for (Chart& chart : charts) chart.log_y = true;
  bool known = false;
  for (const ComparisonRun& run : runs)
    for (const ComparisonPoint& p : run.points)
      known = known || !std::isnan(p.body_error);
  if (!known) return charts;
  charts.push_back(
      Against(runs, "body error [mm]", "time [s]", seconds, error));
  charts.push_back(
      Against(runs, "body error [mm]", "simulation steps", steps, error));
  return charts;
}

void WriteComparison(const RunFolder& folder,
                     const std::vector<ComparisonRun>& runs) {
  folder.Write("report.json", ComparisonJson(runs));
  folder.Write("comparison.csv", ComparisonCsv(runs));
  WebPage page;
  page.title = "Comparison of optimisers";
  page.lead = "The same problem from the same start.";
  page.charts = ComparisonCharts(runs);
  page.details = ComparisonText(runs);
  folder.Write("comparison.svg", StandaloneSvg(page.charts));
  folder.Write("report.html", FormatWebPage(page));
  std::string details = ComparisonText(runs);
  for (const ComparisonRun& run : runs)
    details += "\n" + run.optimizer + ": " + run.summary.reason + "\n" +
               run.summary.details + "\n";
  folder.Write("solver.txt", details);
}

}  // namespace invsim
