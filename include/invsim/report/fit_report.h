// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_FIT_REPORT_H_
#define INVSIM_REPORT_FIT_REPORT_H_

// What a fit was, and how it went: as JSON for programs, as words for people,
// as a table of iterations, as charts.

#include <string>
#include <utility>
#include <vector>

#include "invsim/fit/sequence_fit.h"
#include "invsim/report/chart.h"
#include "invsim/sim/effect_choice.h"

namespace invsim {

inline constexpr int kFitSchemaVersion = 2;

struct FitReport {
  // As given: a path, or the name of something embedded.
  std::string points, body, garment, material;
  int frames = 0;
  double frames_per_second = 0;
  int fewest_points = 0, most_points = 0;  // used, per frame
  int points_dropped = 0;                  // not finite, all frames
  int points_filtered = 0;                 // by input.filter, all frames
  int body_vertices = 0;
  int cloth_vertices = 0, cloth_faces = 0;
  int threads = 0;
  double friction = 0;   // Coulomb's mu
  double thickness = 0;  // m
  double tolerance = 0;  // of the contact solve, weights of a vertex
  std::vector<EffectDecision> effects;
  std::string optimizer;
  std::string loss;  // with its scale
  History history = History::kOneFrame;

  FitResult result;
  std::vector<FrameStats> simulated;  // frames of the final simulation
  double seconds = 0;                 // of wall clock, all in all
};

// One sentence: how it ended, what it gained, whether it can be used.
std::string Verdict(const FitReport& report);

// What was left out or assumed, one sentence each.
std::vector<std::string> Approximations(const FitReport& report);

// Where the time went, largest part first: name, seconds.
std::vector<std::pair<std::string, double>> TimeByPart(const FitReport& report);

// Schema "invsim.fit", version kFitSchemaVersion; every key that has a unit
// ends in it.
std::string FitJson(const FitReport& report);

// In plain words, with Ceres's own full report at the end, for solver.txt.
std::string FitText(const FitReport& report);

// A line per iteration of every dressing, for iterations.csv.
std::string IterationsCsv(const FitReport& report);

// The cost over time, and over the frames what the final simulation shows.
std::vector<Chart> FitCharts(const FitReport& report);

}  // namespace invsim

#endif  // INVSIM_REPORT_FIT_REPORT_H_
