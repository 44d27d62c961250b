// SPDX-License-Identifier: Apache-2.0

// invsim compare: the same fit by several optimisers.

#include <unistd.h>

#include <iostream>

#include "command.h"
#include "effects.h"
#include "fit_inputs.h"
#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/names.h"
#include "invsim/io/earlier_results.h"
#include "invsim/report/chart.h"
#include "invsim/report/comparison_report.h"
#include "invsim/report/run_folder.h"
#include "invsim/sim/scene.h"

namespace invsim {
namespace {

constexpr char kCompareOut[] = "invsim_compare";

struct CompareOptions {
  std::vector<std::string> optimizers = Optimizers().names();
  std::string truth;
};

void Describe(OptionTable* table, CompareOptions* o) {
  table->Add("optimizers",
             &o->optimizers,
             {.doc = "in this order", .choices = Optimizers().names()});
  table->Add("truth",
             &o->truth,
             {.doc = "AMASS npz of the true body, for its error; empty: none"});
}

class CompareCommand : public Command {
 public:
  std::string name() const override { return "compare"; }
  std::string doc() const override {
    return "the same fit by several optimisers: cost and error against time";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override;
  void AddOptions(OptionTable* table) override;
  ExitCode Run(const CommandContext& context) override;

 private:
  std::optional<BodySequence> LoadTruth(int frames) const;

  FitInput input_;
  SceneOptions scene_;
  FitOptions fit_;
  CompareOptions compare_;
  bool force_ = false;
};

void CompareCommand::AddArguments(CLI::App* app, KeyFlags* flags) {
  AddFitInputFlags(flags);
  flags->Add("--optimizers", "compare.optimizers", "lm,dogleg,...");
  flags->Add("--truth", "compare.truth", "AMASS npz of the true body");
  flags->Add("--time-limit",
             "fit.time_limit",
             "seconds of each, without the start that they share; 0: none");
  app->add_flag("--force", force_, "replace an earlier comparison in DIR");
}

void CompareCommand::AddOptions(OptionTable* table) {
  table->AddSection("input", &input_);
  Describe(table, &scene_);
  Describe(table, &fit_);
  table->AddSection("compare", &compare_);
}

std::optional<BodySequence> CompareCommand::LoadTruth(int frames) const {
  if (compare_.truth.empty()) return std::nullopt;
  const Motion motion = ReadMotion(compare_.truth);
  if (motion.num_frames() < frames)
    throw InputError(compare_.truth + ": has " +
                     std::to_string(motion.num_frames()) +
                     " frames, expected at least " + std::to_string(frames));
  return BodySequence{motion.shape, motion.poses, motion.translations};
}

ExitCode CompareCommand::Run(const CommandContext& context) {
  if (compare_.optimizers.empty())
    throw UsageError("compare.optimizers is empty; expected some of " +
                     Join(Optimizers().names()));
  const InterruptGuard interrupt;
  const FitData data = LoadFitData(input_, scene_.material, context);
  UseMaterialFriction(*context.options, data.material, &scene_);
  // Refuses now what stage 1 need not be waited for.
  ChosenEffects(scene_, data.garment, data.material);
  const auto truth = LoadTruth(static_cast<int>(data.clouds.size()));
  std::vector<std::string> inputs = PathsOf(input_);
  inputs.insert(inputs.end(),
                {scene_.material, compare_.truth, context.config});
  const RunFolder folder(
      context.out.empty() ? kCompareOut : context.out, force_, inputs);
  fit_.dressings = 1;
  fit_.uncertainty = false;
  folder.Write(kResolvedConfig, ResolvedToml(*context.options));

  std::unique_ptr<Simulator> simulator;  // one for all
  FitScene scene{
      data.body,
      data.garment,
      [&](const BodySequence& start) {
        if (!simulator)
          simulator = MakeFitSimulator(
              data, start, input_.frames_per_second, fit_.relaxation, &scene_);
        return simulator.get();
      },
      data.clouds,
      input_.frames_per_second,
      data.start};
  scene.seed = static_cast<std::uint64_t>(context.run.seed);
  std::string current;
  FitObserver observer;
  observer.iteration = [&](const FitIteration& i) {
    if (context.verbosity >= 0)
      std::cerr << current << " " << i.record.iteration << ": cost "
                << ShortNumber(i.record.cost) << ", " << i.steps << " steps\n";
    return true;
  };
  const std::vector<ComparisonRun> runs =
      CompareOptimizers(scene,
                        &fit_,
                        compare_.optimizers,
                        truth,
                        observer,
                        [&](const std::string& name) { current = name; });
  WriteComparison(folder, runs);
  std::cout << (context.json ? ComparisonJson(runs) : ComparisonText(runs));
  if (!context.json) std::cout << folder.path() << "\n";
  if (InterruptRequested()) return ExitCode::kInterrupted;
  ExitCode worst = ExitCode::kOk;
  for (const ComparisonRun& run : runs)
    worst = Worse(worst, CodeOf(run.summary.termination));
  return worst;
}

}  // namespace

std::unique_ptr<Command> MakeCompareCommand() {
  return std::make_unique<CompareCommand>();
}

}  // namespace invsim
