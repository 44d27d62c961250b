// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/hard_map.h"

#include <algorithm>
#include <cmath>

#include "hard_cases.h"

namespace invsim {
namespace {

// A sheet falls over a ball for half a second, one step a frame.
HardMap StiffnessAndStep() {
  HardMap map;
  map.name = "stiffness_dt";
  map.shows = "Iterations per step: a sheet of 3.5 cm cells falls over a ball";
  map.x_title = "membrane stiffness, N/m";
  map.y_title = "length of a step, s";
  map.x = {1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10};
  map.x_labels = {"1",
                  "10",
                  "100",
                  "1e3",
                  "1e4",
                  "1e5",
                  "1e6",
                  "1e7",
                  "1e8",
                  "1e9",
                  "1e10"};
  for (int rate : {2000, 1000, 500, 240, 120, 60, 30, 20, 10, 5, 2, 1}) {
    map.y.push_back(1.0 / rate);
    map.y_labels.push_back("1/" + std::to_string(rate));
  }
  map.make = [](double stiffness, double dt) {
    HardScene scene = SheetOverBall();
    scene.material.stretch = IsotropicStretch{stiffness, 0.3};
    scene.frames_per_second = 1 / dt;
    scene.options.step.substeps = 1;
    scene.frames = std::max(5, static_cast<int>(std::lround(0.5 / dt)));
    return scene;
  };
  return map;
}

// The gallery's armpit.
HardMap FrictionAndSqueeze() {
  HardMap map;
  map.name = "mu_squeeze";
  map.shows = "Iterations per step: a sheet in a V that closes on it";
  map.x_title = "angle of the V when it has closed, degrees";
  map.y_title = "friction coefficient";
  map.x = {60, 45, 30, 20, 15, 10, 7, 5, 3, 1, 0};
  map.y = {0, 0.1, 0.3, 0.6, 1, 2, 5, 20, 100};
  map.make = [](double degrees, double mu) {
    HardScene scene = SheetInV(degrees);
    scene.options.contact.friction = mu;
    return scene;
  };
  return map;
}

template <typename T>
void KeepEveryNth(int n, std::vector<T>* line) {
  size_t kept = 0;
  for (size_t i = 0; i < line->size(); i += n) (*line)[kept++] = (*line)[i];
  line->resize(kept);
}

}  // namespace

const std::vector<HardMap>& HardMaps() {
  static const std::vector<HardMap> maps = {StiffnessAndStep(),
                                            FrictionAndSqueeze()};
  return maps;
}

HardMap EveryNth(HardMap map, int n) {
  KeepEveryNth(n, &map.x);
  KeepEveryNth(n, &map.y);
  KeepEveryNth(n, &map.x_labels);
  KeepEveryNth(n, &map.y_labels);
  return map;
}

HardMapCell RunMapCell(const HardMap& map, int i, int j) {
  HardMapCell cell;
  cell.outcome = RunHardScene(map.make(map.x[i], map.y[j]), false);
  const StepStats& step = cell.outcome.step;
  cell.iterations =
      static_cast<double>(step.admm_iterations + step.newton_iterations) /
      std::max(step.substeps, 1);
  return cell;
}

}  // namespace invsim
