// SPDX-License-Identifier: Apache-2.0
// Skinning and its derivatives against SMPL's equations written down once more
// as plainly as possible, in dual numbers.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "invsim/body/body_model.h"
#include "test_bodies.h"

namespace invsim {
namespace {

using Jet = ceres::Jet<double, kNumBodyParameters>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

template <typename T>
Matrix3<T> Rodrigues(const Vector3<T>& v) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  Matrix3<T> k;
  k << T(0), -v(2), v(1), v(2), T(0), -v(0), -v(1), v(0), T(0);
  const T x2 = v(0) * v(0) + v(1) * v(1) + v(2) * v(2);
  const Matrix3<T> identity = Matrix3<T>::Identity();
  if (x2 == T(0)) return identity + k;
  const T x = sqrt(x2);
  const Matrix3<T> first = k * (sin(x) / x);
  const Matrix3<T> second = k * k * ((T(1) - cos(x)) / x2);
  return identity + first + second;
}

// The columns are the vertices, then the joints, of the body posed by
// parameters in the order beta, theta, t.
template <typename T>
Eigen::Matrix<T, 3, Eigen::Dynamic> NaivePose(
    const BodyModelData& d, const Eigen::Matrix<T, kNumBodyParameters, 1>& p) {
  const int n = static_cast<int>(d.v_template.cols());
  Matrix3<T> local[kNumJoints];
  Eigen::Matrix<T, Eigen::Dynamic, 1> features(kNumPoseFeatures);
  for (int j = 0; j < kNumJoints; ++j) {
    local[j] = Rodrigues<T>(p.template segment<3>(kNumShape + 3 * j));
    for (int e = 0; j > 0 && e < 9; ++e) {
      features(9 * (j - 1) + e) =
          local[j](e / 3, e % 3) - T(e / 3 == e % 3 ? 1 : 0);
    }
  }
  Eigen::Matrix<T, 3, Eigen::Dynamic> shaped(3, n);
  Eigen::Matrix<T, 3, Eigen::Dynamic> unposed(3, n);
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < 3; ++c) {
      T value(d.v_template(c, i));
      for (int k = 0; k < kNumShape; ++k) {
        value += p(k) * d.shapedirs(3 * i + c, k);
      }
      shaped(c, i) = value;
      for (int k = 0; d.posedirs.size() > 0 && k < kNumPoseFeatures; ++k) {
        value += features(k) * d.posedirs(3 * i + c, k);
      }
      unposed(c, i) = value;
    }
  }
  Vector3<T> rest[kNumJoints];
  Vector3<T> place[kNumJoints];
  Matrix3<T> world[kNumJoints];
  for (int j = 0; j < kNumJoints; ++j) {
    rest[j].setConstant(T(0));
    for (int i = 0; i < n; ++i) {
      if (d.joint_regressor(j, i) != 0) {
        rest[j] += shaped.col(i) * T(d.joint_regressor(j, i));
      }
    }
    const int a = d.parents[j];
    world[j] = a < 0 ? local[j] : Matrix3<T>(world[a] * local[j]);
    place[j] = rest[j];
    if (a >= 0) place[j] = place[a] + world[a] * (rest[j] - rest[a]);
  }
  Eigen::Matrix<T, 3, Eigen::Dynamic> out(3, n + kNumJoints);
  const Vector3<T> t = p.template tail<3>();
  for (int i = 0; i < n; ++i) {
    Vector3<T> sum = t;
    for (int j = 0; j < kNumJoints; ++j) {
      if (d.weights(i, j) == 0) continue;
      const Vector3<T> arm = unposed.col(i) - rest[j];
      sum += (world[j] * arm + place[j]) * T(d.weights(i, j));
    }
    out.col(i) = sum;
  }
  for (int j = 0; j < kNumJoints; ++j) out.col(n + j) = place[j] + t;
  return out;
}

VectorXd AsVector(const BodyParameters& p) {
  VectorXd v(kNumBodyParameters);
  v << p.shape, p.pose, p.translation;
  return v;
}

struct JetReference {
  Points positions;   // vertices, then joints
  MatrixXd jacobian;  // rows likewise
};

JetReference Differentiate(const BodyModelData& data, const BodyParameters& p) {
  const VectorXd values = AsVector(p);
  Eigen::Matrix<Jet, kNumBodyParameters, 1> jets;
  for (int k = 0; k < kNumBodyParameters; ++k) jets(k) = Jet(values(k), k);
  const auto posed = NaivePose<Jet>(data, jets);
  JetReference reference{Points(3, posed.cols()),
                         MatrixXd(posed.size(), kNumBodyParameters)};
  for (Eigen::Index k = 0; k < posed.size(); ++k) {
    reference.positions.data()[k] = posed.data()[k].a;
    reference.jacobian.row(k) = posed.data()[k].v;
  }
  return reference;
}

struct PoseCase {
  const char* name;
  bool posedirs;
  // Fills in the pose of otherwise random parameters.
  void (*set)(BodyParameters* p);
};

void PrintTo(const PoseCase& pose_case, std::ostream* out) {
  *out << pose_case.name;
}

// Joint rotations of this angle about various axes.
void SetAngles(double angle, BodyParameters* p) {
  for (int j = 0; j < kNumJoints; ++j) {
    const Vector3d axis(1 + j % 3, j % 5 - 2, 1 - j % 2);
    p->pose.segment<3>(3 * j) = angle * axis.normalized();
  }
}

const PoseCase kCases[] = {
    {"Random", false, [](BodyParameters*) {}},
    {"RandomWithPoseBlendShapes", true, [](BodyParameters*) {}},
    {"Zero", true, [](BodyParameters* p) { p->pose.setZero(); }},
    {"NearZero", true, [](BodyParameters* p) { SetAngles(1e-3, p); }},
    {"HalfTurns",
     true,
     [](BodyParameters* p) { SetAngles(std::numbers::pi, p); }},
    {"WholeTurns",
     true,
     [](BodyParameters* p) { SetAngles(2 * std::numbers::pi, p); }},
    {"NearWholeTurns",
     true,
     [](BodyParameters* p) { SetAngles(2 * std::numbers::pi - 1e-7, p); }},
    {"MixedZeroAndWholeTurns", true, [](BodyParameters* p) {
       SetAngles(2 * std::numbers::pi, p);
       for (int j = 0; j < kNumJoints; j += 2) {
         p->pose.segment<3>(3 * j).setZero();
       }
     }}};

class PosedBodyCase : public ::testing::TestWithParam<PoseCase> {
 protected:
  PosedBodyCase()
      : rng_(7),
        data_(RandomBodyData(300, GetParam().posedirs, &rng_)),
        model_(data_),
        parameters_(RandomParameters(0.8, &rng_)) {
    GetParam().set(&parameters_);
    posed_ = model_.Pose(parameters_);
    reference_ = Differentiate(data_, parameters_);
  }
  int n() const { return model_.num_vertices(); }

  std::mt19937 rng_;
  BodyModelData data_;
  BodyModel model_;
  BodyParameters parameters_;
  std::shared_ptr<const PosedBody> posed_;
  JetReference reference_;
};

TEST_P(PosedBodyCase, PositionsAgreeWithTheEquations) {
  EXPECT_LT((posed_->vertices() - reference_.positions.leftCols(n()))
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
  EXPECT_LT((posed_->joints() - reference_.positions.rightCols(kNumJoints))
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
}

TEST_P(PosedBodyCase, JacobianAgreesWithDualNumbers) {
  std::vector<int> all(n());
  std::iota(all.begin(), all.end(), 0);
  const MatrixXd jacobian = posed_->Jacobian(all);
  const MatrixXd error = jacobian - reference_.jacobian.topRows(3 * n());
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-10);
}

TEST_P(PosedBodyCase, JointJacobianAgreesWithDualNumbers) {
  const MatrixXd error =
      posed_->JointJacobian() - reference_.jacobian.bottomRows(3 * kNumJoints);
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-10);
}

TEST_P(PosedBodyCase, ProductsAgreeWithDualNumbers) {
  const auto jacobian = reference_.jacobian.topRows(3 * n());
  const VectorXd u = RandomMatrix(kNumBodyParameters, 1, 1.0, &rng_);
  const Points product = posed_->Product(u);
  EXPECT_LT((Stacked(product) - jacobian * u).cwiseAbs().maxCoeff(), 1e-10);
  const Points w = RandomMatrix(3, n(), 1.0, &rng_);
  const VectorXd pulled = posed_->TransposedProduct(w);
  EXPECT_LT((pulled - jacobian.transpose() * Stacked(w)).cwiseAbs().maxCoeff(),
            1e-10);
}

INSTANTIATE_TEST_SUITE_P(Poses,
                         PosedBodyCase,
                         ::testing::ValuesIn(kCases),
                         [](const auto& param) {
                           return std::string(param.param.name);
                         });

TEST(PosedBody, ChosenVerticesGiveTheirRows) {
  std::mt19937 rng(3);
  const BodyModel model(RandomBodyData(50, true, &rng));
  const auto posed = model.Pose(RandomParameters(0.5, &rng));
  const std::vector<int> chosen = {49, 0, 7, 7};
  const MatrixXd rows = posed->Jacobian(chosen);
  ASSERT_EQ(rows.rows(), 12);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const MatrixXd one = posed->Jacobian(std::span(&chosen[k], 1));
    EXPECT_EQ(rows.middleRows(3 * k, 3), one);
  }
  EXPECT_EQ(posed->Jacobian({}).rows(), 0);
}

TEST(PosedBody, RepeatsItselfExactly) {
  std::mt19937 rng(4);
  const BodyModel model(RandomBodyData(1000, true, &rng));
  const BodyParameters p = RandomParameters(0.5, &rng);
  const Points w = RandomMatrix(3, 1000, 1.0, &rng);
  const VectorXd first = model.Pose(p)->TransposedProduct(w);
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(model.Pose(p)->TransposedProduct(w), first);
  }
}

// The convention: the root turns the body about the pelvis joint, and the
// translation comes last.
TEST(PosedBody, RootTurnsAboutThePelvis) {
  std::mt19937 rng(5);
  const BodyModel model(RandomBodyData(80, false, &rng));
  BodyParameters p = RandomParameters(0.5, &rng);
  p.pose.head<3>().setZero();
  p.translation.setZero();
  const Points straight = model.Vertices(p);
  const Vector3d pelvis = model.Joints(p).col(0);
  p.pose.head<3>() = Vector3d(0, std::numbers::pi / 2, 0);
  p.translation = Vector3d(1, 2, 3);
  const Points turned = model.Vertices(p);
  for (int i = 0; i < 80; ++i) {
    const Vector3d arm = straight.col(i) - pelvis;
    const Vector3d expected =
        Vector3d(arm.z(), arm.y(), -arm.x()) + pelvis + Vector3d(1, 2, 3);
    EXPECT_LT((turned.col(i) - expected).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace invsim
