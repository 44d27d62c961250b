// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/simulator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "energy_balance.h"
#include "invsim/base/stopwatch.h"
#include "step_contacts.h"

namespace invsim {
namespace {

constexpr char kBodyNotFinite[] = "the body is not finite";

// How often contacts that a solution shows to be missing are added to a
// sub-step.
constexpr int kLateRounds = 4;

// The share of energy from nowhere at which a step is halved.
constexpr double kMostGain = 0.01;

// How many times as often as one that is not solved: it takes one solve to see,
// and shorter steps turn less, where a problem without an end stays one.
constexpr int kGainHalvings = 2;

Points Blend(const Points& a, const Points& b, double s) {
  return (1 - s) * a + s * b;
}

}  // namespace

struct Simulator::Impl {
  explicit Impl(SimulatorSetup s);

  struct Outcome {
    bool finite = true;
    bool converged = true;
    bool factored = true;  // that it is not finite has another reason
  };

  void Linearize(const SubstepRecord& sub,
                 LinearizationRecord* lin,
                 Timers* timers);
  std::vector<Vector3d> StartForces(const SubstepRecord& sub) const;
  Outcome Solve(SubstepRecord* sub, LinearizationRecord* lin, StepStats* stats);
  Outcome Iterate(SubstepRecord* sub, StepStats* stats);
  ClothState End(const SubstepRecord& sub) const;
  Outcome Substep(const Points& body0,
                  const Points& body1,
                  SubstepRecord* sub,
                  StepStats* stats);
  std::string WhyNotFinite(const Points& body1,
                           const Outcome& outcome,
                           const SubstepRecord& sub) const;
  bool Interval(const Points& body0,
                const Points& body1,
                double duration,
                double s0,
                double s1,
                int halved,
                ClothState* state,
                StepStats* stats,
                FrameRecord* record);

  SimulatorSetup setup;
  std::vector<std::string> names;  // of the effects
  bool inertia = false;
  bool velocity_dependent = false;
  std::shared_ptr<const BlockPattern> pattern;
  std::unique_ptr<FrictionSolver> solver;
  std::unique_ptr<StepContacts> contacts;
  VectorXd weight;
  Points contact_force, exact_force;  // of all contacts; of exact ones
  // The last forces of cloth on cloth, by the contact's vertices.
  std::map<std::array<int, 4>, Vector3d> cloth_force;
  Points last_x;       // where the last frame ended
  SubstepRecord last;  // the last sub-step advanced, without matrices
  int num_body_vertices = 0;
};

Simulator::Impl::Impl(SimulatorSetup s) : setup(std::move(s)) {
  const int n = static_cast<int>(setup.mass.size());
  BlockPatternBuilder builder(n);
  for (const auto& effect : setup.effects) {
    effect->AddStencils(&builder);
    names.push_back(effect->name());
    inertia = inertia || effect->name() == "inertia";
    velocity_dependent = velocity_dependent || effect->depends_on_velocity();
  }
  pattern = builder.Build();
  for (const auto& effect : setup.effects) effect->Bind(*pattern);
  solver = std::make_unique<FrictionSolver>(pattern);
  contacts = std::make_unique<StepContacts>(setup, pattern);
  weight = kStandardGravity * setup.mass;
  contact_force.setZero(3, n);
  exact_force.setZero(3, n);
}

void Simulator::Impl::Linearize(const SubstepRecord& sub,
                                LinearizationRecord* lin,
                                Timers* timers) {
  const double dt = sub.dt;
  const bool first = sub.linearizations.empty();
  lin->a = BlockMatrix(pattern);
  Points force = Points::Zero(3, pattern->size);
  if (velocity_dependent) lin->damping = BlockMatrix(pattern);
  for (size_t k = 0; k < setup.effects.size(); ++k) {
    const ScopedTimer timer(timers, names[k]);
    const Effect& effect = *setup.effects[k];
    effect.AddStiffness(lin->y, dt, 1, &lin->a);
    effect.AddForce(lin->y, &force);
    if (effect.depends_on_velocity())
      effect.AddStiffness(lin->y, 0, 1, &lin->damping);
  }
  lin->b = Stacked(force);
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

// Last known forces start the splitting.
std::vector<Vector3d> Simulator::Impl::StartForces(
    const SubstepRecord& sub) const {
  std::vector<Vector3d> forces(sub.contacts.size(), Vector3d::Zero());
  for (size_t k = 0; k < sub.contacts.size(); ++k)
    if (sub.contacts[k].exact())
      forces[k] = exact_force.col(sub.contacts[k].vertex[0]);
  for (const ClothContact& source : sub.cloth_sources) {
    const auto known = cloth_force.find(source.vertex);
    if (known != cloth_force.end()) forces[source.contact] = known->second;
  }
  return forces;
}

// `lin` holds the velocity and the forces to start from.
Simulator::Impl::Outcome Simulator::Impl::Solve(SubstepRecord* sub,
                                                LinearizationRecord* lin,
                                                StepStats* stats) {
  const FrictionProblem problem{&lin->a, &lin->b, &sub->contacts, &weight};
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
  // The residual is infinite where the problem itself is not finite; the
  // velocity is then still the one it started with.
  const bool finite = !f.factorization_failed && std::isfinite(f.residual) &&
                      lin->v.allFinite();
  return {finite, f.converged, !f.factorization_failed};
}

// Linearises and solves. If that was done before with fewer contacts, it
// starts from the result, and the matrix about the start serves again.
Simulator::Impl::Outcome Simulator::Impl::Iterate(SubstepRecord* sub,
                                                  StepStats* stats) {
  Outcome outcome;
  const std::vector<LinearizationRecord> before =
      std::exchange(sub->linearizations, {});
  ClothState y = sub->start;
  for (int k = 0; k < setup.step.newton_iterations; ++k) {
    LinearizationRecord lin;
    if (k == 0 && !before.empty()) {
      lin = before.front();
    } else {
      lin.y = y;
      const Stopwatch assembly;
      Linearize(*sub, &lin, &stats->effects);
      stats->assembly_seconds += assembly.seconds();
    }
    if (k > 0) {
      lin.v = Stacked(lin.y.v);
      lin.forces = sub->linearizations.back().forces;
    } else if (!before.empty()) {
      lin.v = before.back().v;
      lin.forces = before.back().forces;
      lin.forces.resize(sub->contacts.size(), Vector3d::Zero());
    } else {
      lin.v = Stacked(lin.y.v);
      lin.forces = StartForces(*sub);
    }
    const Outcome o = Solve(sub, &lin, stats);
    if (!o.finite) return {false, false, o.factored};
    outcome.converged = o.converged;
    const double change = (lin.v - Stacked(y.v)).lpNorm<Eigen::Infinity>();
    Stacked(y.v) = lin.v;
    y.x = sub->start.x + sub->dt * y.v;
    sub->linearizations.push_back(std::move(lin));
    if (k > 0 && change < setup.step.newton_tolerance) break;
  }
  return outcome;
}

Simulator::Impl::Outcome Simulator::Impl::Substep(const Points& body0,
                                                  const Points& body1,
                                                  SubstepRecord* sub,
                                                  StepStats* stats) {
  Points b0, b1;
  if (contacts->has_body()) {
    b0 = Blend(body0, body1, sub->s0);
    b1 = Blend(body0, body1, sub->s1);
  }
  contacts->Find(b0, b1, sub, stats);
  Outcome outcome = Iterate(sub, stats);
  const auto again = [&] {
    stats->worst_residual = 0;  // of an attempt that is not kept
    outcome = Iterate(sub, stats);
  };
  if (contacts->has_body())
    for (int k = 0; k < kLateRounds && outcome.finite &&
                    contacts->FindLate(b0, b1, sub, stats);
         ++k)
      again();
  for (int round = 0; outcome.finite; ++round) {
    const bool slipped = contacts->has_body() && round < kLateRounds &&
                         contacts->FindSlipped(b0, b1, sub, stats);
    const bool yielded =
        !slipped && round < kLateRounds && contacts->Stiffen(sub, stats);
    // Looked for in any case: its last word is that nothing crosses.
    const bool touched =
        contacts->self_contact_options() && contacts->Sweep(round, sub, stats);
    if (!slipped && !yielded && !touched) break;
    again();
  }
  stats->most_contacts =
      std::max(stats->most_contacts, static_cast<int>(sub->contacts.size()));
  stats->most_cloth_contacts = std::max(
      stats->most_cloth_contacts, static_cast<int>(sub->cloth_sources.size()));
  return outcome;
}

// Where a step that was solved leads.
ClothState Simulator::Impl::End(const SubstepRecord& sub) const {
  ClothState end = sub.start;
  Stacked(end.v) = sub.linearizations.back().v;
  if (sub.kept.size() > 0)
    end.v.array().rowwise() *= sub.kept.transpose().array();
  end.x = sub.start.x + sub.dt * end.v;
  return end;
}

// The culprit, sought where the sub-step started.
std::string Simulator::Impl::WhyNotFinite(const Points& body1,
                                          const Outcome& outcome,
                                          const SubstepRecord& sub) const {
  if (!body1.allFinite()) return kBodyNotFinite;
  for (size_t k = 0; k < setup.effects.size(); ++k) {
    Points force = Points::Zero(3, pattern->size);
    setup.effects[k]->AddForce(sub.start, &force);
    if (!force.allFinite())
      return "the force of " + names[k] + " is not finite";
  }
  return outcome.factored ? "the solution is not finite"
                          : "the system matrix is not positive definite";
}

bool Simulator::Impl::Interval(const Points& body0,
                               const Points& body1,
                               double duration,
                               double s0,
                               double s1,
                               int halved,
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
  const bool solved = outcome.finite && outcome.converged;
  const bool gained =
      outcome.finite && inertia &&
      EnergyGain(setup.mass, setup.effects, sub, End(sub)) > kMostGain;
  const int most = (solved ? kGainHalvings : 1) * setup.step.max_halvings;
  if ((!solved || gained) && halved < most) {
    own.worst_residual = 0;  // of an attempt that is not kept
    stats->Add(own);
    ++stats->halved;
    const double middle = 0.5 * (s0 + s1);
    return Interval(body0,
                    body1,
                    duration,
                    s0,
                    middle,
                    halved + 1,
                    state,
                    stats,
                    record) &&
           Interval(body0,
                    body1,
                    duration,
                    middle,
                    s1,
                    halved + 1,
                    state,
                    stats,
                    record);
  }
  stats->Add(own);
  ++stats->substeps;
  if (!outcome.finite) {
    ++stats->failed;
    ++stats->failures[WhyNotFinite(body1, outcome, sub)];
    return false;
  }
  if (!outcome.converged) ++stats->missed;
  const LinearizationRecord& lin = sub.linearizations.back();
  *state = End(sub);
  contact_force.setZero();
  exact_force.setZero();
  Eigen::Map<VectorXd> force = Stacked(contact_force);
  for (size_t k = 0; k < sub.contacts.size(); ++k) {
    const Contact& c = sub.contacts[k];
    for (int j = 0; j < c.num_vertices; ++j)
      force.segment<3>(3 * c.vertex[j]) += c.weight[j] * lin.forces[k];
    if (c.exact()) exact_force.col(c.vertex[0]) = lin.forces[k];
  }
  cloth_force.clear();
  for (const ClothContact& source : sub.cloth_sources)
    cloth_force[source.vertex] = lin.forces[source.contact];
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
const Faces& Simulator::faces() const { return impl_->setup.faces; }
const VectorXd& Simulator::mass() const { return impl_->setup.mass; }
const std::vector<std::unique_ptr<Effect>>& Simulator::effects() const {
  return impl_->setup.effects;
}
const StepOptions& Simulator::step_options() const { return impl_->setup.step; }
const BodyContactOptions& Simulator::contact_options() const {
  return impl_->setup.contact;
}
const SelfContactOptions* Simulator::self_contact_options() const {
  return impl_->contacts->self_contact_options();
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
  if (s.last_x.cols() != state->x.cols() || s.last_x != state->x) {
    s.exact_force.setZero();
    s.cloth_force.clear();
    s.solver->Forget();
  }
  // No contact would be found with it: the cloth would fall as if there were
  // no body.
  if (!body0.allFinite() || !body1.allFinite()) {
    ++stats->failed;
    ++stats->failures[kBodyNotFinite];
    Forget();
    return false;
  }
  ClothState moved = *state;
  const int substeps = s.setup.step.substeps;
  for (int k = 0; k < substeps; ++k) {
    if (!s.Interval(body0,
                    body1,
                    duration,
                    static_cast<double>(k) / substeps,
                    static_cast<double>(k + 1) / substeps,
                    0,
                    &moved,
                    stats,
                    record)) {
      Forget();  // forces of sub-steps that are not kept
      return false;
    }
  }
  *state = std::move(moved);
  s.last_x = state->x;
  return true;
}

int Simulator::FindInside(const Points& body, const ClothState& state) {
  return impl_->contacts->FindInside(body, state.x);
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
  return invsim::PotentialEnergy(effects(), state);
}

double Simulator::KineticEnergy(const ClothState& state) const {
  return invsim::KineticEnergy(mass(), state);
}

}  // namespace invsim
