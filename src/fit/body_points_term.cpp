// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/body_points_term.h"

#include <ceres/loss_function.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "invsim/base/random.h"
#include "invsim/base/threads.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/surface_index.h"

namespace invsim {
namespace {

// Up to 3 rows of residual whose derivative is -direction^T sum_k w_k dM_k
// (a distance along a direction) or dM_k (a vertex's offset).
struct BodyPointResidual {
  double distance;
  Vector3d direction;  // unit, from the skin to the point
  std::array<int, 3> vertices;
  Vector3d weights;
  double weight;
  const ceres::LossFunction* loss;
};

struct BodyVertexResidual {
  int vertex;
  Vector3d offset;
  double weight;
};

struct BodyFrame {
  std::shared_ptr<const PosedBody> body;
  std::vector<BodyPointResidual> points;
  std::vector<BodyVertexResidual> vertices;
};

// How much a point of the skin is hidden, 0 to 1. Interpolated, so that the
// cost does not jump when a nearest point moves across the garment's border.
double CoveredShare(const std::vector<bool>& covered,
                    const Faces& faces,
                    const SurfacePoint& q) {
  double share = 0;
  for (int k = 0; k < 3; ++k)
    if (covered[faces(k, q.face)]) share += q.weights[k];
  return share;
}

}  // namespace

struct BodyPointsTerm::Impl {
  Impl(const BodyModel& model,
       const std::vector<bool>& hidden,
       const std::vector<Points>& measured,
       const BodyPointsOptions& o,
       std::uint64_t seed);
  void ChooseVertices(std::uint64_t seed);
  void FindPoints(int t);
  void FindVertices(int t);
  FrameBlock Block(int t, bool derivatives) const;

  const BodyModel& body;
  std::vector<bool> covered;
  BodyPointsOptions options;
  std::shared_ptr<const ceres::LossFunction> skin_loss, cloth_loss;
  std::vector<KdTree> trees;  // of the frames' points
  std::vector<SurfaceIndex> surfaces;
  std::vector<int> vertices;  // bare, those that are used
  std::vector<double> vertex_weights;
  std::vector<BodyFrame> frames;
};

BodyPointsTerm::Impl::Impl(const BodyModel& model,
                           const std::vector<bool>& hidden,
                           const std::vector<Points>& measured,
                           const BodyPointsOptions& o,
                           std::uint64_t seed)
    : body(model),
      covered(hidden),
      options(o),
      skin_loss(MakeLoss(o.skin)),
      cloth_loss(MakeLoss(o.cloth)),
      frames(measured.size()) {
  for (const Points& points : measured) {
    trees.emplace_back(points);
    surfaces.emplace_back(body.data().v_template, body.faces());
  }
  ChooseVertices(seed);
}

// Bare vertices, at random if there are too many, weighted by their area.
void BodyPointsTerm::Impl::ChooseVertices(std::uint64_t seed) {
  for (int i = 0; i < body.num_vertices(); ++i)
    if (!covered[i]) vertices.push_back(i);
  Random random(seed);
  for (int i = static_cast<int>(vertices.size()) - 1; i > 0; --i)
    std::swap(vertices[i], vertices[random.Index(i + 1)]);
  if (static_cast<int>(vertices.size()) > options.max_vertices)
    vertices.resize(options.max_vertices);
  const VectorXd areas = FaceAreas(body.data().v_template, body.faces());
  VectorXd area = VectorXd::Zero(body.num_vertices());
  for (int f = 0; f < areas.size(); ++f)
    for (int k = 0; k < 3; ++k) area[body.faces()(k, f)] += areas[f] / 3;
  double total = 0;
  for (const int i : vertices) total += area[i];
  const double weight = options.observations * options.skin_to_points /
                        (options.noise * options.noise);
  for (const int i : vertices)
    vertex_weights.push_back(weight * area[i] / total);
}

void BodyPointsTerm::Impl::FindPoints(int t) {
  BodyFrame& frame = frames[t];
  const Points& points = trees[t].points();
  const std::vector<SurfacePoint> nearest = surfaces[t].NearestAll(points);
  const double weight =
      options.observations / (points.cols() * options.noise * options.noise);
  frame.points.clear();
  for (int i = 0; i < points.cols(); ++i) {
    const SurfacePoint& q = nearest[i];
    BodyPointResidual r;
    r.distance = q.signed_distance;
    // On the skin itself the pseudo-normal is the limit of the direction.
    r.direction = q.distance > 1e-9
                      ? Vector3d((points.col(i) - q.point) / q.signed_distance)
                      : q.normal;
    for (int k = 0; k < 3; ++k) r.vertices[k] = body.faces()(k, q.face);
    r.weights = q.weights;
    const double share =
        q.signed_distance > 0 ? CoveredShare(covered, body.faces(), q) : 0;
    r.weight = (1 - share) * weight;
    r.loss = skin_loss.get();
    if (r.weight > 0) frame.points.push_back(r);
    r.weight = share * options.cloth_pull * weight;
    r.loss = cloth_loss.get();
    if (r.weight > 0) frame.points.push_back(r);
  }
}

void BodyPointsTerm::Impl::FindVertices(int t) {
  BodyFrame& frame = frames[t];
  const int n = static_cast<int>(vertices.size());
  const Points& posed = frame.body->vertices();
  Points queries(3, n);
  for (int k = 0; k < n; ++k) queries.col(k) = posed.col(vertices[k]);
  const std::vector<Neighbour> nearest = trees[t].NearestAll(queries);
  frame.vertices.clear();
  for (int k = 0; k < n; ++k) {
    const Vector3d p = trees[t].points().col(nearest[k].index);
    frame.vertices.push_back(
        {vertices[k], queries.col(k) - p, vertex_weights[k]});
  }
}

FrameBlock BodyPointsTerm::Impl::Block(int t, bool derivatives) const {
  const BodyFrame& frame = frames[t];
  BlockCompressor sum(kNumBodyParameters, derivatives);
  MatrixXd all;
  if (derivatives) {
    std::vector<int> every(body.num_vertices());
    std::iota(every.begin(), every.end(), 0);
    all = frame.body->Jacobian(every);
  }
  VectorXd distance(1);
  MatrixXd row;
  for (const BodyPointResidual& p : frame.points) {
    distance[0] = p.distance;
    if (derivatives) {
      row = -p.direction.transpose() *
            (p.weights[0] * all.middleRows<3>(3 * p.vertices[0]) +
             p.weights[1] * all.middleRows<3>(3 * p.vertices[1]) +
             p.weights[2] * all.middleRows<3>(3 * p.vertices[2]));
    }
    sum.Add(distance, row, p.weight, p.loss);
  }
  const MatrixXd none;
  for (const BodyVertexResidual& v : frame.vertices) {
    if (derivatives)
      sum.Add(
          v.offset, all.middleRows<3>(3 * v.vertex), v.weight, skin_loss.get());
    else
      sum.Add(v.offset, none, v.weight, skin_loss.get());
  }
  return sum.Finish();
}

BodyPointsTerm::BodyPointsTerm(const BodyModel& body,
                               const std::vector<bool>& covered,
                               const std::vector<Points>& clouds,
                               const BodyPointsOptions& options,
                               std::uint64_t seed)
    : impl_(std::make_unique<Impl>(body, covered, clouds, options, seed)) {}

BodyPointsTerm::~BodyPointsTerm() = default;

int BodyPointsTerm::num_frames() const {
  return static_cast<int>(impl_->frames.size());
}

Evaluation BodyPointsTerm::Evaluate(const BodySequence& x,
                                    double,
                                    std::vector<double>* costs) {
  const int n = num_frames();
  costs->assign(n, 0);
  ParallelFor(n, 1, [&](int t) {
    BodyFrame& frame = impl_->frames[t];
    frame.body = impl_->body.Pose(x.Frame(t));
    impl_->surfaces[t].Update(frame.body->vertices());
    impl_->FindPoints(t);
    impl_->FindVertices(t);
    (*costs)[t] = impl_->Block(t, false).cost;
  });
  return Evaluation::kDone;
}

bool BodyPointsTerm::Linearize(std::vector<FrameBlock>* blocks) {
  blocks->resize(num_frames());
  ParallelFor(
      num_frames(), 1, [&](int t) { (*blocks)[t] = impl_->Block(t, true); });
  return true;
}

void Describe(OptionTable* table, BodyPointsOptions* o) {
  table->Add("noise",
             &o->noise,
             {.doc = "standard deviation of one observation",
              .unit = "m",
              .above = 0});
  table->Add("observations",
             &o->observations,
             {.doc = "independent observations a frame's points stand for",
              .above = 0});
  table->AddSection("skin", &o->skin);
  table->Add("cloth_pull",
             &o->cloth_pull,
             {.doc = "pull of points outside covered skin, share of skin's",
              .at_least = 0,
              .at_most = 1});
  table->AddSection("cloth", &o->cloth);
  table->Add("skin_to_points",
             &o->skin_to_points,
             {.doc = "weight of the direction skin to points", .at_least = 0});
  table->Add(
      "max_vertices",
      &o->max_vertices,
      {.doc = "most body vertices used in that direction", .at_least = 1});
}

}  // namespace invsim
