// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/simulator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "invsim/base/options.h"
#include "invsim/base/stopwatch.h"

namespace invsim {
namespace {

// The unit of force residuals where there is no gravity to weigh with.
constexpr double kStandardGravity = 9.81;

Points Blend(const Points& a, const Points& b, double s) {
  return (1 - s) * a + s * b;
}

}  // namespace

void Describe(OptionTable* table, FrictionOptions* o) {
  table->Add("tolerance",
             &o->tolerance,
             {.doc = "residual of the contact law and of momentum at which a "
                     "step is solved",
              .unit = "vertex weights",
              .above = 0});
  table->Add(
      "admm_iterations",
      &o->admm_iterations,
      {.doc = "splitting iterations, at most, before Newton", .at_least = 0});
  table->Add("newton_iterations",
             &o->newton_iterations,
             {.doc = "semismooth Newton iterations before splitting is asked "
                     "again",
              .at_least = 1});
  table->Add("retries",
             &o->retries,
             {.doc = "how often splitting is asked again, each time twice as "
                     "long",
              .at_least = 0,
              .at_most = 10});
  table->Add("krylov_tolerance",
             &o->krylov_tolerance,
             {.doc = "relative linear residual at which GMRES is done",
              .above = 0,
              .below = 1});
  table->Add("krylov_iterations",
             &o->krylov_iterations,
             {.doc = "GMRES iterations after which the Jacobian is factorised "
                     "anew",
              .at_least = 0});
}

void Describe(OptionTable* table, StepOptions* o) {
  table->Add("substeps",
             &o->substeps,
             {.doc = "linearly implicit steps per frame: more are more "
                     "accurate and less damped",
              .at_least = 1});
  table->Add("newton_iterations",
             &o->newton_iterations,
             {.doc = "linearisations per sub-step; 1 is linearly implicit",
              .at_least = 1});
  table->Add("newton_tolerance",
             &o->newton_tolerance,
             {.doc = "change of velocity at which re-linearising ends",
              .unit = "m/s",
              .above = 0});
  table->Add("max_halvings",
             &o->max_halvings,
             {.doc = "how often a sub-step that misses the contact tolerance "
                     "is halved",
              .at_least = 0,
              .at_most = 10});
  table->AddSection("friction", &o->friction);
}

void StepStats::Add(const StepStats& o) {
  substeps += o.substeps;
  linearizations += o.linearizations;
  missed += o.missed;
  halved += o.halved;
  failed += o.failed;
  worst_residual = std::max(worst_residual, o.worst_residual);
  most_contacts = std::max(most_contacts, o.most_contacts);
  factorizations += o.factorizations;
  solves += o.solves;
  admm_iterations += o.admm_iterations;
  newton_iterations += o.newton_iterations;
  open += o.open;
  stick += o.stick;
  slide += o.slide;
  assembly_seconds += o.assembly_seconds;
  detection_seconds += o.detection_seconds;
  factor_seconds += o.factor_seconds;
  solve_seconds += o.solve_seconds;
}

struct Simulator::Impl {
  explicit Impl(SimulatorSetup s);

  struct Outcome {
    bool finite = true;
    bool converged = true;
  };

  void DetectContacts(const Points& b0, const Points& b1, SubstepRecord* sub);
  void Linearize(const SubstepRecord& sub, LinearizationRecord* lin);
  Outcome Solve(SubstepRecord* sub, LinearizationRecord* lin, StepStats* stats);
  Outcome Substep(const Points& body0,
                  const Points& body1,
                  SubstepRecord* sub,
                  StepStats* stats);
  bool Interval(const Points& body0,
                const Points& body1,
                double duration,
                double s0,
                double s1,
                int halvings,
                ClothState* state,
                StepStats* stats,
                FrameRecord* record);

  SimulatorSetup setup;
  bool inertia = false;
  bool velocity_dependent = false;
  std::shared_ptr<const BlockPattern> pattern;
  std::unique_ptr<FrictionSolver> solver;
  std::unique_ptr<BodyContactDetector> detector;
  VectorXd weight;
  Points contact_force;
  Points last_x;       // where the last frame ended
  SubstepRecord last;  // the last sub-step advanced, without matrices
  int num_body_vertices = 0;
};

Simulator::Impl::Impl(SimulatorSetup s) : setup(std::move(s)) {
  const int n = static_cast<int>(setup.mass.size());
  BlockPatternBuilder builder(n);
  for (const auto& effect : setup.effects) {
    effect->AddStencils(&builder);
    inertia = inertia || effect->name() == "inertia";
    velocity_dependent = velocity_dependent || effect->depends_on_velocity();
  }
  pattern = builder.Build();
  for (const auto& effect : setup.effects) effect->Bind(*pattern);
  solver = std::make_unique<FrictionSolver>(pattern);
  if (setup.body_faces.cols() > 0)
    detector =
        std::make_unique<BodyContactDetector>(setup.body, setup.body_faces);
  weight = kStandardGravity * setup.mass;
  contact_force.setZero(3, n);
}

void Simulator::Impl::DetectContacts(const Points& b0,
                                     const Points& b1,
                                     SubstepRecord* sub) {
  if (detector)
    detector->Detect(setup.contact,
                     sub->dt,
                     b0,
                     b1,
                     sub->start.x,
                     sub->start.v,
                     setup.mass,
                     &sub->contacts,
                     &sub->sources);
  for (const Pin& pin : setup.pins) {
    Contact contact;
    contact.kind = ContactKind::kPin;
    contact.vertex[0] = pin.vertex;
    contact.velocity = (pin.position - sub->start.x.col(pin.vertex)) / sub->dt;
    // A pinned vertex cannot also be in contact.
    size_t kept = 0;
    for (size_t k = 0; k < sub->sources.size(); ++k) {
      if (sub->sources[k].vertex == pin.vertex) continue;
      sub->contacts[kept] = sub->contacts[k];
      sub->sources[kept] = sub->sources[k];
      sub->sources[kept].contact = static_cast<int>(kept);
      ++kept;
    }
    sub->contacts.erase(sub->contacts.begin() + kept,
                        sub->contacts.begin() + sub->sources.size());
    sub->sources.resize(kept);
    sub->contacts.push_back(contact);
  }
}

void Simulator::Impl::Linearize(const SubstepRecord& sub,
                                LinearizationRecord* lin) {
  const double dt = sub.dt;
  const bool first = sub.linearizations.empty();
  lin->a = BlockMatrix(pattern);
  Points force = Points::Zero(3, pattern->size);
  for (const auto& effect : setup.effects) {
    effect->AddStiffness(lin->y, dt, 1, &lin->a);
    effect->AddForce(lin->y, &force);
  }
  lin->b = Stacked(force);
  if (velocity_dependent) {
    lin->damping = BlockMatrix(pattern);
    for (const auto& effect : setup.effects)
      if (effect->depends_on_velocity())
        effect->AddStiffness(lin->y, 0, 1, &lin->damping);
  }
  // K (y.x - x0) + D y.v: only D v0 at the start of the sub-step; later
  // y.x - x0 = dt y.v.
  const VectorXd y_v = Stacked(lin->y.v);
  if (!first) {
    lin->b += lin->a * y_v;
  } else if (velocity_dependent) {
    lin->b += lin->damping * y_v;
  }
  if (!inertia) return;
  for (int i = 0; i < pattern->size; ++i) {
    const double inertia_i = setup.mass[i] / dt;
    lin->a.diagonal(i).diagonal().array() += inertia_i;
    lin->b.segment<3>(3 * i) += inertia_i * sub.start.v.col(i);
  }
}

Simulator::Impl::Outcome Simulator::Impl::Solve(SubstepRecord* sub,
                                                LinearizationRecord* lin,
                                                StepStats* stats) {
  const FrictionProblem problem{&lin->a, &lin->b, &sub->contacts, &weight};
  lin->v = Stacked(lin->y.v);
  lin->forces.resize(sub->contacts.size());
  // Last known forces start the splitting.
  if (!sub->linearizations.empty()) {
    lin->forces = sub->linearizations.back().forces;
  } else {
    for (size_t k = 0; k < sub->contacts.size(); ++k)
      lin->forces[k] =
          sub->contacts[k].exact()
              ? Vector3d(contact_force.col(sub->contacts[k].vertex[0]))
              : Vector3d(Vector3d::Zero());
  }
  const FrictionStats f =
      solver->Solve(problem, setup.step.friction, &lin->v, &lin->forces);
  ++stats->linearizations;
  stats->worst_residual = std::max(stats->worst_residual, f.residual);
  stats->factorizations += f.factorizations;
  stats->solves += f.solves;
  stats->admm_iterations += f.admm_iterations;
  stats->newton_iterations += f.newton_iterations;
  stats->open += f.open;
  stats->stick += f.stick;
  stats->slide += f.slide;
  stats->factor_seconds += f.factor_seconds;
  stats->solve_seconds += f.solve_seconds;
  return {!f.factorization_failed && lin->v.allFinite(), f.converged};
}

Simulator::Impl::Outcome Simulator::Impl::Substep(const Points& body0,
                                                  const Points& body1,
                                                  SubstepRecord* sub,
                                                  StepStats* stats) {
  const Stopwatch detection;
  if (detector) {
    DetectContacts(
        Blend(body0, body1, sub->s0), Blend(body0, body1, sub->s1), sub);
  } else {
    DetectContacts(body0, body1, sub);
  }
  stats->detection_seconds += detection.seconds();
  stats->most_contacts =
      std::max(stats->most_contacts, static_cast<int>(sub->contacts.size()));
  Outcome outcome;
  ClothState y = sub->start;
  for (int k = 0; k < setup.step.newton_iterations; ++k) {
    LinearizationRecord lin;
    lin.y = y;
    const Stopwatch assembly;
    Linearize(*sub, &lin);
    stats->assembly_seconds += assembly.seconds();
    const Outcome o = Solve(sub, &lin, stats);
    if (!o.finite) return {false, false};
    outcome.converged = o.converged;
    const double change = (lin.v - Stacked(y.v)).lpNorm<Eigen::Infinity>();
    Stacked(y.v) = lin.v;
    y.x = sub->start.x + sub->dt * y.v;
    sub->linearizations.push_back(std::move(lin));
    if (k > 0 && change < setup.step.newton_tolerance) break;
  }
  return outcome;
}

bool Simulator::Impl::Interval(const Points& body0,
                               const Points& body1,
                               double duration,
                               double s0,
                               double s1,
                               int halvings,
                               ClothState* state,
                               StepStats* stats,
                               FrameRecord* record) {
  SubstepRecord sub;
  sub.dt = duration * (s1 - s0);
  sub.s0 = s0;
  sub.s1 = s1;
  sub.start = *state;
  StepStats own;
  const Outcome outcome = Substep(body0, body1, &sub, &own);
  const bool good = outcome.finite && outcome.converged;
  if (!good && halvings > 0) {
    own.worst_residual = 0;  // of an attempt that is not kept
    stats->Add(own);
    ++stats->halved;
    const double middle = 0.5 * (s0 + s1);
    return Interval(body0,
                    body1,
                    duration,
                    s0,
                    middle,
                    halvings - 1,
                    state,
                    stats,
                    record) &&
           Interval(body0,
                    body1,
                    duration,
                    middle,
                    s1,
                    halvings - 1,
                    state,
                    stats,
                    record);
  }
  stats->Add(own);
  ++stats->substeps;
  if (!outcome.finite) {
    ++stats->failed;
    return false;
  }
  if (!outcome.converged) ++stats->missed;
  const LinearizationRecord& lin = sub.linearizations.back();
  Stacked(state->v) = lin.v;
  state->x = sub.start.x + sub.dt * state->v;
  contact_force.setZero();
  Eigen::Map<VectorXd> force = Stacked(contact_force);
  for (size_t k = 0; k < sub.contacts.size(); ++k) {
    const Contact& c = sub.contacts[k];
    for (int j = 0; j < c.num_vertices; ++j)
      force.segment<3>(3 * c.vertex[j]) += c.weight[j] * lin.forces[k];
  }
  last.contacts = sub.contacts;
  last.sources = sub.sources;
  last.linearizations.resize(1);
  last.linearizations[0].forces = lin.forces;
  if (record) record->substeps.push_back(std::move(sub));
  return true;
}

Simulator::Simulator(SimulatorSetup setup)
    : impl_(std::make_unique<Impl>(std::move(setup))) {}
Simulator::~Simulator() = default;

int Simulator::num_vertices() const { return impl_->pattern->size; }
const VectorXd& Simulator::mass() const { return impl_->setup.mass; }
const std::vector<std::unique_ptr<Effect>>& Simulator::effects() const {
  return impl_->setup.effects;
}
const StepOptions& Simulator::step_options() const { return impl_->setup.step; }
const BodyContactOptions& Simulator::contact_options() const {
  return impl_->setup.contact;
}
std::shared_ptr<const BlockPattern> Simulator::pattern() const {
  return impl_->pattern;
}
const Faces& Simulator::body_faces() const { return impl_->setup.body_faces; }
bool Simulator::has_inertia() const { return impl_->inertia; }
bool Simulator::depends_on_velocity() const {
  return impl_->velocity_dependent;
}

bool Simulator::Advance(const Points& body0,
                        const Points& body1,
                        double duration,
                        ClothState* state,
                        StepStats* stats,
                        FrameRecord* record) {
  Impl& s = *impl_;
  if (record) {
    record->body0 = body0;
    record->body1 = body1;
    record->substeps.clear();
  }
  s.num_body_vertices = static_cast<int>(body1.cols());
  // Forces of the last step start the next one, unless the cloth was moved
  // from outside: results depend on what is given and nothing else.
  if (s.last_x.cols() != state->x.cols() || s.last_x != state->x)
    s.contact_force.setZero();
  ClothState moved = *state;
  const int substeps = s.setup.step.substeps;
  for (int k = 0; k < substeps; ++k) {
    if (!s.Interval(body0,
                    body1,
                    duration,
                    static_cast<double>(k) / substeps,
                    static_cast<double>(k + 1) / substeps,
                    s.setup.step.max_halvings,
                    &moved,
                    stats,
                    record))
      return false;
  }
  *state = std::move(moved);
  s.last_x = state->x;
  return true;
}

int Simulator::FindInside(const Points& body, const ClothState& state) {
  return impl_->detector ? impl_->detector->FindInside(body, state.x) : 0;
}

void Simulator::Forget() { impl_->last_x.resize(3, 0); }

const Points& Simulator::contact_force() const { return impl_->contact_force; }

Points Simulator::BodyForce() const {
  const Impl& s = *impl_;
  Points force = Points::Zero(3, s.num_body_vertices);
  for (const BodyContact& source : s.last.sources) {
    const Vector3d& r = s.last.linearizations[0].forces[source.contact];
    for (int k = 0; k < 3; ++k)
      force.col(s.setup.body_faces(k, source.face)) -= source.weights[k] * r;
  }
  return force;
}

double Simulator::PotentialEnergy(const ClothState& state) const {
  double energy = 0;
  for (const auto& effect : impl_->setup.effects)
    energy += effect->Energy(state);
  return energy;
}

double Simulator::KineticEnergy(const ClothState& state) const {
  return 0.5 * (state.v.colwise().squaredNorm() * mass())(0);
}

}  // namespace invsim
