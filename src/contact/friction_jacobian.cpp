// SPDX-License-Identifier: Apache-2.0
#include "invsim/contact/friction_jacobian.h"

namespace invsim {
namespace {

void AddProduct(
    const Matrix3d& m, const Columns& x, int from, Columns* y, int to) {
  for (int r = 0; r < 3; ++r)
    y->row(to + r) += m(r, 0) * x.row(from) + m(r, 1) * x.row(from + 1) +
                      m(r, 2) * x.row(from + 2);
}

// Rows [i, i + 3) of x <- m times them.
void Transform(const Matrix3d& m, int i, Columns* x) {
  const Columns rows = x->middleRows(i, 3);
  x->middleRows(i, 3).setZero();
  AddProduct(m, rows, 0, x, i);
}

// What makes velocities commensurate with forces at an exact contact.
double Rho(const BlockMatrix& a, const Contact& c) {
  return a.diagonal(c.vertex[0]).trace() / 3;
}

}  // namespace

bool Acts(const Contact& c,
          const BlockMatrix& a,
          const VectorXd& v,
          const Vector3d& force) {
  if (c.kind == ContactKind::kPin) return true;
  const Vector3d u = c.Gather(v) - c.velocity;
  const double compressed = -c.normal.dot(u);
  if (!c.exact()) return compressed > 0;
  return c.normal.dot(force) + Rho(a, c) * compressed > 0;
}

FrictionJacobian::FrictionJacobian(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(pattern), momentum_(pattern), jacobian_(pattern) {}

void FrictionJacobian::UsePattern() {
  momentum_ = BlockMatrix(pattern_.pattern());
  jacobian_ = momentum_;
  cholesky_.reset();
  lu_.reset();
}

void FrictionJacobian::Forget() {
  if (pattern_.Reset()) UsePattern();
}

void FrictionJacobian::Linearize(const std::vector<Contact>& contacts,
                                 const VectorXd& v,
                                 const std::vector<Vector3d>& forces,
                                 const BlockMatrix& a) {
  contacts_ = contacts;
  exact_.resize(contacts.size());
  compliant_.resize(contacts.size());
  symmetric_ = true;
  for (size_t k = 0; k < contacts.size(); ++k) {
    const Contact& c = contacts[k];
    const Vector3d u = c.Gather(v) - c.velocity;
    if (!c.exact()) {
      compliant_[k] =
          DifferentiateCompliantForce(c.normal, c.friction, c.compliance, u);
      if (compliant_[k].mode == ContactMode::kSlide && c.friction > 0)
        symmetric_ = false;
      continue;
    }
    const double rho = Rho(a, c);
    if (c.kind == ContactKind::kPin) {
      exact_[k] = {Matrix3d::Zero(),
                   rho * Matrix3d::Identity(),
                   Matrix3d::Zero(),
                   false};
      continue;
    }
    const ContactLinearization l =
        LinearizeAlartCurnier(c.normal, c.friction, rho, forces[k], u);
    exact_[k] = {l.p, l.q, l.n, l.mode == ContactMode::kOpen};
    if (l.mode == ContactMode::kSlide && c.friction > 0) symmetric_ = false;
  }
}

void FrictionJacobian::AssembleCompliant(const BlockMatrix& a) {
  momentum_.Assign(a);
  const BlockPattern& p = *pattern_.pattern();
  for (size_t k = 0; k < contacts_.size(); ++k) {
    const Contact& c = contacts_[k];
    if (c.exact()) continue;
    for (int i = 0; i < c.num_vertices; ++i)
      for (int j = 0; j < c.num_vertices; ++j)
        momentum_.block(p.Find(c.vertex[i], c.vertex[j])) -=
            c.weight[i] * c.weight[j] * compliant_[k].dq;
  }
}

bool FrictionJacobian::Factor(const BlockMatrix& a,
                              const std::vector<Contact>& contacts,
                              const VectorXd& v,
                              const std::vector<Vector3d>& forces) {
  if (pattern_.Cover(contacts)) UsePattern();
  Linearize(contacts, v, forces, a);
  AssembleCompliant(a);
  jacobian_ = momentum_;
  const BlockPattern& p = *pattern_.pattern();
  for (size_t k = 0; k < contacts_.size(); ++k) {
    if (!contacts_[k].exact() || exact_[k].open) continue;
    const int i = contacts_[k].vertex[0];
    for (int b = p.row_start[i]; b < p.row_start[i + 1]; ++b) {
      jacobian_.block(b) = (exact_[k].p * jacobian_.block(b)).eval();
      if (!symmetric_) continue;
      // P is a projector: keep P A P, the known part moves to the right.
      const int t = p.Find(p.column[b], i);
      jacobian_.block(t) = (jacobian_.block(t) * exact_[k].p).eval();
    }
    jacobian_.diagonal(i) += exact_[k].q;
  }
  if (symmetric_) {
    if (!cholesky_)
      cholesky_ = std::make_unique<SparseCholesky>(pattern_.pattern());
    return cholesky_->Factor(jacobian_);
  }
  if (!lu_) lu_ = std::make_unique<SparseLu>(pattern_.pattern());
  return lu_->Factor(jacobian_);
}

// J x = rhs. Symmetric case: J = P A + Q with P a projector and Q = rho (I-P)
// at contacts (P = I, Q = 0 elsewhere). The part (I-P) x = (I-P) rhs / rho is
// known; the rest solves P A P x = P (rhs - A known).
void FrictionJacobian::Solve(Columns* x) const {
  if (!symmetric_) return lu_->Solve(x);
  Columns known = Columns::Zero(x->rows(), x->cols());
  bool any = false;
  for (size_t k = 0; k < contacts_.size(); ++k) {
    if (!contacts_[k].exact()) continue;
    const int i = 3 * contacts_[k].vertex[0];
    const double rho = exact_[k].q.trace();
    if (rho == 0) continue;
    any = true;
    // (I - P) / rho' with Q = rho' (I - P).
    const Matrix3d complement = Matrix3d::Identity() - exact_[k].p;
    const double scale = rho / complement.trace();
    AddProduct(complement / scale, *x, i, &known, i);
  }
  if (any) {
    Columns a_known;
    momentum_.Multiply(known, &a_known);
    *x -= a_known;
    for (size_t k = 0; k < contacts_.size(); ++k) {
      if (!contacts_[k].exact()) continue;
      const int i = 3 * contacts_[k].vertex[0];
      Transform(exact_[k].p, i, x);
      AddProduct(exact_[k].q, known, i, x, i);
    }
  }
  cholesky_->Solve(x);
}

// J^T x = z, J^T = A P + Q: P x from P A P x = P z, then
// (I-P) x = (I-P) (z - A P x) / rho.
void FrictionJacobian::SolveTransposed(Columns* x) const {
  if (!symmetric_) return lu_->SolveTransposed(x);
  const Columns z = *x;
  for (size_t k = 0; k < contacts_.size(); ++k)
    if (contacts_[k].exact())
      Transform(exact_[k].p, 3 * contacts_[k].vertex[0], x);
  cholesky_->Solve(x);
  Columns a_x;
  bool multiplied = false;
  for (size_t k = 0; k < contacts_.size(); ++k) {
    const double trace = contacts_[k].exact() ? exact_[k].q.trace() : 0;
    if (trace == 0) continue;
    if (!multiplied) momentum_.Multiply(*x, &a_x);
    multiplied = true;
    const int i = 3 * contacts_[k].vertex[0];
    const Matrix3d complement = Matrix3d::Identity() - exact_[k].p;
    const Matrix3d inverse = complement * (complement.trace() / trace);
    AddProduct(inverse, z, i, x, i);
    AddProduct(-inverse, a_x, i, x, i);
  }
}

void FrictionJacobian::Forward(const Columns& dn,
                               const Columns& dw,
                               Columns* rhs) const {
  for (size_t k = 0; k < contacts_.size(); ++k) {
    const Contact& c = contacts_[k];
    if (c.exact()) continue;
    const int row = 3 * static_cast<int>(k);
    for (int j = 0; j < c.num_vertices; ++j) {
      AddProduct(
          -c.weight[j] * compliant_[k].dq, dw, row, rhs, 3 * c.vertex[j]);
      AddProduct(c.weight[j] * compliant_[k].dn, dn, row, rhs, 3 * c.vertex[j]);
    }
  }
  for (size_t k = 0; k < contacts_.size(); ++k) {
    const Contact& c = contacts_[k];
    if (!c.exact() || exact_[k].open) continue;
    const int row = 3 * static_cast<int>(k), i = 3 * c.vertex[0];
    Transform(exact_[k].p, i, rhs);
    AddProduct(exact_[k].q, dw, row, rhs, i);
    AddProduct(-exact_[k].n, dn, row, rhs, i);
  }
  Solve(rhs);
}

void FrictionJacobian::Adjoint(Columns* z, Columns* dn, Columns* dw) const {
  SolveTransposed(z);
  for (size_t k = 0; k < contacts_.size(); ++k) {
    const Contact& c = contacts_[k];
    if (!c.exact() || exact_[k].open) continue;
    const int row = 3 * static_cast<int>(k), i = 3 * c.vertex[0];
    AddProduct(exact_[k].q.transpose(), *z, i, dw, row);
    AddProduct(-exact_[k].n.transpose(), *z, i, dn, row);
    Transform(exact_[k].p.transpose(), i, z);
  }
  for (size_t k = 0; k < contacts_.size(); ++k) {
    const Contact& c = contacts_[k];
    if (c.exact()) continue;
    const int row = 3 * static_cast<int>(k);
    for (int j = 0; j < c.num_vertices; ++j) {
      AddProduct(-c.weight[j] * compliant_[k].dq.transpose(),
                 *z,
                 3 * c.vertex[j],
                 dw,
                 row);
      AddProduct(c.weight[j] * compliant_[k].dn.transpose(),
                 *z,
                 3 * c.vertex[j],
                 dn,
                 row);
    }
  }
}

}  // namespace invsim
