// SPDX-License-Identifier: Apache-2.0
#include "sewing.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "invsim/base/error.h"
#include "invsim/cloth/clearance.h"
#include "invsim/geometry/cut.h"
#include "invsim/geometry/remesh.h"
#include "invsim/geometry/self_intersection.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

// What is promised of every garment, metres.
constexpr double kVertexClearance = 0.003;
constexpr double kFaceClearance = 0.002;
// How often triangles that cross are drawn apart.
constexpr int kUntanglingRounds = 20;

[[noreturn]] void Fail(const SewingPattern& pattern, const std::string& why) {
  throw InputError("cannot make a " + pattern.name + " for this body: " + why);
}

// Evens out the openings: Taubin's smoothing along the boundary, which does
// not shrink it (A signal processing approach to fair surface design, 1995).
void FairBoundary(TriangleMesh* mesh) {
  for (const std::vector<int>& loop : BoundaryLoops(mesh->faces)) {
    const size_t n = loop.size();
    for (int round = 0; round < 20; ++round) {
      const double step = round % 2 == 0 ? 0.5 : -0.53;
      const Points old = mesh->vertices;
      for (size_t i = 0; i < n; ++i) {
        const Vector3d mean =
            0.5 * (old.col(loop[(i + n - 1) % n]) + old.col(loop[(i + 1) % n]));
        mesh->vertices.col(loop[i]) += step * (mean - old.col(loop[i]));
      }
    }
  }
}

// Newton steps onto the smooth zero surface, off the polygons' chords.
void OntoSurface(const ScalarGrid& solid, TriangleMesh* mesh) {
  for (Eigen::Index v = 0; v < mesh->vertices.cols(); ++v) {
    for (int step = 0; step < 4; ++step) {
      const Vector3d x = mesh->vertices.col(v), g = solid.Gradient(x);
      if (g.squaredNorm() < 0.01) break;
      const double move = solid.Sample(x) / g.squaredNorm();
      mesh->vertices.col(v) -=
          std::clamp(move, -solid.cell(), solid.cell()) * g;
    }
  }
}

// Off the skin, and faces off each other: where large triangles cross, at the
// crotch and in armpits, their corners give way towards their neighbours.
void KeepClear(const SewingPattern& pattern, TriangleMesh* mesh) {
  for (int round = 0;; ++round) {
    PushClear(mesh->faces,
              pattern.skin,
              std::max(0.6 * pattern.ease, kVertexClearance),
              std::max(0.5 * pattern.ease, kFaceClearance),
              &mesh->vertices);
    const auto crossings = SelfIntersections(mesh->vertices, mesh->faces);
    if (crossings.empty() || round == kUntanglingRounds) return;
    std::set<int> corners;
    for (const auto& pair : crossings)
      for (const int f : pair)
        for (int c = 0; c < 3; ++c) corners.insert(mesh->faces(c, f));
    Points sum = Points::Zero(3, mesh->vertices.cols());
    VectorXd count = VectorXd::Zero(mesh->vertices.cols());
    for (const Edge& e : Edges(mesh->faces)) {
      sum.col(e.a) += mesh->vertices.col(e.b);
      sum.col(e.b) += mesh->vertices.col(e.a);
      count[e.a] += 1;
      count[e.b] += 1;
    }
    for (const int v : corners)
      mesh->vertices.col(v) +=
          0.5 * (sum.col(v) / count[v] - mesh->vertices.col(v));
  }
}

void Check(const SewingPattern& pattern, const TriangleMesh& mesh) {
  const int openings = static_cast<int>(BoundaryLoops(mesh.faces).size());
  const int expected = pattern.openings;
  if (openings != expected)
    Fail(pattern,
         std::to_string(openings) + " openings, expected " +
             std::to_string(expected));
  // A disc with holes closed to a sphere: no handle joins its parts.
  if (EulerCharacteristic(mesh.faces) != 2 - expected)
    Fail(pattern, "its parts have grown together");
  const auto crossings = SelfIntersections(mesh.vertices, mesh.faces);
  if (!crossings.empty())
    Fail(pattern,
         "faces " + std::to_string(crossings[0][0]) + " and " +
             std::to_string(crossings[0][1]) + " cross");
  const Clearance c = MeasureClearance(mesh.vertices, mesh.faces, pattern.skin);
  if (c.vertices < kVertexClearance || c.faces < kFaceClearance) {
    char text[80];
    std::snprintf(text,
                  sizeof(text),
                  "it comes within %.1f mm of the skin",
                  1e3 * std::min(c.vertices, c.faces));
    Fail(pattern, text);
  }
}

}  // namespace

TriangleMesh SewGarment(const SewingPattern& pattern) {
  TriangleMesh mesh = ZeroSurface(pattern.solid);
  for (const Field& keep : pattern.cuts) {
    VectorXd values(mesh.vertices.cols());
    for (Eigen::Index v = 0; v < values.size(); ++v)
      values[v] = keep(mesh.vertices.col(v));
    mesh = CutMesh(mesh, values);
    if (mesh.faces.cols() == 0) Fail(pattern, "nothing is left after the cuts");
  }
  RemeshOptions remesh;
  remesh.corner_angle = 180.0;
  mesh =
      Remesh(PieceNearest(mesh, pattern.inside), pattern.edge_length, remesh);
  FairBoundary(&mesh);
  OntoSurface(pattern.solid, &mesh);
  KeepClear(pattern, &mesh);
  Check(pattern, mesh);
  return mesh;
}

}  // namespace invsim
