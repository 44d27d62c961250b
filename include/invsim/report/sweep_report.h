// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_SWEEP_REPORT_H_
#define INVSIM_REPORT_SWEEP_REPORT_H_

// What a sweep found: for programs, for spreadsheets, and as a chart of error
// over cost in which the settings that no other beats stand out.

#include <string>
#include <vector>

#include "invsim/study/sweep.h"

namespace invsim {

inline constexpr int kSweepSchemaVersion = 1;

struct SweepReport {
  std::string command;
  std::string error_key, cost_key;
  double tolerance = 0.05;
  int repeats = 1;
  std::string held_against;  // the truth's path, or "reference"
  std::vector<SweepResult> results;
};

// Schema "invsim.sweep".
std::string SweepJson(const SweepReport& report);

// A row per setting: its options, why it failed if it did, all its numbers.
std::string SweepCsv(const SweepReport& report);

// Error over cost, both logarithmic: the Pareto front joined by a line,
// dominated settings grey, bars from the least to the largest cost. Hovering
// over a point shows its settings (SVG titles). Readable by itself.
std::string SweepSvg(const SweepReport& report);

// The chart, the verdict and the table as one page.
std::string SweepHtml(const SweepReport& report);

// For people: a line per setting, cheapest first, the front marked by '*', and
// the verdict.
std::string SweepText(const SweepReport& report);

}  // namespace invsim

#endif  // INVSIM_REPORT_SWEEP_REPORT_H_
