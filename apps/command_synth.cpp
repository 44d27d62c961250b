// SPDX-License-Identifier: Apache-2.0

// invsim synth: writes what is embedded to files, to start from or to look at,
// and makes sequences of measured points with known truth, one or a grid.

#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "command.h"
#include "effects.h"
#include "inputs.h"
#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/logging.h"
#include "invsim/base/names.h"
#include "invsim/base/progress.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/report/chart.h"
#include "invsim/study/clothed_sequence.h"
#include "synth_grid.h"

namespace invsim {
namespace {

constexpr char kGrid[] = "grid";

struct SynthOptions {
  std::string body = "mannequin";
  std::string garment = "tshirt";
  AuthoredGarmentOptions authored;
  MotionInput motion;
};

void Describe(OptionTable* table, SynthOptions* o) {
  table->Add("body", &o->body, {.doc = "mannequin or an SMPL-layout npz"});
  table->Add(
      "garment",
      &o->garment,
      {.doc = "an authored garment; for a sequence also the path of an OBJ"});
  Describe(table, &o->authored);
  Describe(table, &o->motion);
}

class SynthCommand : public Command {
 public:
  std::string name() const override { return "synth"; }
  std::string doc() const override {
    return "write the embedded body, a garment made to measure, a motion, or "
           "sequences of measured points with their truth";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override;
  void AddOptions(OptionTable* table) override {
    table->AddSection("synth", &options_);
    Describe(table, &physics_);
    table->AddSection("relaxation", &sequence_.relaxation);
    table->AddSection("measurement", &sequence_.measurement);
  }
  void TakeConfig(Config* config) override {
    if (what_ != kGrid) return;
    grid_.TakeConfig(config, [](const Config& sequence) {
      SynthCommand command;
      RunOptions run;
      OptionTable table;
      ReadOptions(&command, &run, sequence, &table);
    });
  }
  ExitCode Run(const CommandContext& context) override;

 private:
  // The file written if --out does not say.
  std::string DefaultFile() const;
  std::string Write(const std::string& path) const;
  ExitCode WriteSequence(const CommandContext& context);

  std::string what_;
  std::string name_;
  SynthOptions options_;
  SceneOptions physics_;
  ClothedSequenceOptions sequence_;
  SynthGrid grid_;
  bool force_ = false;
};

void SynthCommand::AddArguments(CLI::App* app, KeyFlags* flags) {
  app->add_option("WHAT",
                  what_,
                  "body, garment, motion, sequence or grid (of sequences)")
      ->required();
  app->add_option("--name", name_, "of the garment or the motion")
      ->option_text("NAME");
  flags->Add("--body", "synth.body", "mannequin or an SMPL-layout npz");
  flags->Add("--garment", "synth.garment", "authored, or an OBJ");
  flags->Add("--motion", "synth.motion", "embedded or an AMASS npz");
  flags->Add("--material", "scene.material", "of a sequence");
  flags->Add("--points", "measurement.points", "of a sequence, per frame");
  flags->Add("--noise", "measurement.noise", "of a sequence, m");
  flags->Add("--edge", "synth.edge", "edge length of the garment, m");
  flags->Add("--ease", "synth.ease", "distance from the skin, m");
  flags->Add("--frames", "synth.frames", "of the motion");
  flags->Add("--fps", "synth.frames_per_second", "of the motion");
  app->add_flag("--force", force_, "overwrite the file or sequence");
}

std::string SynthCommand::DefaultFile() const {
  if (what_ == "body") return "mannequin.npz";
  if (what_ == "garment") return options_.garment + ".obj";
  if (what_ == "sequence") return "invsim_sequence";
  if (what_ == kGrid) return "invsim_sequences";
  return options_.motion.name + ".npz";
}

// Returns what was written, in a few words.
std::string SynthCommand::Write(const std::string& path) const {
  const BodyModel body = LoadBody(options_.body);
  if (what_ == "body") {
    WriteBodyModel(path, body);
    return std::to_string(body.num_vertices()) + " vertices";
  }
  if (what_ == "garment") {
    const Garment garment =
        LoadGarment(options_.garment, body, options_.authored);
    WriteGarment(path, garment);
    return std::to_string(garment.num_vertices()) + " vertices, " +
           std::to_string(garment.num_faces()) + " faces";
  }
  const Motion motion = LoadMotion(options_.motion, body);
  WriteMotion(path, motion);
  return std::to_string(motion.num_frames()) + " frames";
}

ExitCode SynthCommand::WriteSequence(const CommandContext& context) {
  const InterruptGuard interrupt;
  const std::string path = context.out.empty() ? DefaultFile() : context.out;
  const BodyModel body = LoadBody(options_.body);
  const Garment garment =
      LoadGarment(options_.garment, body, options_.authored);
  CheckGarmentFits(garment, body, ShapeVector::Zero(), options_.garment);
  const Motion motion = LoadMotion(options_.motion, body);
  const Material material = FindMaterial(physics_.material);
  UseMaterialFriction(*context.options, material, &physics_);
  const std::vector<BodyParameters> frames = motion.Frames();
  DecideSceneEffects({body, garment, frames, motion.frame_rate},
                     material,
                     sequence_.relaxation,
                     &physics_);
  sequence_.seed = static_cast<std::uint64_t>(context.run.seed);
  sequence_.config = ResolvedToml(*context.options);
  sequence_.force = force_;
  sequence_.inputs = {options_.body,
                      options_.motion.name,
                      options_.garment,
                      physics_.material,
                      context.config};
  std::ostream* log = context.verbosity < 0 ? nullptr : &std::cerr;
  std::string title;
  std::unique_ptr<Progress> progress;
  const ClothedSequenceResult made = MakeClothedSequence(
      {body,
       garment,
       material,
       motion,
       {options_.body, options_.motion.name, options_.garment}},
      physics_,
      sequence_,
      path,
      [&](const char* what, int, int total, const FrameStats&) {
        if (title != what) {
          progress.reset();
          progress = std::make_unique<Progress>(
              log, StyleFor(STDERR_FILENO), what, total);
          title = what;
        }
        progress->Advance();
      });
  progress.reset();
  if (made.status() == RunStatus::kInterrupted) return ExitCode::kInterrupted;
  if (made.status() == RunStatus::kFailed) {
    LOG(ERROR) << path << ": the simulation failed; nothing was written";
    return ExitCode::kFailed;
  }
  const StepStats& steps = made.sequence.stats.step;
  if (steps.missed > 0)
    LOG(WARNING) << steps.missed << " of " << steps.substeps
                 << " steps missed the contact tolerance";
  if (!made.relaxation.at_rest)
    LOG(WARNING) << "the cloth was not at rest when the sequence began";
  std::cout << path << ": " << motion.num_frames() << " frames of "
            << sequence_.measurement.points << " points, "
            << garment.num_vertices() << " cloth vertices, penetration "
            << ShortNumber(1000 * made.sequence.stats.penetration.deepest)
            << " mm\n";
  return ExitCode::kOk;
}

ExitCode SynthCommand::Run(const CommandContext& context) {
  const std::vector<std::string> kinds = {
      "body", "garment", "motion", "sequence", kGrid};
  if (std::find(kinds.begin(), kinds.end(), what_) == kinds.end())
    throw UsageError(UnknownName("kind", what_, kinds));
  if (!name_.empty() && what_ == "garment") options_.garment = name_;
  if (!name_.empty() && what_ == "motion") options_.motion.name = name_;
  options_.motion.up_is_said = context.options->IsSet("synth.motion_up");
  if (what_ == "sequence") return WriteSequence(context);
  const std::string path = context.out.empty() ? DefaultFile() : context.out;
  if (what_ == kGrid)
    return grid_.Run(
        path, force_, &std::cout, context.verbosity < 0 ? nullptr : &std::cerr);
  if (std::filesystem::exists(path) && !force_)
    throw UsageError(path + ": exists; choose another --out, or --force");
  const std::string done = Write(path);
  std::cout << path << ": " << done << "\n";
  return ExitCode::kOk;
}

}  // namespace

std::unique_ptr<Command> MakeSynthCommand() {
  return std::make_unique<SynthCommand>();
}

}  // namespace invsim
