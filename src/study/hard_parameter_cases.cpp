// SPDX-License-Identifier: Apache-2.0

// Hard scenes: bodies that parameters allow and nature does not. A T-shirt of
// 6 cm triangles on the mannequin, which goes from the T-pose to the wanted
// parameters in half a second.

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "hard_cases.h"
#include "invsim/base/joints.h"
#include "invsim/base/random.h"
#include "invsim/body/mannequin.h"
#include "invsim/cloth/authored_garment.h"

namespace invsim {
namespace {

constexpr int kMoving = 30;  // frames

const Garment& Shirt() {
  static const Garment shirt = [] {
    const BodyModel& body = Mannequin();
    return AuthoredGarment(
        "tshirt",
        {body.Vertices({}), body.faces(), body.Joints({}), body.data().weights},
        {.edge_length = 0.06});
  }();
  return shirt;
}

HardScene Dressed(const BodyParameters& from, const BodyParameters& to) {
  const BodyModel& body = Mannequin();
  HardScene scene;
  scene.garment = Shirt();
  scene.material = {
      "jersey", 0.2, IsotropicStretch{200, 0.3}, IsotropicBending{1e-5}};
  scene.body = {body.Vertices(from), body.faces()};
  scene.limits.contacts = 1;
  scene.frames = kMoving + 2;
  scene.body_at = [&body, from, to](int frame) {
    const double s = std::min(frame, kMoving) / static_cast<double>(kMoving);
    BodyParameters p;
    p.shape = (1 - s) * from.shape + s * to.shape;
    p.pose = (1 - s) * from.pose + s * to.pose;
    p.translation = (1 - s) * from.translation + s * to.translation;
    return body.Vertices(p);
  };
  // Height, a turn of the root, a shoulder, a shift.
  const std::shared_ptr<const PosedBody> posed = body.Pose(to);
  for (int k : {0, 11, 60, 83}) {
    Points direction = posed->Product(VectorXd::Unit(kNumBodyParameters, k));
    // At 2 pi a rotation vector has but one direction left.
    if (direction.norm() > 1e-9)
      scene.directions.push_back(std::move(direction));
  }
  return scene;
}

HardScene ToPose(const std::vector<std::pair<int, Vector3d>>& joints) {
  BodyParameters to;
  for (const auto& [joint, rotation] : joints)
    to.pose.segment<3>(3 * joint) = rotation;
  return Dressed({}, to);
}

HardScene ToShape(double value) {
  BodyParameters to;
  for (int k = 0; k < kNumShape; ++k) to.shape[k] = k % 2 == 0 ? value : -value;
  return Dressed({}, to);
}

// The root turned by 2 pi all the time: the pose of 0 by another name.
HardScene FullTurn() {
  BodyParameters turned;
  turned.pose[1] = 2 * EIGEN_PI;
  return Dressed(turned, turned);
}

// Every joint by about a radian about anything.
HardScene Impossible() {
  Random random(5);
  BodyParameters to;
  for (int k = 3; k < kNumPose; ++k) to.pose[k] = random.Normal();
  return Dressed({}, to);
}

}  // namespace

void AddParameterCases(std::vector<HardCase>* cases) {
  const auto add = [&](const char* name,
                       const char* shows,
                       std::function<HardScene()> make,
                       const char* border = "",
                       HardLimits ceiling = {}) {
    cases->push_back({std::string("parameters/") + name,
                      shows,
                      std::move(make),
                      border,
                      ceiling});
  };
  const char* caught =
      "cloth that was caught where the body overlaps itself is led out slowly";
  add("theta_0", "all rotations exactly zero", [] { return ToPose({}); });
  add("theta_2_pi", "the root turned by exactly 2 pi", FullTurn);
  // For a frame or two; how deep is by which edge it slips from.
  add("elbows_180",
      "elbows folded by 180 degrees",
      [] {
        return ToPose({{kLeftElbow, Vector3d(0, -EIGEN_PI, 0)},
                       {kRightElbow, Vector3d(0, EIGEN_PI, 0)}});
      },
      caught,
      {.penetration = 0.01});
  add("shoulders_180",
      "arms turned by 180 degrees, across the body",
      [] {
        return ToPose({{kLeftShoulder, Vector3d(0, -EIGEN_PI, 0)},
                       {kRightShoulder, Vector3d(0, EIGEN_PI, 0)}});
      },
      caught,
      {.penetration = 0.025});
  add("arms_pressed", "sleeves squeezed between arms and torso", [] {
    return ToPose({{kLeftShoulder, Vector3d(0, 0, -1.4)},
                   {kRightShoulder, Vector3d(0, 0, 1.4)}});
  });
  add("beta_5", "shape coefficients of 5 and -5", [] { return ToShape(5); });
  add("beta_minus_5", "shape coefficients of -5 and 5", [] {
    return ToShape(-5);
  });
  add("impossible_pose",
      "every joint turned by about a radian",
      Impossible,
      caught,
      {.penetration = 0.01});
}

}  // namespace invsim
