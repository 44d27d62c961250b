// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_SIMULATION_REPORT_H_
#define INVSIM_REPORT_SIMULATION_REPORT_H_

// What a simulation was, and how it went: as JSON for programs, as words for
// people, as charts.

#include <string>
#include <vector>

#include "invsim/report/chart.h"
#include "invsim/sim/effect_choice.h"
#include "invsim/sim/relaxation.h"
#include "invsim/sim/rollout.h"

namespace invsim {

inline constexpr int kSimulationSchemaVersion = 1;

struct SimulationReport {
  // As given: a path, or the name of something embedded.
  std::string body, motion, garment, material;
  int body_vertices = 0, body_faces = 0;
  int cloth_vertices = 0, cloth_faces = 0;
  int frames_wanted = 0;
  double frames_per_second = 0;
  int threads = 0;
  double cloth_mass = 0;  // kg
  double thickness = 0;   // m, kept between cloth and body
  double friction = 0;    // Coulomb's mu
  double tolerance = 0;   // of the contact solve, weights of a vertex
  std::vector<EffectDecision> effects;

  RelaxationResult relaxation;
  RolloutResult sequence;
  std::vector<FrameStats> frames;  // of the sequence
  std::vector<double> stress;      // per frame, 99th percentile, N/m
  double seconds = 0;              // of wall clock, all in all
};

// kComplete if both parts are.
RunStatus Status(const SimulationReport& report);

// Steps with a residual above the tolerance, both parts.
int MissedSteps(const SimulationReport& report);

// One sentence: done or not, how many steps missed, the worst residual.
std::string Verdict(const SimulationReport& report);

// Schema "invsim.simulation", version kSimulationSchemaVersion; every key that
// has a unit ends in it.
std::string SimulationJson(const SimulationReport& report);

// In plain words, for solver.txt.
std::string SimulationText(const SimulationReport& report);

// Over the time of the sequence.
std::vector<Chart> SimulationCharts(const SimulationReport& report);

}  // namespace invsim

#endif  // INVSIM_REPORT_SIMULATION_REPORT_H_
