// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_HARD_MAP_REPORT_H_
#define INVSIM_REPORT_HARD_MAP_REPORT_H_

// A map of where the simulator breaks: iterations per step and, by letters,
// the limits that do not hold in each cell.

#include <string>
#include <vector>

#include "invsim/study/hard_map.h"

namespace invsim {

inline constexpr int kHardMapSchemaVersion = 1;

struct HardMapReport {
  HardMap map;
  std::vector<std::vector<HardMapCell>> cells;  // [y][x]
};

// A table: iterations and letters.
std::string HardMapText(const HardMapReport& report);

// Schema "invsim.map".
std::string HardMapJson(const HardMapReport& report);

std::string HardMapSvg(const HardMapReport& report);

}  // namespace invsim

#endif  // INVSIM_REPORT_HARD_MAP_REPORT_H_
