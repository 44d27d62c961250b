// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/scene_motion.h"

#include <algorithm>
#include <cmath>

#include "invsim/geometry/mesh.h"
#include "invsim/geometry/surface_index.h"
#include "invsim/sim/body_path.h"

namespace invsim {
namespace {

constexpr int kMostLayerFrames = 30;  // in which layers are looked for

// The points of the skin to which a garment is tied.
class Anchors {
 public:
  explicit Anchors(const RelaxationScene& scene) : scene_(scene) {
    BodyParameters made;
    made.shape = scene.garment_shape;
    const SurfaceIndex surface(scene.body.Vertices(made), scene.body.faces());
    points_ = surface.NearestAll(scene.garment.placed);
    slack_.resize(scene.garment.num_vertices());
    for (Eigen::Index i = 0; i < slack_.size(); ++i)
      slack_[i] = points_[i].distance;
  }

  const VectorXd& slack() const { return slack_; }

  Points At(const BodyParameters& parameters) const {
    const Points body = scene_.body.Vertices(parameters);
    const Faces& faces = scene_.body.faces();
    Points at(3, points_.size());
    for (size_t i = 0; i < points_.size(); ++i) {
      const SurfacePoint& p = points_[i];
      at.col(i).setZero();
      for (int c = 0; c < 3; ++c)
        at.col(i) += p.weights[c] * body.col(faces(c, p.face));
    }
    return at;
  }

 private:
  const RelaxationScene& scene_;
  std::vector<SurfacePoint> points_;
  VectorXd slack_;
};

double LargestStep(const Points& a, const Points& b) {
  return (b - a).colwise().norm().maxCoeff();
}

double LargestTurn(const Points& a, const Points& b, const Points& c) {
  return (c - 2 * b + a).colwise().norm().maxCoeff();
}

double LargestAcceleration(const std::vector<Points>& path, double rate) {
  double most = 0;
  for (size_t t = 1; t + 1 < path.size(); ++t)
    most = std::max(most, LargestTurn(path[t - 1], path[t], path[t + 1]));
  return most * rate * rate;
}

// The way from the T-pose to where the cloth is brought to rest.
double DressingAcceleration(const RelaxationScene& scene,
                            const RelaxationOptions& options,
                            const Anchors& anchors) {
  constexpr int kSamples = 30;
  const BodyParameters goal = BeforeFirst(scene.motion,
                                          scene.frames_per_second,
                                          options.lead_in_seconds,
                                          -options.lead_in_seconds);
  const BodyParameters start =
      PlaceAtStart(scene.body, goal, scene.garment_shape).body;
  std::vector<Points> path;
  for (int k = 0; k <= kSamples; ++k)
    path.push_back(anchors.At(DressingBody(start, goal, k / double{kSamples})));
  return LargestAcceleration(path, kSamples / options.move_seconds);
}

}  // namespace

bool LayersCanMeet(const Garment& garment,
                   const std::vector<Points>& anchors,
                   const VectorXd& slack,
                   double thickness) {
  const int n = garment.num_vertices();
  double edges = 0;
  for (int f = 0; f < garment.num_faces(); ++f)
    for (int c = 0; c < 3; ++c)
      edges += (garment.placed.col(garment.faces(c, f)) -
                garment.placed.col(garment.faces((c + 1) % 3, f)))
                   .norm();
  const double far = kFarEdges * edges / (3 * garment.num_faces());
  const size_t stride = 1 + (anchors.size() - 1) / kMostLayerFrames;
  for (size_t t = 0; t < anchors.size(); t += stride)
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        const double reach = slack[i] + slack[j] + thickness;
        if ((anchors[t].col(i) - anchors[t].col(j)).squaredNorm() <=
                reach * reach &&
            (garment.placed.col(i) - garment.placed.col(j)).norm() > far)
          return true;
      }
  return false;
}

SceneMotion MeasureMotion(const RelaxationScene& scene,
                          const RelaxationOptions& options,
                          double thickness) {
  const Anchors anchors(scene);
  SceneMotion m;
  m.frames_per_second = scene.frames_per_second;
  m.steps_per_second = options.steps_per_second;
  std::vector<Points> path;
  for (const BodyParameters& frame : scene.motion)
    path.push_back(anchors.At(frame));
  m.speed = 0;
  for (size_t t = 1; t < path.size(); ++t)
    m.speed = std::max(m.speed,
                       LargestStep(path[t - 1], path[t]) * m.frames_per_second);
  m.layers_can_meet =
      LayersCanMeet(scene.garment, path, anchors.slack(), thickness);
  if (options.lead_in_seconds == 0) path.insert(path.begin(), path.front());
  m.acceleration = LargestAcceleration(path, m.frames_per_second);
  m.dressing_acceleration = DressingAcceleration(scene, options, anchors);
  return m;
}

}  // namespace invsim
