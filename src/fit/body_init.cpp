// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/body_init.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "invsim/base/joints.h"
#include "invsim/base/random.h"
#include "invsim/body/rotation.h"
#include "invsim/fit/coverage.h"
#include "invsim/geometry/mesh.h"
#include "invsim/io/point_filters.h"
#include "limb_starts.h"

namespace invsim {
namespace {

// Arms straight out, half down and hanging, radians about the front axis.
constexpr double kArmAngles[] = {0.0, 0.7, 1.25};
// So many of the roughly fitted starts are fitted finely.
constexpr int kKeptStarts = 4;
// A tracked frame is started afresh if its cost is so many times the median.
constexpr double kLost = 2;
// The share of its cost below which another pose of a limb is followed up.
constexpr double kClearlyBetter = 0.99;
// Body heights a person may have against the points' largest extent.
constexpr double kSmallestExtent = 0.3, kLargestExtent = 5;

// Joints left alone in the coarse fit.
constexpr int kFineJoints[] = {kLeftAnkle,
                               kRightAnkle,
                               kLeftFoot,
                               kRightFoot,
                               kLeftCollar,
                               kRightCollar,
                               kLeftWrist,
                               kRightWrist,
                               kLeftHand,
                               kRightHand};

Points Subsample(const Points& cloud, int count, std::uint64_t seed, int t) {
  const int n = static_cast<int>(cloud.cols());
  if (n <= count) return cloud;
  Random random(seed, t);
  std::vector<int> order(n);
  for (int i = 0; i < n; ++i) order[i] = i;
  Points chosen(3, count);
  for (int i = 0; i < count; ++i) {
    std::swap(order[i], order[i + random.Index(n - i)]);
    chosen.col(i) = cloud.col(order[i]);
  }
  return chosen;
}

struct Scored {
  BodyParameters at;
  double cost;
};

class Initializer {
 public:
  Initializer(const BodyModel& body,
              const Garment& garment,
              const std::vector<Points>& clouds,
              const BodyInitOptions& options,
              std::uint64_t seed,
              const InitObserver& note,
              const StopPredicate& stop);
  BodyInit Run();

 private:
  std::vector<BodyParameters> Starts(int t) const;
  // One frame from one start; `width` metres is the robust loss's scale.
  Scored FitFrame(int t,
                  const BodyParameters& start,
                  double width,
                  const FreeParameters& free,
                  int iterations);
  Scored TryLimbs(int t, const Scored& found);
  Scored SearchFrame(int t);
  Scored TrackFrame(int t, const BodyParameters& neighbour);
  void Track(int anchor, const Scored& start);
  void Refine(BodyInit* result);
  bool Tell(const std::string& what) {
    stopped_ = stopped_ || (note_ && !note_(what));
    return MayGoOn();
  }
  bool MayGoOn() {
    stopped_ = stopped_ || StopRequested(stop_);
    return !stopped_;
  }

  const BodyModel& body_;
  const std::vector<Points>& clouds_;
  const BodyInitOptions& options_;
  std::uint64_t seed_;
  const InitObserver& note_;
  const StopPredicate& stop_;
  bool stopped_ = false;  // as was asked for
  std::vector<bool> covered_;
  std::vector<Points> coarse_;
  BodySequence sequence_;
  std::vector<double> costs_;  // of the frames tracked so far
};

void CheckExtent(const std::vector<Points>& clouds) {
  if (clouds.empty()) throw InputError("points: no frame");
  for (size_t t = 0; t < clouds.size(); ++t) {
    if (clouds[t].cols() == 0)
      throw InputError("points of frame " + std::to_string(t) + ": none");
    const Points person = WithoutStrays(clouds[t]);
    const Vector3d size =
        person.rowwise().maxCoeff() - person.rowwise().minCoeff();
    const double extent = size.maxCoeff();
    if (extent >= kSmallestExtent && extent <= kLargestExtent) continue;
    throw InputError("points of frame " + std::to_string(t) + " span " +
                     std::to_string(extent) +
                     " m; expected a person, 0.3 to 5 m (wrong unit?)");
  }
}

Initializer::Initializer(const BodyModel& body,
                         const Garment& garment,
                         const std::vector<Points>& clouds,
                         const BodyInitOptions& options,
                         std::uint64_t seed,
                         const InitObserver& note,
                         const StopPredicate& stop)
    : body_(body),
      clouds_(clouds),
      options_(options),
      seed_(seed),
      note_(note),
      stop_(stop) {
  CheckExtent(clouds);
  const Points& skin = body.data().v_template;
  covered_ = CoveredVertices(skin,
                             VertexNormals(skin, body.faces()),
                             SurfaceIndex(garment.placed, garment.faces));
  for (size_t t = 0; t < clouds.size(); ++t)
    coarse_.push_back(
        Subsample(clouds[t], options.coarse_points, seed, static_cast<int>(t)));
}

std::vector<BodyParameters> Initializer::Starts(int t) const {
  std::vector<BodyParameters> starts;
  const Vector3d centroid = clouds_[t].rowwise().mean();
  for (int h = 0; h < options_.headings; ++h) {
    for (const double arms : kArmAngles) {
      BodyParameters p;
      p.pose[1] = 2 * std::numbers::pi * h / options_.headings;
      p.pose[3 * kLeftShoulder + 2] = -arms;
      p.pose[3 * kRightShoulder + 2] = arms;
      Canonicalize(&p.pose);
      p.translation = centroid - body_.Vertices(p).rowwise().mean();
      starts.push_back(p);
    }
  }
  return starts;
}

Scored Initializer::FitFrame(int t,
                             const BodyParameters& start,
                             double width,
                             const FreeParameters& free,
                             int iterations) {
  if (!MayGoOn()) return {start, kNoLimit};
  BodyPointsOptions points = options_.points;
  points.skin = {"cauchy", width};
  points.cloth.scale = std::max(points.cloth.scale, 0.5 * width);
  points.max_vertices = options_.coarse_points;
  BodyPointsTerm term(body_, covered_, {coarse_[t]}, points, seed_);
  BodySequence x;
  x.shape = start.shape;
  x.Append(start);
  Objective objective(options_.priors, free, &term, &x, body_);
  TrustRegionOptions ceres;
  ceres.iterations = iterations;
  ceres.function_tolerance = 1e-3;
  const OptimizerSummary summary = MakeLevenbergMarquardt(ceres)->Run(
      &objective, [this](const IterationRecord&) { return MayGoOn(); });
  BodyParameters end = x.Frame(0);
  Canonicalize(&end.pose);
  return {end, summary.final_cost};
}

Scored Initializer::SearchFrame(int t) {
  FreeParameters coarse;
  for (const int j : kFineJoints) coarse.joints[j] = false;
  std::vector<Scored> found;
  for (const BodyParameters& start : Starts(t))
    found.push_back(FitFrame(t, start, 0.2, coarse, 10));
  const auto better = [](const Scored& a, const Scored& b) {
    return a.cost < b.cost;
  };
  std::sort(found.begin(), found.end(), better);
  if (found.size() > kKeptStarts) found.resize(kKeptStarts);
  for (Scored& s : found) {
    s = FitFrame(t, s.at, 0.1, FreeParameters{}, 15);
    s = FitFrame(t, s.at, 0.04, FreeParameters{}, 15);
  }
  return TryLimbs(t, *std::min_element(found.begin(), found.end(), better));
}

// Limb by limb: whether a start of that limb alone ends better.
Scored Initializer::TryLimbs(int t, const Scored& found) {
  Scored best = found;
  for (const Limb& limb : Limbs()) {
    FreeParameters only;
    only.shape = only.translation = false;
    only.joints.assign(kNumJoints, false);
    for (const int joint : limb.joints) only.joints[joint] = true;
    Scored tried = FitFrame(t, best.at, 0.1, only, 3);
    const double as_it_is = tried.cost;
    for (const LimbStart& start : limb.starts) {
      const Scored s = FitFrame(t, start.From(best.at), 0.1, only, 12);
      if (s.cost < tried.cost) tried = s;
    }
    if (tried.cost > kClearlyBetter * as_it_is) continue;
    tried = FitFrame(t, tried.at, 0.04, FreeParameters{}, 15);
    if (tried.cost < best.cost) best = tried;
  }
  return best;
}

Scored Initializer::TrackFrame(int t, const BodyParameters& neighbour) {
  FreeParameters free;
  free.shape = false;
  const Scored near = FitFrame(t, neighbour, 0.1, free, 10);
  return FitFrame(t, near.at, 0.04, free, 10);
}

void Initializer::Track(int anchor, const Scored& start) {
  const int n = static_cast<int>(clouds_.size());
  sequence_.shape = start.at.shape;
  sequence_.poses.assign(n, start.at.pose);
  sequence_.translations.assign(n, start.at.translation);
  costs_ = {start.cost};
  for (const int direction : {1, -1}) {
    BodyParameters last = start.at;
    for (int t = anchor + direction; t >= 0 && t < n; t += direction) {
      if (!MayGoOn()) return;
      Scored s = TrackFrame(t, last);
      std::vector<double> sorted = costs_;
      std::sort(sorted.begin(), sorted.end());
      if (s.cost > kLost * sorted[sorted.size() / 2]) {
        const Scored fresh = SearchFrame(t);
        if (fresh.cost < s.cost) s = fresh;
      }
      sequence_.poses[t] = s.at.pose;
      sequence_.translations[t] = s.at.translation;
      costs_.push_back(s.cost);
      last = s.at;
      last.shape = sequence_.shape;
      Tell("tracked frame " + std::to_string(t));
    }
  }
}

// All frames together.
void Initializer::Refine(BodyInit* result) {
  std::vector<Points> fine;
  for (size_t t = 0; t < clouds_.size(); ++t)
    fine.push_back(Subsample(
        clouds_[t], options_.fine_points, seed_, static_cast<int>(t)));
  BodyPointsTerm term(body_, covered_, fine, options_.points, seed_);
  Objective objective(
      options_.priors, FreeParameters{}, &term, &sequence_, body_);
  TrustRegionOptions ceres;
  ceres.iterations = options_.iterations;
  result->refinement = MakeLevenbergMarquardt(ceres)->Run(
      &objective, [this](const IterationRecord& record) {
        return Tell("all frames, iteration " +
                    std::to_string(record.iteration) + ", cost " +
                    std::to_string(record.cost));
      });
}

BodyInit Initializer::Run() {
  const int n = static_cast<int>(clouds_.size());
  BodyInit result;
  std::optional<Scored> best;
  const int anchors = std::min(options_.anchors, n);
  for (int a = 0; a < anchors; ++a) {
    const int t = (2 * a + 1) * n / (2 * anchors);
    const Scored s = SearchFrame(t);
    if (!best || s.cost < best->cost) {
      best = s;
      result.anchor = t;
    }
    if (!Tell("searched frame " + std::to_string(t))) break;
  }
  Track(result.anchor, *best);
  if (MayGoOn())
    Refine(&result);
  else
    result.refinement.reason = "A stop was asked for before it.";
  for (PoseVector& pose : sequence_.poses) Canonicalize(&pose);
  result.body = GaussianFilter(sequence_, options_.filter);
  result.complete = !stopped_;
  return result;
}

}  // namespace

BodyInit InitializeBody(const BodyModel& body,
                        const Garment& garment,
                        const std::vector<Points>& clouds,
                        const BodyInitOptions& options,
                        std::uint64_t seed,
                        const InitObserver& note,
                        const StopPredicate& stop) {
  return Initializer(body, garment, clouds, options, seed, note, stop).Run();
}

void Describe(OptionTable* table, BodyInitOptions* o) {
  table->AddSection("points", &o->points);
  table->AddSection("priors", &o->priors);
  table->Add("anchors",
             &o->anchors,
             {.doc = "frames searched from scratch", .at_least = 1});
  table->Add("headings",
             &o->headings,
             {.doc = "directions the body is started in", .at_least = 1});
  table->Add(
      "coarse_points",
      &o->coarse_points,
      {.doc = "points per frame while searching and tracking", .at_least = 10});
  table->Add("fine_points",
             &o->fine_points,
             {.doc = "points per frame in the end", .at_least = 10});
  table->Add("iterations",
             &o->iterations,
             {.doc = "most iterations of the last stage", .at_least = 0});
  table->Add("filter",
             &o->filter,
             {.doc = "standard deviation of the filter in time; 0: none",
              .unit = "frames",
              .at_least = 0});
}

}  // namespace invsim
