// SPDX-License-Identifier: Apache-2.0

// invsim soak: random hard scenes for as long as wanted.

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>

#include "command.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/progress.h"
#include "invsim/base/stopwatch.h"
#include "invsim/io/earlier_results.h"
#include "invsim/report/run_folder.h"
#include "invsim/report/soak_report.h"
#include "invsim/study/random_scene.h"
#include "invsim/study/soak.h"

namespace invsim {
namespace {

struct SoakOptions {
  double seconds = 3600;
  int scenes = 0;
  bool people = false;
};

void Describe(OptionTable* table, SoakOptions* o) {
  table->Add("seconds",
             &o->seconds,
             {.doc = "how long scenes are begun", .unit = "s", .at_least = 0});
  table->Add(
      "scenes",
      &o->scenes,
      {.doc = "scenes at most; 0: as many as the time allows", .at_least = 0});
  table->Add("people", &o->people, {.doc = "only scenes of people"});
}

class SoakCommand : public Command {
 public:
  std::string name() const override { return "soak"; }
  std::string doc() const override {
    return "random hard scenes, from seed --seed on, for as long as wanted";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override {
    flags->Add("--seconds", "soak.seconds", "how long");
    flags->Add("--scenes", "soak.scenes", "how many at most; 1: only --seed");
    app->add_flag("--force", force_, "replace an earlier report in DIR");
  }
  void AddOptions(OptionTable* table) override {
    table->AddSection("soak", &options_);
  }
  ExitCode Run(const CommandContext& context) override;

 private:
  // Of the work, 0 to 1.
  double Done(const SoakResult& result, double seconds) const {
    const double time = seconds / std::max(options_.seconds, 1e-9);
    const double count =
        options_.scenes > 0
            ? static_cast<double>(result.scenes) / options_.scenes
            : 0;
    return std::min(1.0, std::max(time, count));
  }

  SoakOptions options_;
  bool force_ = false;
};

ExitCode SoakCommand::Run(const CommandContext& context) {
  const InterruptGuard interrupt;
  std::optional<RunFolder> folder;
  if (!context.out.empty()) {
    folder.emplace(
        context.out, force_, std::vector<std::string>{context.config});
    folder->Write(kResolvedConfig, ResolvedToml(*context.options));
  }
  SoakResult result;
  result.first_seed = static_cast<std::uint64_t>(context.run.seed);
  std::uint64_t next = result.first_seed;
  {
    const Stopwatch watch;
    Progress progress(context.verbosity < 0 ? nullptr : &std::cerr,
                      StyleFor(STDERR_FILENO),
                      "percent",
                      100);
    for (int percent = 0; percent < 100 && !InterruptRequested();) {
      const std::uint64_t seed = next++;
      if (options_.people && !IsPerson(seed)) continue;
      const RandomScene drawn = DrawScene(seed);
      result.Add(drawn, RunRandomScene(drawn));
      const int done = static_cast<int>(100 * Done(result, watch.seconds()));
      if (done <= percent) continue;
      progress.Advance(std::to_string(result.scenes) + " scenes, " +
                           std::to_string(result.failures.size()) + " failing",
                       done - percent);
      percent = done;
    }
  }
  if (folder) folder->Write("report.json", SoakJson(result));
  std::cout << (context.json ? SoakJson(result) : SoakText(result));
  // Stopped or not, it is a soak of so many scenes.
  return result.failures.empty() ? ExitCode::kOk : ExitCode::kFailed;
}

}  // namespace

std::unique_ptr<Command> MakeSoakCommand() {
  return std::make_unique<SoakCommand>();
}

}  // namespace invsim
