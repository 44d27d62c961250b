// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CONTACT_FRICTION_JACOBIAN_H_
#define INVSIM_CONTACT_FRICTION_JACOBIAN_H_

// The Jacobian J of the frictional problem F(v) = 0 of friction_solver.h, with
// momentum on the free vertices and the contact law, r = A v - b, on the
// others. Newton's method solves with it, and at the solution it gives the
// derivative of v by the implicit function theorem (the paper's eq. 6):
//
//   J dv = rhs,   row i of J:  A_i                      free vertex
//                              P_i A_i + Q_i            vertex in contact
//   rhs row i:    m_i                                   free
//                 P_i m_i + Q_i dw - N_i dn             in contact
//
// where m is the change of the momentum's right side at fixed v, dw and dn
// those of the contact's velocity and normal, and (P, Q, N) the derivatives of
// the contact law with respect to (r, u, n). A compliant contact is a force and
// adds to m and to A. J is symmetric, after elimination, if nothing slides with
// friction; then it is factorised by Cholesky, else by LU.

#include <memory>
#include <vector>

#include "invsim/algebra/block_matrix.h"
#include "invsim/algebra/sparse_cholesky.h"
#include "invsim/algebra/sparse_lu.h"
#include "invsim/contact/contact.h"
#include "invsim/contact/contact_pattern.h"
#include "invsim/contact/coulomb.h"

namespace invsim {

// Whether the contact acts at a solution, that is, is not open: J, and with it
// the derivative of v, does not depend on the plane of one that does not.
bool Acts(const Contact& contact,
          const BlockMatrix& a,
          const VectorXd& v,
          const Vector3d& force);

class FrictionJacobian {
 public:
  // `pattern` of A. Contacts may couple vertices that it does not.
  explicit FrictionJacobian(std::shared_ptr<const BlockPattern> pattern);

  // J at `v`, with the contacts' `forces` there. False if J is singular.
  bool Factor(const BlockMatrix& a,
              const std::vector<Contact>& contacts,
              const VectorXd& v,
              const std::vector<Vector3d>& forces);

  // On entry `rhs` holds m (3N x p), on return dv. `dn`, `dw`: 3 rows per
  // contact, p columns.
  void Forward(const Columns& dn, const Columns& dw, Columns* rhs) const;

  // The transpose: on entry `z` holds the adjoint of dv, on return that of m;
  // the adjoints of dn and dw are added to.
  void Adjoint(Columns* z, Columns* dn, Columns* dw) const;

  // x <- J^{-1} x and x <- J^{-T} x.
  void Solve(Columns* x) const;
  void SolveTransposed(Columns* x) const;

  bool symmetric() const { return symmetric_; }

  // Forgets which contacts there were (contact/contact_pattern.h).
  void Forget();

 private:
  struct Row {
    Matrix3d p, q, n;
    bool open;  // p = 1, q = n = 0
  };
  void Linearize(const std::vector<Contact>& contacts,
                 const VectorXd& v,
                 const std::vector<Vector3d>& forces,
                 const BlockMatrix& a);
  void AssembleCompliant(const BlockMatrix& a);
  void UsePattern();

  ContactPattern pattern_;
  std::vector<Contact> contacts_;
  std::vector<Row> exact_;                      // of exact contacts
  std::vector<CompliantDerivative> compliant_;  // of the others
  bool symmetric_ = false;
  BlockMatrix momentum_;                      // A with the compliant contacts
  BlockMatrix jacobian_;                      // the matrix factorised
  std::unique_ptr<SparseCholesky> cholesky_;  // made when first needed
  std::unique_ptr<SparseLu> lu_;
};

}  // namespace invsim

#endif  // INVSIM_CONTACT_FRICTION_JACOBIAN_H_
