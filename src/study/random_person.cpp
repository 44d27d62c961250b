// SPDX-License-Identifier: Apache-2.0

// Random scenes of people: the mannequin, dressed in the T-pose, goes to a
// shape and a pose drawn from far beyond what people are and do.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "invsim/base/joints.h"
#include "invsim/body/mannequin.h"
#include "invsim/cloth/authored_garment.h"
#include "invsim/cloth/named_materials.h"
#include "scene_draw.h"

namespace invsim {
namespace {

constexpr int kMostFrames = 24;

BodyParameters Scaled(const BodyParameters& to, double s) {
  BodyParameters p;
  p.shape = s * to.shape;
  p.pose = s * to.pose;
  p.translation = s * to.translation;
  return p;
}

// Metres that the farthest vertex goes on the way from the T-pose.
double LongestWay(const BodyModel& body, const BodyParameters& to) {
  constexpr int kPieces = 8;
  Points before = body.Vertices({});
  VectorXd way = VectorXd::Zero(before.cols());
  for (int k = 1; k <= kPieces; ++k) {
    const Points next = body.Vertices(Scaled(to, k / double{kPieces}));
    way += (next - before).colwise().norm().transpose();
    before = next;
  }
  return way.maxCoeff();
}

// Every authored garment, in the order of its names.
const std::vector<Garment>& Wardrobe() {
  static const std::vector<Garment> wardrobe = [] {
    const BodyModel& body = Mannequin();
    const TPoseBody standing{
        body.Vertices({}), body.faces(), body.Joints({}), body.data().weights};
    std::vector<Garment> made;
    for (const std::string& name : AuthoredGarmentNames())
      made.push_back(AuthoredGarment(name, standing, {.edge_length = 0.06}));
    return made;
  }();
  return wardrobe;
}

class PersonDraw : SceneDraw {
 public:
  explicit PersonDraw(std::uint64_t seed) : SceneDraw(seed) {}

  RandomScene Scene();

 private:
  void DrawGarment();
  void DrawShape();
  void DrawPose();
  void DrawMotion();
  void DrawDirections(const BodyParameters& at);

  const BodyModel& body_ = Mannequin();
  BodyParameters to_;
};

void PersonDraw::DrawGarment() {
  const std::vector<std::string>& names = AuthoredGarmentNames();
  const int k = random_.Index(static_cast<int>(names.size()));
  const std::vector<Material>& fabrics = NamedMaterials();
  scene_.material = fabrics[random_.Index(static_cast<int>(fabrics.size()))];
  scene_.garment = Wardrobe()[k];
  Say("a person in a ", names[k], " of ", scene_.material.name);
}

void PersonDraw::DrawShape() {
  if (Chance(0.3)) return;
  const double spread = Chance(0.2) ? 5 : Log(0.1, 3);
  for (int k = 0; k < kNumShape; ++k)
    to_.shape[k] = std::clamp(spread * random_.Normal(), -5.0, 5.0);
  Say("beta to ", to_.shape.cwiseAbs().maxCoeff());
}

void PersonDraw::DrawPose() {
  const double kind = random_.Uniform();
  if (kind < 0.45) {
    const double spread = Log(0.05, 1);
    for (int k = 3; k < kNumPose; ++k) to_.pose[k] = spread * random_.Normal();
    Say("joints turned by ", spread);
  } else if (kind < 0.7) {
    const int joint = 1 + random_.Index(kNumJoints - 1);
    to_.pose.segment<3>(3 * joint) = EIGEN_PI * Direction();
    Say("joint ", joint, " turned by 180 degrees");
  } else if (kind < 0.85) {
    const double down = random_.Uniform(1.2, 1.6);
    to_.pose[3 * kLeftShoulder + 2] = -down;
    to_.pose[3 * kRightShoulder + 2] = down;
    Say("arms down by ", down);
  }
  if (Chance(0.3)) {
    to_.pose.head<3>() = random_.Uniform(0, 2 * EIGEN_PI) * Direction();
    Say("turned by ", to_.pose.head<3>().norm());
  }
  if (Chance(0.5)) {
    to_.translation = Log(0.01, 1) * Direction();
    Say("going ", to_.translation.norm(), " m");
  }
}

// From the T-pose to the shape and pose, or as far as the frames suffice.
void PersonDraw::DrawMotion() {
  scene_.frames_per_second = Log(10, 500);
  scene_.options.step.substeps = 1 + random_.Index(4);
  const double speed = Log(0.2, 5), fps = scene_.frames_per_second;
  const double moving =
      std::max(1.0, std::ceil(LongestWay(body_, to_) / speed * fps));
  scene_.frames = std::min(kMostFrames, static_cast<int>(moving) + 3);
  scene_.body_at = [&body = body_, to = to_, moving](int frame) {
    return body.Vertices(Scaled(to, std::min(1.0, frame / moving)));
  };
  scene_.body = {scene_.body_at(0), body_.faces()};
  DrawDirections(Scaled(to_, std::min(1.0, scene_.frames / moving)));
  Say("at ",
      speed,
      " m/s in frames of 1/",
      fps,
      " s in ",
      scene_.options.step.substeps);
}

// Some parameters of shape, pose and place.
void PersonDraw::DrawDirections(const BodyParameters& at) {
  const std::shared_ptr<const PosedBody> posed = body_.Pose(at);
  const auto add = [&](int k) {
    Points direction = posed->Product(VectorXd::Unit(kNumBodyParameters, k));
    // At 2 pi a rotation vector has but one direction left.
    if (direction.norm() > 1e-9)
      scene_.directions.push_back(std::move(direction));
  };
  add(random_.Index(kNumShape));
  for (int k = 0; k < 3; ++k) add(kNumShape + random_.Index(kNumPose));
  add(kNumShape + kNumPose + random_.Index(3));
}

RandomScene PersonDraw::Scene() {
  RandomScene drawn;
  drawn.derivative = Chance(0.2);
  DrawGarment();
  DrawEffects();
  DrawShape();
  DrawPose();
  DrawMotion();
  Finish(&drawn);
  return drawn;
}

}  // namespace

RandomScene DrawPerson(std::uint64_t seed) { return PersonDraw(seed).Scene(); }

}  // namespace invsim
