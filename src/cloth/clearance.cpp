// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/clearance.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "invsim/geometry/mesh.h"

namespace invsim {
namespace {

// Where faces are looked at, as weights of their corners.
constexpr double kSamples[4][3] = {{0.5, 0.5, 0.0},
                                   {0.0, 0.5, 0.5},
                                   {0.5, 0.0, 0.5},
                                   {1.0 / 3, 1.0 / 3, 1.0 / 3}};
constexpr int kNumSamples = 4;

constexpr int kRounds = 60;
// Rounds in which neighbours follow; later ones only finish the job.
constexpr int kSmoothRounds = 4;
// A push ends this far beyond the wish, so that the next test passes.
constexpr double kMargin = 1e-5;

Points FaceSamples(const Points& cloth, const Faces& faces) {
  Points samples(3, kNumSamples * faces.cols());
  for (int f = 0; f < faces.cols(); ++f)
    for (int s = 0; s < kNumSamples; ++s)
      samples.col(kNumSamples * f + s) =
          kSamples[s][0] * cloth.col(faces(0, f)) +
          kSamples[s][1] * cloth.col(faces(1, f)) +
          kSamples[s][2] * cloth.col(faces(2, f));
  return samples;
}

// The way out of the body from a point near it.
Vector3d Outward(const Vector3d& x, const SurfacePoint& nearest) {
  if (nearest.signed_distance < 1e-6) return nearest.normal;
  return (x - nearest.point) / nearest.distance;
}

// Keeps the longest of the moves asked of a vertex.
void Ask(const Vector3d& move, int vertex, Points* moves) {
  if (move.squaredNorm() > moves->col(vertex).squaredNorm())
    moves->col(vertex) = move;
}

// The moves asked for; zero where none is. Returns whether any is.
bool Moves(const Points& cloth,
           const Faces& faces,
           const SurfaceIndex& body,
           double vertex_clearance,
           double face_clearance,
           Points* moves) {
  moves->setZero(3, cloth.cols());
  bool any = false;
  const auto at_vertices = body.NearestAll(cloth);
  for (int v = 0; v < cloth.cols(); ++v) {
    const double lack = vertex_clearance - at_vertices[v].signed_distance;
    if (lack <= 0.0) continue;
    any = true;
    Ask((lack + kMargin) * Outward(cloth.col(v), at_vertices[v]), v, moves);
  }
  const Points samples = FaceSamples(cloth, faces);
  const auto at_samples = body.NearestAll(samples);
  for (int i = 0; i < samples.cols(); ++i) {
    const double lack = face_clearance - at_samples[i].signed_distance;
    if (lack <= 0.0) continue;
    any = true;
    const double(&w)[3] = kSamples[i % kNumSamples];
    const double squares = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    const Vector3d out = Outward(samples.col(i), at_samples[i]);
    for (int c = 0; c < 3; ++c)
      Ask((lack + kMargin) * w[c] / squares * out,
          faces(c, i / kNumSamples),
          moves);
  }
  return any;
}

// Vertices that are not asked to move follow the mean of their neighbours by
// half.
void Follow(const std::vector<Edge>& edges, Points* moves) {
  Points sum = Points::Zero(3, moves->cols());
  VectorXd count = VectorXd::Zero(moves->cols());
  for (const Edge& e : edges) {
    sum.col(e.a) += moves->col(e.b);
    sum.col(e.b) += moves->col(e.a);
    count[e.a] += 1.0;
    count[e.b] += 1.0;
  }
  for (int v = 0; v < moves->cols(); ++v)
    if (moves->col(v).isZero() && count[v] > 0.0)
      moves->col(v) = 0.5 / count[v] * sum.col(v);
}

}  // namespace

Clearance MeasureClearance(const Points& cloth,
                           const Faces& faces,
                           const SurfaceIndex& body) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Clearance r{kFar, kFar};
  for (const SurfacePoint& p : body.NearestAll(cloth))
    r.vertices = std::min(r.vertices, p.signed_distance);
  r.faces = r.vertices;
  for (const SurfacePoint& p : body.NearestAll(FaceSamples(cloth, faces)))
    r.faces = std::min(r.faces, p.signed_distance);
  return r;
}

Clearance PushClear(const Faces& faces,
                    const SurfaceIndex& body,
                    double vertex_clearance,
                    double face_clearance,
                    Points* cloth) {
  const std::vector<Edge> edges = Edges(faces);
  Points moves;
  for (int round = 0; round < kRounds; ++round) {
    if (!Moves(*cloth, faces, body, vertex_clearance, face_clearance, &moves))
      break;
    if (round < kSmoothRounds) Follow(edges, &moves);
    *cloth += moves;
  }
  return MeasureClearance(*cloth, faces, body);
}

}  // namespace invsim
