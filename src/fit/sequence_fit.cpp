// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/sequence_fit.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/stopwatch.h"
#include "invsim/fit/fit_checkpoint.h"
#include "invsim/fit/remembered_term.h"

namespace invsim {
namespace {

// Points closer together than this were not measured on anybody, m.
constexpr double kSmallestCloud = 0.01;

// Frames by which ways of dressing are compared.
constexpr size_t kJudgedFrames = 4;

void CheckClouds(const std::vector<Points>& clouds) {
  if (clouds.empty()) throw InputError("points: no frame");
  for (size_t t = 0; t < clouds.size(); ++t) {
    const std::string frame = "points of frame " + std::to_string(t);
    if (clouds[t].cols() == 0) throw InputError(frame + ": none");
    if (!clouds[t].allFinite()) throw InputError(frame + ": not all finite");
    const Vector3d size =
        clouds[t].rowwise().maxCoeff() - clouds[t].rowwise().minCoeff();
    if (size.maxCoeff() >= kSmallestCloud) continue;
    std::ostringstream text;
    text << frame << ": all " << clouds[t].cols() << " within "
         << 1000 * size.maxCoeff() << " mm; expected a person's";
    throw InputError(text.str());
  }
}

void CheckStart(const BodySequence& start, size_t frames) {
  const size_t given = start.poses.size() != frames ? start.poses.size()
                                                    : start.translations.size();
  if (given != frames)
    throw InputError("the start has " + std::to_string(given) +
                     " frames, expected one per point cloud, " +
                     std::to_string(frames));
  bool finite = start.shape.allFinite();
  for (size_t t = 0; t < frames; ++t)
    finite = finite && start.poses[t].allFinite() &&
             start.translations[t].allFinite();
  if (!finite) throw InputError("the start is not finite");
}

// `reason`, a sentence, with the most frequent cause of failures in it.
std::string WithCause(std::string reason,
                      const StepStats& stats,
                      int no_derivative) {
  std::string cause = no_derivative > 0 ? "there is no derivative" : "";
  int most = no_derivative;
  for (const auto& [why, count] : stats.failures) {
    if (count <= most) continue;
    most = count;
    cause = why;
  }
  if (cause.empty()) return reason;
  if (reason.ends_with('.')) reason.pop_back();
  return reason + ": " + cause + ".";
}

// All steps of all ways tried.
StepStats DressingSteps(const Dressing& dressing) {
  StepStats all;
  for (const DressingTry& tried : dressing.tries)
    if (tried.relaxation) all.Add(tried.relaxation->stats.step);
  return all;
}

class Fitter {
 public:
  Fitter(const FitScene& scene,
         const FitOptions& options,
         const FitObserver& observer)
      : scene_(scene),
        options_(options),
        observer_(observer),
        checkpoint_(scene.checkpoint) {
    CheckClouds(scene.clouds);
    if (scene.start) CheckStart(*scene.start, scene.clouds.size());
  }

  FitResult Run();

 private:
  bool TimeIsUp() const {
    return options_.time_limit > 0 && watch_.seconds() >= options_.time_limit;
  }
  bool MayGoOn() const { return !InterruptRequested() && !TimeIsUp(); }

  void FindStart();
  ClothPointsTerm Term(const std::vector<Points>& clouds,
                       const ClothReference& reference) const;
  double StartingCost(const ClothReference& reference) const;
  void DressStart();
  void Optimize(ClothPointsTerm* term);
  void Simulate(ClothPointsTerm* term);
  void FindUncertain(Objective* objective);
  void Conclude();

  const FitScene& scene_;
  const FitOptions& options_;
  const FitObserver& observer_;
  FitCheckpoint checkpoint_;
  Stopwatch watch_;
  FitResult result_;
};

// Stage 1.
void Fitter::FindStart() {
  const Stopwatch watch;
  const int frames = static_cast<int>(scene_.clouds.size());
  if (const auto kept = checkpoint_.LoadStart(frames)) {
    result_.start = *kept;
  } else if (scene_.start) {
    result_.start = *scene_.start;
  } else {
    result_.init = InitializeBody(
        scene_.body,
        scene_.garment,
        scene_.clouds,
        options_.init,
        scene_.seed,
        [this](const std::string& what) {
          return (!observer_.init || observer_.init(what)) && MayGoOn();
        });
    result_.start = result_.init->body;
  }
  if (MayGoOn()) checkpoint_.Save(result_.start);
  result_.seconds.init = watch.seconds();
}

ClothPointsTerm Fitter::Term(const std::vector<Points>& clouds,
                             const ClothReference& reference) const {
  return {scene_.body,
          scene_.simulator,
          scene_.garment.faces,
          VertexAreas(scene_.garment),
          clouds,
          scene_.frames_per_second,
          reference,
          options_.data};
}

// Of the first frames, from this cloth.
double Fitter::StartingCost(const ClothReference& reference) const {
  const auto judged = std::min<size_t>(kJudgedFrames, scene_.clouds.size());
  ClothPointsTerm term =
      Term({scene_.clouds.begin(), scene_.clouds.begin() + judged}, reference);
  std::vector<double> costs;
  if (term.Evaluate(result_.start, kNoLimit, &costs) != Evaluation::kDone)
    return kNoLimit;
  return std::accumulate(costs.begin(), costs.end(), 0.0);
}

// Stage 2.
void Fitter::DressStart() {
  const Stopwatch watch;
  result_.reference = checkpoint_.LoadReference(scene_.body.num_vertices(),
                                                scene_.garment.num_vertices());
  if (!result_.reference) result_.reference = scene_.reference;
  if (result_.reference) return;
  std::vector<BodyParameters> motion;
  for (int t = 0; t < result_.start.num_frames(); ++t)
    motion.push_back(result_.start.Frame(t));
  result_.dressing = Dress(
      {scene_.body, scene_.garment, motion, scene_.frames_per_second},
      options_.relaxation,
      scene_.simulator,
      [this](const ClothReference& cloth) { return StartingCost(cloth); },
      observer_.relaxation);
  result_.reference = result_.dressing.reference;
  if (result_.reference) checkpoint_.Save(*result_.reference);
  result_.seconds.dressing = watch.seconds();
}

// Stage 3, and the uncertainty of stage 4.
void Fitter::Optimize(ClothPointsTerm* term) {
  std::unique_ptr<RememberedTerm> remembered;
  if (checkpoint_.kept())
    remembered =
        std::make_unique<RememberedTerm>(term, checkpoint_.evaluations());
  Objective objective(
      options_.priors,
      FreeParameters{},
      remembered ? static_cast<DataTerm*>(remembered.get()) : term,
      &result_.body);
  const Stopwatch watch;
  const auto observer = [&](const IterationRecord& record) {
    const bool wanted =
        !observer_.iteration ||
        observer_.iteration(
            {record, result_.body, term->rollout().stats().substeps});
    const bool written = !remembered || remembered->error().empty();
    return wanted && written && MayGoOn();
  };
  result_.optimizer = options_.optimizers.at(options_.optimizer)
                          ->Make()
                          ->Run(&objective, observer);
  result_.seconds.optimization = watch.seconds();
  if (remembered) {
    result_.recalled = remembered->recalled();
    if (!remembered->error().empty()) throw InputError(remembered->error());
  }
  if (result_.optimizer->usable() && options_.uncertainty && MayGoOn())
    FindUncertain(&objective);
}

void Fitter::FindUncertain(Objective* objective) {
  const Stopwatch watch;
  result_.uncertainty = FindUncertainty(options_.priors, objective);
  result_.seconds.uncertainty = watch.seconds();
}

// Stage 4.
void Fitter::Simulate(ClothPointsTerm* term) {
  const Stopwatch watch;
  std::vector<double> costs;
  term->rollout().set_on_frame(observer_.frame);
  result_.simulated =
      term->Evaluate(result_.body, kNoLimit, &costs) == Evaluation::kDone;
  if (result_.simulated) result_.costs = term->costs();
  result_.seconds.final_simulation = watch.seconds();
}

void Fitter::Conclude() {
  result_.termination = Termination::kConverged;
  result_.reason = "The initialisation is done.";
  if (result_.optimizer) {
    const OptimizerSummary& optimizer = *result_.optimizer;
    result_.termination = optimizer.termination;
    result_.reason = optimizer.reason;
    if (!optimizer.usable() || optimizer.termination == Termination::kStalled)
      result_.reason = WithCause(
          optimizer.reason, result_.stats.step, optimizer.counts.no_derivative);
  }
  if (!result_.simulated) {
    result_.termination = Termination::kFailed;
    result_.reason = "The garment cannot be simulated on the body found.";
    if (result_.reference)
      result_.reason = WithCause(result_.reason, result_.stats.step, 0);
    else
      result_.reason =
          WithCause("The garment cannot be dressed on the first body.",
                    DressingSteps(result_.dressing),
                    0);
  }
  // Who stopped early was told to.
  const bool early = result_.termination == Termination::kInterrupted ||
                     !result_.simulated || !result_.optimizer;
  if (InterruptRequested()) {
    result_.termination = Termination::kInterrupted;
    result_.reason = "Interrupted.";
  } else if (early && TimeIsUp() && result_.simulated) {
    result_.termination = Termination::kTimeLimit;
    result_.reason = "The time limit was reached.";
  }
}

FitResult Fitter::Run() {
  FindStart();
  result_.body = result_.start;
  if (!InterruptRequested()) DressStart();
  if (result_.reference && !InterruptRequested()) {
    ClothPointsTerm term = Term(scene_.clouds, *result_.reference);
    if (scene_.optimize && MayGoOn()) Optimize(&term);
    for (PoseVector& pose : result_.body.poses) Canonicalize(&pose);
    if (!InterruptRequested()) Simulate(&term);
    result_.stats = term.stats();
  }
  Conclude();
  return std::move(result_);
}

}  // namespace

FitOptions::FitOptions() {
  for (const std::string& name : Optimizers().names())
    optimizers[name] = Optimizers().Choose(name);
}

void Describe(OptionTable* table, FitOptions* o) {
  table->AddSection("init", &o->init);
  table->AddSection("relaxation", &o->relaxation);
  table->AddSection("data", &o->data);
  table->AddSection("priors", &o->priors);
  table->Add("fit.optimizer",
             &o->optimizer,
             {.doc = "what moves the body", .choices = Optimizers().names()});
  table->Add("fit.uncertainty",
             &o->uncertainty,
             {.doc = "whether the covariance of the unknowns is found"});
  table->Add("fit.time_limit",
             &o->time_limit,
             {.doc = "end with what there is after this time; 0: never",
              .unit = "s",
              .at_least = 0});
  for (const std::string& name : Optimizers().names())
    table->AddSection(name, o->optimizers.at(name).get());
}

FitResult FitSequence(const FitScene& scene,
                      const FitOptions& options,
                      const FitObserver& observer) {
  return Fitter(scene, options, observer).Run();
}

}  // namespace invsim
