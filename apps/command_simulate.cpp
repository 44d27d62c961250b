// SPDX-License-Identifier: Apache-2.0

// invsim simulate: a garment on a moving body, and the forces in it.

#include <unistd.h>

#include <iostream>

#include "command.h"
#include "effects.h"
#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/logging.h"
#include "invsim/base/progress.h"
#include "invsim/base/stopwatch.h"
#include "invsim/base/threads.h"
#include "invsim/io/earlier_results.h"
#include "invsim/report/run_folder.h"
#include "invsim/report/simulation_writer.h"
#include "invsim/sim/relaxation.h"
#include "invsim/sim/scene.h"
#include "simulation_input.h"

namespace invsim {
namespace {

constexpr char kSimulateOut[] = "invsim_simulate";

std::string Note(const FrameStats& stats) {
  std::string note = std::to_string(stats.step.most_contacts) + " contacts";
  if (stats.step.missed > 0)
    note += ", " + std::to_string(stats.step.missed) + " steps missed";
  return note;
}

class SimulateCommand : public Command {
 public:
  std::string name() const override { return "simulate"; }
  std::string doc() const override {
    return "a garment on a moving body, with forces, strain and stress";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override;
  void AddOptions(OptionTable* table) override;
  ExitCode Run(const CommandContext& context) override;

 private:
  SimulationReport StartReport(const SimulationScene& scene,
                               const Simulator& simulator) const;
  void Simulate(const SimulationScene& scene,
                const CommandContext& context,
                Simulator* simulator,
                FrameWriter* writer,
                SimulationReport* report) const;

  SimulationInput input_;
  SceneOptions scene_;
  RelaxationOptions relaxation_;
  FrameWriterOptions output_;
  bool force_ = false;
};

void SimulateCommand::AddArguments(CLI::App* app, KeyFlags* flags) {
  flags->Add("--body", "input.body", "mannequin or an SMPL-layout npz");
  flags->Add("--motion", "input.motion", "embedded or an AMASS npz");
  flags->Add("--garment", "input.garment", "authored or an OBJ");
  flags->Add("--material", "scene.material", "named or an ARCSim json");
  flags->Add("--fps", "input.frames_per_second", "frames per second");
  flags->Add("--frames", "input.frames", "at most so many; 0: all");
  flags->Add("--friction", "contact.friction", "of the cloth on the body");
  flags->Add("--substeps", "step.substeps", "steps per frame");
  app->add_flag("--force", force_, "replace an earlier run in DIR");
}

void SimulateCommand::AddOptions(OptionTable* table) {
  table->AddSection("input", &input_);
  Describe(table, &scene_);
  table->AddSection("relaxation", &relaxation_);
  table->AddSection("output", &output_);
}

SimulationReport SimulateCommand::StartReport(
    const SimulationScene& scene, const Simulator& simulator) const {
  SimulationReport report;
  report.body = input_.body;
  report.motion = input_.motion.name;
  report.garment = input_.garment;
  report.material = scene_.material;
  report.body_vertices = scene.body.num_vertices();
  report.body_faces = static_cast<int>(scene.body.faces().cols());
  report.cloth_vertices = scene.garment.num_vertices();
  report.cloth_faces = scene.garment.num_faces();
  report.frames_wanted = scene.motion.num_frames();
  report.frames_per_second = scene.motion.frame_rate;
  report.threads = NumThreads();
  report.cloth_mass = simulator.mass().sum();
  report.thickness = scene_.contact.thickness;
  report.friction = scene_.contact.friction;
  report.tolerance = scene_.step.friction.tolerance;
  report.effects = scene_.decisions;
  return report;
}

void SimulateCommand::Simulate(const SimulationScene& scene,
                               const CommandContext& context,
                               Simulator* simulator,
                               FrameWriter* writer,
                               SimulationReport* report) const {
  std::ostream* log = context.verbosity < 0 ? nullptr : &std::cerr;
  const ProgressStyle style = StyleFor(STDERR_FILENO);
  std::unique_ptr<Progress> dressing;
  report->relaxation =
      Relax({scene.body, scene.garment, scene.frames, scene.motion.frame_rate},
            relaxation_,
            simulator,
            [&](const RelaxationFrame& f) {
              if (!dressing)
                dressing = std::make_unique<Progress>(
                    log, style, "dressing", f.most_frames);
              dressing->Advance(std::string(PhaseName(f.phase)) + ", " +
                                Note(f.stats));
            });
  dressing.reset();
  if (report->relaxation.status != RunStatus::kComplete) return;
  Progress frames(log, style, "frames", report->frames_wanted);
  ClothState cloth = report->relaxation.cloth;
  report->sequence = SimulateSequence(
      simulator,
      [&](int t) { return scene.body.Vertices(scene.frames[t]); },
      report->frames_wanted,
      report->frames_per_second,
      &cloth,
      [&](const SimulatedFrame& f) {
        writer->AddFrame(f);
        frames.Advance(Note(f.stats));
      });
}

ExitCode SimulateCommand::Run(const CommandContext& context) {
  const Stopwatch watch;
  const InterruptGuard interrupt;
  input_.motion.up_is_said = context.options->IsSet("input.motion_up");
  const SimulationScene scene = LoadSimulation(input_, scene_.material);
  UseMaterialFriction(*context.options, scene.material, &scene_);
  DecideSceneEffects(
      {scene.body, scene.garment, scene.frames, scene.motion.frame_rate},
      scene.material,
      relaxation_,
      &scene_);
  Simulator simulator(
      MakeSetup(scene_, scene.body, scene.garment, scene.material));
  const RunFolder folder(context.out.empty() ? kSimulateOut : context.out,
                         force_,
                         {input_.body,
                          input_.motion.name,
                          input_.garment,
                          scene_.material,
                          context.config});
  folder.Write(kResolvedConfig, ResolvedToml(*context.options));
  WriteMotion(folder.File("body.npz"), scene.motion);
  SimulationReport report = StartReport(scene, simulator);
  FrameWriter writer(folder,
                     scene.garment,
                     scene.material,
                     scene.body.faces(),
                     report.frames_wanted,
                     report.frames_per_second,
                     output_);
  Simulate(scene, context, &simulator, &writer, &report);
  report.seconds = watch.seconds();
  WriteSimulation(folder, &writer, &report);

  if (MissedSteps(report) > 0)
    LOG(WARNING) << MissedSteps(report)
                 << " steps missed the contact tolerance; see "
                 << folder.File("report.json");
  if (report.relaxation.status == RunStatus::kComplete &&
      !report.relaxation.at_rest)
    LOG(WARNING) << "the cloth was not at rest when the sequence began";
  if (context.json) {
    std::cout << SimulationJson(report);
  } else {
    std::cout << Verdict(report) << "\n" << folder.path() << "\n";
  }
  switch (Status(report)) {
    case RunStatus::kComplete:
      return ExitCode::kOk;
    case RunStatus::kInterrupted:
      return ExitCode::kInterrupted;
    default:
      return ExitCode::kFailed;
  }
}

}  // namespace

std::unique_ptr<Command> MakeSimulateCommand() {
  return std::make_unique<SimulateCommand>();
}

}  // namespace invsim
