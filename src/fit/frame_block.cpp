// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/frame_block.h"

#include <ceres/loss_function.h>

#include <Eigen/QR>
#include <cmath>

namespace invsim {
namespace {

// Rows gathered before they are folded into the triangle: enough for blocked
// Householder reflections, few enough to stay in the cache.
constexpr int kChunk = 512;

// The scaling of residual and Jacobian by which squares stand for the loss.
// The second-order part alpha is used where it is safe (rho'' > 0 only),
// as in Ceres.
struct Correction {
  double scale;     // of r, and of J: sqrt(rho')
  double residual;  // further factor of r: 1 / (1 - alpha)
  double alpha;     // J loses alpha r r^T J / |r|^2
};

Correction Correct(double squared_norm, const double rho[3]) {
  const double scale = std::sqrt(rho[1]);
  if (squared_norm == 0 || rho[2] <= 0) return {scale, 1, 0};
  const double d = 1 + 2 * squared_norm * rho[2] / rho[1];
  const double alpha = 1 - std::sqrt(d);
  return {scale, 1 / (1 - alpha), alpha};
}

}  // namespace

BlockCompressor::BlockCompressor(int num_parameters, bool derivatives)
    : parameters_(num_parameters),
      derivatives_(derivatives),
      used_(num_parameters) {
  if (derivatives_) rows_.setZero(parameters_ + kChunk, parameters_ + 1);
}

void BlockCompressor::Add(const Eigen::Ref<const VectorXd>& residual,
                          const Eigen::Ref<const MatrixXd>& jacobian,
                          double weight,
                          const ceres::LossFunction* loss) {
  const double s = residual.squaredNorm();
  double rho[3] = {s, 1, 0};
  if (loss) loss->Evaluate(s, rho);
  for (double& value : rho) value *= weight;
  cost_ += 0.5 * rho[0];
  if (!derivatives_ || rho[1] == 0) return;
  const int d = static_cast<int>(residual.size());
  if (used_ + d > rows_.rows()) Compress();
  const Correction c = Correct(s, rho);
  auto j = rows_.block(used_, 0, d, parameters_);
  j = c.scale * jacobian;
  if (c.alpha != 0) {
    const Eigen::RowVectorXd along = residual.transpose() * j;
    j -= (c.alpha / s) * residual * along;
  }
  rows_.block(used_, parameters_, d, 1) = c.scale * c.residual * residual;
  used_ += d;
}

void BlockCompressor::Compress() {
  auto rows = rows_.topRows(used_);
  const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(rows);
  for (int c = 0; c < parameters_; ++c)
    rows_.col(c).tail(rows_.rows() - c - 1).setZero();
  rows_.col(parameters_).tail(rows_.rows() - parameters_).setZero();
  used_ = parameters_;
}

FrameBlock BlockCompressor::Finish() {
  FrameBlock block;
  block.cost = cost_;
  if (!derivatives_) return block;
  Compress();
  block.jacobian = rows_.topLeftCorner(parameters_, parameters_);
  block.residual = rows_.col(parameters_).head(parameters_);
  return block;
}

}  // namespace invsim
