// SPDX-License-Identifier: Apache-2.0
#include "mannequin_skin.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "invsim/base/joints.h"
#include "smooth_step.h"

namespace invsim {
namespace {

using JointWeights = Eigen::Matrix<double, 1, kNumJoints>;

// Rounds of averaging with the neighbours, and how much of the mean is taken.
constexpr int kSmoothings = 4;
constexpr double kMeanShare = 0.5;
constexpr int kMaxInfluences = 4;

Vector3d Mirrored(const Vector3d& x) { return {-x.x(), x.y(), x.z()}; }

// Share of what hangs on a joint: `blend` metres to either side of it.
double Beyond(double place, double blend, double s) {
  return SmoothStep(place - blend, place + blend, s);
}

// The right side has the numbers of the left plus one.
void AddArm(const Vector3d& x, double share, int side, JointWeights* w) {
  const double forearm = Beyond(.425, .055, x.x());
  const double wrist = Beyond(.695, .040, x.x());
  const double thumb = SmoothStep(.034, .060, x.z());
  const double fingers = Beyond(.785, .035, x.x()) * (1.0 - thumb);
  (*w)[kLeftShoulder + side] += share * (1.0 - forearm);
  (*w)[kLeftElbow + side] += share * forearm * (1.0 - wrist);
  (*w)[kLeftWrist + side] += share * forearm * wrist * (1.0 - fingers);
  (*w)[kLeftHand + side] += share * forearm * wrist * fingers;
}

void AddLeg(const Vector3d& x, double share, int side, JointWeights* w) {
  const double shin = Beyond(.615, .065, -x.y());
  const double foot = Beyond(1.015, .035, -x.y());
  const double toes = Beyond(.105, .030, x.z()) * foot;
  (*w)[kLeftHip + side] += share * (1.0 - shin);
  (*w)[kLeftKnee + side] += share * shin * (1.0 - foot);
  (*w)[kLeftAnkle + side] += share * shin * foot * (1.0 - toes);
  (*w)[kLeftFoot + side] += share * shin * foot * toes;
}

void AddTrunk(const Vector3d& x, double share, JointWeights* w) {
  const double spine1 = Beyond(-.115, .075, x.y());
  const double spine2 = Beyond(.010, .070, x.y());
  const double spine3 = Beyond(.115, .070, x.y());
  // The neck leans forward, and so does its lower end.
  const double neck = Beyond(.315, .045, x.y() + .25 * x.z());
  const double head = HeadShare(x);
  const double collar = SmoothStep(.02, .13, std::abs(x.x())) *
                        SmoothStep(.10, .22, x.y()) * (1.0 - neck);
  (*w)[kPelvis] += share * (1.0 - spine1);
  (*w)[kSpine1] += share * spine1 * (1.0 - spine2);
  (*w)[kSpine2] += share * spine2 * (1.0 - spine3);
  (*w)[kSpine3] += share * spine3 * (1.0 - neck) * (1.0 - collar);
  const int side = x.x() < 0.0 ? 1 : 0;
  (*w)[kLeftCollar + side] += share * spine3 * (1.0 - neck) * collar;
  (*w)[kNeck] += share * neck * (1.0 - head);
  (*w)[kHead] += share * neck * head;
}

JointWeights RawWeights(const Vector3d& x) {
  const int side = x.x() < 0.0 ? 1 : 0;
  const Vector3d folded(std::abs(x.x()), x.y(), x.z());
  const double arm = ArmShare(x);
  const double left_leg = LeftLegShare(x);
  const double right_leg = LeftLegShare(Mirrored(x));
  JointWeights w = JointWeights::Zero();
  AddArm(folded, arm, side, &w);
  AddLeg(x, left_leg, 0, &w);
  AddLeg(Mirrored(x), right_leg, 1, &w);
  AddTrunk(x, 1.0 - arm - left_leg - right_leg, &w);
  return w;
}

int MirrorJoint(int j) {
  static const std::array<int, kNumJoints> mirror = {
      kPelvis,     kRightHip,      kLeftHip,      kSpine1,      kRightKnee,
      kLeftKnee,   kSpine2,        kRightAnkle,   kLeftAnkle,   kSpine3,
      kRightFoot,  kLeftFoot,      kNeck,         kRightCollar, kLeftCollar,
      kHead,       kRightShoulder, kLeftShoulder, kRightElbow,  kLeftElbow,
      kRightWrist, kLeftWrist,     kRightHand,    kLeftHand};
  return mirror[j];
}

// Makes mirror images equal: sums in another order differ in the last bit.
void Symmetrise(const std::vector<int>& mirror, MatrixXd* weights) {
  const auto n = static_cast<int>(mirror.size());
  for (int i = 0; i < n; ++i) {
    if (mirror[i] < i) continue;
    for (int j = 0; j < kNumJoints; ++j) {
      double& a = (*weights)(i, j);
      double& b = (*weights)(mirror[i], MirrorJoint(j));
      a = b = 0.5 * (a + b);
    }
  }
}

// Keeps the largest weights. Each is lowered by the largest one dropped, so
// that no weight jumps where two vertices drop different joints. Sums run in
// the order of size, to be the same for mirror images.
void KeepLargest(MatrixXd* weights) {
  for (Eigen::Index i = 0; i < weights->rows(); ++i) {
    JointWeights sorted = weights->row(i);
    std::sort(sorted.data(), sorted.data() + kNumJoints, std::greater<>());
    const double dropped = sorted[kMaxInfluences];
    double sum = 0.0;
    for (int k = 0; k < kMaxInfluences; ++k) sum += sorted[k] - dropped;
    weights->row(i) =
        ((weights->row(i).array() - dropped).max(0.0) / sum).matrix();
  }
}

}  // namespace

const Points& MannequinJoints() {
  static const Points joints = [] {
    Points p(3, kNumJoints);
    const auto set = [&](int left, double x, double y, double z) {
      p.col(left) << x, y, z;
      p.col(MirrorJoint(left)) << -x, y, z;
    };
    set(kPelvis, 0.0, -.195, .002);
    set(kLeftHip, .090, -.240, .000);
    set(kSpine1, 0.0, -.115, -.018);
    set(kLeftKnee, .108, -.615, .002);
    set(kSpine2, 0.0, .010, -.022);
    set(kLeftAnkle, .125, -1.015, -.020);
    set(kSpine3, 0.0, .115, -.018);
    set(kLeftFoot, .136, -1.075, .100);
    set(kNeck, 0.0, .305, -.018);
    set(kLeftCollar, .050, .235, -.012);
    set(kHead, 0.0, .395, .004);
    set(kLeftShoulder, .172, .248, -.012);
    set(kLeftElbow, .425, .250, -.012);
    set(kLeftWrist, .695, .250, -.005);
    set(kLeftHand, .785, .248, .002);
    return p;
  }();
  return joints;
}

const std::vector<int>& MannequinParents() {
  static const std::vector<int> parents = {
      -1,         kPelvis,     kPelvis,      kPelvis,       kLeftHip,
      kRightHip,  kSpine1,     kLeftKnee,    kRightKnee,    kSpine2,
      kLeftAnkle, kRightAnkle, kSpine3,      kSpine3,       kSpine3,
      kNeck,      kLeftCollar, kRightCollar, kLeftShoulder, kRightShoulder,
      kLeftElbow, kRightElbow, kLeftWrist,   kRightWrist};
  return parents;
}

// Below the shoulder the border runs inward and up, round the armpit.
double ArmShare(const Vector3d& x) {
  const double out = std::abs(x.x()) + 0.6 * std::min(0.0, x.y() - .250);
  return SmoothStep(.110, .235, out);
}

// From the groin line, which climbs from the crotch to the hip bone; in the
// middle the legs share.
double LeftLegShare(const Vector3d& x) {
  const double below = .625 * x.x() - .780 * (x.y() + .340);
  const double low = SmoothStep(0.0, -.10, x.y());  // the line ends at the hip
  return low * SmoothStep(-.090, .060, below) * SmoothStep(-.035, .035, x.x());
}

double HeadShare(const Vector3d& x) {
  return Beyond(.395, .040, x.y() + .25 * x.z());
}

MatrixXd MannequinWeights(const MirrorMesh& body) {
  const TriangleMesh& mesh = body.mesh;
  const Eigen::Index n = mesh.vertices.cols();
  MatrixXd weights(n, kNumJoints);
  for (Eigen::Index i = 0; i < n; ++i) {
    weights.row(i) = RawWeights(mesh.vertices.col(i));
  }
  const std::vector<Edge> edges = Edges(mesh.faces);
  for (int round = 0; round < kSmoothings; ++round) {
    MatrixXd mean = MatrixXd::Zero(n, kNumJoints);
    VectorXd count = VectorXd::Zero(n);
    for (const Edge& edge : edges) {
      mean.row(edge.a) += weights.row(edge.b);
      mean.row(edge.b) += weights.row(edge.a);
      count[edge.a] += 1.0;
      count[edge.b] += 1.0;
    }
    weights = (1.0 - kMeanShare) * weights +
              kMeanShare * (count.cwiseInverse().asDiagonal() * mean);
  }
  Symmetrise(body.mirror, &weights);
  KeepLargest(&weights);
  return weights;
}

// Among the weights whose mean is the joint, those closest to a Gaussian in
// relative entropy: w_i ~ g_i exp(lambda . (x_i - joint)), with lambda from
// the convex minimum of log sum_i of that (Newton's method).
MatrixXd MannequinRegressor(const MirrorMesh& body) {
  constexpr double kWidth = 0.05;
  constexpr double kReach = 0.16;
  const Points& vertices = body.mesh.vertices;
  MatrixXd regressor = MatrixXd::Zero(kNumJoints, vertices.cols());
  for (int j = 0; j < kNumJoints; ++j) {
    if (MirrorJoint(j) < j) continue;
    const Vector3d joint = MannequinJoints().col(j);
    std::vector<int> near;
    std::vector<Vector3d> arms;
    std::vector<double> prior;
    for (int i = 0; i < vertices.cols(); ++i) {
      const Vector3d arm = vertices.col(i) - joint;
      if (arm.norm() > kReach) continue;
      near.push_back(i);
      arms.push_back(arm / kWidth);
      prior.push_back(std::exp(-0.5 * arms.back().squaredNorm()));
    }
    std::vector<double> w(near.size());
    Vector3d lambda = Vector3d::Zero();
    for (int iteration = 0; iteration < 30; ++iteration) {
      double sum = 0.0;
      Vector3d mean = Vector3d::Zero();
      Matrix3d second = Matrix3d::Zero();
      for (std::size_t k = 0; k < near.size(); ++k) {
        w[k] = prior[k] * std::exp(lambda.dot(arms[k]));
        sum += w[k];
        mean += w[k] * arms[k];
        second += w[k] * arms[k] * arms[k].transpose();
      }
      mean /= sum;
      for (double& value : w) value /= sum;
      if (mean.norm() < 1e-14) break;
      const Matrix3d hessian = second / sum - mean * mean.transpose();
      Vector3d step = hessian.ldlt().solve(mean);
      lambda -= step * std::min(1.0, 2.0 / step.norm());
    }
    for (std::size_t k = 0; k < near.size(); ++k) {
      regressor(j, near[k]) = w[k];
      regressor(MirrorJoint(j), body.mirror[near[k]]) = w[k];
    }
  }
  return regressor;
}

}  // namespace invsim
