// SPDX-License-Identifier: Apache-2.0
#include "mannequin_solid.h"

#include <algorithm>
#include <cmath>

#include "loft.h"

namespace invsim {
namespace {

constexpr int kAlongX = 0;
constexpr int kAlongY = 1;
constexpr int kAlongZ = 2;

// An upright symmetric section: centre z, half width, front and back depth.
Station Upright(double y,
                double z,
                double width,
                double front,
                double back,
                double exponent = 2.0) {
  return {y, 0.0, z, width, width, front, back, exponent};
}

const Loft& Torso() {
  static const Loft loft(kAlongY,
                         {Upright(-0.27, 0.003, 0.163, 0.093, 0.102),
                          Upright(-0.24, 0.003, 0.167, 0.098, 0.107),
                          Upright(-0.19, 0.004, 0.163, 0.101, 0.105),
                          Upright(-0.11, 0.008, 0.148, 0.100, 0.092),
                          Upright(-0.03, 0.008, 0.136, 0.096, 0.084),
                          Upright(0.03, 0.006, 0.136, 0.098, 0.086),
                          Upright(0.10, 0.003, 0.147, 0.106, 0.094),
                          Upright(0.16, -0.001, 0.157, 0.108, 0.101),
                          Upright(0.20, -0.005, 0.158, 0.102, 0.102)},
                         0.095,
                         0.110);
  return loft;
}

const Loft& Leg() {
  static const Loft loft(kAlongY,
                         {{-1.06, .128, -.022, .031, .030, .032, .036},
                          {-1.02, .126, -.022, .034, .032, .034, .040},
                          {-0.97, .124, -.020, .033, .032, .036, .038},
                          {-0.90, .121, -.017, .038, .037, .042, .046},
                          {-0.80, .117, -.014, .052, .048, .048, .064},
                          {-0.73, .114, -.012, .056, .052, .050, .068},
                          {-0.66, .112, -.006, .052, .048, .051, .056},
                          {-0.60, .110, .000, .053, .050, .056, .050},
                          {-0.54, .108, .002, .058, .054, .062, .056},
                          {-0.46, .104, .002, .068, .062, .072, .068},
                          {-0.38, .098, .000, .078, .070, .082, .078},
                          {-0.31, .092, -.002, .085, .076, .086, .086},
                          {-0.24, .085, -.004, .085, .070, .085, .085}},
                         0.03,
                         0.08);
  return loft;
}

const Loft& Foot() {
  static const Loft loft(kAlongZ,
                         {{-.060, .126, -1.070, .028, .026, .030, .030, 2.3},
                          {-.030, .127, -1.066, .032, .030, .040, .034, 2.4},
                          {.020, .131, -1.066, .037, .032, .042, .034, 2.4},
                          {.070, .135, -1.070, .042, .038, .034, .030, 2.5},
                          {.110, .138, -1.077, .045, .040, .026, .023, 2.5},
                          {.145, .140, -1.081, .038, .040, .020, .019, 2.4}},
                         0.028,
                         0.035);
  return loft;
}

const Loft& Arm() {
  static const Loft loft(kAlongX,
                         {{.10, .243, -.012, .042, .048, .046, .048},
                          {.17, .247, -.012, .056, .058, .058, .056},
                          {.23, .250, -.012, .050, .056, .050, .050},
                          {.30, .251, -.012, .046, .050, .046, .046},
                          {.37, .251, -.012, .044, .045, .043, .043},
                          {.43, .251, -.012, .040, .041, .040, .040},
                          {.50, .250, -.010, .041, .042, .042, .042},
                          {.58, .250, -.008, .036, .037, .038, .038},
                          {.65, .250, -.006, .028, .028, .031, .031},
                          {.69, .250, -.005, .023, .023, .029, .029},
                          {.72, .250, -.004, .022, .022, .030, .030}},
                         0.04,
                         0.02);
  return loft;
}

const Loft& Hand() {
  static const Loft loft(kAlongX,
                         {{.70, .250, -.004, .020, .020, .030, .030},
                          {.73, .250, .000, .018, .019, .038, .036},
                          {.78, .249, .002, .016, .018, .044, .040},
                          {.82, .248, .002, .0135, .015, .042, .040},
                          {.86, .246, .002, .011, .0125, .035, .034}},
                         0.02,
                         0.022);
  return loft;
}

const Loft& Neck() {
  static const Loft loft(kAlongY,
                         {Upright(.25, -.026, .062, .055, .060),
                          Upright(.31, -.017, .056, .052, .054),
                          Upright(.36, -.006, .053, .050, .054),
                          Upright(.42, .004, .052, .048, .058)},
                         0.04,
                         0.03);
  return loft;
}

const Loft& Head() {
  static const Loft loft(kAlongY,
                         {Upright(.395, .046, .034, .036, .050),
                          Upright(.415, .034, .047, .053, .066),
                          Upright(.440, .022, .058, .068, .078),
                          Upright(.470, .012, .066, .079, .088),
                          Upright(.500, .006, .072, .086, .095),
                          Upright(.520, .004, .074, .087, .097)},
                         0.022,
                         0.080);
  return loft;
}

double Ellipsoid(const Vector3d& x,
                 const Vector3d& centre,
                 const Vector3d& radii) {
  const Vector3d p = x - centre;
  const double r = p.cwiseQuotient(radii).norm();
  const double slope = p.cwiseQuotient(radii.cwiseAbs2()).norm();
  if (slope < 1e-9) return -radii.minCoeff();
  return r * (r - 1.0) / slope;
}

// A capsule from a to b whose radius runs from ra to rb.
double TaperedCapsule(const Vector3d& x,
                      const Vector3d& a,
                      const Vector3d& b,
                      double ra,
                      double rb) {
  const Vector3d ab = b - a;
  const double t = std::clamp((x - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (x - a - t * ab).norm() - (ra + t * (rb - ra));
}

double Thumb(const Vector3d& x) {
  const Vector3d base(.715, .245, .018);
  const Vector3d knuckle(.762, .240, .058);
  const Vector3d tip(.800, .238, .074);
  return SmoothMin(TaperedCapsule(x, base, knuckle, .016, .0135),
                   TaperedCapsule(x, knuckle, tip, .0135, .0115),
                   .006);
}

}  // namespace

double MannequinDistance(const Vector3d& x) {
  const Vector3d left(std::abs(x.x()), x.y(), x.z());
  const Vector3d right(-left.x(), x.y(), x.z());
  // Both of what meets at the middle, so that the surface has no crease there.
  const auto pair = [&](const auto& part, double k) {
    return SmoothMin(part(left), part(right), k);
  };
  const auto leg = [](const Vector3d& p) { return Leg().Distance(p); };
  const auto chest = [](const Vector3d& p) {
    return Ellipsoid(p, {.070, .155, .054}, {.076, .072, .048});
  };
  const auto buttock = [](const Vector3d& p) {
    return Ellipsoid(p, {.078, -.275, -.060}, {.074, .085, .060});
  };
  const auto trapezius = [](const Vector3d& p) {
    return TaperedCapsule(p, {.02, .345, -.022}, {.15, .262, -.018}, .035, .04);
  };
  double d = Torso().Distance(x);
  d = SmoothMin(d, pair(chest, .04), .04);
  d = SmoothMin(d, pair(trapezius, .03), .04);
  d = SmoothMin(d, pair(buttock, .03), .04);
  d = SmoothMin(d, pair(leg, .02), .06);
  d = SmoothMin(d, Foot().Distance(left), .03);
  d = SmoothMin(d, Neck().Distance(x), .04);
  d = SmoothMin(d, Arm().Distance(left), .06);
  const double hand = SmoothMin(Hand().Distance(left), Thumb(left), .014);
  d = SmoothMin(d, hand, .02);
  double head = Head().Distance(x);
  head =
      SmoothMin(head,
                TaperedCapsule(x, {0, .500, .083}, {0, .466, .099}, .007, .011),
                .016);
  head = SmoothMin(
      head, Ellipsoid(left, {.075, .486, -.010}, {.009, .029, .018}), .01);
  return SmoothMin(d, head, .025);
}

}  // namespace invsim
