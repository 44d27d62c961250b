// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_RUN_SUMMARY_H_
#define INVSIM_REPORT_RUN_SUMMARY_H_

// What runs left in their folders (report/run_folder.h), read back and side by
// side: how each ended, its figures, and the settings in which they differ.

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace invsim {

struct RunSummary {
  std::string run;      // the folder
  std::string schema;   // "invsim.fit", "invsim.simulation"
  std::string status;   // one word
  std::string verdict;  // a sentence
  // One for every entry of FigureNames(); none: such a run has no such figure.
  std::vector<std::optional<double>> figures;
  // Of config.resolved.toml, by key.
  std::map<std::string, std::string> settings;
};

// "cost", "penetration_max_mm", ...: names that say the unit.
const std::vector<std::string>& FigureNames();

// Reads report.json and config.resolved.toml, and the evaluation.json of
// `invsim eval --out FOLDER` if it is there too. Throws InputError if the
// folder holds no run of a fit or a simulation.
RunSummary ReadRunSummary(const std::string& folder);

// The keys whose values are not the same in all runs.
std::vector<std::string> DifferingSettings(const std::vector<RunSummary>& runs);

// A line for each run, then figures and differing settings, a column each.
std::string SummaryText(const std::vector<RunSummary>& runs);
// Schema "invsim.report": `runs`, each with its figures and the settings in
// which it differs from another one.
std::string SummaryJson(const std::vector<RunSummary>& runs);

}  // namespace invsim

#endif  // INVSIM_REPORT_RUN_SUMMARY_H_
