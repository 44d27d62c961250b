// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/gallery_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "invsim/report/web_page.h"
#include "text_line.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

const char* Word(const GalleryRow& row) {
  if (row.known()) return "border";
  if (!row.holds()) return "FAILS";
  return row.outcome.refused ? "refused" : "holds";
}

const char* Word(const GalleryFitRow& row) {
  if (!row.holds()) return "FAILS";
  return row.outcome.refused ? "refused" : "holds";
}

Json NumberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

std::string TextRow(const GalleryRow& row) {
  const HardOutcome& o = row.outcome;
  if (o.refused)
    return Line("%-31s %-7s  %s\n",
                row.hard.name.c_str(),
                Word(row),
                o.refusal.c_str());
  const std::string derivative =
      o.columns > 0 ? Line("%.0e", o.derivative) : std::string("-");
  return Line("%-31s %-7s %6d/%-6d %8.0e %8.3f %8.0e %8s %7.2f\n",
              row.hard.name.c_str(),
              Word(row),
              o.step.substeps - o.step.missed,
              o.step.substeps,
              o.step.worst_residual,
              1e3 * o.penetration,
              std::max(o.energy, 0.0),
              derivative.c_str(),
              o.seconds);
}

std::string SceneTable(const std::vector<GalleryRow>& rows) {
  std::string text = Line("%-31s %-7s %13s %8s %8s %8s %8s %7s\n",
                          "case",
                          "",
                          "converged",
                          "residual",
                          "inside",
                          "energy",
                          "slope",
                          "time");
  text += Line("%-31s %-7s %13s %8s %8s %8s %8s %7s\n",
               "",
               "",
               "steps",
               "weights",
               "mm",
               "relative",
               "relative",
               "s");
  for (const GalleryRow& row : rows) text += TextRow(row);
  return text;
}

// "31 > 12", what is not known as "-".
std::string FromTo(double from, double to) {
  const auto number = [](double value) {
    return std::isfinite(value) ? Line("%.3g", value) : std::string("-");
  };
  return number(from) + " > " + number(to);
}

std::string TextRow(const GalleryFitRow& row) {
  const HardFitOutcome& o = row.outcome;
  if (o.refused)
    return Line("%-31s %-7s  %s\n",
                row.hard.name.c_str(),
                Word(row),
                o.refusal.c_str());
  const OptimizerSummary s =
      o.result.optimizer() ? *o.result.optimizer() : OptimizerSummary();
  const std::string cost = s.iterations.empty()
                               ? "-"
                               : FromTo(o.result.initial_cost(), s.final_cost);
  const std::string error = FromTo(1e3 * o.start_error, 1e3 * o.body_error);
  return Line("%-31s %-7s %-15s %19s %5d %6d %13s %7.2f\n",
              row.hard.name.c_str(),
              Word(row),
              Name(o.result.termination),
              cost.c_str(),
              o.result.counts().evaluations,
              o.result.counts().failed,
              error.c_str(),
              o.seconds);
}

std::string FitTable(const std::vector<GalleryFitRow>& rows) {
  std::string text = Line("%-31s %-7s %-15s %19s %5s %6s %13s %7s\n",
                          "case",
                          "",
                          "ended",
                          "cost",
                          "eval.",
                          "failed",
                          "body",
                          "time");
  text += Line("%-31s %-7s %-15s %19s %5s %6s %13s %7s\n",
               "",
               "",
               "",
               "from > to",
               "",
               "",
               "mm",
               "s");
  for (const GalleryFitRow& row : rows) text += TextRow(row);
  for (const GalleryFitRow& row : rows)
    if (!row.outcome.refused)
      text += row.hard.name + ": " + row.outcome.result.reason + "\n";
  return text;
}

Json JsonRow(const GalleryFitRow& row) {
  const HardFitOutcome& o = row.outcome;
  Json json;
  json["name"] = row.hard.name;
  json["shows"] = row.hard.shows;
  json["result"] = Word(row);
  json["broken"] = o.broken;
  if (o.refused) {
    json["refusal"] = o.refusal;
    return json;
  }
  json["status"] = Name(o.result.termination);
  json["usable"] = o.result.usable();
  json["reason"] = o.result.reason;
  if (o.result.optimizer()) {
    const OptimizerSummary& s = *o.result.optimizer();
    json["initial_cost"] = NumberOrNull(o.result.initial_cost());
    json["final_cost"] = NumberOrNull(s.final_cost);
    json["evaluations"] = o.result.counts().evaluations;
    json["evaluations_failed"] = o.result.counts().failed;
    json["evaluations_without_derivative"] = o.result.counts().no_derivative;
  }
  json["steps_failed_because"] = o.result.stats.step.failures;
  json["substeps"] = o.result.stats.step.substeps;
  json["substeps_missed"] = o.result.stats.step.missed;
  json["start_body_v2v_mean_mm"] = NumberOrNull(1e3 * o.start_error);
  json["body_v2v_mean_mm"] = NumberOrNull(1e3 * o.body_error);
  json["seconds"] = o.seconds;
  return json;
}

Json JsonRow(const GalleryRow& row) {
  const HardOutcome& o = row.outcome;
  Json json;
  json["name"] = row.hard.name;
  json["shows"] = row.hard.shows;
  json["result"] = Word(row);
  if (!row.hard.border.empty()) json["border"] = row.hard.border;
  json["broken"] = Json::array();
  for (const Breach& broken : o.broken) json["broken"].push_back(broken.text);
  if (o.refused) {
    json["refusal"] = o.refusal;
    return json;
  }
  json["frames"] = o.frames;
  json["substeps"] = o.step.substeps;
  json["substeps_missed"] = o.step.missed;
  json["substeps_halved"] = o.step.halved;
  json["substeps_failed"] = o.step.failed;
  json["worst_residual_weights"] = NumberOrNull(o.step.worst_residual);
  json["most_contacts"] = o.step.most_contacts;
  json["splitting_iterations"] = o.step.admm_iterations;
  json["newton_iterations"] = o.step.newton_iterations;
  json["factorizations"] = o.step.factorizations;
  json["penetration_max_mm"] = 1e3 * o.penetration;
  json["penetration_in_overlap_max_mm"] = 1e3 * o.overlap;
  json["energy_gain_relative"] = NumberOrNull(o.energy);
  json["speed_max_m_per_s"] = NumberOrNull(o.speed);
  json["creep_max_mm"] = 1e3 * o.creep;
  json["vertices_misplaced"] = o.misplaced;
  json["faces_closed"] = o.closed;
  json["crossing_faces_max"] = o.crossings;
  json["derivative_relative_error"] = NumberOrNull(o.derivative);
  json["derivative_columns"] = o.columns;
  json["derivative_columns_switched"] = o.switched;
  json["seconds"] = o.seconds;
  return json;
}

}  // namespace

bool Holds(const GalleryReport& report) {
  return std::all_of(report.rows.begin(),
                     report.rows.end(),
                     [](const GalleryRow& row) {
                       return row.holds() || row.known();
                     }) &&
         std::all_of(report.fits.begin(),
                     report.fits.end(),
                     [](const GalleryFitRow& row) { return row.holds(); });
}

std::string GalleryVerdict(const GalleryReport& report) {
  int holds = 0, known = 0;
  std::string failing;
  for (const GalleryRow& row : report.rows) {
    holds += row.holds();
    known += row.known();
    if (!row.holds() && !row.known())
      failing += (failing.empty() ? "" : ", ") + row.hard.name;
  }
  for (const GalleryFitRow& row : report.fits) {
    holds += row.holds();
    if (!row.holds()) failing += (failing.empty() ? "" : ", ") + row.hard.name;
  }
  std::string text =
      Line("%d of %d cases hold",
           holds,
           static_cast<int>(report.rows.size() + report.fits.size()));
  if (known > 0) text += Line(", %d are at a known border", known);
  return text + (failing.empty() ? "." : "; failing: " + failing + ".");
}

std::string GalleryText(const GalleryReport& report) {
  std::string text;
  if (!report.rows.empty()) text += SceneTable(report.rows) + "\n";
  if (!report.fits.empty()) text += FitTable(report.fits) + "\n";
  text += GalleryVerdict(report) + "\n";
  for (const GalleryRow& row : report.rows) {
    for (const Breach& broken : row.outcome.broken)
      text += row.hard.name + ": " + broken.text + "\n";
    if (row.known())
      text += row.hard.name + ": known: " + row.hard.border + "\n";
    for (const Breach& broken : row.outcome.beyond)
      text += row.hard.name + ": beyond its border: " + broken.text + "\n";
  }
  for (const GalleryFitRow& row : report.fits)
    for (const std::string& broken : row.outcome.broken)
      text += row.hard.name + ": " + broken + "\n";
  return text;
}

std::string GalleryJson(const GalleryReport& report) {
  Json json;
  json["schema"] = "invsim.gallery";
  json["schema_version"] = kGallerySchemaVersion;
  json["holds"] = Holds(report);
  json["verdict"] = GalleryVerdict(report);
  json["derivative_checked"] = report.derivative;
  json["cases"] = Json::array();
  for (const GalleryRow& row : report.rows)
    json["cases"].push_back(JsonRow(row));
  json["fits"] = Json::array();
  for (const GalleryFitRow& row : report.fits)
    json["fits"].push_back(JsonRow(row));
  return json.dump(2) + "\n";
}

std::string GalleryHtml(const GalleryReport& report) {
  WebPage page;
  page.title = "Hard cases";
  page.lead = GalleryVerdict(report);
  for (const GalleryRow& row : report.rows)
    page.facts.emplace_back(row.hard.name,
                            std::string(Word(row)) + ": " + row.hard.shows);
  for (const GalleryFitRow& row : report.fits)
    page.facts.emplace_back(row.hard.name,
                            std::string(Word(row)) + ": " + row.hard.shows);
  page.details = GalleryText(report);
  return FormatWebPage(page);
}

}  // namespace invsim
