// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/frame_block.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "invsim/base/random.h"
#include "invsim/fit/loss.h"

namespace invsim {
namespace {

constexpr int kParameters = 7;
constexpr int kPoints = 700;  // more than one chunk of rows

struct Point {
  VectorXd r;
  MatrixXd j;
  double weight;
};

// A third of the points are outliers, ten scales away.
std::vector<Point> RandomPoints(int d) {
  Random random(3, d);
  std::vector<Point> points(kPoints);
  for (int k = 0; k < kPoints; ++k) {
    const double size = k % 3 == 0 ? 0.2 : 0.01;
    points[k].r =
        VectorXd(d).unaryExpr([&](double) { return size * random.Normal(); });
    points[k].j = MatrixXd(d, kParameters).unaryExpr([&](double) {
      return random.Normal();
    });
    points[k].weight = random.Uniform(0.1, 2);
  }
  return points;
}

// r + J x.
class LinearPoint : public ceres::CostFunction {
 public:
  explicit LinearPoint(const Point& point) : point_(point) {
    set_num_residuals(static_cast<int>(point.r.size()));
    mutable_parameter_block_sizes()->push_back(kParameters);
  }
  bool Evaluate(double const* const* x,
                double* residuals,
                double** jacobians) const override {
    Eigen::Map<VectorXd>(residuals, point_.r.size()) =
        point_.r + point_.j * Eigen::Map<const VectorXd>(x[0], kParameters);
    if (jacobians && jacobians[0])
      Eigen::Map<Columns>(jacobians[0], point_.r.size(), kParameters)
          .noalias() = point_.j;
    return true;
  }

 private:
  Point point_;
};

struct Linearized {
  double cost;
  VectorXd gradient;
  MatrixXd hessian;
};

// Ceres's own: one residual block and one loss per point.
Linearized ByCeres(const std::vector<Point>& points,
                   const ceres::LossFunction* loss) {
  VectorXd x = VectorXd::Zero(kParameters);
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  std::vector<std::unique_ptr<ceres::LossFunction>> losses;
  for (const Point& point : points) {
    losses.push_back(std::make_unique<ceres::ScaledLoss>(
        loss, point.weight, ceres::DO_NOT_TAKE_OWNERSHIP));
    problem.AddResidualBlock(
        new LinearPoint(point), losses.back().get(), x.data());
  }
  Linearized result;
  std::vector<double> residuals, gradient;
  ceres::CRSMatrix crs;
  problem.Evaluate({}, &result.cost, &residuals, &gradient, &crs);
  result.gradient = Eigen::Map<VectorXd>(gradient.data(), kParameters);
  const Eigen::Map<Columns> j(crs.values.data(), crs.num_rows, kParameters);
  result.hessian = j.transpose() * j;
  return result;
}

class EveryLossAndSize
    : public ::testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(EveryLossAndSize, EqualsOneCeresBlockPerPoint) {
  const auto loss = MakeLoss({std::get<0>(GetParam()), 0.02});
  const std::vector<Point> points = RandomPoints(std::get<1>(GetParam()));
  const Linearized expected = ByCeres(points, loss.get());
  BlockCompressor compressor(kParameters, true);
  BlockCompressor cost_only(kParameters, false);
  for (const Point& point : points) {
    compressor.Add(point.r, point.j, point.weight, loss.get());
    cost_only.Add(point.r, MatrixXd(), point.weight, loss.get());
  }
  const FrameBlock block = compressor.Finish();
  ASSERT_EQ(block.jacobian.rows(), kParameters);
  EXPECT_NEAR(block.cost / expected.cost, 1, 1e-12);
  EXPECT_EQ(cost_only.Finish().cost, block.cost);
  EXPECT_NEAR(0.5 * (block.residual.squaredNorm() + block.offset()),
              expected.cost,
              1e-12 * expected.cost);
  const VectorXd gradient = block.jacobian.transpose() * block.residual;
  EXPECT_LT((gradient - expected.gradient).norm(),
            1e-12 * expected.gradient.norm());
  const MatrixXd hessian = block.jacobian.transpose() * block.jacobian;
  EXPECT_LT((hessian - expected.hessian).norm(),
            1e-12 * expected.hessian.norm());
  const VectorXd step = hessian.ldlt().solve(-gradient);
  const VectorXd expected_step =
      expected.hessian.ldlt().solve(-expected.gradient);
  EXPECT_LT((step - expected_step).norm(), 1e-11 * expected_step.norm());
}

INSTANTIATE_TEST_SUITE_P(
    Registered,
    EveryLossAndSize,
    ::testing::Combine(::testing::ValuesIn(Losses().names()),
                       ::testing::Values(1, 3)));

TEST(BlockCompressor, NothingAddedIsNothing) {
  const FrameBlock block = BlockCompressor(4, true).Finish();
  EXPECT_EQ(block.cost, 0);
  EXPECT_TRUE(block.jacobian.isZero());
  EXPECT_TRUE(block.residual.isZero());
}

// A parameter that no point depends on leaves a zero column, not noise.
TEST(BlockCompressor, UnseenParameterStaysUnseen) {
  BlockCompressor compressor(3, true);
  Random random(1);
  for (int k = 0; k < 50; ++k) {
    VectorXd r(1);
    r[0] = random.Normal();
    MatrixXd j(1, 3);
    j << random.Normal(), 0, random.Normal();
    compressor.Add(r, j, 1, nullptr);
  }
  const FrameBlock block = compressor.Finish();
  EXPECT_TRUE(block.jacobian.col(1).isZero(0));
}

}  // namespace
}  // namespace invsim
