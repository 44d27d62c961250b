// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/remesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include "invsim/base/error.h"
#include "invsim/geometry/closest_point.h"
#include "invsim/geometry/mesh_editor.h"
#include "invsim/geometry/surface_index.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

constexpr double kLong = 4.0 / 3.0;
constexpr double kShort = 4.0 / 5.0;
// How far an operation may turn a face: cos 60 degrees.
constexpr double kSameSide = 0.5;
constexpr double kDegree = std::numbers::pi / 180.0;

// 1 for an equilateral triangle, 0 for a degenerate one: area over the sum of
// the squared sides, scaled.
double Quality(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double sides =
      (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  if (!(sides > 0.0)) return 0.0;
  return 2.0 * std::numbers::sqrt3 * (b - a).cross(c - a).norm() / sides;
}

// The angle at a of the triangle (a, b, c).
double Angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d u = b - a, v = c - a;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

bool Agree(const Vector3d& n, const Vector3d& m) {
  return n.dot(m) > kSameSide * n.norm() * m.norm();
}

class Remesher {
 public:
  Remesher(const TriangleMesh& mesh,
           const EdgeLengthField& edge_length,
           const RemeshOptions& options)
      : mesh_(mesh),
        surface_(mesh.vertices, mesh.faces),
        edge_length_(edge_length),
        options_(options),
        fixed_(mesh.vertices.cols(), 0) {
    for (const auto& loop : BoundaryLoops(mesh.faces)) AddLoop(mesh, loop);
  }

  TriangleMesh Run() {
    for (int round = 0; round < options_.rounds; ++round) {
      SplitLong();
      CollapseShort();
      if (4 * round < 3 * options_.rounds) {
        FlipForValence();
      } else {
        FlipForAngles();
      }
      Smooth();
    }
    FlipForAngles();
    return mesh_.Compact();
  }

 private:
  void AddLoop(const TriangleMesh& mesh, const std::vector<int>& loop) {
    const size_t n = loop.size();
    const double limit = std::cos(options_.corner_angle * kDegree);
    for (size_t i = 0; i < n; ++i) {
      const Vector3d a = mesh.vertices.col(loop[(i + n - 1) % n]);
      const Vector3d b = mesh.vertices.col(loop[i]);
      const Vector3d c = mesh.vertices.col(loop[(i + 1) % n]);
      boundary_.push_back({b, c});
      const bool corner =
          (b - a).dot(c - b) < limit * (b - a).norm() * (c - b).norm();
      fixed_[loop[i]] = corner || options_.keep_boundary;
    }
  }

  double Wanted(const Vector3d& x, const Vector3d& y) const {
    const double length = edge_length_(0.5 * (x + y));
    if (!(length > 0.0))
      throw InputError("edge length is " + std::to_string(length) +
                       " m, expected a positive number");
    return length;
  }
  double Wanted(int a, int b) const {
    return Wanted(mesh_.position(a), mesh_.position(b));
  }
  double Length(int a, int b) const {
    return (mesh_.position(a) - mesh_.position(b)).norm();
  }

  struct Candidate {
    double ratio;  // length over wanted length
    int a, b;
  };
  // The edges whose ratio `select` accepts, smallest ratio first.
  template <typename Select>
  std::vector<Candidate> Candidates(Select select) const {
    std::vector<Candidate> r;
    for (const auto& [a, b] : mesh_.EdgeList()) {
      if (options_.keep_boundary && mesh_.FindEdge(a, b).boundary()) continue;
      const double ratio = Length(a, b) / Wanted(a, b);
      if (select(ratio)) r.push_back({ratio, a, b});
    }
    std::sort(r.begin(), r.end(), [](const Candidate& p, const Candidate& q) {
      return std::tie(p.ratio, p.a, p.b) < std::tie(q.ratio, q.a, q.b);
    });
    return r;
  }

  // An edge is split when it is the longest of both its faces: the edges this
  // makes are then at most 0.87 of its length (a median between sides that are
  // no longer), so the loop ends even beside long edges that must stay.
  void SplitLong() {
    for (bool again = true; again;) {
      again = false;
      for (const Candidate& e :
           Candidates([](double r) { return r > kLong; })) {
        if (!IsLongest(e.a, e.b)) continue;
        const Vector3d x = 0.5 * (mesh_.position(e.a) + mesh_.position(e.b));
        mesh_.Split(e.a, e.b, x);
        fixed_.push_back(0);
        again = true;
      }
    }
  }
  bool IsLongest(int a, int b) const {
    const double length = Length(a, b) * (1.0 + 1e-12);
    for (const int c : mesh_.FindEdge(a, b).opposite)
      if (c >= 0 && std::max(Length(a, c), Length(b, c)) > length) return false;
    return true;
  }

  void CollapseShort() {
    const auto edges = Candidates([](double r) { return r < kShort; });
    for (const Candidate& e : edges) {
      int a = e.a, b = e.b;
      if (!mesh_.HasVertex(a) || !mesh_.HasVertex(b)) continue;
      if (Length(a, b) >= kShort * Wanted(a, b)) continue;
      if (!mesh_.CanCollapse(a, b) || (fixed_[a] && fixed_[b])) continue;
      // A vertex bound to a corner or to the boundary stays where it is.
      if (Bound(b) > Bound(a)) std::swap(a, b);
      Vector3d x = mesh_.position(a);
      if (Bound(a) == Bound(b)) x = 0.5 * (x + mesh_.position(b));
      if (!KeepsShape(a, b, x) || !KeepsShape(b, a, x)) continue;
      mesh_.Collapse(a, b, x);
    }
  }
  int Bound(int v) const { return fixed_[v] ? 2 : mesh_.OnBoundary(v) ? 1 : 0; }

  // Whether the faces at v that do not have `gone` keep their side and their
  // edges do not get too long when v goes to x.
  bool KeepsShape(int v, int gone, const Vector3d& x) const {
    for (const int f : mesh_.FacesAt(v)) {
      const std::array<int, 3>& face = mesh_.face(f);
      if (std::find(face.begin(), face.end(), gone) != face.end()) continue;
      if (!Agree(mesh_.AreaVector(f), mesh_.AreaVector(f, v, x))) return false;
      for (const int w : face) {
        const Vector3d y = mesh_.position(w);
        if (w != v && (x - y).norm() > kLong * Wanted(x, y)) return false;
      }
    }
    return true;
  }

  // Flips where `better(a, b, c, d)` says that edge (c, d) is better than
  // (a, b), if the two faces are nearly in one plane and stay so.
  template <typename Better>
  int Flip(Better better) {
    int count = 0;
    for (const auto& [a, b] : mesh_.EdgeList()) {
      if (!mesh_.CanFlip(a, b)) continue;
      const MeshEditor::EdgeFaces e = mesh_.FindEdge(a, b);
      const int c = e.opposite[0], d = e.opposite[1];
      if (!better(a, b, c, d)) continue;
      const Vector3d n0 = mesh_.AreaVector(e.faces[0]);
      const Vector3d n1 = mesh_.AreaVector(e.faces[1]);
      const Vector3d m0 = mesh_.AreaVector(e.faces[0], b, mesh_.position(d));
      const Vector3d m1 = mesh_.AreaVector(e.faces[1], a, mesh_.position(c));
      if (!Agree(n0, n1) || !Agree(m0, m1) || !Agree(n0 + n1, m0 + m1))
        continue;
      mesh_.Flip(a, b);
      ++count;
    }
    return count;
  }

  void FlipForValence() {
    const auto off = [this](int v, int change) {
      const int faces = static_cast<int>(mesh_.FacesAt(v).size()) + change;
      const int d = faces - (mesh_.OnBoundary(v) ? 3 : 6);
      return d * d;
    };
    Flip([&off](int a, int b, int c, int d) {
      return off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1) <
             off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0);
    });
  }

  // Delaunay: the two angles opposite an edge add to at most pi.
  void FlipForAngles() {
    const auto better = [this](int a, int b, int c, int d) {
      const Vector3d xa = mesh_.position(a), xb = mesh_.position(b);
      const Vector3d xc = mesh_.position(c), xd = mesh_.position(d);
      return Angle(xc, xa, xb) + Angle(xd, xa, xb) >
             Angle(xa, xc, xd) + Angle(xb, xc, xd) + 1e-9;
    };
    for (int pass = 0; pass < 10; ++pass)
      if (Flip(better) == 0) return;
  }

  void Smooth() {
    for (int v = 0; v < mesh_.num_vertices(); ++v) {
      if (!mesh_.HasVertex(v) || fixed_[v]) continue;
      const Vector3d x =
          mesh_.OnBoundary(v) ? OnBoundaryCurve(v) : OnSurface(v);
      if (Improves(v, x)) mesh_.set_position(v, x);
    }
  }

  Vector3d OnSurface(int v) const {
    Vector3d mean = Vector3d::Zero(), normal = Vector3d::Zero();
    const std::vector<int> neighbours = mesh_.Neighbours(v);
    for (const int w : neighbours) mean += mesh_.position(w);
    mean /= static_cast<double>(neighbours.size());
    for (const int f : mesh_.FacesAt(v)) normal += mesh_.AreaVector(f);
    normal.normalize();
    const Vector3d x = mesh_.position(v), step = mean - x;
    const SurfacePoint on =
        surface_.Nearest(x + step - normal.dot(step) * normal);
    // The nearest surface may be another sheet: then stay.
    return on.normal.dot(normal) > 0.0 ? on.point : x;
  }

  Vector3d OnBoundaryCurve(int v) const {
    Vector3d mean = Vector3d::Zero();
    for (const int w : mesh_.Neighbours(v))
      if (mesh_.FindEdge(v, w).boundary()) mean += 0.5 * mesh_.position(w);
    double best = std::numeric_limits<double>::infinity();
    Vector3d x = mean;
    for (const auto& [a, b] : boundary_) {
      const Vector3d p = a + ClosestPointOnSegment(mean, a, b) * (b - a);
      if ((p - mean).squaredNorm() >= best) continue;
      best = (p - mean).squaredNorm();
      x = p;
    }
    return x;
  }

  // A move may not turn a face over, nor spoil the worst face at v.
  bool Improves(int v, const Vector3d& x) const {
    double before = 1.0, after = 1.0;
    for (const int f : mesh_.FacesAt(v)) {
      if (!Agree(mesh_.AreaVector(f), mesh_.AreaVector(f, v, x))) return false;
      Vector3d p[3], q[3];
      for (int c = 0; c < 3; ++c) {
        const int w = mesh_.face(f)[c];
        p[c] = mesh_.position(w);
        q[c] = w == v ? x : p[c];
      }
      before = std::min(before, Quality(p[0], p[1], p[2]));
      after = std::min(after, Quality(q[0], q[1], q[2]));
    }
    return after > std::min(before, 0.5);
  }

  MeshEditor mesh_;
  SurfaceIndex surface_;
  const EdgeLengthField& edge_length_;
  RemeshOptions options_;
  std::vector<char> fixed_;
  std::vector<std::array<Vector3d, 2>> boundary_;
};

}  // namespace

TriangleMesh Remesh(const TriangleMesh& mesh,
                    double edge_length,
                    const RemeshOptions& options) {
  return Remesh(
      mesh, [edge_length](const Vector3d&) { return edge_length; }, options);
}

TriangleMesh Remesh(const TriangleMesh& mesh,
                    const EdgeLengthField& edge_length,
                    const RemeshOptions& options) {
  return Remesher(mesh, edge_length, options).Run();
}

VectorXd SmallestAngles(const Points& vertices, const Faces& faces) {
  VectorXd r(faces.cols());
  for (Eigen::Index f = 0; f < faces.cols(); ++f)
    r[f] = std::min({CornerAngle(vertices, faces, f, 0),
                     CornerAngle(vertices, faces, f, 1),
                     CornerAngle(vertices, faces, f, 2)});
  return r;
}

}  // namespace invsim
