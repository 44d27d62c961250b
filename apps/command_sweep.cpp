// SPDX-License-Identifier: Apache-2.0

// invsim sweep: one command with many settings; what each buys and costs.

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>

#include "command.h"
#include "evaluation_inputs.h"
#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/progress.h"
#include "invsim/io/file.h"
#include "invsim/report/sweep_report.h"
#include "invsim/study/cloth_difference.h"
#include "sweep_runs.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

constexpr char kSweepOut[] = "invsim_sweep";
constexpr const char* kFiles[] = {
    "sweep.json", "sweep.csv", "sweep.svg", "sweep.html"};
constexpr char kClothRms[] = "cloth_rms_mm";
constexpr char kClothSurface[] = "cloth_surface_mm";
constexpr char kBodyError[] = "body_v2v_mean_mm";
constexpr char kCpuPerSecond[] = "cpu_per_simulated_second";
constexpr char kWall[] = "wall_seconds";

class SweepCommand : public Command {
 public:
  std::string name() const override { return "sweep"; }
  std::string doc() const override {
    return "one command with many settings: what each buys and costs";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override {
    flags->Add("--repeats", "sweep.repeats", "of every setting");
    flags->Add("--truth", "sweep.truth", "a sequence to hold runs against");
    app->add_flag("--force", force_, "run again what DIR holds already");
  }
  void AddOptions(OptionTable* table) override {
    table->AddSection("sweep", &options_);
  }
  void TakeConfig(Config* config) override { plan_ = TakeSweepPlan(config); }
  ExitCode Run(const CommandContext& context) override;

 private:
  void CheckFolder(const fs::path& out) const;
  void CheckSettings() const;
  bool CheckKeys(const SweepRuns& runs, const SweepSetting& setting) const;
  bool RunAll(const SweepRuns& runs, std::ostream* log) const;
  SweepReport KeysChosen() const;
  SweepReport Gather(const SweepRuns& runs) const;
  SweepResult ResultOf(const SweepRuns& runs,
                       const SweepSetting& setting,
                       int repeats) const;
  std::vector<std::pair<std::string, double>> Compare(
      const SweepRuns& runs,
      const std::string& folder,
      SweepResult* result) const;
  void Measure(const SweepRuns& runs, int repeats, SweepResult* result) const;
  void ChooseError(SweepReport* report) const;
  void UseErrorAndCost(SweepReport* report) const;

  SweepOptions options_;
  std::optional<LoadedReference> truth_;
  SweepPlan plan_;
  bool force_ = false;
};

// Its own files are replaced whenever it is gone on with, others never.
void SweepCommand::CheckFolder(const fs::path& out) const {
  if (fs::exists(out) && !fs::is_directory(out))
    throw UsageError(out.string() + ": is a file, expected a folder");
  for (const char* file : kFiles)
    if (fs::exists(out / file) && !fs::is_directory(out / "runs"))
      throw UsageError((out / file).string() +
                       ": is of no sweep here; choose another --out");
}

// Reads all settings as their runs will, so that one that cannot be asked for
// is known before anything runs.
void SweepCommand::CheckSettings() const {
  std::vector<SweepSetting> all = plan_.settings;
  if (plan_.has_reference) all.push_back(plan_.reference);
  for (const SweepSetting& setting : all) {
    const std::unique_ptr<Command> command =
        options_.command == "fit" ? MakeFitCommand() : MakeSimulateCommand();
    RunOptions run;
    OptionTable table;
    ReadOptions(command.get(), &run, ConfigOf(plan_, setting), &table);
  }
}

// That the results have the two keys is looked at in the first of them; false
// if there is nothing to look at. Of keys of a spread only all repeats know.
bool SweepCommand::CheckKeys(const SweepRuns& runs,
                             const SweepSetting& setting) const {
  SweepReport first = KeysChosen();
  first.results.push_back(ResultOf(runs, setting, 1));
  if (!first.results[0].usable) return false;
  ChooseError(&first);
  for (const std::string& key : {first.error_key, first.cost_key})
    if (key.ends_with("_least") || key.ends_with("_largest")) return true;
  UseErrorAndCost(&first);
  return true;
}

// Every setting once, then every setting again. False if interrupted.
bool SweepCommand::RunAll(const SweepRuns& runs, std::ostream* log) const {
  const std::vector<SweepSetting>& settings = plan_.settings;
  const int total = options_.repeats * static_cast<int>(settings.size()) +
                    (plan_.has_reference ? 1 : 0);
  Progress progress(log, StyleFor(STDERR_FILENO), "runs", total);
  const auto run = [&](const SweepSetting& setting, int repeat) {
    const RunOutcome done = runs.At(setting, repeat).Run();
    if (done.exit_code == static_cast<int>(ExitCode::kInterrupted) ||
        InterruptRequested())
      return false;
    progress.Advance(setting.name + (done.usable()
                                         ? ""
                                         : ": failed, exit code " +
                                               std::to_string(done.exit_code)));
    return true;
  };
  const auto clear = [&](const RecordedRun& earlier) {
    if (force_)
      earlier.Forget();
    else
      earlier.ForgetIfKilled();
  };
  if (plan_.has_reference) clear(runs.At(plan_.reference, 0));
  for (const SweepSetting& setting : settings)
    for (int k = 0; k < options_.repeats; ++k) clear(runs.At(setting, k));
  if (plan_.has_reference) {
    if (!run(plan_.reference, 0)) return false;
    const RecordedRun reference = runs.At(plan_.reference, 0);
    if (!reference.Run().usable()) {
      const std::string why = reference.LastLine();
      reference.Forget();  // to be tried again: nothing goes without it
      throw InputError("the reference run failed: " + why);
    }
  }
  bool checked = false;
  for (int repeat = 0; repeat < options_.repeats; ++repeat)
    for (const SweepSetting& setting : settings) {
      if (!run(setting, repeat)) return false;
      if (repeat == 0) checked = checked || CheckKeys(runs, setting);
    }
  return true;
}

// The numbers of a run that need a comparison.
std::vector<std::pair<std::string, double>> SweepCommand::Compare(
    const SweepRuns& runs,
    const std::string& folder,
    SweepResult* result) const {
  if (truth_)
    return Evaluate(*truth_->reference, LoadEstimate(folder)).Values();
  if (!plan_.has_reference) return {};
  const ClothDifference d =
      CompareClothFolders(folder, runs.At(plan_.reference, 0).folder());
  if (!d.vertex_by_vertex()) return {{kClothSurface, d.mean_surface_mm()}};
  if (result->frame_errors_mm.empty()) result->frame_errors_mm = d.rms_mm;
  return {{kClothRms, d.total_rms_mm()},
          {"cloth_last_frame_rms_mm", d.rms_mm.back()},
          {"cloth_mean_mm", d.mean_mm},
          {"cloth_max_mm", d.max_mm},
          {kClothSurface, d.mean_surface_mm()}};
}

// Of every repeat: rounding alone may lead two runs apart.
void SweepCommand::Measure(const SweepRuns& runs,
                           int repeats,
                           SweepResult* result) const {
  std::vector<std::string> keys;
  std::map<std::string, std::vector<double>> values;
  try {
    for (int k = 0; k < repeats; ++k) {
      const std::string folder = runs.At(result->setting, k).folder();
      for (const auto& [key, value] : Compare(runs, folder, result)) {
        if (!values.count(key)) keys.push_back(key);
        values[key].push_back(value);
      }
    }
  } catch (const InputError& error) {
    result->usable = false;
    result->failure = error.what();
    return;
  }
  for (const std::string& key : keys) result->Add(key, values[key]);
}

// Looks the two keys up in every result.
void SweepCommand::UseErrorAndCost(SweepReport* report) const {
  for (SweepResult& r : report->results) {
    if (!r.usable) continue;
    bool has_error = false, has_cost = false;
    double least = 0, largest = 0;
    for (const auto& [key, value] : r.values) {
      if (key == report->error_key) {
        r.error = value;
        has_error = true;
      } else if (key == report->cost_key) {
        r.cost.median = least = largest = value;
        has_cost = true;
      }
    }
    for (const auto& [key, value] : r.values) {
      if (key == report->cost_key + "_least") least = value;
      if (key == report->cost_key + "_largest") largest = value;
    }
    r.cost.least = least;
    r.cost.largest = largest;
    if (!has_error || !has_cost)
      throw UsageError("sweep: the results have no '" +
                       (has_error ? report->cost_key : report->error_key) +
                       "'; expected a key of the CSV, or a [reference] or "
                       "sweep.truth to measure errors");
  }
  MarkPareto(&report->results);
}

// Whether every run could be held against the reference vertex by vertex.
bool SameMesh(const SweepReport& report) {
  return std::ranges::all_of(report.results, [](const SweepResult& r) {
    return !r.usable || std::ranges::any_of(r.values, [](const auto& value) {
      return value.first == kClothRms;
    });
  });
}

SweepResult SweepCommand::ResultOf(const SweepRuns& runs,
                                   const SweepSetting& setting,
                                   int repeats) const {
  SweepResult result = runs.Result(setting, repeats, options_.report);
  if (result.usable) Measure(runs, repeats, &result);
  return result;
}

SweepReport SweepCommand::KeysChosen() const {
  SweepReport report;
  report.command = options_.command;
  report.tolerance = options_.tolerance;
  report.repeats = options_.repeats;
  report.held_against =
      options_.truth.empty() ? "the reference run" : options_.truth;
  report.cost_key = options_.cost;
  if (report.cost_key.empty())
    report.cost_key = options_.command == "fit" ? kWall : kCpuPerSecond;
  return report;
}

// What counts as error, of results that are there.
void SweepCommand::ChooseError(SweepReport* report) const {
  report->error_key = !options_.error.empty()   ? options_.error
                      : !options_.truth.empty() ? kBodyError
                      : SameMesh(*report)       ? kClothRms
                                                : kClothSurface;
}

SweepReport SweepCommand::Gather(const SweepRuns& runs) const {
  SweepReport report = KeysChosen();
  for (const SweepSetting& setting : plan_.settings)
    report.results.push_back(ResultOf(runs, setting, options_.repeats));
  ChooseError(&report);
  UseErrorAndCost(&report);
  return report;
}

ExitCode SweepCommand::Run(const CommandContext& context) {
  const InterruptGuard interrupt;
  const fs::path out(context.out.empty() ? kSweepOut : context.out);
  if (options_.truth.empty() && !plan_.has_reference)
    throw UsageError(
        "sweep: nothing to hold runs against; expected a [reference] or "
        "sweep.truth");
  CheckSettings();
  CheckFolder(out);
  if (!options_.truth.empty())
    truth_ = LoadReference(options_.truth, options_.body);
  std::vector<std::string> common = {options_.command,
                                     "--threads",
                                     std::to_string(context.run.threads),
                                     "--seed",
                                     std::to_string(context.run.seed),
                                     "-q"};
  for (const auto& [key, value] : plan_.base)
    common.insert(common.end(), {"--set", key + "=" + value});
  const SweepRuns runs(out.string(), common);
  std::ostream* log = context.verbosity < 0 ? nullptr : &std::cerr;
  if (!RunAll(runs, log)) {
    std::cerr << "invsim: interrupted; the same command goes on with "
              << out.string() << std::endl;
    return ExitCode::kInterrupted;
  }
  const SweepReport report = Gather(runs);
  WriteFileBytes((out / "sweep.json").string(), SweepJson(report));
  WriteFileBytes((out / "sweep.csv").string(), SweepCsv(report));
  WriteFileBytes((out / "sweep.svg").string(), SweepSvg(report));
  WriteFileBytes((out / "sweep.html").string(), SweepHtml(report));
  std::cout << (context.json ? SweepJson(report) : SweepText(report));
  for (const SweepResult& r : report.results)
    if (r.usable) return ExitCode::kOk;
  return ExitCode::kFailed;
}

}  // namespace

std::unique_ptr<Command> MakeSweepCommand() {
  return std::make_unique<SweepCommand>();
}

}  // namespace invsim
