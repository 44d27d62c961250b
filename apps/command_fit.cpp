// SPDX-License-Identifier: Apache-2.0

// invsim init and invsim fit: from point clouds to the body under the clothes
// and the moving garment; init stops before the inverse simulation.

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "command.h"
#include "effects.h"
#include "fit_inputs.h"
#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/logging.h"
#include "invsim/base/progress.h"
#include "invsim/base/stopwatch.h"
#include "invsim/base/threads.h"
#include "invsim/fit/sequence_fit.h"
#include "invsim/io/earlier_results.h"
#include "invsim/report/chart.h"
#include "invsim/report/fit_writer.h"
#include "invsim/report/run_folder.h"
#include "invsim/sim/scene.h"
#include "presets.h"
#include "version.h"

namespace invsim {
namespace {

// What a resumed run may be asked anew; anything else would make another run
// of it. The iterations of an optimiser are in the list, too.
const std::vector<std::string> kMayChange = {"fit.time_limit",
                                             "fit.uncertainty",
                                             "output.ply",
                                             "output.most_poses",
                                             "run.threads"};

bool MayChange(const std::string& key) {
  return std::find(kMayChange.begin(), kMayChange.end(), key) !=
             kMayChange.end() ||
         key.ends_with(".iterations");
}

// All options but those a resumed run may be asked anew.
std::string FixedOptions(const OptionTable& table) {
  std::string text;
  for (const OptionTable::Option& option : table.options())
    if (!MayChange(option.key))
      text += option.key + " = " + TomlText(option.get()) + "\n";
  return text;
}

// One line of progress per stage.
class FitProgress {
 public:
  FitProgress(bool quiet, int frames)
      : log_(quiet ? nullptr : &std::cerr),
        style_(StyleFor(STDERR_FILENO)),
        frames_(frames) {}

  void Init(const std::string& what, int most) {
    Begin("initialisation", most)->Advance(what);
  }
  void Relaxation(const RelaxationFrame& f) {
    Begin("dressing", f.most_frames)->Advance(PhaseName(f.phase));
  }
  void Iteration(const IterationRecord& record, int most) {
    std::string note = "cost " + ShortNumber(record.cost);
    if (!record.successful) note += " (step refused)";
    if (record.iteration == 0) progress_.reset();  // of the next dressing
    Begin("iterations", most + 1)->Advance(note);
  }
  void Frame() { Begin("final simulation", frames_)->Advance(); }
  void End() { progress_.reset(); }

 private:
  Progress* Begin(const std::string& title, int total) {
    if (!progress_ || title != title_) {
      progress_.reset();
      progress_ = std::make_unique<Progress>(log_, style_, title, total);
      title_ = title;
    }
    return progress_.get();
  }

  std::ostream* log_;
  ProgressStyle style_;
  int frames_;
  std::string title_;
  std::unique_ptr<Progress> progress_;
};

class FitCommand : public Command {
 public:
  explicit FitCommand(bool optimize) : optimize_(optimize) {}
  std::string name() const override { return optimize_ ? "fit" : "init"; }
  std::string doc() const override {
    return optimize_
               ? "the body under the clothes, and the garment, from points"
               : "a first body for every frame, and the garment on it";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override;
  void AddOptions(OptionTable* table) override;
  void TakeConfig(Config* config) override { ApplyPreset(config); }
  ExitCode Run(const CommandContext& context) override;

 private:
  RunFolder OpenFolder(const CommandContext& context);
  void TakeOverConfiguration(const std::string& path);
  FitReport StartReport(const FitData& data) const;
  int Iterations() const;
  FitObserver Observer(const FitData& data,
                       FitProgress* progress,
                       FrameWriter* writer) const;
  void Warn(const FitReport& report, const RunFolder& folder) const;

  const bool optimize_;
  OptionTable* table_ = nullptr;
  FitInput input_;
  SceneOptions scene_;
  FitOptions fit_;
  PresetChoice preset_;
  FrameWriterOptions output_;
  bool force_ = false;
  bool resume_ = false;
};

void FitCommand::AddArguments(CLI::App* app, KeyFlags* flags) {
  AddFitInputFlags(flags);
  if (optimize_) {
    flags->Add("--optimizer", "fit.optimizer", "see invsim list optimizers");
    flags->Add("--loss", "data.loss", "see invsim list losses");
  }
  flags->Add("--preset", "fit.preset", "see invsim list presets");
  flags->Add("--time-limit", "fit.time_limit", "seconds; 0: none");
  CLI::Option* force =
      app->add_flag("--force", force_, "replace an earlier run in DIR");
  app->add_flag("--resume", resume_, "go on with the run in DIR")
      ->excludes(force);
}

void FitCommand::AddOptions(OptionTable* table) {
  table_ = table;
  table->AddSection("input", &input_);
  Describe(table, &scene_);
  Describe(table, &fit_);
  table->AddSection("fit", &preset_);
  table->AddSection("output", &output_);
}

// What the earlier run used, unless the user says otherwise where that is
// possible.
void FitCommand::TakeOverConfiguration(const std::string& path) {
  const Config earlier = Config::FromFile(path);
  Config config = earlier;
  for (const OptionTable::Option& option : table_->options()) {
    if (option.origin.empty()) continue;
    const auto found = earlier.entries().find(option.key);
    const std::string now = TomlText(option.get());
    if (found != earlier.entries().end() && !MayChange(option.key) &&
        TomlText(found->second.value) != now)
      throw UsageError(option.origin + ": " + option.key + " is " + now +
                       ", but was " + TomlText(found->second.value) + " in " +
                       path + "; a resumed run cannot change it");
    config.Set(option.key, now, option.origin);
  }
  table_->Read(config);
}

RunFolder FitCommand::OpenFolder(const CommandContext& context) {
  const std::string path =
      context.out.empty() ? "invsim_" + name() : context.out;
  if (!resume_) {
    std::vector<std::string> inputs = PathsOf(input_);
    inputs.insert(inputs.end(), {scene_.material, context.config});
    return RunFolder(path, force_, inputs);
  }
  RunFolder folder = RunFolder::Reopen(path);
  TakeOverConfiguration(folder.File(kResolvedConfig));
  return folder;
}

FitReport FitCommand::StartReport(const FitData& data) const {
  FitReport report;
  report.points = input_.points;
  report.body = input_.body;
  report.garment = input_.garment;
  report.material = scene_.material;
  report.frames = static_cast<int>(data.clouds.size());
  report.frames_per_second = input_.frames_per_second;
  report.fewest_points = report.most_points =
      static_cast<int>(data.clouds[0].cols());
  for (const Points& cloud : data.clouds) {
    const int n = static_cast<int>(cloud.cols());
    report.fewest_points = std::min(report.fewest_points, n);
    report.most_points = std::max(report.most_points, n);
  }
  report.points_dropped = data.dropped;
  report.points_filtered = data.filtered;
  report.body_vertices = data.body.num_vertices();
  report.cloth_vertices = data.garment.num_vertices();
  report.cloth_faces = data.garment.num_faces();
  report.threads = NumThreads();
  report.friction = scene_.contact.friction;
  report.thickness = scene_.contact.thickness;
  report.tolerance = scene_.step.friction.tolerance;
  report.optimizer = optimize_ ? fit_.optimizer : "none";
  report.loss = fit_.data.loss.name + " " +
                ShortNumber(1000 * fit_.data.loss.scale) + " mm";
  report.history = fit_.data.history;
  return report;
}

int FitCommand::Iterations() const {
  for (const OptionTable::Option& option : table_->options())
    if (option.key == fit_.optimizer + ".iterations")
      return static_cast<int>(std::get<std::int64_t>(option.get()));
  return 0;
}

FitObserver FitCommand::Observer(const FitData& data,
                                 FitProgress* progress,
                                 FrameWriter* writer) const {
  const int frames = static_cast<int>(data.clouds.size());
  const int init_steps = std::min(fit_.init.anchors, frames) + frames - 1 +
                         fit_.init.iterations + 1;
  FitObserver observer;
  observer.init = [=](const std::string& what) {
    progress->Init(what, init_steps);
    return true;
  };
  observer.relaxation = [=](const RelaxationFrame& f) {
    progress->Relaxation(f);
  };
  const int iterations = Iterations();
  observer.iteration = [=](const FitIteration& iteration) {
    progress->Iteration(iteration.record, iterations);
    return true;
  };
  observer.frame = [=, &data](const SimulatedFrame& f) {
    writer->AddFrame(f, &data.clouds[f.frame]);
    progress->Frame();
  };
  return observer;
}

void FitCommand::Warn(const FitReport& report, const RunFolder& folder) const {
  const FitResult& r = report.result;
  const Dressing* worn = r.kept < 0 ? nullptr : &r.rounds[r.kept].dressing;
  if (worn && worn->worn >= 0 && !worn->tries[worn->worn].relaxation->at_rest)
    LOG(WARNING) << "the cloth was not at rest when the fit began";
  if (r.stats.step.missed > 0)
    LOG(WARNING) << r.stats.step.missed
                 << " steps missed the contact tolerance; see "
                 << folder.File("report.json");
}

ExitCode FitCommand::Run(const CommandContext& context) {
  const Stopwatch watch;
  const InterruptGuard interrupt;
  std::optional<RunFolder> resumed;
  if (resume_) resumed = OpenFolder(context);
  const FitData data = LoadFitData(input_, scene_.material, context);
  UseMaterialFriction(*context.options, data.material, &scene_);
  // Refuses now what stage 1 need not be waited for.
  ChosenEffects(scene_, data.garment, data.material);
  const RunFolder folder = resumed ? *resumed : OpenFolder(context);
  std::unique_ptr<Simulator> simulator;
  FitScene scene{
      data.body,
      data.garment,
      [&](const BodySequence& start) {
        simulator = MakeFitSimulator(
            data, start, input_.frames_per_second, fit_.relaxation, &scene_);
        return simulator.get();
      },
      data.clouds,
      input_.frames_per_second,
      data.start};
  scene.optimize = optimize_;
  scene.seed = static_cast<std::uint64_t>(context.run.seed);
  scene.more_inputs = {{"the material", DigestOf(data.material)},
                       {"an option", DigestOf(FixedOptions(*context.options))},
                       {"the program", DigestOf(ProgramVersion())}};
  if (resumed) {  // refused with nothing changed
    scene.checkpoint = folder.Checkpoint();
    CheckInputs(scene);
  }
  folder.Write(kResolvedConfig, ResolvedToml(*context.options));
  scene.checkpoint = folder.Checkpoint();
  FitReport report = StartReport(data);
  FrameWriter writer(folder,
                     data.garment,
                     data.material,
                     data.body.faces(),
                     report.frames,
                     report.frames_per_second,
                     output_);
  FitProgress progress(context.verbosity < 0, report.frames);
  report.result = FitSequence(scene, fit_, Observer(data, &progress, &writer));
  progress.End();
  report.effects = scene_.decisions;
  report.seconds = watch.seconds();
  if (report.result.termination == Termination::kInterrupted) {
    std::cerr << "invsim: interrupted"
              << (report.result.resumable
                      ? "; go on with"
                      : " before the first body was found, nothing of which "
                        "is kept; begin again with")
              << ": invsim " << name() << " --resume --out " << folder.path()
              << std::endl;
    return ExitCode::kInterrupted;
  }
  WriteFit(folder, &writer, &report);
  Warn(report, folder);
  if (context.json)
    std::cout << FitJson(report);
  else
    std::cout << Verdict(report) << "\n" << folder.path() << "\n";
  return CodeOf(report.result.termination);
}

}  // namespace

std::unique_ptr<Command> MakeFitCommand() {
  return std::make_unique<FitCommand>(true);
}

std::unique_ptr<Command> MakeInitCommand() {
  return std::make_unique<FitCommand>(false);
}

}  // namespace invsim
