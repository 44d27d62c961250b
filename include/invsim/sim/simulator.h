// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_SIMULATOR_H_
#define INVSIM_SIM_SIMULATOR_H_

// One frame of cloth on a moving body.
//
// A frame is `substeps` linearly implicit steps, the body moving on straight
// lines between its two positions. Each sub-step freezes stiffness and damping
// at a state y, which makes it one strictly convex frictional problem
//
//   A v1 = b + r,  A = M/dt + dt K(y) + D(y),
//   b = M v0/dt + f(y) + K(y) (y.x - x0) + D(y) y.v,
//
// solved exactly (contact/friction_solver.h), then x1 = x0 + dt v1. Smaller
// sub-steps, or re-linearising about the result (`newton_iterations`), buy
// accuracy with time. A sub-step that misses its tolerance is halved, at most
// `max_halvings` times, and one that is solved but has energy from nowhere (its
// linearisation does not see how far it turns) at most twice as often; if that
// does not help it is taken as it is, counted and reported.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "invsim/base/timer.h"
#include "invsim/cloth/effect.h"
#include "invsim/contact/body_contact.h"
#include "invsim/contact/friction_solver.h"
#include "invsim/sim/frame_record.h"

namespace invsim {

// Residuals are in units of a vertex's weight; it weighs its mass times this
// where there is no gravity, too, m/s^2.
inline constexpr double kStandardGravity = 9.81;

struct StepOptions {
  int substeps = 4;
  // Linearisations per sub-step; 1 is the linearly implicit scheme.
  int newton_iterations = 1;
  // A sub-step is done with re-linearising when no velocity changes by more.
  double newton_tolerance = 1e-10;  // m/s
  int max_halvings = 3;
  FrictionOptions friction;
};
void Describe(OptionTable* table, StepOptions* options);
void Describe(OptionTable* table, FrictionOptions* options);

// Counts and times, summed over what they describe.
struct StepStats {
  int substeps = 0;
  int linearizations = 0;
  int missed = 0;  // sub-steps that stayed above the contact tolerance
  int halved = 0;  // sub-steps replaced by two halves
  int failed = 0;  // sub-steps with no result at all (not finite)
  // Why they failed, in words, and how many for that reason.
  std::map<std::string, int> failures;
  double worst_residual = 0;  // weights; over all sub-steps
  int most_contacts = 0;
  int factorizations = 0;
  int solves = 0;
  long contact_queries = 0;  // searches for the skin near a cloth vertex
  int admm_iterations = 0;
  int newton_iterations = 0;  // of the frictional solve
  int open = 0, stick = 0, slide = 0;
  // Further solves for vertices that slid past a face and into the next.
  int slip_solves = 0;
  // And for contacts that gave way too far (BodyContactOptions).
  int yield_solves = 0;
  // Of the cloth with itself: the most in a step, further solves for pairs
  // that touched on their way, vertices stopped (one in two steps counts
  // twice), and the most pairs of faces that crossed at the start of a step.
  int most_cloth_contacts = 0;
  int sweep_solves = 0;
  int stopped = 0;
  int most_crossings = 0;
  double assembly_seconds = 0;
  Timers effects;  // of assembly, by effect; only those there are
  double detection_seconds = 0;
  double factor_seconds = 0;
  double solve_seconds = 0;

  void Add(const StepStats& other);
};

// A vertex held in place.
struct Pin {
  int vertex;
  Vector3d position;
};

// What a simulator is made of. An effect called "inertia" gives the cloth its
// mass in the momentum balance; without it steps are quasi-static, and loose
// cloth needs something else that resists it (mass damping, pins). A
// SelfContact among the effects keeps layers of cloth apart.
struct SimulatorSetup {
  Faces faces;  // of the cloth
  // Any usual position of the cloth, to know how stiff it is there; without
  // it only the mass resists a force (BodyContactOptions::shared_compliance).
  Points cloth;
  VectorXd mass;  // kg per vertex
  std::vector<std::unique_ptr<Effect>> effects;
  std::vector<Pin> pins;
  BodyContactOptions contact;
  StepOptions step;
  // The body's faces; no columns: nothing to collide with.
  Faces body_faces;
  Points body;  // any position of the body, to check its topology
};

class Simulator {
 public:
  explicit Simulator(SimulatorSetup setup);
  ~Simulator();

  int num_vertices() const;
  const Faces& faces() const;  // of the cloth
  const VectorXd& mass() const;
  const std::vector<std::unique_ptr<Effect>>& effects() const;
  const StepOptions& step_options() const;
  const BodyContactOptions& contact_options() const;
  // Null if no effect is called "self_contact".
  const SelfContactOptions* self_contact_options() const;
  std::shared_ptr<const BlockPattern> pattern() const;
  const Faces& body_faces() const;
  bool has_inertia() const;
  bool depends_on_velocity() const;

  // Moves `state` by `duration` seconds while the body moves from body0 to
  // body1. If `record` is given it is filled. False if there is no finite
  // result (stats->failures says why); `state` is then unchanged.
  bool Advance(const Points& body0,
               const Points& body1,
               double duration,
               ClothState* state,
               StepStats* stats,
               FrameRecord* record = nullptr);

  // Finds vertices inside the body at `state`; to be called when positions
  // were set from outside. Returns how many there are.
  int FindInside(const Points& body, const ClothState& state);

  // Forgets the last step, whose forces start the next one if the cloth was
  // not moved since: what follows depends only on what is given to it.
  void Forget();

  // Contact force on every vertex (N) of the last sub-step advanced.
  const Points& contact_force() const;
  // Its reaction spread over the body's vertices (N), 3 x V.
  Points BodyForce() const;

  // Potential and kinetic energy, J.
  double PotentialEnergy(const ClothState& state) const;
  double KineticEnergy(const ClothState& state) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_SIM_SIMULATOR_H_
