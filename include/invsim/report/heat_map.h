// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_HEAT_MAP_H_
#define INVSIM_REPORT_HEAT_MAP_H_

// A grid of numbers as coloured cells, as SVG text that opens without a network
// or scripts.

#include <string>
#include <vector>

namespace invsim {

struct HeatMap {
  std::string title;
  std::string x_title;            // with the unit
  std::string y_title;            // with the unit
  std::string legend;             // what the colours stand for, with the unit
  std::vector<std::string> x, y;  // labels, from the left and from below
  // values[j][i]: of y[j] and x[i]. Colours go by the logarithm; values that
  // are not finite or not positive stay white.
  std::vector<std::vector<double>> values;
  // Letters on a cell that stand for `notes`; empty: none.
  std::vector<std::vector<std::string>> marks;
  std::vector<std::string> notes;  // lines below: "E: energy from nowhere"
};

// A file of its own.
std::string HeatMapSvg(const HeatMap& map);

}  // namespace invsim

#endif  // INVSIM_REPORT_HEAT_MAP_H_
