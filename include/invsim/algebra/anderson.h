// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_ALGEBRA_ANDERSON_H_
#define INVSIM_ALGEBRA_ANDERSON_H_

// Anderson acceleration (Anderson 1965; type II of Fang & Saad 2009) of a
// fixed-point iteration q <- T(q), for instance of a splitting method
// (Zhang, O'Donoghue & Boyd 2020). With f_k = T(q_k) - q_k and the last m
// differences dF, dT of f and of T(q),
//
//   q_{k+1} = T(q_k) - dT gamma,   gamma = argmin |f_k - dF gamma| .
//
// On a linear map it equals GMRES; on a piecewise smooth one it still gains
// much, but may go astray. If |f| doubles from one iterate to the next, the
// history is forgotten and the iteration resumes from the last plain image.

#include "invsim/base/types.h"

namespace invsim {

class AndersonAcceleration {
 public:
  explicit AndersonAcceleration(int memory) : memory_(memory) {}

  void Reset();

  // From the image T(q) of the iterate *q, the next iterate.
  void Next(const VectorXd& image, VectorXd* q);

  // |T(q) - q| of the last iterate.
  double residual() const { return norm_; }

 private:
  void Remember(const VectorXd& f, const VectorXd& image);
  VectorXd Coefficients(const VectorXd& f) const;

  int memory_;
  int count_ = 0;      // differences remembered since the last reset
  bool have_ = false;  // whether last_f_, last_image_ are set
  double norm_ = 0;
  VectorXd last_f_, last_image_;
  MatrixXd df_, dt_;  // a difference per column, the oldest overwritten
  MatrixXd gram_;     // df_^T df_
};

}  // namespace invsim

#endif  // INVSIM_ALGEBRA_ANDERSON_H_
