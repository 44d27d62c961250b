// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/tpose_body.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "invsim/base/error.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/topology.h"

namespace invsim {
namespace {

constexpr int kJoints = 24;

void Require(bool condition, const std::string& what) {
  if (!condition) throw InputError("body to dress: " + what);
}

std::string Size(Eigen::Index rows, Eigen::Index cols) {
  return std::to_string(rows) + " x " + std::to_string(cols);
}

double Volume(const TPoseBody& body) {
  double volume = 0.0;
  for (Eigen::Index f = 0; f < body.faces.cols(); ++f) {
    const Vector3d a = body.vertices.col(body.faces(0, f));
    const Vector3d b = body.vertices.col(body.faces(1, f));
    volume += a.cross(b).dot(body.vertices.col(body.faces(2, f))) / 6.0;
  }
  return volume;
}

void CheckPose(const Points& j) {
  Require(j.allFinite(), "a joint is not finite, expected numbers");
  const auto y = [&](int joint) { return j(1, joint); };
  Require(y(kHead) > y(kNeck) && y(kNeck) > y(kPelvis) &&
              y(kPelvis) > y(kLeftKnee) && y(kLeftKnee) > y(kLeftAnkle),
          "head, neck, pelvis, knee and ankle joints are not above each "
          "other, expected a body standing along +y");
  for (int side = 0; side < 2; ++side) {
    const Vector3d arm = j.col(kLeftWrist + side) - j.col(kLeftShoulder + side);
    const double out = side == 0 ? arm[0] : -arm[0];
    Require(out > 0.8 * arm.norm(),
            std::string(side == 0 ? "left arm is not along +x"
                                  : "right arm is not along -x") +
                ", expected the T-pose, facing +z");
  }
}

}  // namespace

void ValidateTPoseBody(const TPoseBody& body) {
  Require(body.joints.cols() == kJoints,
          std::to_string(body.joints.cols()) + " joints, expected 24");
  Require(body.weights.rows() == body.vertices.cols() &&
              body.weights.cols() == kJoints,
          "weights are " + Size(body.weights.rows(), body.weights.cols()) +
              ", expected " + Size(body.vertices.cols(), kJoints));
  ValidateMesh(body.vertices, body.faces, "body to dress");
  for (const Edge& e : Edges(body.faces))
    Require(e.faces[1] >= 0,
            "edge (" + std::to_string(e.a) + ", " + std::to_string(e.b) +
                ") has one face, expected a closed mesh");
  Require(Volume(body) > 0.0, "faces point inwards, expected outwards");
  CheckPose(body.joints);
}

std::vector<char> FacesOf(const TPoseBody& body,
                          const std::vector<int>& joints) {
  VectorXd share = VectorXd::Zero(body.weights.rows());
  for (const int j : joints) share += body.weights.col(j);
  std::vector<char> chosen(body.faces.cols());
  for (Eigen::Index f = 0; f < body.faces.cols(); ++f)
    chosen[f] = share[body.faces(0, f)] > 0.5 &&
                share[body.faces(1, f)] > 0.5 && share[body.faces(2, f)] > 0.5;
  return chosen;
}

}  // namespace invsim
