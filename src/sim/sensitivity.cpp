// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/sensitivity.h"

#include <algorithm>
#include <utility>

#include "cloth_derivatives.h"
#include "invsim/base/stopwatch.h"

namespace invsim {
namespace {

// The planes of a sub-step's contacts with the body that act, as functions of
// the body at the two ends of the frame and of the cloth at the start of the
// sub-step.
class PlaneDerivatives {
 public:
  PlaneDerivatives(const Simulator& simulator,
                   const FrameRecord& record,
                   const SubstepRecord& sub,
                   const std::vector<int>& vertices)
      : sub_(sub) {
    const Faces& faces = simulator.body_faces();
    for (const BodyContact& source : sub.sources) {
      if (!Matters(sub, source.contact)) continue;
      sources_.push_back(&source);
      Matrix3d p0, p1;
      std::array<int, 3> corners;
      for (int k = 0; k < 3; ++k) {
        const int vertex = faces(k, source.face);
        p0.col(k) = (1 - sub.s0) * record.body0.col(vertex) +
                    sub.s0 * record.body1.col(vertex);
        p1.col(k) = (1 - sub.s1) * record.body0.col(vertex) +
                    sub.s1 * record.body1.col(vertex);
        corners[k] = static_cast<int>(
            std::lower_bound(vertices.begin(), vertices.end(), vertex) -
            vertices.begin());
      }
      corners_.push_back(corners);
      jacobians_.push_back(
          DifferentiateContactPlane(simulator.contact_options(),
                                    sub.dt,
                                    source.feature,
                                    source.side,
                                    sub.start.x.col(source.vertex),
                                    p0,
                                    p1));
    }
  }

  // dn, dw (3 rows per contact) for moves of the body and of x0; any of them
  // may be empty.
  void Forward(const Columns& body0,
               const Columns& body1,
               const Columns& x0,
               Columns* dn,
               Columns* dw) const {
    for (size_t k = 0; k < sources_.size(); ++k) {
      const int row = 3 * sources_[k]->contact;
      for (int corner = 0; corner < 3; ++corner) {
        const int from = 3 * corners_[k][corner];
        if (body0.size() > 0)
          Add(Block(k, corner, false), body0, from, row, dn, dw);
        if (body1.size() > 0)
          Add(Block(k, corner, true), body1, from, row, dn, dw);
      }
      if (x0.size() > 0)
        Add(jacobians_[k].leftCols<3>(),
            x0,
            3 * sources_[k]->vertex,
            row,
            dn,
            dw);
    }
    if (x0.size() > 0)
      ForPins([&](int contact, int vertex) {
        dw->middleRows(3 * contact, 3) -=
            x0.middleRows(3 * vertex, 3) / sub_.dt;
      });
  }

  // The transpose, added to the results; body0 and body1 may be null.
  void Adjoint(const Columns& dn,
               const Columns& dw,
               Columns* body0,
               Columns* body1,
               Columns* x0) const {
    for (size_t k = 0; k < sources_.size(); ++k) {
      const int row = 3 * sources_[k]->contact;
      for (int corner = 0; corner < 3; ++corner) {
        const int to = 3 * corners_[k][corner];
        if (body0)
          AddTransposed(Block(k, corner, false), dn, dw, row, to, body0);
        if (body1)
          AddTransposed(Block(k, corner, true), dn, dw, row, to, body1);
      }
      AddTransposed(jacobians_[k].leftCols<3>(),
                    dn,
                    dw,
                    row,
                    3 * sources_[k]->vertex,
                    x0);
    }
    ForPins([&](int contact, int vertex) {
      x0->middleRows(3 * vertex, 3) -= dw.middleRows(3 * contact, 3) / sub_.dt;
    });
  }

 private:
  using Block63 = Eigen::Matrix<double, 6, 3>;

  static bool Matters(const SubstepRecord& sub, int contact) {
    return std::any_of(
        sub.linearizations.begin(),
        sub.linearizations.end(),
        [&](const LinearizationRecord& lin) {
          return Acts(sub.contacts[contact], lin.a, lin.v, lin.forces[contact]);
        });
  }

  // d(n, w)/d(corner at the start or end of the frame).
  Block63 Block(size_t k, int corner, bool end) const {
    const double start_share = end ? sub_.s0 : 1 - sub_.s0;
    const double end_share = end ? sub_.s1 : 1 - sub_.s1;
    return start_share * jacobians_[k].middleCols<3>(3 + 3 * corner) +
           end_share * jacobians_[k].middleCols<3>(12 + 3 * corner);
  }
  static void Add(const Block63& m,
                  const Columns& x,
                  int from,
                  int row,
                  Columns* dn,
                  Columns* dw) {
    for (int r = 0; r < 3; ++r) {
      dn->row(row + r) += m(r, 0) * x.row(from) + m(r, 1) * x.row(from + 1) +
                          m(r, 2) * x.row(from + 2);
      dw->row(row + r) += m(3 + r, 0) * x.row(from) +
                          m(3 + r, 1) * x.row(from + 1) +
                          m(3 + r, 2) * x.row(from + 2);
    }
  }
  static void AddTransposed(const Block63& m,
                            const Columns& dn,
                            const Columns& dw,
                            int row,
                            int to,
                            Columns* x) {
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r)
        x->row(to + c) +=
            m(r, c) * dn.row(row + r) + m(3 + r, c) * dw.row(row + r);
  }
  template <typename F>
  void ForPins(const F& f) const {
    for (size_t k = 0; k < sub_.contacts.size(); ++k)
      if (sub_.contacts[k].kind == ContactKind::kPin)
        f(static_cast<int>(k), sub_.contacts[k].vertex[0]);
  }

  const SubstepRecord& sub_;
  std::vector<const BodyContact*> sources_;  // of contacts that matter
  std::vector<std::array<int, 3>> corners_;
  std::vector<ContactPlaneJacobian> jacobians_;
};

void AddInertia(const VectorXd& mass, double dt, const Columns& x, Columns* y) {
  for (Eigen::Index i = 0; i < mass.size(); ++i)
    y->middleRows(3 * i, 3) += mass[i] / dt * x.middleRows(3 * i, 3);
}

// Rows of stopped vertices keep only their share.
void ScaleByKept(const SubstepRecord& sub, Columns* rows) {
  for (Eigen::Index i = 0; i < sub.kept.size(); ++i)
    if (sub.kept[i] < 1) rows->middleRows(3 * i, 3) *= sub.kept[i];
}

}  // namespace

int FixedContacts(const FrameRecord& record) {
  int count = 0;
  for (const SubstepRecord& sub : record.substeps) {
    for (const ClothContact& source : sub.cloth_sources) count += source.swept;
    count += static_cast<int>((sub.kept.array() < 1).count());
  }
  return count;
}

Sensitivity::Sensitivity(const Simulator& simulator)
    : simulator_(simulator), jacobian_(simulator.pattern()) {}
Sensitivity::~Sensitivity() = default;

std::vector<int> Sensitivity::BodyVertices(const Faces& body_faces,
                                           const FrameRecord& record) {
  std::vector<int> vertices;
  for (const SubstepRecord& sub : record.substeps)
    for (const BodyContact& source : sub.sources)
      for (int k = 0; k < 3; ++k)
        vertices.push_back(body_faces(k, source.face));
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

// H_x, H_v of all effects at linearisation `index` (cloth/effect.h).
void Sensitivity::Tangents(const SubstepRecord& sub,
                           size_t index,
                           BlockMatrix* h_x,
                           BlockMatrix* h_v) {
  const Stopwatch watch;
  const LinearizationRecord& lin = sub.linearizations[index];
  const Eigen::Map<const Points> v(lin.v.data(), 3, lin.v.size() / 3);
  const Points dx = sub.start.x + sub.dt * v - lin.y.x;
  const Points dv = v - lin.y.v;
  *h_x = BlockMatrix(simulator_.pattern());
  *h_v = BlockMatrix(simulator_.pattern());
  for (const auto& effect : simulator_.effects())
    effect->AddTangent(lin.y, dx, dv, 1, h_x, h_v);
  stats_.tangent_seconds += watch.seconds();
}

bool Sensitivity::Factor(const SubstepRecord& sub,
                         const LinearizationRecord& lin) {
  const Stopwatch watch;
  const bool ok = jacobian_.Factor(lin.a, sub.contacts, lin.v, lin.forces);
  ++stats_.factorizations;
  if (!ok) ++stats_.failed;
  stats_.factor_seconds += watch.seconds();
  return ok;
}

// The right side of momentum, b = M v0/dt + f(y) + K (y.x - x0) + D y.v, moves
// at fixed v1 by
//
//   m = M dv0/dt + [K d(y.x - x0)] + D d(y.v) - H_x d(y.x) - H_v d(y.v) ,
//
// where y = (x0, v0) in the first linearisation, and y = (x0 + dt v, v) with v
// the result of the one before in the others, whose bracket is dt K dv.
bool Sensitivity::Forward(const FrameRecord& record,
                          const std::vector<int>& vertices,
                          const Columns& body0,
                          const Columns& body1,
                          const StateColumns* start,
                          StateColumns* end) {
  const Eigen::Index rows = 3 * simulator_.num_vertices();
  const Eigen::Index p = std::max(
      {body0.cols(), body1.cols(), start ? start->x.cols() : Eigen::Index{0}});
  bool moves = start != nullptr;  // whether x0, v0 of the sub-step do
  StateColumns at =
      moves ? *start
            : StateColumns{Columns::Zero(rows, p), Columns::Zero(rows, p)};
  const Columns none;
  Columns product;
  for (const SubstepRecord& sub : record.substeps) {
    const double dt = sub.dt;
    const int contact_rows = 3 * static_cast<int>(sub.contacts.size());
    Columns dn = Columns::Zero(contact_rows, p);
    Columns dw = Columns::Zero(contact_rows, p);
    PlaneDerivatives(simulator_, record, sub, vertices)
        .Forward(body0, body1, moves ? at.x : none, &dn, &dw);
    const ClothDerivatives cloth(simulator_.self_contact_options(), sub);
    Columns weights;
    if (moves && !cloth.empty()) weights = cloth.Forward(at.x, &dn, &dw);
    Columns dv = at.v;  // of y, then of the solution
    for (size_t k = 0; k < sub.linearizations.size(); ++k) {
      const LinearizationRecord& lin = sub.linearizations[k];
      if (!Factor(sub, lin)) return false;
      Columns m = Columns::Zero(rows, p);
      if (moves || k > 0) {
        BlockMatrix h_x, h_v;
        Tangents(sub, k, &h_x, &h_v);
        Columns dyx = at.x;
        if (k > 0) dyx += dt * dv;
        h_x.Multiply(dyx, &product);
        m -= product;
        if (simulator_.depends_on_velocity()) {
          h_v.Multiply(dv, &product);
          m -= product;
        }
        if (k > 0) {
          lin.a.Multiply(dv, &product);  // dt K + D + M/dt
          m += product;
          if (simulator_.has_inertia())
            AddInertia(simulator_.mass(), dt, at.v - dv, &m);
        } else {
          if (simulator_.depends_on_velocity()) {
            lin.damping.Multiply(dv, &product);
            m += product;
          }
          if (simulator_.has_inertia())
            AddInertia(simulator_.mass(), dt, at.v, &m);
        }
      }
      const Stopwatch watch;
      if (weights.size() > 0) {
        Columns dw_here = dw;
        cloth.AddForward(lin, weights, &dw_here, &m);
        jacobian_.Forward(dn, dw_here, &m);
      } else {
        jacobian_.Forward(dn, dw, &m);
      }
      stats_.solve_seconds += watch.seconds();
      dv = std::move(m);
    }
    ScaleByKept(sub, &dv);
    at.x += dt * dv;
    at.v = std::move(dv);
    moves = true;
  }
  *end = std::move(at);
  return true;
}

bool Sensitivity::Adjoint(const FrameRecord& record,
                          const std::vector<int>& vertices,
                          const StateColumns& end,
                          Columns* body0,
                          Columns* body1,
                          StateColumns* start) {
  const Eigen::Index p = end.x.cols();
  const Eigen::Index body_rows = 3 * static_cast<Eigen::Index>(vertices.size());
  if (body0) body0->setZero(body_rows, p);
  if (body1) body1->setZero(body_rows, p);
  StateColumns at = end;
  Columns product;
  for (size_t s = record.substeps.size(); s-- > 0;) {
    const SubstepRecord& sub = record.substeps[s];
    const double dt = sub.dt;
    const int contact_rows = 3 * static_cast<int>(sub.contacts.size());
    Columns dn = Columns::Zero(contact_rows, p);
    Columns dw = Columns::Zero(contact_rows, p);
    // x1 = x0 + dt v1.
    Columns z = at.v + dt * at.x;
    ScaleByKept(sub, &z);
    const ClothDerivatives cloth(simulator_.self_contact_options(), sub);
    Columns weights = Columns::Zero(4 * sub.cloth_sources.size(), p);
    Columns start_v = Columns::Zero(at.v.rows(), p);
    for (size_t k = sub.linearizations.size(); k-- > 0;) {
      const LinearizationRecord& lin = sub.linearizations[k];
      if (!Factor(sub, lin)) return false;
      const Stopwatch watch;
      if (cloth.empty()) {
        jacobian_.Adjoint(&z, &dn, &dw);
      } else {
        Columns dw_here = Columns::Zero(contact_rows, p);
        jacobian_.Adjoint(&z, &dn, &dw_here);
        cloth.AddAdjoint(lin, dw_here, z, &weights);
        dw += dw_here;
      }
      stats_.solve_seconds += watch.seconds();
      // z is now the adjoint of m; what follows transposes Forward.
      if (s == 0 && k == 0 && !start) break;
      const Columns m = std::move(z);
      z = Columns::Zero(m.rows(), p);  // of dv of the linearisation before
      BlockMatrix h_x, h_v;
      Tangents(sub, k, &h_x, &h_v);
      Columns dyx;
      h_x.MultiplyTransposed(m, &dyx);
      at.x -= dyx;
      if (k > 0) z -= dt * dyx;
      if (simulator_.depends_on_velocity()) {
        h_v.MultiplyTransposed(m, &product);
        z -= product;
      }
      if (k > 0) {
        lin.a.MultiplyTransposed(m, &product);
        z += product;
        if (simulator_.has_inertia()) {
          AddInertia(simulator_.mass(), dt, m, &start_v);
          AddInertia(simulator_.mass(), dt, -m, &z);
        }
      } else {
        if (simulator_.depends_on_velocity()) {
          lin.damping.MultiplyTransposed(m, &product);
          z += product;
        }
        if (simulator_.has_inertia()) AddInertia(simulator_.mass(), dt, m, &z);
      }
    }
    PlaneDerivatives(simulator_, record, sub, vertices)
        .Adjoint(dn, dw, body0, body1, &at.x);
    cloth.Adjoint(dn, dw, weights, &at.x);
    at.v = std::move(z);
    at.v += start_v;
  }
  if (start) *start = std::move(at);
  return true;
}

}  // namespace invsim
