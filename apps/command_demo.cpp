// SPDX-License-Identifier: Apache-2.0

// invsim demo: the whole way on embedded input. It runs the commands a user
// would type, and shows them:
//
//   1. synth sequence   points of a clothed person, from a finer garment, more
//                       steps and another material than the fit uses, so that
//                       the fit does not find its own echo
//   2. fit              from a disturbed start
//
// and prints how far the body and the cloth are from the truth.

#include <iomanip>
#include <iostream>

#include "child_process.h"
#include "command.h"
#include "dispatcher.h"
#include "inputs.h"
#include "invsim/base/error.h"
#include "invsim/base/stopwatch.h"
#include "invsim/geometry/chamfer.h"
#include "invsim/io/earlier_results.h"
#include "invsim/io/ply.h"
#include "invsim/report/chart.h"
#include "invsim/report/run_folder.h"
#include "invsim/study/clothed_sequence.h"
#include "invsim/study/disturbance.h"
#include "invsim/study/optimizer_comparison.h"
#include "invsim/study/truth.h"

namespace invsim {
namespace {

constexpr char kDemoOut[] = "invsim_demo";

struct DemoOptions {
  int frames = 12;
  DisturbanceOptions start;
};
void Describe(OptionTable* table, DemoOptions* o) {
  table->Add("frames", &o->frames, {.doc = "of the sequence", .at_least = 2});
  table->AddSection("start", &o->start);
}

using Line = std::vector<std::string>;

bool Usable(ExitCode code) {
  return code == ExitCode::kOk || code == ExitCode::kStoppedEarly;
}

BodySequence AsSequence(const Motion& motion) {
  return {motion.shape, motion.poses, motion.translations};
}

// Mean over frames of the distance between two surfaces, from the vertices of
// each to the other, m.
double ClothError(const Truth& truth,
                  const Faces& truth_faces,
                  const std::string& run) {
  double sum = 0;
  for (size_t t = 0; t < truth.cloth.size(); ++t) {
    char name[32];
    std::snprintf(name, sizeof(name), "/cloth/%06d.ply", static_cast<int>(t));
    const PlyMesh cloth = ReadPly(run + name);
    const SurfaceIndex found(cloth.vertices, cloth.faces);
    const SurfaceIndex wanted(truth.cloth[t], truth_faces);
    sum += 0.5 * (DistancesToSurface(truth.cloth[t], found).mean() +
                  DistancesToSurface(cloth.vertices, wanted).mean());
  }
  return sum / truth.cloth.size();
}

class DemoCommand : public Command {
 public:
  std::string name() const override { return "demo"; }
  std::string doc() const override {
    return "make a clothed sequence, fit it, and say how well that went";
  }
  void AddArguments(CLI::App* app, KeyFlags* flags) override {
    flags->Add("--frames", "demo.frames", "of the sequence");
    app->add_flag("--force", force_, "replace an earlier demo in DIR");
  }
  void AddOptions(OptionTable* table) override {
    table->AddSection("demo", &options_);
  }
  ExitCode Run(const CommandContext& context) override;

 private:
  // Runs `invsim LINE` in this process.
  ExitCode RunLine(Line line, const CommandContext& context) const;
  Line SynthLine(const std::string& sequence) const;
  Line FitLine(const std::string& sequence,
               const std::string& start,
               const std::string& run) const;
  void PrintTable(const Truth& truth,
                  const BodySequence& start,
                  const std::string& sequence,
                  const std::string& run,
                  double seconds) const;

  DemoOptions options_;
  bool force_ = false;
};

ExitCode DemoCommand::RunLine(Line line, const CommandContext& context) const {
  line.insert(line.end(), {"--threads", std::to_string(context.run.threads)});
  line.insert(line.end(), {"--seed", std::to_string(context.run.seed)});
  if (context.verbosity < 0) line.push_back("-q");
  if (force_) line.push_back("--force");
  std::cerr << "\n$ " << ShellLine(line) << std::endl;
  line.insert(line.begin(), "invsim");
  std::vector<char*> arguments;
  for (std::string& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return static_cast<ExitCode>(
      Dispatch(AllCommands(), static_cast<int>(line.size()), arguments.data()));
}

Line DemoCommand::SynthLine(const std::string& sequence) const {
  return {"synth",      "sequence",
          "--body",     "mannequin",
          "--motion",   "walk_in_place",
          "--garment",  "tshirt",
          "--edge",     "0.025",
          "--material", "cotton",
          "--frames",   std::to_string(options_.frames),
          "--points",   "4000",
          "--set",      "synth.shape=[0.8, -0.6, 0.5, 0.4]",
          "--set",      "step.substeps=6",
          "--out",      sequence};
}

Line DemoCommand::FitLine(const std::string& sequence,
                          const std::string& start,
                          const std::string& run) const {
  return {"fit",
          "--points",
          sequence + "/points",
          "--body",
          "mannequin",
          "--garment",
          "tshirt",
          "--set",
          "input.edge=0.033",
          "--material",
          "jersey",
          "--fps",
          "30",
          "--start",
          start,
          "--out",
          run};
}

void DemoCommand::PrintTable(const Truth& truth,
                             const BodySequence& start,
                             const std::string& sequence,
                             const std::string& run,
                             double seconds) const {
  const BodyModel body = LoadBody("mannequin");
  const BodySequence wanted = AsSequence(truth.body);
  const BodySequence found = AsSequence(ReadMotion(run + "/body.npz"));
  const auto t_pose = [&](const BodySequence& x) {
    BodySequence standing;
    standing.shape = x.shape;
    standing.Append({});
    return standing;
  };
  const Garment garment = ReadGarment(sequence + "/garment.obj");
  const auto row = [](const char* name, double before, double after) {
    std::cout << "  " << std::left << std::setw(34) << name << std::right
              << std::setw(8) << ShortNumber(1000 * before) << std::setw(8)
              << ShortNumber(1000 * after) << "\n";
  };
  std::cout << "\nMean distance from the truth [mm]      before   after\n";
  row("body (all vertices, all frames)",
      BodyError(body, start, wanted),
      BodyError(body, found, wanted));
  row("shape alone (body in the T-pose)",
      BodyError(body, t_pose(start), t_pose(wanted)),
      BodyError(body, t_pose(found), t_pose(wanted)));
  std::cout << "  " << std::left << std::setw(34)
            << "cloth (surface to surface)" << std::right << std::setw(16)
            << ShortNumber(1000 * ClothError(truth, garment.faces, run))
            << "\nTime: " << ShortNumber(seconds) << " s in all\n"
            << "Look at " << run << "/report.html (a browser), " << run
            << "/scene.glb (Blender), " << run << "/solver.txt\n";
}

ExitCode DemoCommand::Run(const CommandContext& context) {
  const Stopwatch watch;
  const std::string out = context.out.empty() ? kDemoOut : context.out;
  const std::string sequence = out + "/sequence", run = out + "/fit",
                    start_path = out + "/start.npz";
  const RunFolder folder(out, force_, {context.config});
  folder.Write(kResolvedConfig, ResolvedToml(*context.options));
  ExitCode code = RunLine(SynthLine(sequence), context);
  if (!Usable(code)) return code;
  const Truth truth = ReadTruth(sequence + "/truth.npz");
  const BodySequence start =
      Disturb(AsSequence(truth.body),
              options_.start,
              static_cast<std::uint64_t>(context.run.seed));
  Motion motion = truth.body;
  motion.shape = start.shape;
  motion.poses = start.poses;
  motion.translations = start.translations;
  WriteMotion(start_path, motion);
  code = RunLine(FitLine(sequence, start_path, run), context);
  if (!Usable(code)) return code;
  PrintTable(truth, start, sequence, run, watch.seconds());
  return ExitCode::kOk;
}

}  // namespace

std::unique_ptr<Command> MakeDemoCommand() {
  return std::make_unique<DemoCommand>();
}

}  // namespace invsim
