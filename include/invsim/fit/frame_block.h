// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_FRAME_BLOCK_H_
#define INVSIM_FIT_FRAME_BLOCK_H_

// Thousands of points of a frame as one small least-squares block.
//
// Each point k adds the cost 1/2 w_k rho_k(|r_k|^2) with its own robust loss,
// which is what an outlier is. As Ceres does (Triggs et al., "Bundle
// adjustment: a modern synthesis", 2000, section 4.3) r_k and its Jacobian are
// rescaled so that J^T r is the exact gradient and J^T J the Gauss-Newton
// matrix with the loss's curvature. The stacked rows (J | r) of all points are
// then replaced by the triangle of their QR factorisation, p rows for p
// parameters,
//
//   J = Q R,  r' = Q^T r:   R^T R = J^T J,  R^T r' = J^T r,
//
// so gradient, Gauss-Newton matrix and step are those of the points. What the
// triangle does not carry of the cost is a constant of the Gauss-Newton model:
// `offset` = 2 cost - |r'|^2, which may have either sign.

#include <cmath>

#include "invsim/base/types.h"

namespace ceres {
class LossFunction;
}

namespace invsim {

struct FrameBlock {
  double cost = 0;    // 1/2 sum_k w_k rho_k
  VectorXd residual;  // p, or empty: cost only
  MatrixXd jacobian;  // p x p, upper triangle
  double offset() const { return 2 * cost - residual.squaredNorm(); }
  bool finite() const {
    return std::isfinite(cost) && residual.allFinite() && jacobian.allFinite();
  }
};

class BlockCompressor {
 public:
  // With `derivatives` false only the cost is summed.
  BlockCompressor(int num_parameters, bool derivatives);

  // A point: residual r (d numbers), Jacobian (d x p), weight >= 0 and loss
  // (null: trivial). `jacobian` may be empty when there are no derivatives.
  void Add(const Eigen::Ref<const VectorXd>& residual,
           const Eigen::Ref<const MatrixXd>& jacobian,
           double weight,
           const ceres::LossFunction* loss);

  FrameBlock Finish();

 private:
  void Compress();

  int parameters_;
  bool derivatives_;
  double cost_ = 0;
  MatrixXd rows_;  // (J | r): the triangle so far on top, then new rows
  int used_;
};

}  // namespace invsim

#endif  // INVSIM_FIT_FRAME_BLOCK_H_
