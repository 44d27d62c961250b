// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_HARD_MAP_H_
#define INVSIM_STUDY_HARD_MAP_H_

// Where the simulator breaks: one scene over a grid of two of its figures,
// wide enough that the edges fail.

#include <functional>
#include <string>
#include <vector>

#include "invsim/study/hard_scene.h"

namespace invsim {

struct HardMap {
  std::string name;              // "stiffness_dt"
  std::string shows;             // one line
  std::string x_title, y_title;  // with the unit
  std::vector<double> x, y;
  std::vector<std::string> x_labels = {}, y_labels = {};  // empty: the numbers
  std::function<HardScene(double x, double y)> make;
};

const std::vector<HardMap>& HardMaps();

// The first and each n-th after it of the map's columns and rows.
HardMap EveryNth(HardMap map, int n);

// Per step, over the whole scene.
struct HardMapCell {
  double iterations = 0;  // of splitting and Newton, per step
  HardOutcome outcome;
};

HardMapCell RunMapCell(const HardMap& map, int i, int j);

}  // namespace invsim

#endif  // INVSIM_STUDY_HARD_MAP_H_
