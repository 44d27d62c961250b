// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/hard_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "closed_faces.h"
#include "hard_cases.h"
#include "invsim/base/error.h"
#include "invsim/base/stopwatch.h"
#include "invsim/geometry/self_intersection.h"
#include "invsim/sim/penetration.h"
#include "invsim/sim/sensitivity.h"
#include "invsim/study/gradient_check.h"

namespace invsim {
namespace {

// Where positions are known to no better than 1e-13 m.
constexpr double kFar = 1e3;
// For differences to mean anything; see CheckFrameGradient. Where contacts stay
// as they are only over 1e-9 m, what the first leaves open is part of the
// difference; a column that is off is compared again with the second.
constexpr double kTightTolerances[] = {1e-10, 1e-12};

Simulator MakeSimulator(const HardScene& scene, double tolerance) {
  SimulatorSetup setup =
      MakeSetup(scene.options, scene.body, scene.garment, scene.material);
  setup.pins = scene.pins;
  if (tolerance > 0) setup.step.friction.tolerance = tolerance;
  return Simulator(std::move(setup));
}

Points BodyAt(const HardScene& scene, int frame) {
  return scene.body_at ? scene.body_at(frame) : scene.body.vertices;
}

// The work of the contact forces on the cloth in a frame, J: what they gave
// it, and all that went either way.
struct Work {
  double net = 0;
  double turnover = 0;
};

Work ContactWork(const FrameRecord& record) {
  Work work;
  for (const SubstepRecord& sub : record.substeps) {
    const LinearizationRecord& lin = sub.linearizations.back();
    for (size_t k = 0; k < sub.contacts.size(); ++k) {
      const double w =
          sub.dt * lin.forces[k].dot(sub.contacts[k].Gather(lin.v));
      work.net += w;
      work.turnover += std::abs(w);
    }
  }
  return work;
}

// Keeps the account of energy from frame to frame: what the cloth has less what
// contacts gave it only falls. A breach is a rise above the least it has been,
// so that no loss makes room for a later gain.
class EnergyAccount {
 public:
  EnergyAccount(const Simulator& simulator, const ClothState& state)
      : simulator_(simulator),
        first_(Total(state)),
        least_(first_),
        // A cloth lifted by a millimetre is no drift.
        turnover_(kStandardGravity * simulator.mass().sum() * 1e-3) {}

  void Add(const FrameRecord& record, const ClothState& state) {
    const Work work = ContactWork(record);
    net_ += work.net;
    turnover_ += work.turnover;
    const double kinetic = simulator_.KineticEnergy(state);
    const double total = Total(state);
    least_ = std::min(least_, total - net_);
    const double scale =
        turnover_ + std::max(kinetic, std::abs(first_ - total));
    worst_ = std::max(worst_, (total - net_ - least_) / scale);
  }
  double worst() const { return worst_; }

 private:
  double Total(const ClothState& state) const {
    return simulator_.PotentialEnergy(state) + simulator_.KineticEnergy(state);
  }

  const Simulator& simulator_;
  double first_, least_, turnover_;
  double net_ = 0, worst_ = 0;
};

// Three shifts, three turns and a swelling about the middle.
std::vector<Points> RigidDirections(const Points& body) {
  const Vector3d middle = body.rowwise().mean();
  std::vector<Points> directions;
  for (int k = 0; k < 3; ++k)
    directions.push_back(Vector3d::Unit(k).replicate(1, body.cols()));
  for (int k = 0; k < 3; ++k) {
    Points turn(3, body.cols());
    for (Eigen::Index i = 0; i < body.cols(); ++i)
      turn.col(i) = Vector3d::Unit(k).cross(body.col(i) - middle);
    directions.push_back(std::move(turn));
  }
  directions.push_back(body.colwise() - middle);
  return directions;
}

// Where the derivative of a frame begins.
struct FrameStart {
  Points previous, body;
  ClothState cloth;
};

// The body at the end of the frame, moved by the scene's directions.
MovableBody MakeMovable(const HardScene& scene, const Points& at) {
  const std::vector<Points> directions =
      scene.directions.empty() ? RigidDirections(at) : scene.directions;
  MovableBody body;
  body.at = at;
  body.parameters = static_cast<int>(directions.size());
  body.moved = [=](int k, double step) {
    return Points(at + step * directions[k]);
  };
  body.jacobian = [=](const std::vector<int>& vertices) {
    Columns columns(3 * vertices.size(), directions.size());
    for (size_t k = 0; k < directions.size(); ++k)
      for (size_t i = 0; i < vertices.size(); ++i)
        columns.col(k).segment<3>(3 * i) = directions[k].col(vertices[i]);
    return columns;
  };
  return body;
}

GradientCheckOptions DifferencesOf(const HardScene& scene,
                                   const Points& at,
                                   double tolerance) {
  GradientCheckOptions options;
  options.steps = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
  // Rounding of positions far away drowns small steps.
  if (at.cwiseAbs().maxCoeff() > kFar)
    options.steps = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  if (!scene.difference_steps.empty()) options.steps = scene.difference_steps;
  options.floor = 1e-3;
  // A residual of the tolerance, in weights, moves a free vertex by tolerance
  // g T^2 in a frame of T; light neighbours of heavy ones by more.
  const double frame = 1 / scene.frames_per_second;
  options.noise = 10 * tolerance * kStandardGravity * frame * frame;
  return options;
}

// Nothing where the frame is not solved to `tolerance`, or cloth was swept
// against cloth in it: its derivative is an approximate one then
// (sim/sensitivity.h).
std::optional<GradientCheck> CheckDerivative(const HardScene& scene,
                                             const FrameStart& start,
                                             double tolerance) {
  const double duration = 1 / scene.frames_per_second;
  Simulator simulator = MakeSimulator(scene, tolerance);
  simulator.FindInside(start.previous, start.cloth);
  StepStats stats;
  ClothState end = start.cloth;
  FrameRecord record;
  if (!simulator.Advance(
          start.previous, start.body, duration, &end, &stats, &record) ||
      stats.missed > 0 || FixedContacts(record) > 0)
    return std::nullopt;
  return CheckFrameGradient(DifferencesOf(scene, start.body, tolerance),
                            MakeMovable(scene, start.body),
                            start.previous,
                            duration,
                            start.cloth,
                            &simulator);
}

void CompareDerivative(const HardScene& scene,
                       const FrameStart& start,
                       HardOutcome* outcome) {
  try {
    for (const double tolerance : kTightTolerances) {
      const std::optional<GradientCheck> check =
          CheckDerivative(scene, start, tolerance);
      // What compares less takes nothing back.
      if (!check || check->compared() < outcome->columns) return;
      outcome->switched = check->switched;
      outcome->columns = check->compared();
      if (outcome->columns == 0) return;
      outcome->derivative = check->worst;
      if (check->worst <= scene.limits.derivative) return;
    }
  } catch (const InputError& error) {
    outcome->broken.push_back({"derivative", error.what()});
  }
}

std::string Text(auto... parts) {
  std::ostringstream text;
  text.precision(3);
  (text << ... << parts);
  return text.str();
}

bool HasEffect(const HardScene& scene, const char* name) {
  const std::vector<std::string>& effects = scene.options.effects;
  return std::find(effects.begin(), effects.end(), name) != effects.end();
}

bool Bends(const HardScene& scene) {
  const auto* bending = std::get_if<IsotropicBending>(&scene.material.bending);
  return HasEffect(scene, "bending") && !(bending && bending->stiffness == 0);
}

// The limits that the outcome of the scene breaks.
std::vector<Breach> Judge(const HardScene& scene,
                          const HardLimits& limits,
                          const HardOutcome& o) {
  std::vector<Breach> broken;
  const auto fail = [&](const char* limit, auto... parts) {
    broken.push_back({limit, Text(parts...)});
  };
  if (o.step.failed > 0 || o.frames < scene.frames)
    fail("finite", "not finite in frame ", o.frames + 1, " of ", scene.frames);
  if (o.step.missed > limits.missed)
    fail("converged",
         o.step.missed,
         " of ",
         o.step.substeps,
         " steps above the contact tolerance");
  const double tolerance = scene.options.step.friction.tolerance;
  if (o.step.missed == 0 && o.step.worst_residual > tolerance)
    fail("counted", "residual ", o.step.worst_residual, " not counted");
  if (!(o.penetration <= limits.penetration))
    fail("penetration", "penetration ", 1e3 * o.penetration, " mm");
  if (!(o.energy <= limits.energy))
    fail("energy", "energy gained from nowhere: ", o.energy);
  if (!(o.creep <= limits.creep)) fail("creep", "creep of ", o.creep, " m");
  if (o.step.most_contacts < limits.contacts)
    fail("contacts", "only ", o.step.most_contacts, " contacts");
  const std::string amiss = scene.check ? scene.check(o.step) : "";
  if (!amiss.empty()) fail("check", amiss);
  if (o.misplaced > 0) fail("misplaced", o.misplaced, " vertices misplaced");
  if (o.crossings > 0 && HasEffect(scene, "self_contact"))
    fail("crossing", o.crossings, " pairs of faces cross");
  if (o.differentiated && o.columns < limits.columns)
    fail("derivative", o.columns, " columns of the derivative compared");
  if (o.columns > 0 && !(o.derivative <= limits.derivative))
    fail("derivative", "derivative off by ", o.derivative);
  return broken;
}

// Follows one scene through its frames.
class Run {
 public:
  Run(const HardScene& scene, HardOutcome* outcome)
      : scene_(scene),
        outcome_(*outcome),
        simulator_(MakeSimulator(scene, 0)),
        body_(BodyAt(scene, 0)),
        state_(Start(scene)),
        energy_(simulator_, state_) {
    if (scene.body.faces.cols() > 0) surface_.emplace(body_, scene.body.faces);
    if (Bends(scene)) {
      closed_.emplace(scene.garment);
      closed_->Add(state_.x);
    }
    apart_ = NumCrossings() == 0;
  }

  void Frames() {
    for (int frame = 1; frame <= scene_.frames; ++frame)
      if (!Frame(frame)) return;
  }

  // Of the last frame and of some before, the last one first.
  const std::vector<FrameStart>& starts() const { return starts_; }

 private:
  static ClothState Start(const HardScene& scene) {
    if (scene.start.x.cols() > 0) return scene.start;
    return {scene.garment.placed,
            Points::Zero(3, scene.garment.num_vertices())};
  }

  int NumCrossings() const {
    return static_cast<int>(
        SelfIntersections(state_.x, scene_.garment.faces).size());
  }

  bool Frame(int frame) {
    Points next = BodyAt(scene_, frame);
    // Of a cloth that has left the body by the end, others can be compared.
    const int quarter = std::max(1, scene_.frames / 4);
    if ((scene_.frames - frame) % quarter == 0)
      starts_.insert(starts_.begin(), {body_, next, state_});
    simulator_.FindInside(body_, state_);
    FrameRecord record;
    if (!simulator_.Advance(body_,
                            next,
                            1 / scene_.frames_per_second,
                            &state_,
                            &outcome_.step,
                            &record))
      return false;
    body_ = std::move(next);
    ++outcome_.frames;
    energy_.Add(record, state_);
    if (closed_) CountClosed(record);
    Measure(frame);
    return true;
  }

  void CountClosed(const FrameRecord& record) {
    for (size_t k = 1; k < record.substeps.size(); ++k)
      closed_->Add(record.substeps[k].start.x);
    closed_->Add(state_.x);
    outcome_.closed = closed_->count();
  }

  void Measure(int frame) {
    outcome_.energy = energy_.worst();
    outcome_.speed = std::max(
        outcome_.speed, std::sqrt(state_.v.colwise().squaredNorm().maxCoeff()));
    if (frame == scene_.grace || (frame == 1 && scene_.grace == 0))
      resting_ = state_.x;
    if (apart_)
      outcome_.crossings = std::max(outcome_.crossings, NumCrossings());
    if (frame < scene_.grace) return;
    outcome_.creep = std::max(
        outcome_.creep, (state_.x - resting_).colwise().norm().maxCoeff());
    if (surface_) {
      surface_->Update(body_);
      const Penetration p = MeasurePenetration(*surface_, state_.x);
      outcome_.penetration = std::max(outcome_.penetration, p.deepest);
      outcome_.overlap = std::max(outcome_.overlap, p.deepest_overlap);
    }
    if (scene_.misplaced)
      outcome_.misplaced =
          std::max(outcome_.misplaced, scene_.misplaced(state_.x, body_));
  }

  const HardScene& scene_;
  HardOutcome& outcome_;
  Simulator simulator_;
  std::optional<SurfaceIndex> surface_;
  std::optional<ClosedFaces> closed_;  // of cloth that bends
  Points body_;
  ClothState state_;
  std::vector<FrameStart> starts_;
  bool apart_ = false;  // no faces crossed at the start
  EnergyAccount energy_;
  Points resting_;
};

}  // namespace

HardOutcome RunHardScene(const HardScene& scene, bool derivative) {
  const Stopwatch watch;
  HardOutcome outcome;
  Run run(scene, &outcome);
  run.Frames();
  outcome.differentiated = derivative && outcome.frames == scene.frames &&
                           outcome.step.missed == 0 &&
                           scene.body.faces.cols() > 0;
  if (outcome.differentiated)
    for (const FrameStart& start : run.starts()) {
      CompareDerivative(scene, start, &outcome);
      if (outcome.columns >= scene.limits.columns || !outcome.broken.empty())
        break;
    }
  for (Breach& breach : Judge(scene, scene.limits, outcome))
    outcome.broken.push_back(std::move(breach));
  outcome.seconds = watch.seconds();
  return outcome;
}

HardOutcome RunHardCase(const HardCase& hard, bool derivative) {
  std::optional<HardScene> scene;
  try {
    scene.emplace(hard.make());
  } catch (const InputError& error) {
    HardOutcome outcome;
    outcome.refused = true;
    outcome.refusal = error.what();
    if (!hard.refused) outcome.broken.push_back({"refused", error.what()});
    return outcome;
  }
  HardOutcome outcome = RunHardScene(*scene, derivative);
  if (!hard.border.empty())
    outcome.beyond = Judge(*scene, hard.ceiling, outcome);
  if (hard.refused)
    outcome.broken.push_back({"refused", "taken, though bad input"});
  return outcome;
}

const std::vector<HardCase>& HardCases() {
  static const std::vector<HardCase> cases = [] {
    std::vector<HardCase> all;
    AddGeometryCases(&all);
    AddMaterialCases(&all);
    AddTimeCases(&all);
    AddContactCases(&all);
    AddParameterCases(&all);
    return all;
  }();
  return cases;
}

}  // namespace invsim
