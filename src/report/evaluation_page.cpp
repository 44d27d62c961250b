// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "invsim/report/evaluation_report.h"
#include "invsim/report/web_page.h"

namespace invsim {
namespace {

// What a curve shows of every frame, mm.
struct Quantity {
  const char* name;
  double (*of)(const FrameMetrics&);
};
// By charts: curves of one chart are of one size.
const std::vector<std::vector<Quantity>> kCharts = {
    {{"body", [](const FrameMetrics& f) { return f.body_v2v; }},
     {"joints", [](const FrameMetrics& f) { return f.joint; }}},
    {{"cloth", [](const FrameMetrics& f) { return f.cloth_chamfer.mean(); }},
     {"combined",
      [](const FrameMetrics& f) { return f.combined_chamfer.mean(); }}},
    {{"points to surface",
      [](const FrameMetrics& f) { return f.points_to_surface; }}},
    {{"penetration", [](const FrameMetrics& f) { return f.penetration; }}}};

// Over the frames, means of the runs that have the number; none if none has.
ChartSeries Curve(const std::string& name,
                  const std::vector<const Metrics*>& runs,
                  const Quantity& quantity) {
  ChartSeries series;
  series.name = name;
  bool any = false;
  size_t frames = 0;
  for (const Metrics* m : runs) frames = std::max(frames, m->frames.size());
  for (size_t k = 0; k < frames; ++k) {
    double sum = 0;
    int count = 0;
    for (const Metrics* m : runs) {
      if (k >= m->frames.size()) continue;
      const double value = quantity.of(m->frames[k]);
      if (std::isnan(value)) continue;
      sum += value;
      ++count;
    }
    any = any || count > 0;
    series.x.push_back(static_cast<double>(k));
    series.values.push_back(sum / count);
  }
  if (!any) return {};
  return series;
}

// "body 4.3, cloth 5.6, penetration 0 mm"
std::string InShort(const Metrics& metrics) {
  static const std::map<std::string, std::string> names = {
      {"body_v2v_mean_mm", "body"},
      {"cloth_chamfer_l1_mm", "cloth"},
      {"penetration_max_mm", "penetration"}};
  std::string text;
  for (const auto& [key, value] : metrics.Values())
    if (const auto name = names.find(key); name != names.end())
      text +=
          (text.empty() ? "" : ", ") + name->second + " " + ShortNumber(value);
  return text.empty() ? "nothing to compare" : text + " mm";
}

Chart OverFrames(const std::string& title) {
  Chart chart;
  chart.title = title + " [mm]";
  chart.x_title = "frame";
  return chart;
}

void AddCurve(ChartSeries curve, Chart* chart) {
  if (!curve.values.empty()) chart->series.push_back(std::move(curve));
}
void AddChart(Chart chart, WebPage* page) {
  if (!chart.series.empty()) page->charts.push_back(std::move(chart));
}

}  // namespace

std::string EvaluationPage(const RunEvaluation& e) {
  WebPage page;
  page.title = "Evaluation of " + e.run;
  page.lead = "Distances to the truth, " + e.truth + ".";
  page.facts = {{"garment", e.garment},
                {"frames", std::to_string(e.metrics.frames.size())}};
  for (const auto& [key, value] : e.metrics.Values())
    page.facts.emplace_back(key, ShortNumber(value));
  for (const std::vector<Quantity>& quantities : kCharts) {
    std::string title;
    for (const Quantity& q : quantities)
      title += (title.empty() ? "" : ", ") + std::string(q.name);
    Chart chart = OverFrames(title);
    for (const Quantity& q : quantities)
      AddCurve(Curve(q.name, {&e.metrics}, q), &chart);
    AddChart(std::move(chart), &page);
  }
  return FormatWebPage(page);
}

std::string EvaluationsPage(const std::vector<RunEvaluation>& evaluations) {
  WebPage page;
  page.title = "Evaluation of " + std::to_string(evaluations.size()) + " runs";
  page.lead = "Mean distances to the truth by garment, frame by frame.";
  std::map<std::string, std::vector<const Metrics*>> by_garment;
  for (const RunEvaluation& e : evaluations) {
    by_garment[e.garment].push_back(&e.metrics);
    page.facts.emplace_back(e.run, InShort(e.metrics));
  }
  for (const std::vector<Quantity>& quantities : kCharts) {
    for (const Quantity& q : quantities) {
      Chart chart = OverFrames(q.name);
      for (const auto& [garment, runs] : by_garment)
        AddCurve(Curve(garment, runs, q), &chart);
      AddChart(std::move(chart), &page);
    }
  }
  page.details = ResultsTable(evaluations);
  return FormatWebPage(page);
}

}  // namespace invsim
