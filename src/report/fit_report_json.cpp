// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "effects_json.h"
#include "fit_report_parts.h"
#include "invsim/base/names.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;

template <typename Vector>
Json List(const Vector& values, double factor = 1) {
  Json list = Json::array();
  for (const double value : values) list.push_back(factor * value);
  return list;
}

Json InputsJson(const FitReport& r) {
  Json json;
  json["points"] = r.points;
  json["body"] = r.body;
  json["garment"] = r.garment;
  json["material"] = r.material;
  json["effects"] = EffectsOn(r.effects);
  json["frames"] = r.frames;
  json["frames_per_second"] = r.frames_per_second;
  json["points_per_frame_min"] = r.fewest_points;
  json["points_per_frame_max"] = r.most_points;
  json["points_dropped"] = r.points_dropped;
  json["points_filtered"] = r.points_filtered;
  json["body_vertices"] = r.body_vertices;
  json["cloth_vertices"] = r.cloth_vertices;
  json["cloth_faces"] = r.cloth_faces;
  json["friction"] = r.friction;
  json["thickness_mm"] = 1000 * r.thickness;
  json["contact_tolerance_weights"] = r.tolerance;
  json["optimizer"] = r.optimizer;
  json["loss"] = r.loss;
  json["threads"] = r.threads;
  return json;
}

Json TriesJson(const Dressing& dressing) {
  Json tries = Json::array();
  for (const DressingTry& tried : dressing.tries) {
    Json json;
    json["way"] = Name(tried.way);
    json["worn"] = static_cast<int>(tries.size()) == dressing.worn;
    if (!tried.refused.empty()) json["refused"] = tried.refused;
    if (tried.relaxation) {
      json["frames"] = tried.relaxation->frames;
      json["at_rest"] = tried.relaxation->at_rest;
    }
    if (std::isfinite(tried.cost)) json["first_frames_cost"] = tried.cost;
    tries.push_back(std::move(json));
  }
  return tries;
}

Json StepsJson(const StepStats& s) {
  Json json;
  json["steps"] = s.substeps;
  json["steps_missed"] = s.missed;
  json["steps_halved"] = s.halved;
  json["steps_failed"] = s.failed;
  if (!s.failures.empty()) json["steps_failed_because"] = s.failures;
  json["worst_residual_weights"] = s.worst_residual;
  json["most_contacts"] = s.most_contacts;
  json["factorizations"] = s.factorizations;
  json["solves"] = s.solves;
  json["contact_queries"] = s.contact_queries;
  return json;
}

Json CostJson(const CostTerms& terms) {
  Json json;
  json["total"] = terms.total();
  json["data"] = terms.data;
  json["smoothness"] = terms.smoothness;
  json["shape"] = terms.shape;
  json["pose"] = terms.pose;
  json["overlap"] = terms.overlap;
  return json;
}

Json DressingsJson(const FitResult& r) {
  Json dressings = Json::array();
  for (const FitRound& round : r.rounds) {
    Json json;
    json["kept"] = static_cast<int>(dressings.size()) == r.kept;
    json["tries"] = TriesJson(round.dressing);
    if (const auto& optimizer = round.optimizer) {
      json["termination"] = Name(optimizer->termination);
      json["reason"] = optimizer->reason;
      json["iterations"] = optimizer->num_iterations();
      json["initial_cost"] = optimizer->initial_cost;
      json["final_cost"] = optimizer->final_cost;
    }
    dressings.push_back(std::move(json));
  }
  return dressings;
}

// Of all rounds, with the end of the one kept.
Json OptimizationJson(const FitResult& r) {
  const OptimizerSummary& s = *r.optimizer();
  const ObjectiveCounts counts = r.counts();
  Json json;
  json["termination"] = Name(s.termination);
  json["reason"] = s.reason;
  json["iterations"] = r.iterations();
  json["initial_cost"] = r.initial_cost();
  json["final_cost"] = s.final_cost;
  json["evaluations"] = counts.evaluations;
  json["evaluations_abandoned"] = counts.abandoned;
  json["evaluations_failed"] = counts.failed;
  json["evaluations_without_derivative"] = counts.no_derivative;
  json["linearizations"] = counts.linearizations;
  if (!s.iterations.empty())
    json["cost_by_term"] = CostJson(s.iterations.back().terms);
  return json;
}

Json UncertaintyJson(const Uncertainty& u) {
  Json json;
  if (!u.failure.empty()) {
    json["failure"] = u.failure;
    return json;
  }
  json["shape_deviation"] = List(u.shape_deviation);
  json["shape_undetermined_directions"] = Json::array();
  for (int k = 0; k < u.undetermined_directions; ++k) {
    Json direction;
    direction["direction"] = List(u.shape_directions.col(k));
    direction["deviation"] = u.direction_deviation[k];
    json["shape_undetermined_directions"].push_back(std::move(direction));
  }
  json["joints_undetermined"] = Json::array();
  json["joints_undetermined_axis"] = Json::object();
  for (const int j : UndeterminedJoints(u)) {
    json["joints_undetermined"].push_back(kJointNames[j]);
    if (!u.undetermined_axes[j].isZero())
      json["joints_undetermined_axis"][kJointNames[j]] =
          List(u.undetermined_axes[j]);
  }
  json["frames"] = Json::array();
  for (size_t t = 0; t < u.pose_deviation.size(); ++t) {
    Json frame;
    frame["pose_deviation_deg"] = List(u.pose_deviation[t], kDegrees);
    frame["translation_deviation_mm"] = List(u.translation_deviation[t], 1000);
    json["frames"].push_back(std::move(frame));
  }
  return json;
}

Json FramesJson(const FitReport& r) {
  Json frames = Json::array();
  for (size_t t = 0; t < r.simulated.size(); ++t) {
    const FrameStats& f = r.simulated[t];
    Json frame;
    frame["frame"] = t;
    frame["steps_missed"] = f.step.missed;
    frame["worst_residual_weights"] = f.step.worst_residual;
    frame["penetration_max_mm"] = 1000 * f.penetration.deepest;
    frame["body_overlap_penetration_max_mm"] =
        1000 * f.penetration.deepest_overlap;
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace

std::string FitJson(const FitReport& report) {
  const FitResult& r = report.result;
  Json json;
  json["schema"] = "invsim.fit";
  json["schema_version"] = kFitSchemaVersion;
  json["status"] = Name(r.termination);
  json["usable"] = r.usable();
  json["verdict"] = Verdict(report);
  json["inputs"] = InputsJson(report);
  json["effects"] = EffectsJson(report.effects);
  json["shape"] = List(r.body.shape);
  if (r.optimizer()) json["optimization"] = OptimizationJson(r);
  json["cost_by_distance"] = {{"cloth_to_points", r.costs.cloth_to_points},
                              {"skin_to_points", r.costs.skin_to_points},
                              {"points_to_surface", r.costs.points_to_surface}};
  json["dressings"] = DressingsJson(r);
  json["simulation"] = StepsJson(r.stats.step);
  json["simulation"]["neighbour_queries"] = r.stats.neighbour_queries;
  const FrameStats last = Simulated(report);
  json["final_simulation"] = StepsJson(last.step);
  json["final_simulation"]["penetration_max_mm"] =
      1000 * last.penetration.deepest;
  json["final_simulation"]["body_overlap_penetration_max_mm"] =
      1000 * last.penetration.deepest_overlap;
  if (r.uncertainty) json["uncertainty"] = UncertaintyJson(*r.uncertainty);
  json["approximations"] = Approximations(report);
  json["wall_seconds"] = report.seconds;
  for (const auto& [name, seconds] : TimeByPart(report))
    json["seconds_by_part"][name] = seconds;
  json["frames"] = FramesJson(report);
  // A path may hold any bytes, JSON only UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace invsim
