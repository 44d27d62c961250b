// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_SWEEP_H_
#define INVSIM_STUDY_SWEEP_H_

// A sweep: one command run with many settings of its options, to see what
// each buys and what it costs. It is written as a configuration:
//
//   [sweep]                        # how, see SweepOptions
//   command = "simulate"
//   repeats = 3
//
//   [base]                         # options of every run
//   input.frames = 20
//
//   [reference]                    # options, over base, of the run that the
//   step.substeps = 64             # others are held against
//
//   [grid]                         # every combination of these
//   step.substeps = [1, 2, 4, 8]
//   step.newton_iterations = [1, 3]
//   scene.effects = ["auto", ["inertia", "gravity", "membrane"]]
//
//   [list.no_bending]              # and each of these by itself
//   scene.effects = ["inertia", "gravity", "membrane"]
//
// Runs are repeated in interleaved order (every setting once, then every
// setting again): what slows the machine for a while slows all settings alike.
// Times are given as median, least and largest.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "invsim/base/config.h"
#include "invsim/base/options.h"

namespace invsim {

struct SweepOptions {
  std::string command = "simulate";
  int repeats = 1;
  // A sequence with known truth, or "": runs are held against the reference.
  std::string truth = "";
  std::string body = "";  // of the truth, if there is none beside it
  // What counts as error and as cost: keys of the results.
  // "": cloth_rms_mm, or cloth_surface_mm if a run has another mesh than the
  // reference; with a truth body_v2v_mean_mm.
  std::string error = "";
  std::string cost = "";  // "": cpu_per_simulated_second; of a fit wall_seconds
  // Numbers of the runs' report.json to keep as results, those that there are.
  // Of a simulation those of the sequence alone, as its processor time is.
  std::vector<std::string> report = {"sequence.steps",
                                     "sequence.steps_missed",
                                     "sequence.steps_halved",
                                     "sequence.factorizations",
                                     "sequence.solves",
                                     "sequence.contact_queries",
                                     "sequence.newton_iterations",
                                     "sequence.splitting_iterations",
                                     "optimization.iterations",
                                     "optimization.evaluations",
                                     "optimization.final_cost",
                                     "simulation.steps",
                                     "simulation.steps_missed",
                                     "simulation.factorizations",
                                     "simulation.solves",
                                     "simulation.contact_queries",
                                     "simulation.neighbour_queries"};
  double tolerance = 0.05;  // of "within 5 % of the best error"
};
void Describe(OptionTable* table, SweepOptions* options);

// One setting: what to call it, and its options with their values as TOML.
struct SweepSetting {
  std::string name;  // may be the name of a folder
  std::vector<std::pair<std::string, std::string>> options;
};

struct SweepPlan {
  std::vector<std::pair<std::string, std::string>> base;
  // The reference run, named "reference"; no options and no name if there is
  // none.
  SweepSetting reference;
  bool has_reference = false;
  std::vector<SweepSetting> settings;
  // Where everything was written, by its key with the part it stood in.
  std::map<std::string, std::string> origins;
};

// A value, given as TOML, in the name of a setting: "cotton", or
// "inertia+gravity" of a list. What may not stand in a folder's name is '_'.
std::string NameOfValue(const std::string& toml);

// Takes the keys under base, reference, grid and list out of `config` and
// makes the plan of them. Throws UsageError, naming where the key was
// written: a value of the grid that is no list, two settings of one name, no
// setting at all.
SweepPlan TakeSweepPlan(Config* config);

// The options of a run: base and, over it, those of the setting, each with
// where it was written.
Config ConfigOf(const SweepPlan& plan, const SweepSetting& setting);

// Median, least and largest of the repeats.
struct SweepSpread {
  double median = 0, least = 0, largest = 0;
};
SweepSpread SpreadOf(std::vector<double> values);

// What came of a setting.
struct SweepResult {
  SweepSetting setting;
  bool usable = false;  // every repeat ended with exit code 0 or 4
  std::vector<int> exit_codes;
  std::string failure;  // the last line of its messages, if it is not usable
  SweepSpread cost;
  double error = 0;
  // All numbers by key, medians over the repeats.
  std::vector<std::pair<std::string, double>> values;
  std::vector<double> frame_errors_mm;  // rms per frame against the reference
  bool pareto = false;                  // no other is better in both

  // Adds the median of a number's repeats, and as KEY_least and KEY_largest
  // the others, if they differ.
  void Add(const std::string& key, const std::vector<double>& repeats);
};

// Marks the usable results that no other usable one beats: as good in both
// error and cost and better in one.
void MarkPareto(std::vector<SweepResult>* results);

// What to ask for to have a setting: "--preset draft" if that is all it sets,
// else its name.
std::string SettingInWords(const SweepSetting& setting);

// "within 5 % of the best error (1.2, precise) at 1/6 of the time: --preset
// balanced", or that nothing succeeded. Of equal errors the cheapest is the
// best; surely cheaper is what cost less in every repeat than the best in any.
// `cost`: what the cost is called.
std::string SweepVerdict(const std::vector<SweepResult>& results,
                         double tolerance,
                         const std::string& cost = "cost");

}  // namespace invsim

#endif  // INVSIM_STUDY_SWEEP_H_
