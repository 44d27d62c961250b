// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/sequence_fit.h"

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <sstream>

#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/base/stopwatch.h"
#include "invsim/fit/fit_checkpoint.h"
#include "invsim/fit/remembered_term.h"
#include "prospects.h"

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

InputDigests Inputs(const FitScene& scene) {
  InputDigests inputs = scene.more_inputs;
  for (size_t t = 0; t < scene.clouds.size(); ++t)
    inputs["the points of frame " + std::to_string(t)] =
        DigestOf(scene.clouds[t]);
  inputs["the body"] = DigestOf(scene.body);
  inputs["the garment"] = DigestOf(scene.garment);
  std::ostringstream rate;
  rate << std::setprecision(17) << scene.frames_per_second;
  inputs["the frame rate"] = DigestOf(rate.str());
  inputs["the seed"] = DigestOf(std::to_string(scene.seed));
  if (scene.start) inputs["the start"] = DigestOf(*scene.start);
  if (scene.reference) inputs["the worn cloth"] = DigestOf(*scene.reference);
  return inputs;
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

// Nothing was kept yet, or this ended at less.
bool IsBetter(const FitRound& round, const FitResult& result) {
  if (result.kept < 0) return true;
  const OptimizerSummary* kept = result.optimizer();
  return kept && round.optimizer && round.optimizer->usable() &&
         round.optimizer->final_cost < kept->final_cost;
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
    CheckInputs(scene);
  }

  FitResult Run();

 private:
  bool TimeIsUp() const {
    return options_.time_limit > 0 && watch_.seconds() >= options_.time_limit;
  }
  bool MayGoOn() const {
    return !stopped_ && !InterruptRequested() && !TimeIsUp();
  }
  // An observer's answer.
  bool Heed(bool go_on) {
    stopped_ = stopped_ || !go_on;
    return MayGoOn();
  }

  void FindStart();
  void GoThroughRound();
  bool WantsAnotherRound() const;
  Dressing DressBody();
  std::unique_ptr<ClothPointsTerm> Term(const std::vector<Points>& clouds,
                                        const ClothReference& reference);
  double StartingCost(const ClothReference& reference);
  std::unique_ptr<RememberedTerm> Remembered(int round);
  std::optional<OptimizerSummary> Optimize(BodySequence* body);
  void FindUncertain();
  void Simulate();
  void Conclude();
  bool CutShort() const;

  const FitScene& scene_;
  const FitOptions& options_;
  const FitObserver& observer_;
  FitCheckpoint checkpoint_;
  Stopwatch watch_;
  bool stopped_ = false;                   // as an observer asked
  bool evaluation_stopped_ = false;        // one was cut short
  Simulator* simulator_ = nullptr;         // after stage 1
  std::unique_ptr<ClothPointsTerm> term_;  // none before something was worn
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
          return Heed(!observer_.init || observer_.init(what));
        },
        [this] { return !MayGoOn(); });
    result_.start = result_.init->body;
  }
  if (!result_.init || result_.init->complete) checkpoint_.Save(result_.start);
  result_.resumable = checkpoint_.HasStart();
  result_.seconds.init = watch.seconds();
}

std::unique_ptr<ClothPointsTerm> Fitter::Term(const std::vector<Points>& clouds,
                                              const ClothReference& reference) {
  auto term = std::make_unique<ClothPointsTerm>(scene_.body,
                                                simulator_,
                                                scene_.garment.faces,
                                                VertexAreas(scene_.garment),
                                                clouds,
                                                scene_.frames_per_second,
                                                reference,
                                                options_.data);
  term->set_stop([this] { return evaluation_stopped_ = !MayGoOn(); });
  return term;
}

// Of the first frames, from this cloth.
double Fitter::StartingCost(const ClothReference& reference) {
  const auto judged = std::min<size_t>(kJudgedFrames, scene_.clouds.size());
  const std::unique_ptr<ClothPointsTerm> term =
      Term({scene_.clouds.begin(), scene_.clouds.begin() + judged}, reference);
  std::vector<double> costs;
  if (term->Evaluate(result_.body, kNoLimit, &costs) != Evaluation::kDone)
    return kNoLimit;
  return std::accumulate(costs.begin(), costs.end(), 0.0);
}

// Stage 2, on the best body so far.
Dressing Fitter::DressBody() {
  const int round = static_cast<int>(result_.rounds.size());
  Dressing known;
  known.reference =
      checkpoint_.LoadReference(round,
                                scene_.body.Vertices(result_.body.Frame(0)),
                                scene_.garment.num_vertices());
  if (!known.reference) known.reference = scene_.reference;
  if (known.reference) return known;
  const Stopwatch watch;
  // Something has to be worn, however late it is.
  bool wearable = result_.kept >= 0;
  std::vector<BodyParameters> motion;
  for (int t = 0; t < result_.body.num_frames(); ++t)
    motion.push_back(result_.body.Frame(t));
  Dressing dressing = Dress(
      {scene_.body, scene_.garment, motion, scene_.frames_per_second},
      options_.relaxation,
      simulator_,
      [&](const ClothReference& cloth) {
        wearable = true;
        return StartingCost(cloth);
      },
      observer_.relaxation,
      [&] { return wearable && !MayGoOn(); });
  if (dressing.reference && !dressing.cut_short)
    checkpoint_.Save(round, *dressing.reference);
  result_.seconds.dressing += watch.seconds();
  return dressing;
}

// The term with what is known of it from that round; null if nothing is kept.
std::unique_ptr<RememberedTerm> Fitter::Remembered(int round) {
  if (!checkpoint_.kept()) return nullptr;
  return std::make_unique<RememberedTerm>(term_.get(),
                                          checkpoint_.Evaluations(round));
}

// Stage 3; nothing if it was stopped before its start was evaluated.
std::optional<OptimizerSummary> Fitter::Optimize(BodySequence* body) {
  const Stopwatch watch;
  const std::unique_ptr<RememberedTerm> remembered =
      Remembered(static_cast<int>(result_.rounds.size()));
  Objective objective(
      options_.priors,
      FreeParameters{},
      remembered ? static_cast<DataTerm*>(remembered.get()) : term_.get(),
      body,
      scene_.body);
  const std::unique_ptr<Optimizer> optimizer =
      options_.optimizers.at(options_.optimizer)->Make();
  const OptimizerSummary* kept = result_.optimizer();
  Prospects prospects(
      kept && optimizer->first_step_gains_most() ? kept->final_cost : kNoLimit);
  const auto observer = [&](const IterationRecord& record) {
    const bool written = !remembered || remembered->error().empty();
    prospects.Update(record);
    return Heed(!observer_.iteration ||
                observer_.iteration(
                    {record, *body, term_->rollout().stats().substeps})) &&
           written && prospects.good();
  };
  OptimizerSummary summary = optimizer->Run(&objective, observer);
  if (!prospects.good() && MayGoOn()) {
    summary.termination = Termination::kGivenUp;
    summary.reason = prospects.reason();
  }
  result_.seconds.optimization += watch.seconds();
  if (remembered) {
    result_.recalled += remembered->recalled();
    if (!remembered->error().empty()) throw InputError(remembered->error());
  }
  if (evaluation_stopped_) {  // whatever the optimiser made of it
    if (summary.iterations.empty()) return std::nullopt;
    summary.termination = Termination::kInterrupted;
    summary.reason = "A stop was asked for.";
  }
  return summary;
}

// Stages 2 and 3, from the best body so far.
void Fitter::GoThroughRound() {
  FitRound& round = result_.rounds.emplace_back();
  round.dressing = DressBody();
  if (!round.dressing.reference || InterruptRequested()) return;
  if (term_)
    term_->set_reference(*round.dressing.reference);
  else
    term_ = Term(scene_.clouds, *round.dressing.reference);
  BodySequence body = result_.body;
  if (scene_.optimize && MayGoOn()) round.optimizer = Optimize(&body);
  if (!IsBetter(round, result_)) return;
  result_.body = body;
  result_.kept = static_cast<int>(result_.rounds.size()) - 1;
}

bool Fitter::WantsAnotherRound() const {
  const std::optional<OptimizerSummary>& last = result_.rounds.back().optimizer;
  // From a body that was not found anew it would be the same again.
  const bool anew = result_.kept + 1 == static_cast<int>(result_.rounds.size());
  return last && anew &&
         (last->termination == Termination::kConverged ||
          last->termination == Termination::kIterationLimit) &&
         !scene_.reference &&
         static_cast<int>(result_.rounds.size()) < options_.dressings;
}

// Of stage 4.
void Fitter::FindUncertain() {
  const std::unique_ptr<RememberedTerm> remembered =
      Remembered(result_.kept + 1);
  Objective objective(
      options_.priors,
      FreeParameters{},
      remembered ? static_cast<DataTerm*>(remembered.get()) : term_.get(),
      &result_.body,
      scene_.body);
  result_.uncertainty = FindUncertainty(&objective);
  result_.seconds.uncertainty = result_.uncertainty->seconds;
  if (evaluation_stopped_) result_.uncertainty.reset();
}

// Stage 4.
void Fitter::Simulate() {
  const Stopwatch watch;
  for (PoseVector& pose : result_.body.poses) Canonicalize(&pose);
  std::vector<double> costs;
  term_->set_stop({});  // without it there is no result
  term_->rollout().set_on_frame(observer_.frame);
  result_.simulated =
      term_->Evaluate(result_.body, kNoLimit, &costs) == Evaluation::kDone;
  if (result_.simulated) result_.costs = term_->costs();
  result_.seconds.final_simulation = watch.seconds();
}

// Whether something was left out because of a wish to stop.
bool Fitter::CutShort() const {
  const OptimizerSummary* optimizer = result_.optimizer();
  if (!optimizer) return scene_.optimize || !MayGoOn();
  const FitRound& last = result_.rounds.back();
  const bool begun =
      last.optimizer || (!last.dressing.reference && !last.dressing.cut_short);
  const bool ended = !last.optimizer ||
                     last.optimizer->termination != Termination::kInterrupted;
  const bool uncertain = options_.uncertainty && optimizer->usable();
  return !begun || !ended || WantsAnotherRound() ||
         (uncertain && !result_.uncertainty);
}

void Fitter::Conclude() {
  result_.termination = Termination::kConverged;
  result_.reason = "The initialisation is done.";
  const OptimizerSummary* optimizer = result_.optimizer();
  if (optimizer) {
    result_.termination = optimizer->termination;
    result_.reason = optimizer->reason;
    if (!optimizer->usable() || optimizer->termination == Termination::kStalled)
      result_.reason = WithCause(optimizer->reason,
                                 result_.stats.step,
                                 result_.counts().no_derivative);
  }
  if (!result_.simulated) {
    result_.termination = Termination::kFailed;
    result_.reason = "The garment cannot be simulated on the body found.";
    if (result_.kept >= 0)
      result_.reason = WithCause(result_.reason, result_.stats.step, 0);
    else if (!result_.rounds.empty())
      result_.reason =
          WithCause("The garment cannot be dressed on the first body.",
                    DressingSteps(result_.rounds.front().dressing),
                    0);
  }
  if (InterruptRequested()) {
    result_.termination = Termination::kInterrupted;
    result_.reason = "Interrupted.";
  } else if (result_.simulated && CutShort()) {
    result_.termination =
        stopped_ ? Termination::kInterrupted : Termination::kTimeLimit;
    result_.reason =
        stopped_ ? "Stopped as asked." : "The time limit was reached.";
  }
}

FitResult Fitter::Run() {
  FindStart();
  result_.body = result_.start;
  if (!InterruptRequested()) {
    simulator_ = scene_.make_simulator(result_.start);
    GoThroughRound();
  }
  while (MayGoOn() && WantsAnotherRound()) GoThroughRound();
  if (result_.kept >= 0 && !InterruptRequested()) {
    term_->set_reference(*result_.reference());
    const OptimizerSummary* optimizer = result_.optimizer();
    if (optimizer && optimizer->usable() && options_.uncertainty && MayGoOn())
      FindUncertain();
    Simulate();
  }
  if (term_) result_.stats = term_->stats();
  Conclude();
  return std::move(result_);
}

}  // namespace

const OptimizerSummary* FitResult::optimizer() const {
  if (kept < 0 || !rounds[kept].optimizer) return nullptr;
  return &*rounds[kept].optimizer;
}

const ClothReference* FitResult::reference() const {
  return kept < 0 ? nullptr : &*rounds[kept].dressing.reference;
}

double FitResult::initial_cost() const {
  if (rounds.empty() || !rounds.front().optimizer) return 0;
  return rounds.front().optimizer->initial_cost;
}

ObjectiveCounts FitResult::counts() const {
  ObjectiveCounts all;
  for (const FitRound& round : rounds)
    if (round.optimizer) all.Add(round.optimizer->counts);
  return all;
}

double FitResult::linear_solver_seconds() const {
  double all = 0;
  for (const FitRound& round : rounds)
    if (round.optimizer) all += round.optimizer->linear_solver_seconds;
  return all;
}

int FitResult::iterations() const {
  int all = 0;
  for (const FitRound& round : rounds)
    if (round.optimizer) all += round.optimizer->num_iterations();
  return all;
}

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
  table->Add("fit.dressings",
             &o->dressings,
             {.doc = "times the garment is dressed at most: first on the body "
                     "of the initialisation, then on the body found; the fit "
                     "of least cost is kept",
              .at_least = 1});
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

void CheckInputs(const FitScene& scene) {
  if (!scene.checkpoint.empty())
    FitCheckpoint(scene.checkpoint).Open(Inputs(scene));
}

FitResult FitSequence(const FitScene& scene,
                      const FitOptions& options,
                      const FitObserver& observer) {
  return Fitter(scene, options, observer).Run();
}

}  // namespace invsim
