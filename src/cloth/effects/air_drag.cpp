// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/effects/air_drag.h"

#include <ceres/jet.h>

#include <Eigen/Geometry>
#include <cmath>

namespace invsim {
namespace {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

// What the drag of a face depends on: its area vector N = A n and the stream u.
template <typename T>
struct Stream {
  T area;
  Vector3<T> normal;
  T across;          // u_n
  Vector3<T> along;  // u_t
  T along_speed;     // |u_t|
};

// False for a face of no area, which meets no air.
template <typename T>
bool MakeStream(const Vector3<T>& area_vector,
                const Vector3<T>& u,
                Stream<T>* s) {
  using std::sqrt;
  const T square = area_vector.dot(area_vector);
  if (!(square > T(1e-24))) return false;
  s->area = sqrt(square);
  s->normal = area_vector / s->area;
  s->across = u.dot(s->normal);
  s->along = u - s->across * s->normal;
  const T along_square = s->along.dot(s->along);
  // The speed has a kink at zero, where all it multiplies vanishes.
  s->along_speed = along_square > T(1e-24) ? T(sqrt(along_square)) : T(0.0);
  return true;
}

// F of the header.
template <typename T>
Vector3<T> Drag(const AirDragOptions& o, const Stream<T>& s) {
  using std::abs;
  const double half = 0.5 * o.air_density;
  const T across =
      (o.linear_normal + half * o.normal * abs(s.across)) * s.across;
  const T along = o.linear_tangential + half * o.tangential * s.along_speed;
  return s.area * (across * s.normal + along * s.along);
}

// dF/du w.
template <typename T>
Vector3<T> DragSlope(const AirDragOptions& o,
                     const Stream<T>& s,
                     const Vector3<T>& w) {
  using std::abs;
  const double half = 0.5 * o.air_density;
  const T w_across = w.dot(s.normal);
  const Vector3<T> w_along = w - w_across * s.normal;
  const T across = o.linear_normal + 2.0 * half * o.normal * abs(s.across);
  const T along = o.linear_tangential + half * o.tangential * s.along_speed;
  Vector3<T> slope = across * w_across * s.normal + along * w_along;
  if (s.along_speed > T(0.0))
    slope +=
        (half * o.tangential * s.along.dot(w_along) / s.along_speed) * s.along;
  return s.area * slope;
}

Vector3d Mean(const std::array<int, 3>& face, const Points& p) {
  return (p.col(face[0]) + p.col(face[1]) + p.col(face[2])) / 3.0;
}

Vector3d AreaVector(const std::array<int, 3>& face, const Points& x) {
  const Vector3d a = x.col(face[1]) - x.col(face[0]);
  const Vector3d b = x.col(face[2]) - x.col(face[0]);
  return 0.5 * a.cross(b);
}

}  // namespace

void Describe(OptionTable* table, AirDragOptions* o) {
  table->Add("wind", &o->wind, {.doc = "velocity of the air", .unit = "m/s"});
  table->Add("air_density",
             &o->air_density,
             {.doc = "density of the air", .unit = "kg/m^3", .at_least = 0.0});
  table->Add("normal",
             &o->normal,
             {.doc = "drag coefficient across a face", .at_least = 0.0});
  table->Add("tangential",
             &o->tangential,
             {.doc = "drag coefficient along a face", .at_least = 0.0});
  table->Add(
      "linear_normal",
      &o->linear_normal,
      {.doc = "linear drag across a face", .unit = "N s/m^3", .at_least = 0.0});
  table->Add(
      "linear_tangential",
      &o->linear_tangential,
      {.doc = "linear drag along a face", .unit = "N s/m^3", .at_least = 0.0});
}

AirDrag::AirDrag(const Faces& faces, const AirDragOptions& options)
    : options_(options) {
  faces_.reserve(faces.cols());
  for (int f = 0; f < faces.cols(); ++f)
    faces_.push_back({faces(0, f), faces(1, f), faces(2, f)});
}

void AirDrag::AddStencils(BlockPatternBuilder* builder) const {
  for (const auto& face : faces_) builder->AddStencil(face);
}

void AirDrag::Bind(const BlockPattern& pattern) {
  slots_ = StencilSlots<3>(pattern, faces_);
}

void AirDrag::AddForce(const ClothState& y, Points* force) const {
  for (const auto& face : faces_) {
    const Vector3d u = options_.wind - Mean(face, y.v);
    Stream<double> stream;
    if (!MakeStream<double>(AreaVector(face, y.x), u, &stream)) continue;
    const Vector3d third = Drag(options_, stream) / 3.0;
    for (const int i : face) force->col(i) += third;
  }
}

void AirDrag::AddStiffness(const ClothState& y,
                           double x_scale,
                           double v_scale,
                           BlockMatrix* a) const {
  if (v_scale == 0.0) return;
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Vector3d u = options_.wind - Mean(faces_[f], y.v);
    Stream<double> stream;
    if (!MakeStream<double>(AreaVector(faces_[f], y.x), u, &stream)) continue;
    Matrix3d d;
    for (int k = 0; k < 3; ++k)
      d.col(k) = DragSlope<double>(options_, stream, Vector3d::Unit(k));
    d *= v_scale / 9.0;
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) a->block(slots_.slot(f, p, q)) += d;
  }
}

// Every vertex of a face has the third part of G(N, u) = -F + (dF/du) w with w
// the mean of dv. Dual numbers carry dG/dN and dG/du.
void AirDrag::AddTangent(const ClothState& y,
                         const Points& dx,
                         const Points& dv,
                         double scale,
                         BlockMatrix* h_x,
                         BlockMatrix* h_v) const {
  using Dual = ceres::Jet<double, 6>;
  for (size_t f = 0; f < faces_.size(); ++f) {
    const auto& face = faces_[f];
    const Vector3d area = AreaVector(face, y.x);
    const Vector3d u = options_.wind - Mean(face, y.v);
    const Vector3<Dual> w = Mean(face, dv).cast<Dual>();
    Vector3<Dual> area_dual, u_dual;
    for (int k = 0; k < 3; ++k) {
      area_dual[k] = Dual(area[k], k);
      u_dual[k] = Dual(u[k], 3 + k);
    }
    Stream<Dual> stream;
    if (!MakeStream<Dual>(area_dual, u_dual, &stream)) continue;
    const Vector3<Dual> g =
        DragSlope<Dual>(options_, stream, w) - Drag<Dual>(options_, stream);
    Matrix3d by_area, by_u;
    for (int k = 0; k < 3; ++k) {
      by_area.row(k) = g[k].v.head<3>();
      by_u.row(k) = g[k].v.tail<3>();
    }
    for (int q = 0; q < 3; ++q) {
      const Vector3d opposite =
          y.x.col(face[(q + 2) % 3]) - y.x.col(face[(q + 1) % 3]);
      // dN = opposite x dx / 2, and r . (o x d) = (r x o) . d row by row.
      const Matrix3d by_x =
          (scale / 6.0) * by_area.rowwise().cross(opposite.transpose());
      const Matrix3d by_v = (-scale / 9.0) * by_u;
      for (int p = 0; p < 3; ++p) {
        h_x->block(slots_.slot(f, p, q)) += by_x;
        h_v->block(slots_.slot(f, p, q)) += by_v;
      }
    }
  }
}

}  // namespace invsim
