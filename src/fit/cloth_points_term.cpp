// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/cloth_points_term.h"

#include <ceres/loss_function.h>

#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "invsim/base/stopwatch.h"
#include "invsim/base/threads.h"
#include "invsim/fit/coverage.h"
#include "invsim/geometry/kd_tree.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/point_normals.h"
#include "invsim/geometry/surface_index.h"
#include "invsim/sim/sensitivity.h"

namespace invsim {
namespace {

constexpr double kOnSurface = 1e-9;  // m
// Frames whose derivatives share an analysis of their matrices.
constexpr int kFramesPerAnalysis = 2;

enum class Side { kCloth, kSkin };

// A vertex and the point it belongs to.
struct ClothVertexResidual {
  Side side;
  int vertex;
  Vector3d offset;
  Vector3d normal;  // of the plane at the point; zero: the point itself
  double weight;

  bool to_plane() const { return !normal.isZero(); }
  double squared() const {
    return to_plane() ? std::pow(normal.dot(offset), 2) : offset.squaredNorm();
  }
};

// A point's distance to a face along `direction` (from face to point).
struct ClothPointResidual {
  Side side;
  double distance;
  Vector3d direction;
  std::array<int, 3> vertices;
  Vector3d weights;
  double weight;
};

struct ClothFrame {
  std::shared_ptr<const PosedBody> body;
  std::vector<ClothVertexResidual> vertices;
  std::vector<ClothPointResidual> points;
};

VectorXd VertexShares(const Points& vertices, const Faces& faces) {
  const VectorXd areas = FaceAreas(vertices, faces);
  VectorXd share = VectorXd::Zero(vertices.cols());
  for (int f = 0; f < areas.size(); ++f)
    for (int k = 0; k < 3; ++k) share[faces(k, f)] += areas[f] / 3;
  return share / share.sum();
}

ClothPointResidual ToFace(Side side,
                          const Vector3d& p,
                          const SurfacePoint& q,
                          const Faces& faces,
                          double weight) {
  ClothPointResidual r;
  r.side = side;
  r.distance = q.distance;
  r.direction =
      q.distance > kOnSurface ? Vector3d((p - q.point) / q.distance) : q.normal;
  for (int k = 0; k < 3; ++k) r.vertices[k] = faces(k, q.face);
  r.weights = q.weights;
  r.weight = weight;
  return r;
}

}  // namespace

struct ClothPointsTerm::Impl {
  Impl(const BodyModel& model,
       const Faces& faces,
       const ClothPointsOptions& o,
       ClothRollout r);
  void FindResiduals(int t);
  double Total(int t) const { return Block(t, nullptr, nullptr).cost; }
  FrameBlock Block(int t, const MatrixXd* skin, const Columns* cloth) const;
  bool BlockOneFrame(int t, Sensitivity* sensitivity, FrameBlock* block);
  bool Carry(const FrameRecord& record,
             const PosedBody* before,
             const PosedBody& after,
             StateColumns* columns);
  bool LinearizeCarried(std::vector<FrameBlock>* blocks);
  bool LinearizeOneFrame(std::vector<FrameBlock>* blocks);

  const BodyModel& body;
  Faces cloth_faces;
  ClothPointsOptions options;
  ClothRollout rollout;
  VectorXd cloth_share, body_share;
  std::vector<KdTree> trees;
  std::vector<Points> normals;  // one per frame, or none are needed
  std::shared_ptr<const ceres::LossFunction> loss;
  std::unique_ptr<SurfaceIndex> body_index, cloth_index;
  std::vector<int> every_vertex;
  std::vector<ClothFrame> frames;
  ClothPointsStats stats;
  StopPredicate stop;
};

ClothPointsTerm::Impl::Impl(const BodyModel& model,
                            const Faces& faces,
                            const ClothPointsOptions& o,
                            ClothRollout r)
    : body(model), cloth_faces(faces), options(o), rollout(std::move(r)) {
  body_share = VertexShares(model.data().v_template, model.faces());
  every_vertex.resize(model.num_vertices());
  std::iota(every_vertex.begin(), every_vertex.end(), 0);
  loss = MakeLoss(options.loss);
}

void ClothPointsTerm::Impl::FindResiduals(int t) {
  const Stopwatch watch;
  ClothFrame& frame = frames[t];
  const Points& skin = frame.body->vertices();
  const Points& garment = rollout.cloth(t).x;
  body_index->Update(skin);
  cloth_index->Update(garment);
  const std::vector<bool> covered =
      CoveredVertices(skin, VertexNormals(skin, body.faces()), *cloth_index);
  const double unit = options.observations / (options.noise * options.noise);
  const KdTree& tree = trees[t];

  frame.vertices.clear();
  const auto add_vertices =
      [&](Side side, const Points& from, const VectorXd& share, double weight) {
        if (!(weight > 0)) return;
        const std::vector<Neighbour> nearest = tree.NearestAll(from);
        stats.neighbour_queries += from.cols();
        for (int i = 0; i < from.cols(); ++i) {
          if (side == Side::kSkin && covered[i]) continue;
          const int point = nearest[i].index;
          frame.vertices.push_back({side,
                                    i,
                                    from.col(i) - tree.points().col(point),
                                    normals.empty()
                                        ? Vector3d(0, 0, 0)
                                        : Vector3d(normals[t].col(point)),
                                    unit * weight * share[i]});
        }
      };
  add_vertices(Side::kCloth, garment, cloth_share, options.cloth_to_points);
  add_vertices(Side::kSkin, skin, body_share, options.skin_to_points);

  frame.points.clear();
  const Points& points = tree.points();
  const double weight = unit * options.points_to_surface / points.cols();
  if (weight > 0) {
    const std::vector<SurfacePoint> on_cloth = cloth_index->NearestAll(points);
    const std::vector<SurfacePoint> on_skin = body_index->NearestAll(points);
    stats.neighbour_queries += 2 * points.cols();
    for (int i = 0; i < points.cols(); ++i) {
      bool bare = true;
      for (int k = 0; k < 3; ++k)
        bare = bare && !covered[body.faces()(k, on_skin[i].face)];
      const bool skin_is_nearer =
          bare && on_skin[i].distance < on_cloth[i].distance;
      frame.points.push_back(skin_is_nearer ? ToFace(Side::kSkin,
                                                     points.col(i),
                                                     on_skin[i],
                                                     body.faces(),
                                                     weight)
                                            : ToFace(Side::kCloth,
                                                     points.col(i),
                                                     on_cloth[i],
                                                     cloth_faces,
                                                     weight));
    }
  }
  stats.neighbour_seconds += watch.seconds();
}

// Without derivatives if `skin` is null; else the Jacobians of all body and
// cloth vertices, three rows each.
FrameBlock ClothPointsTerm::Impl::Block(int t,
                                        const MatrixXd* skin,
                                        const Columns* garment) const {
  const ClothFrame& frame = frames[t];
  const bool derivatives = skin != nullptr;
  BlockCompressor sum(kNumBodyParameters, derivatives);
  MatrixXd j;
  VectorXd distance(1);
  for (const ClothVertexResidual& v : frame.vertices) {
    if (derivatives) {
      if (v.side == Side::kSkin)
        j = skin->middleRows<3>(3 * v.vertex);
      else
        j = garment->middleRows<3>(3 * v.vertex);
    }
    if (v.to_plane()) {
      distance[0] = v.normal.dot(v.offset);
      if (derivatives) j = (v.normal.transpose() * j).eval();
      sum.Add(distance, j, v.weight, loss.get());
    } else {
      sum.Add(v.offset, j, v.weight, loss.get());
    }
  }
  j.resize(0, 0);
  for (const ClothPointResidual& p : frame.points) {
    distance[0] = p.distance;
    if (derivatives) {
      j.setZero(1, kNumBodyParameters);
      for (int k = 0; k < 3; ++k) {
        const int row = 3 * p.vertices[k];
        const Eigen::RowVector3d d = -p.weights[k] * p.direction.transpose();
        if (p.side == Side::kSkin)
          j += d * skin->middleRows<3>(row);
        else
          j += d * garment->middleRows<3>(row);
      }
    }
    sum.Add(distance, j, p.weight, loss.get());
  }
  return sum.Finish();
}

bool ClothPointsTerm::Impl::BlockOneFrame(int t,
                                          Sensitivity* sensitivity,
                                          FrameBlock* block) {
  const FrameRecord& record = rollout.record(t);
  const std::vector<int> touched =
      Sensitivity::BodyVertices(body.faces(), record);
  const MatrixXd skin = frames[t].body->Jacobian(every_vertex);
  Columns body1(3 * touched.size(), kNumBodyParameters);
  for (size_t k = 0; k < touched.size(); ++k)
    body1.middleRows<3>(3 * k) = skin.middleRows<3>(3 * touched[k]);
  StateColumns end;
  if (!sensitivity->Forward(record, touched, Columns(), body1, nullptr, &end))
    return false;
  *block = Block(t, &skin, &end.x);
  return block->finite();
}

bool ClothPointsTerm::Impl::LinearizeOneFrame(std::vector<FrameBlock>* blocks) {
  const int n = static_cast<int>(frames.size());
  std::atomic<bool> good = true;
  // One sensitivity object for a few frames: its analysis is reused.
  ParallelForPieces(n, kFramesPerAnalysis, [&](int begin, int end) {
    Sensitivity sensitivity(rollout.simulator());
    for (int t = begin; t < end && good; ++t)
      if (!BlockOneFrame(t, &sensitivity, &(*blocks)[t])) good = false;
  });
  return good;
}

// columns <- d(state at the end)/d(parameters) given that at the start.
// `before` null: the body's start does not depend on the parameters.
bool ClothPointsTerm::Impl::Carry(const FrameRecord& record,
                                  const PosedBody* before,
                                  const PosedBody& after,
                                  StateColumns* columns) {
  Sensitivity sensitivity(rollout.simulator());
  const std::vector<int> touched =
      Sensitivity::BodyVertices(body.faces(), record);
  const Columns body0 = before ? Columns(before->Jacobian(touched)) : Columns();
  const Columns body1 = after.Jacobian(touched);
  StateColumns end;
  if (!sensitivity.Forward(record,
                           touched,
                           body0,
                           body1,
                           columns->x.size() ? columns : nullptr,
                           &end))
    return false;
  *columns = std::move(end);
  return true;
}

bool ClothPointsTerm::Impl::LinearizeCarried(std::vector<FrameBlock>* blocks) {
  const int n = static_cast<int>(frames.size());
  StateColumns columns;
  // While held the body already is that of frame 0.
  const PosedBody* before = nullptr;
  const std::vector<FrameRecord>& lead = rollout.lead_records();
  const size_t moves = std::max(1, options.lead.lead_frames);
  for (size_t k = moves - 1; k < lead.size(); ++k) {
    if (!Carry(lead[k], before, *frames[0].body, &columns)) return false;
    before = frames[0].body.get();
    if (k >= moves) columns.v *= ClothRollout::kKeptVelocity;
  }
  columns.v.setZero();
  for (int t = 0; t < n; ++t) {
    if (t > 0 && !Carry(rollout.record(t),
                        frames[t - 1].body.get(),
                        *frames[t].body,
                        &columns))
      return false;
    const MatrixXd skin = frames[t].body->Jacobian(every_vertex);
    (*blocks)[t] = Block(t, &skin, &columns.x);
    if (!(*blocks)[t].finite()) return false;
  }
  return true;
}

ClothPointsTerm::ClothPointsTerm(const BodyModel& body,
                                 Simulator* simulator,
                                 const Faces& cloth_faces,
                                 const VectorXd& cloth_areas,
                                 const std::vector<Points>& clouds,
                                 double frames_per_second,
                                 const ClothReference& reference,
                                 const ClothPointsOptions& options)
    : impl_(std::make_unique<Impl>(body,
                                   cloth_faces,
                                   options,
                                   ClothRollout(simulator,
                                                reference,
                                                static_cast<int>(clouds.size()),
                                                frames_per_second,
                                                options.lead))) {
  impl_->cloth_share = cloth_areas / cloth_areas.sum();
  for (const Points& cloud : clouds) impl_->trees.emplace_back(cloud);
  if (options.distance == VertexDistance::kPlane)
    for (const KdTree& tree : impl_->trees)
      impl_->normals.push_back(EstimateNormals(tree));
  impl_->body_index =
      std::make_unique<SurfaceIndex>(reference.body, body.faces());
  impl_->cloth_index =
      std::make_unique<SurfaceIndex>(reference.cloth.x, cloth_faces);
  impl_->frames.resize(clouds.size());
}

ClothPointsTerm::~ClothPointsTerm() = default;

int ClothPointsTerm::num_frames() const {
  return static_cast<int>(impl_->frames.size());
}

Evaluation ClothPointsTerm::Evaluate(const BodySequence& x,
                                     double cost_limit,
                                     std::vector<double>* costs) {
  costs->assign(num_frames(), 0);
  double total = 0;
  for (int t = 0; t < num_frames(); ++t) {
    if (StopRequested(impl_->stop)) return Evaluation::kStopped;
    impl_->frames[t].body = impl_->body.Pose(x.Frame(t));
    const Points& skin = impl_->frames[t].body->vertices();
    if (!skin.allFinite() || !impl_->rollout.Step(t, skin))
      return Evaluation::kFailed;
    impl_->FindResiduals(t);
    const Stopwatch watch;
    total += (*costs)[t] = impl_->Total(t);
    impl_->stats.block_seconds += watch.seconds();
    if (!std::isfinite(total)) return Evaluation::kFailed;
    if (total > cost_limit) return Evaluation::kAbandoned;
  }
  return Evaluation::kDone;
}

bool ClothPointsTerm::Linearize(std::vector<FrameBlock>* blocks) {
  const Stopwatch watch;
  blocks->resize(num_frames());
  const bool good = impl_->options.history == History::kOneFrame
                        ? impl_->LinearizeOneFrame(blocks)
                        : impl_->LinearizeCarried(blocks);
  for (int t = 0; t < num_frames(); ++t)
    impl_->stats.fixed_contacts += FixedContacts(impl_->rollout.record(t));
  impl_->stats.sensitivity_seconds += watch.seconds();
  return good;
}

void ClothPointsTerm::set_stop(StopPredicate stop) {
  impl_->stop = std::move(stop);
}

void ClothPointsTerm::set_reference(const ClothReference& reference) {
  impl_->rollout.set_reference(reference);
}

ClothRollout& ClothPointsTerm::rollout() { return impl_->rollout; }
const ClothRollout& ClothPointsTerm::rollout() const { return impl_->rollout; }

ClothPointsCosts ClothPointsTerm::costs() const {
  ClothPointsCosts costs;
  const auto cost = [&](double weight, double squared) {
    double rho[3];
    impl_->loss->Evaluate(squared, rho);
    return 0.5 * weight * rho[0];
  };
  for (const ClothFrame& frame : impl_->frames) {
    for (const ClothVertexResidual& v : frame.vertices)
      (v.side == Side::kCloth ? costs.cloth_to_points : costs.skin_to_points) +=
          cost(v.weight, v.squared());
    for (const ClothPointResidual& p : frame.points)
      costs.points_to_surface += cost(p.weight, p.distance * p.distance);
  }
  return costs;
}

ClothPointsStats ClothPointsTerm::stats() const {
  ClothPointsStats stats = impl_->stats;
  stats.step = impl_->rollout.stats();
  stats.frames = impl_->rollout.frames_simulated();
  stats.simulation_seconds = impl_->rollout.seconds();
  return stats;
}

void Describe(OptionTable* table, ClothPointsOptions* o) {
  table->Add("noise",
             &o->noise,
             {.doc = "standard deviation of one observation",
              .unit = "m",
              .above = 0});
  table->Add("observations",
             &o->observations,
             {.doc = "independent observations a frame's points stand for",
              .above = 0});
  Describe(table, &o->loss);
  table->Add("cloth_to_points",
             &o->cloth_to_points,
             {.doc = "weight of cloth vertices' distances", .at_least = 0});
  table->Add("skin_to_points",
             &o->skin_to_points,
             {.doc = "weight of bare body vertices' distances", .at_least = 0});
  table->Add("points_to_surface",
             &o->points_to_surface,
             {.doc = "weight of the points' distances", .at_least = 0});
  table->Add(
      "distance",
      &o->distance,
      {{"point", VertexDistance::kPoint}, {"plane", VertexDistance::kPlane}},
      {.doc = "of a vertex: to its nearest point, or to the plane there"});
  Describe(table, &o->lead);
  table->Add(
      "history",
      &o->history,
      {{"one_frame", History::kOneFrame}, {"carried", History::kCarried}},
      {.doc = "how much of the cloth's past its derivative knows"});
}

}  // namespace invsim
