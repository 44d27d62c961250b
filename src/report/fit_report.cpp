// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/fit_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "effects_json.h"
#include "invsim/base/names.h"
#include "invsim/base/progress.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;
// A joint counts as undetermined if so much of it (frames, angles) is.
constexpr double kMostly = 0.5;

FrameStats Simulated(const FitReport& report) {
  FrameStats total;
  for (const FrameStats& frame : report.simulated) total.Add(frame);
  return total;
}

template <typename Vector>
Json List(const Vector& values, double factor = 1) {
  Json list = Json::array();
  for (const double value : values) list.push_back(factor * value);
  return list;
}

std::vector<std::string> UndeterminedJointNames(const Uncertainty& u) {
  std::vector<std::string> names;
  for (int j = 1; j < kNumJoints; ++j)
    if (u.undetermined_joints[j] > kMostly) names.push_back(kJointNames[j]);
  return names;
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

Json OptimizerJson(const OptimizerSummary& s) {
  Json json;
  json["termination"] = Name(s.termination);
  json["reason"] = s.reason;
  json["iterations"] = s.iterations.empty() ? 0 : s.iterations.size() - 1;
  json["initial_cost"] = s.initial_cost;
  json["final_cost"] = s.final_cost;
  json["evaluations"] = s.counts.evaluations;
  json["evaluations_abandoned"] = s.counts.abandoned;
  json["evaluations_failed"] = s.counts.failed;
  json["evaluations_without_derivative"] = s.counts.no_derivative;
  json["linearizations"] = s.counts.linearizations;
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
  json["joints_undetermined"] = UndeterminedJointNames(u);
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

// Two columns.
class Lines {
 public:
  explicit Lines(std::ostream* out) : out_(out) {}
  Lines& Add(const std::string& name, const std::string& value) {
    std::string padded = name;
    padded.resize(std::max<size_t>(padded.size() + 1, 26), ' ');
    *out_ << "  " << padded << value << "\n";
    return *this;
  }
  Lines& Add(const std::string& name, double value, const char* unit = "") {
    return Add(name, ShortNumber(value) + unit);
  }

 private:
  std::ostream* out_;
};

// "2 (the force of membrane is not finite)"
std::string FailedSteps(const StepStats& s) {
  std::string why;
  for (const auto& [cause, count] : s.failures)
    why += (why.empty() ? " (" : ", ") +
           (s.failures.size() > 1 ? std::to_string(count) + ": " : "") + cause;
  return std::to_string(s.failed) + why + (why.empty() ? "" : ")");
}

void InputText(const FitReport& r, std::ostream* out) {
  *out << "Input\n";
  Lines(out)
      .Add("points",
           r.points + ", " + std::to_string(r.frames) + " frames at " +
               ShortNumber(r.frames_per_second) + " per second, " +
               std::to_string(r.fewest_points) + " to " +
               std::to_string(r.most_points) + " points used of each")
      .Add("points dropped", std::to_string(r.points_dropped) + " (not finite)")
      .Add("body",
           r.body + ", " + std::to_string(r.body_vertices) + " vertices")
      .Add("garment",
           r.garment + ", " + std::to_string(r.cloth_vertices) + " vertices")
      .Add("material",
           r.material + ", friction " + ShortNumber(r.friction) + ", kept " +
               ShortNumber(1000 * r.thickness) + " mm from the body")
      .Add("loss", r.loss)
      .Add("threads", std::to_string(r.threads));
}

void StartText(const FitResult& r, std::ostream* out) {
  *out << "\nInitialisation\n";
  Lines lines(out);
  if (r.init) {
    lines.Add("tracking began at", "frame " + std::to_string(r.init->anchor));
    lines.Add("refinement", r.init->refinement.reason);
  } else {
    lines.Add("body", "as given, or found in the checkpoint");
  }
  if (r.carried) lines.Add("garment", "carried to the estimated shape");
  if (!r.carry_note.empty())
    lines.Add("garment", "not carried to the estimated shape: " + r.carry_note);
  if (r.relaxation && r.relaxation->status == RunStatus::kFailed)
    lines.Add(
        "relaxation",
        "failed after " + std::to_string(r.relaxation->frames) +
            " frames; failed steps: " + FailedSteps(r.relaxation->stats.step));
  else if (r.relaxation)
    lines.Add("relaxation",
              std::to_string(r.relaxation->frames) + " frames, " +
                  (r.relaxation->at_rest ? "at rest" : "not at rest") +
                  " (mean speed " +
                  ShortNumber(100 * r.relaxation->rest_speed) + " cm/s)");
}

void OptimizerText(const FitReport& report, std::ostream* out) {
  const OptimizerSummary& s = *report.result.optimizer;
  *out << "\nOptimisation by " << report.optimizer << "\n";
  Lines lines(out);
  lines.Add("ended", std::string(Name(s.termination)) + ": " + s.reason)
      .Add("cost",
           ShortNumber(s.initial_cost) + " to " + ShortNumber(s.final_cost))
      .Add("iterations",
           std::to_string(s.iterations.empty() ? 0 : s.iterations.size() - 1))
      .Add("evaluations", std::to_string(s.counts.evaluations))
      .Add("  given up as worse", std::to_string(s.counts.abandoned))
      .Add("  failed",
           std::to_string(s.counts.failed) +
               (s.counts.failed > 0
                    ? " (no derivative at " +
                          std::to_string(s.counts.no_derivative) + " of them)"
                    : ""))
      .Add("linearisations", std::to_string(s.counts.linearizations));
  if (report.result.recalled > 0)
    lines.Add("answers from checkpoint",
              std::to_string(report.result.recalled));
  if (s.iterations.empty()) return;
  const CostTerms& terms = s.iterations.back().terms;
  const ClothPointsCosts& costs = report.result.costs;
  *out << "\nCost by term\n";
  Lines(out)
      .Add("data", terms.data)
      .Add("  cloth to points", costs.cloth_to_points)
      .Add("  skin to points", costs.skin_to_points)
      .Add("  points to surface", costs.points_to_surface)
      .Add("smoothness", terms.smoothness)
      .Add("shape prior", terms.shape)
      .Add("pose prior", terms.pose)
      .Add("overlap of body parts", terms.overlap);
}

void SimulationText(const FitReport& report, std::ostream* out) {
  const StepStats& s = report.result.stats.step;
  const FrameStats last = Simulated(report);
  *out << "\nSimulation, all evaluations\n";
  Lines(out)
      .Add("frames", std::to_string(report.result.stats.frames))
      .Add("steps", std::to_string(s.substeps))
      .Add("missed the tolerance", std::to_string(s.missed))
      .Add("halved", std::to_string(s.halved))
      .Add("failed", FailedSteps(s))
      .Add("worst residual", s.worst_residual, " of a vertex's weight")
      .Add("factorisations", std::to_string(s.factorizations))
      .Add("solves", std::to_string(s.solves))
      .Add("contact queries", std::to_string(s.contact_queries))
      .Add("nearest neighbours sought",
           std::to_string(report.result.stats.neighbour_queries));
  *out << "\nSimulation at the solution\n";
  Lines(out)
      .Add("steps", std::to_string(last.step.substeps))
      .Add("missed the tolerance", std::to_string(last.step.missed))
      .Add("worst residual", last.step.worst_residual, " of a vertex's weight")
      .Add("penetration", 1000 * last.penetration.deepest, " mm")
      .Add("where skin crosses skin",
           1000 * last.penetration.deepest_overlap,
           " mm");
}

void UncertaintyText(const Uncertainty& u, std::ostream* out) {
  *out << "\nUncertainty (one standard deviation, if the noise is as assumed "
          "and the model true)\n";
  if (!u.failure.empty()) {
    *out << "  " << u.failure << "\n";
    return;
  }
  Lines lines(out);
  std::string shape;
  for (const double d : u.shape_deviation)
    shape += (shape.empty() ? "" : " ") + ShortNumber(d);
  lines.Add("shape", shape);
  double pose = 0, translation = 0;
  for (const PoseVector& d : u.pose_deviation) pose += d.mean();
  for (const Vector3d& d : u.translation_deviation) translation += d.mean();
  const double n = static_cast<double>(u.pose_deviation.size());
  lines.Add("pose, mean", kDegrees * pose / n, " degrees")
      .Add("translation, mean", 1000 * translation / n, " mm");
  for (int k = 0; k < u.undetermined_directions; ++k) {
    std::string direction;
    for (const double c : u.shape_directions.col(k))
      direction += (direction.empty() ? "" : " ") + ShortNumber(c);
    lines.Add("not determined",
              "shape along (" + direction + "): deviation " +
                  ShortNumber(u.direction_deviation[k]));
  }
  const std::vector<std::string> joints = UndeterminedJointNames(u);
  if (!joints.empty())
    lines.Add("not determined", "rotation of " + Join(joints));
}

const char* Usable(const FitReport& report) {
  return report.result.usable() ? "usable" : "not usable";
}

}  // namespace

std::string Verdict(const FitReport& report) {
  const FitResult& r = report.result;
  std::ostringstream out;
  std::string name = Name(r.termination);
  name[0] = static_cast<char>(std::toupper(name[0]));
  out << name << ", " << Usable(report);
  if (r.optimizer && r.optimizer->initial_cost > 0)
    out << ": cost " << ShortNumber(r.optimizer->initial_cost) << " to "
        << ShortNumber(r.optimizer->final_cost) << " in "
        << (r.optimizer->iterations.empty()
                ? 0
                : r.optimizer->iterations.size() - 1)
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
  if (report.result.optimizer)
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
      {"relaxation", r.seconds.relaxation},
      {"simulation", r.stats.simulation_seconds},
      {"sensitivity and blocks", r.stats.sensitivity_seconds},
      {"nearest neighbours", r.stats.neighbour_seconds},
      {"cost", r.stats.block_seconds},
      {"uncertainty", r.seconds.uncertainty}};
  double known = 0;
  for (const auto& part : parts) known += part.second;
  parts.push_back(
      {"linear solver and the rest", std::max(0.0, report.seconds - known)});
  std::stable_sort(
      parts.begin(), parts.end(), [](const auto& a, const auto& b) {
        return a.second > b.second;
      });
  return parts;
}

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
  if (r.optimizer) json["optimization"] = OptimizerJson(*r.optimizer);
  json["cost_by_distance"] = {{"cloth_to_points", r.costs.cloth_to_points},
                              {"skin_to_points", r.costs.skin_to_points},
                              {"points_to_surface", r.costs.points_to_surface}};
  json["garment_carried_to_shape"] = r.carried;
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

std::string FitText(const FitReport& report) {
  const FitResult& r = report.result;
  std::ostringstream out;
  out << Verdict(report) << "\n\n";
  InputText(report, &out);
  out << "\nEffects\n" << DecisionsText(report.effects);
  StartText(r, &out);
  if (r.optimizer) OptimizerText(report, &out);
  SimulationText(report, &out);
  if (r.uncertainty) UncertaintyText(*r.uncertainty, &out);
  out << "\nApproximations in force\n";
  for (const std::string& line : Approximations(report))
    out << "  - " << line << "\n";
  out << "\nTime: " << ClockText(report.seconds) << "\n";
  Lines lines(&out);
  for (const auto& [name, seconds] : TimeByPart(report))
    lines.Add(name, seconds, " s");
  if (r.optimizer && !r.optimizer->details.empty())
    out << "\nCeres's own report\n" << r.optimizer->details << "\n";
  return out.str();
}

std::string IterationsCsv(const FitReport& report) {
  std::ostringstream out;
  out.precision(10);
  out << "iteration,successful,cost,data,smoothness,shape,pose,overlap,"
         "gradient_max_norm,step_norm,evaluations,abandoned,failed,"
         "linearizations,seconds\n";
  if (!report.result.optimizer) return out.str();
  for (const IterationRecord& i : report.result.optimizer->iterations)
    out << i.iteration << ',' << i.successful << ',' << i.cost << ','
        << i.terms.data << ',' << i.terms.smoothness << ',' << i.terms.shape
        << ',' << i.terms.pose << ',' << i.terms.overlap << ','
        << i.gradient_norm << ',' << i.step_norm << ',' << i.counts.evaluations
        << ',' << i.counts.abandoned << ',' << i.counts.failed << ','
        << i.counts.linearizations << ',' << i.seconds << '\n';
  return out.str();
}

std::vector<Chart> FitCharts(const FitReport& report) {
  std::vector<Chart> charts;
  if (report.result.optimizer &&
      report.result.optimizer->iterations.size() > 1) {
    Chart cost;
    cost.title = "cost";
    cost.x_title = "time of the optimisation [s]";
    cost.log_y = true;
    cost.series = {{"all", {}}, {"data", {}}};
    for (const IterationRecord& i : report.result.optimizer->iterations) {
      cost.x.push_back(i.seconds);
      cost.series[0].values.push_back(i.cost);
      cost.series[1].values.push_back(i.terms.data);
    }
    charts.push_back(cost);
  }
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
