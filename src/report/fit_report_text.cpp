// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>
#include <sstream>

#include "fit_report_parts.h"
#include "invsim/base/names.h"
#include "invsim/base/progress.h"

namespace invsim {
namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

// Two columns.
class Lines {
 public:
  explicit Lines(std::ostream* out) : out_(out) {}
  Lines& Add(const std::string& name, const std::string& value) {
    std::string padded = name;
    padded.resize(std::max<size_t>(padded.size() + 1, 28), ' ');
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
      .Add("points filtered", std::to_string(r.points_filtered))
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

std::string TryText(const DressingTry& tried) {
  if (!tried.refused.empty()) return tried.refused;
  const RelaxationResult& r = *tried.relaxation;
  const std::string frames = std::to_string(r.frames) + " frames";
  if (r.status == RunStatus::kFailed)
    return "failed after " + frames +
           "; failed steps: " + FailedSteps(r.stats.step);
  return frames + ", " + (r.at_rest ? "at rest" : "not at rest") +
         " (mean speed " + ShortNumber(100 * r.rest_speed) +
         " cm/s), first frames cost " + ShortNumber(tried.cost);
}

std::string RoundText(const OptimizerSummary& s) {
  return "cost " + ShortNumber(s.initial_cost) + " to " +
         ShortNumber(s.final_cost) + " in " +
         std::to_string(s.num_iterations()) + " iterations, " +
         Name(s.termination);
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
}

void DressingsText(const FitResult& r, std::ostream* out) {
  int number = 0;
  for (const FitRound& round : r.rounds) {
    ++number;
    *out << "\nDressing " << number << ", on the body "
         << (number == 1 ? "of the initialisation" : "found so far") << "\n";
    Lines lines(out);
    const Dressing& d = round.dressing;
    for (const DressingTry& tried : d.tries)
      lines.Add(std::string("garment ") + Name(tried.way), TryText(tried));
    if (d.tries.empty())
      lines.Add("garment", "as given, or found in the checkpoint");
    if (d.worn >= 0 && d.tries.size() > 1)
      lines.Add("worn", Name(d.tries[d.worn].way));
    if (round.optimizer)
      lines.Add("fit from there", RoundText(*round.optimizer));
  }
  if (r.rounds.size() > 1) *out << "\nKept: dressing " << r.kept + 1 << "\n";
}

void OptimizerText(const FitReport& report, std::ostream* out) {
  const FitResult& r = report.result;
  const OptimizerSummary& s = *r.optimizer();
  const ObjectiveCounts counts = r.counts();
  *out << "\nOptimisation by " << report.optimizer << "\n";
  Lines lines(out);
  lines.Add("ended", std::string(Name(s.termination)) + ": " + s.reason)
      .Add("cost",
           ShortNumber(r.initial_cost()) + " to " + ShortNumber(s.final_cost))
      .Add("iterations", std::to_string(r.iterations()))
      .Add("evaluations", std::to_string(counts.evaluations))
      .Add("  given up as worse", std::to_string(counts.abandoned))
      .Add("  failed",
           std::to_string(counts.failed) +
               (counts.failed > 0
                    ? " (no derivative at " +
                          std::to_string(counts.no_derivative) + " of them)"
                    : ""))
      .Add("linearisations", std::to_string(counts.linearizations));
  if (r.recalled > 0)
    lines.Add("answers from checkpoint", std::to_string(r.recalled));
  if (s.iterations.empty()) return;
  const CostTerms& terms = s.iterations.back().terms;
  const ClothPointsCosts& costs = r.costs;
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

std::string Numbers(const VectorXd& values) {
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : " ") + ShortNumber(value);
  return text;
}

// The axis of its parent that a joint turns about: a letter if it is nearly
// one of the three, nothing if it is none.
std::string AxisText(const Vector3d& axis) {
  constexpr double kNearly = 0.95;
  if (axis.isZero()) return "";
  for (int c = 0; c < 3; ++c)
    if (std::abs(axis[c]) > kNearly) return std::string(" about ") + "xyz"[c];
  return " about (" + Numbers(axis) + ")";
}

void UncertaintyText(const Uncertainty& u, std::ostream* out) {
  *out << "\nUncertainty (one standard deviation, if the noise is as assumed "
          "and the model true)\n";
  if (!u.failure.empty()) {
    *out << "  " << u.failure << "\n";
    return;
  }
  Lines lines(out);
  lines.Add("shape", Numbers(u.shape_deviation));
  double pose = 0, translation = 0;
  for (const PoseVector& d : u.pose_deviation) pose += d.mean();
  for (const Vector3d& d : u.translation_deviation) translation += d.mean();
  const double n = static_cast<double>(u.pose_deviation.size());
  lines.Add("pose, mean", kDegreesPerRadian * pose / n, " degrees")
      .Add("translation, mean", 1000 * translation / n, " mm");
  for (int k = 0; k < u.undetermined_directions; ++k)
    lines.Add("not determined",
              "shape along (" + Numbers(u.shape_directions.col(k)) +
                  "): deviation " + ShortNumber(u.direction_deviation[k]));
  std::vector<std::string> joints;
  for (const int j : UndeterminedJoints(u))
    joints.push_back(kJointNames[j] + AxisText(u.undetermined_axes[j]));
  if (!joints.empty())
    lines.Add("not determined", "rotation of " + Join(joints));
}

}  // namespace

std::string FitText(const FitReport& report) {
  const FitResult& r = report.result;
  std::ostringstream out;
  out << Verdict(report) << "\n\n";
  InputText(report, &out);
  out << "\nEffects\n" << DecisionsText(report.effects);
  StartText(r, &out);
  DressingsText(r, &out);
  if (r.optimizer()) OptimizerText(report, &out);
  SimulationText(report, &out);
  if (r.uncertainty) UncertaintyText(*r.uncertainty, &out);
  out << "\nApproximations in force\n";
  for (const std::string& line : Approximations(report))
    out << "  - " << line << "\n";
  out << "\nTime: " << ClockText(report.seconds) << "\n";
  Lines lines(&out);
  for (const auto& [name, seconds] : TimeByPart(report))
    lines.Add(name, seconds, " s");
  if (r.optimizer() && !r.optimizer()->details.empty())
    out << "\nCeres's own report\n" << r.optimizer()->details << "\n";
  return out.str();
}

}  // namespace invsim
