// SPDX-License-Identifier: Apache-2.0
#include "synth_grid.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <ostream>
#include <set>

#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/progress.h"
#include "invsim/study/sweep.h"
#include "recorded_run.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

// "dress_walk" of garment "data/dress.obj" and motion "walk".
std::string NameOf(const SweepSetting& setting) {
  std::string name;
  for (const auto& [key, toml] : setting.options) {
    std::string value = toml;
    value.erase(std::remove(value.begin(), value.end(), '"'), value.end());
    const bool file = value.find('/') != std::string::npos ||
                      fs::path(value).extension() == ".obj" ||
                      fs::path(value).extension() == ".npz";
    name += (name.empty() ? "" : "_") +
            (file ? fs::path(value).stem().string() : NameOfValue(toml));
  }
  return name;
}

}  // namespace

void SynthGrid::TakeConfig(Config* config,
                           const std::function<void(const Config&)>& check) {
  const auto& given = config->entries();
  if (std::none_of(given.begin(), given.end(), [](const auto& entry) {
        return entry.first.rfind("grid.", 0) == 0;
      }))
    throw UsageError(
        "synth grid: nothing to combine; expected a [grid] of lists, such as "
        "synth.garment = [\"tshirt\", \"dress\"]");
  const SweepPlan plan = TakeSweepPlan(config);
  if (!plan.base.empty() || plan.has_reference)
    throw UsageError(
        "synth grid: [base] and [reference] belong to sweeps; expected options "
        "of all sequences as they are, and [grid]");
  std::vector<std::string> common = {"synth", "sequence", "-q"};
  for (const auto& [key, entry] : config->entries())
    common.insert(common.end(), {"--set", key + "=" + TomlText(entry.value)});
  std::set<std::string> names;
  for (const SweepSetting& setting : plan.settings) {
    Config sequence = *config;
    sequence.Merge(ConfigOf(plan, setting));
    check(sequence);
    std::vector<std::string> arguments = common;
    for (const auto& [key, value] : setting.options)
      arguments.insert(arguments.end(), {"--set", key + "=" + value});
    const std::string name = NameOf(setting);
    if (!names.insert(name).second)
      throw UsageError("synth grid: two sequences are called '" + name +
                       "'; expected files of different names");
    sequences_.emplace_back(name, std::move(arguments));
  }
}

ExitCode SynthGrid::Run(const std::string& out,
                        bool force,
                        std::ostream* results,
                        std::ostream* log) const {
  const InterruptGuard interrupt;
  if (fs::exists(out) && !fs::is_directory(out))
    throw UsageError(out + ": is a file, expected a folder");
  Progress progress(log,
                    StyleFor(STDERR_FILENO),
                    "sequences",
                    static_cast<int>(sequences_.size()));
  bool complete = true;
  for (const auto& [name, arguments] : sequences_) {
    const RecordedRun run((fs::path(out) / name).string(), arguments);
    if (force)
      run.Forget();
    else
      run.ForgetIfKilled();
    const RunOutcome outcome = run.Run();
    if (outcome.exit_code == static_cast<int>(ExitCode::kInterrupted) ||
        InterruptRequested()) {
      std::cerr << "invsim: interrupted; the same command goes on with " << out
                << std::endl;
      return ExitCode::kInterrupted;
    }
    progress.Advance(name);
    complete = complete && outcome.usable();
    *results << (outcome.usable() ? "" : run.folder() + ": failed: ")
             << run.LastLine() << std::endl;
    if (!outcome.usable()) run.Forget();  // to be tried again
  }
  return complete ? ExitCode::kOk : ExitCode::kFailed;
}

}  // namespace invsim
