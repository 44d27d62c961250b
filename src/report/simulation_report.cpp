// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/simulation_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "effects_json.h"
#include "invsim/base/names.h"
#include "invsim/base/progress.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

const char* StatusName(RunStatus status) {
  switch (status) {
    case RunStatus::kComplete:
      return "complete";
    case RunStatus::kFailed:
      return "failed";
    case RunStatus::kInterrupted:
      return "interrupted";
  }
  return "";
}

FrameStats Total(const SimulationReport& report) {
  FrameStats total = report.relaxation.stats;
  total.Add(report.sequence.stats);
  return total;
}

Json InputsJson(const SimulationReport& r) {
  Json json;
  json["body"] = r.body;
  json["motion"] = r.motion;
  json["garment"] = r.garment;
  json["material"] = r.material;
  json["effects"] = EffectsOn(r.effects);
  json["frames_per_second"] = r.frames_per_second;
  json["friction"] = r.friction;
  json["thickness_mm"] = 1000 * r.thickness;
  json["contact_tolerance_weights"] = r.tolerance;
  json["threads"] = r.threads;
  return json;
}

Json CountsJson(const SimulationReport& r) {
  Json json;
  json["body_vertices"] = r.body_vertices;
  json["body_faces"] = r.body_faces;
  json["cloth_vertices"] = r.cloth_vertices;
  json["cloth_faces"] = r.cloth_faces;
  json["cloth_mass_kg"] = r.cloth_mass;
  json["frames_wanted"] = r.frames_wanted;
  json["frames_done"] = r.sequence.frames;
  return json;
}

Json StatsJson(const FrameStats& stats) {
  const StepStats& s = stats.step;
  Json json;
  json["steps"] = s.substeps;
  json["steps_missed"] = s.missed;
  json["steps_halved"] = s.halved;
  json["steps_failed"] = s.failed;
  if (!s.failures.empty()) json["steps_failed_because"] = s.failures;
  json["worst_residual_weights"] = s.worst_residual;
  json["most_contacts"] = s.most_contacts;
  json["newton_iterations"] = s.newton_iterations;
  json["splitting_iterations"] = s.admm_iterations;
  json["factorizations"] = s.factorizations;
  json["solves"] = s.solves;
  json["contact_queries"] = s.contact_queries;
  json["slip_solves"] = s.slip_solves;
  json["yield_solves"] = s.yield_solves;
  json["penetration_max_mm"] = 1000 * stats.penetration.deepest;
  json["penetrating_vertices"] = stats.penetration.inside;
  json["body_overlap_penetration_max_mm"] =
      1000 * stats.penetration.deepest_overlap;
  json["body_overlap_vertices"] = stats.penetration.overlap;
  if (stats.crossing_pairs >= 0) {
    json["cloth_contacts_max"] = s.most_cloth_contacts;
    json["sweep_solves"] = s.sweep_solves;
    json["stopped_vertices"] = s.stopped;
    json["crossing_pairs_max"] = stats.crossing_pairs;
  }
  json["mean_speed_m_per_s"] = stats.mean_speed;
  json["seconds"] = {{"total", stats.seconds},
                     {"processor", stats.processor_seconds},
                     {"assembly", s.assembly_seconds},
                     {"contact_detection", s.detection_seconds},
                     {"factorization", s.factor_seconds},
                     {"solve", s.solve_seconds}};
  for (const Timers::Part& part : s.effects.parts())
    json["seconds"]["assembly_by_effect"][part.name] = part.seconds;
  return json;
}

Json RelaxationJson(const RelaxationResult& r) {
  Json json;
  json["status"] = StatusName(r.status);
  json["last_phase"] = PhaseName(r.phase);
  json["frames"] = r.frames;
  json["at_rest"] = r.at_rest;
  json["rest_speed_m_per_s"] = r.rest_speed;
  json["stats"] = StatsJson(r.stats);
  return json;
}

void PartText(const FrameStats& stats, std::ostream* out) {
  const StepStats& s = stats.step;
  *out << "  steps                 " << s.substeps << "\n"
       << "  missed the tolerance  " << s.missed << "\n"
       << "  halved                " << s.halved << "\n"
       << "  without a result      " << s.failed << "\n"
       << "  worst residual        " << ShortNumber(s.worst_residual)
       << " of a vertex's weight\n"
       << "  most contacts         " << s.most_contacts << "\n"
       << "  Newton iterations     " << s.newton_iterations << "\n"
       << "  splitting iterations  " << s.admm_iterations << "\n"
       << "  factorisations        " << s.factorizations << "\n"
       << "  solves                " << s.solves << "\n"
       << "  contact queries       " << s.contact_queries << "\n"
       << "  penetration           "
       << ShortNumber(1000 * stats.penetration.deepest) << " mm, "
       << stats.penetration.inside << " vertices at most\n";
  if (stats.penetration.overlap > 0)
    *out << "  in skin crossing skin "
         << ShortNumber(1000 * stats.penetration.deepest_overlap) << " mm, "
         << stats.penetration.overlap << " vertices at most\n";
  if (stats.crossing_pairs >= 0)
    *out << "  cloth on cloth        " << s.most_cloth_contacts
         << " contacts at most, " << s.sweep_solves
         << " more solves by the sweep, " << s.stopped << " vertices stopped\n"
         << "  crossing faces        " << stats.crossing_pairs
         << " pairs at most\n";
  *out << "  time                  " << ShortNumber(stats.seconds)
       << " s: assembly " << ShortNumber(s.assembly_seconds)
       << ", contact detection " << ShortNumber(s.detection_seconds)
       << ", factorisation " << ShortNumber(s.factor_seconds) << ", solve "
       << ShortNumber(s.solve_seconds) << "\n";
}

std::string RestText(const RelaxationResult& r) {
  if (r.status == RunStatus::kFailed)
    return std::string("failed while the body was in phase '") +
           PhaseName(r.phase) + "'";
  if (r.status == RunStatus::kInterrupted) return "interrupted";
  return std::string(r.at_rest ? "at rest" : "not at rest in the time given") +
         " (mean speed " + ShortNumber(100 * r.rest_speed) + " cm/s)";
}

std::string WhereItFailed(const SimulationReport& r) {
  if (r.relaxation.status == RunStatus::kFailed)
    return std::string("while dressing, in phase '") +
           PhaseName(r.relaxation.phase) + "'";
  return "in frame " + std::to_string(r.sequence.frames);
}

// " (the force of membrane is not finite)", "" if nobody knows.
std::string WhyItFailed(const StepStats& s) {
  std::string why;
  for (const auto& [cause, count] : s.failures)
    why += (why.empty() ? " (" : ", ") + cause;
  return why + (why.empty() ? "" : ")");
}

// Of the steps that have a result how many met the tolerance.
std::string ToleranceText(const StepStats& s, double tolerance) {
  std::ostringstream out;
  if (s.failed > 0)
    out << s.failed << (s.failed == 1 ? " step" : " steps")
        << " had no result, ";
  if (s.missed > 0)
    out << s.missed << " of " << s.substeps
        << " steps missed the contact tolerance of " << ShortNumber(tolerance);
  else if (s.failed > 0)
    out << "the others met the contact tolerance";
  else
    out << "Every one of " << s.substeps << " steps met the contact tolerance";
  // A step without a result has a residual that is not finite.
  if (std::isfinite(s.worst_residual))
    out << " (worst residual " << ShortNumber(s.worst_residual)
        << " of a vertex's weight)";
  return out.str();
}

}  // namespace

RunStatus Status(const SimulationReport& report) {
  return report.relaxation.status != RunStatus::kComplete
             ? report.relaxation.status
             : report.sequence.status;
}

int MissedSteps(const SimulationReport& report) {
  return Total(report).step.missed;
}

std::string Verdict(const SimulationReport& report) {
  const FrameStats total = Total(report);
  std::ostringstream out;
  switch (Status(report)) {
    case RunStatus::kComplete:
      out << "Complete: ";
      break;
    case RunStatus::kFailed:
      out << "Failed " << WhereItFailed(report) << WhyItFailed(total.step)
          << ", after ";
      break;
    case RunStatus::kInterrupted:
      out << "Interrupted after ";
      break;
  }
  out << report.sequence.frames << " of " << report.frames_wanted << " frames. "
      << ToleranceText(total.step, report.tolerance) << "; deepest penetration "
      << ShortNumber(1000 * total.penetration.deepest) << " mm.";
  return out.str();
}

std::string SimulationJson(const SimulationReport& report) {
  Json json;
  json["schema"] = "invsim.simulation";
  json["schema_version"] = kSimulationSchemaVersion;
  json["status"] = StatusName(Status(report));
  json["usable"] = Status(report) == RunStatus::kComplete;
  json["verdict"] = Verdict(report);
  json["inputs"] = InputsJson(report);
  json["effects"] = EffectsJson(report.effects);
  json["counts"] = CountsJson(report);
  json["total"] = StatsJson(Total(report));
  json["wall_seconds"] = report.seconds;
  json["relaxation"] = RelaxationJson(report.relaxation);
  json["sequence"] = StatsJson(report.sequence.stats);
  json["frames"] = Json::array();
  for (size_t k = 0; k < report.frames.size(); ++k) {
    Json frame;
    frame["frame"] = k;
    frame["stress_p99_n_per_m"] = report.stress[k];
    frame.update(StatsJson(report.frames[k]));
    json["frames"].push_back(std::move(frame));
  }
  // A path may hold any bytes, JSON only UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string SimulationText(const SimulationReport& r) {
  std::ostringstream out;
  out << Verdict(r) << "\n\nInput\n"
      << "  body                  " << r.body << ", " << r.body_vertices
      << " vertices\n"
      << "  motion                " << r.motion << ", " << r.frames_wanted
      << " frames at " << ShortNumber(r.frames_per_second) << " per second\n"
      << "  garment               " << r.garment << ", " << r.cloth_vertices
      << " vertices, " << ShortNumber(r.cloth_mass) << " kg\n"
      << "  material              " << r.material << ", friction "
      << ShortNumber(r.friction) << ", kept " << ShortNumber(1000 * r.thickness)
      << " mm from the body\n"
      << "\nEffects\n"
      << DecisionsText(r.effects) << "\n"
      << "Relaxation: " << r.relaxation.frames << " frames, "
      << RestText(r.relaxation) << "\n";
  PartText(r.relaxation.stats, &out);
  out << "\nSequence: " << r.sequence.frames << " of " << r.frames_wanted
      << " frames, " << StatusName(r.sequence.status) << "\n";
  PartText(r.sequence.stats, &out);
  out << "\nAll in all " << ClockText(r.seconds) << " on " << r.threads
      << (r.threads == 1 ? " thread.\n" : " threads.\n");
  return out.str();
}

std::vector<Chart> SimulationCharts(const SimulationReport& report) {
  Chart base;
  base.x_title = "time [s]";
  for (size_t k = 0; k < report.frames.size(); ++k)
    base.x.push_back(static_cast<double>(k) / report.frames_per_second);
  const auto chart = [&](const std::string& title,
                         const auto& value,
                         const std::string& name = "") {
    Chart c = base;
    c.title = title;
    c.series.push_back({name, {}});
    for (const FrameStats& stats : report.frames)
      c.series[0].values.push_back(value(stats));
    return c;
  };
  std::vector<Chart> charts;
  charts.push_back(
      chart("worst contact residual [vertex weights]",
            [](const FrameStats& f) { return f.step.worst_residual; }));
  charts.back().log_y = true;
  charts.push_back(chart(
      "deepest penetration [mm]",
      [](const FrameStats& f) { return 1000 * f.penetration.deepest; },
      "body"));
  charts.back().series.push_back({"where skin crosses skin", {}});
  for (const FrameStats& f : report.frames)
    charts.back().series.back().values.push_back(1000 *
                                                 f.penetration.deepest_overlap);
  charts.push_back(chart("most contacts in a step", [](const FrameStats& f) {
    return f.step.most_contacts;
  }));
  charts.push_back(chart("mean speed of the cloth [m/s]",
                         [](const FrameStats& f) { return f.mean_speed; }));
  charts.push_back(base);
  charts.back().title = "stress of the cloth, 99th percentile [N/m]";
  charts.back().series.push_back({"", report.stress});
  charts.push_back(chart("time to simulate a frame [s]",
                         [](const FrameStats& f) { return f.seconds; }));
  return charts;
}

}  // namespace invsim
