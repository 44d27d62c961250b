// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_COMPARISON_REPORT_H_
#define INVSIM_REPORT_COMPARISON_REPORT_H_

// A comparison of optimisers as a table for people, JSON and CSV for programs,
// and charts: cost and body error against simulation steps and seconds.

#include <string>
#include <vector>

#include "invsim/report/chart.h"
#include "invsim/report/run_folder.h"
#include "invsim/study/optimizer_comparison.h"

namespace invsim {

inline constexpr int kComparisonSchemaVersion = 1;

// One row per optimiser: how it ended, iterations, steps, seconds, cost, body
// error, and the steps it took to the best of the baseline, the run named
// gradient_descent (else the last one).
std::string ComparisonText(const std::vector<ComparisonRun>& runs);
std::string ComparisonJson(const std::vector<ComparisonRun>& runs);
// A line per iteration of every run.
std::string ComparisonCsv(const std::vector<ComparisonRun>& runs);
std::vector<Chart> ComparisonCharts(const std::vector<ComparisonRun>& runs);

// report.json, report.html, comparison.csv, comparison.svg, solver.txt.
void WriteComparison(const RunFolder& folder,
                     const std::vector<ComparisonRun>& runs);

}  // namespace invsim

#endif  // INVSIM_REPORT_COMPARISON_REPORT_H_
