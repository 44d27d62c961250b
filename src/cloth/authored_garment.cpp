// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/authored_garment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "invsim/cloth/cone_cut.h"
#include "invsim/cloth/section_tube.h"
#include "invsim/geometry/scalar_grid.h"
#include "invsim/geometry/surface_index.h"
#include "sewing.h"

namespace invsim {
namespace {

// Distance of the sections of a tube, and how wide two solids are blended
// where they meet (an armpit), metres.
constexpr double kSectionSpacing = 0.01;
constexpr double kBlend = 0.04;
constexpr double kLegBlend = 0.025;
// How far under the skin the trunk's tube starts, metres.
constexpr double kSunk = 0.03;
// 0 below 0, 1 above 1, smooth between.
double SmoothStep(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

double SmoothMin(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * h * h;
}

// The cut of an upper garment. Lengths are metres, or fractions of the body's
// measures: "torso" is neck to hip joints, "breadth" the middle to a shoulder
// joint, "arm" shoulder to wrist joint.
struct UpperCut {
  double hem;              // torsos below the hip joints ...
  double hem_to_knee;      // ... moved by this share of the way to the knees
  double trunk_ease;       // metres, below the arms
  double trunk_narrowing;  // see SectionTube::Hang
  double trunk_widening;
  double flare;        // how fast a skirt widens below the hips
  double sleeve;       // arms long; 0: none
  double sleeve_ease;  // metres, at the cuff
  double sleeve_narrowing;
  double neck_width;  // breadths, each side
  double neck_front;  // torsos below the side of the neck
  double neck_back;
  double strap;  // breadths to the armhole at the shoulder, if no sleeve
};

constexpr UpperCut kTShirt{.hem = 0.08,
                           .hem_to_knee = 0.0,
                           .trunk_ease = 0.014,
                           .trunk_narrowing = 0.06,
                           .trunk_widening = 0.12,
                           .flare = 0.0,
                           .sleeve = 0.36,
                           .sleeve_ease = 0.022,
                           .sleeve_narrowing = 0.02,
                           .neck_width = 0.44,
                           .neck_front = 0.13,
                           .neck_back = 0.025,
                           .strap = 0.0};
constexpr UpperCut kLongSleevedShirt{.hem = 0.08,
                                     .hem_to_knee = 0.0,
                                     .trunk_ease = 0.014,
                                     .trunk_narrowing = 0.08,
                                     .trunk_widening = 0.15,
                                     .flare = 0.0,
                                     .sleeve = 0.97,
                                     .sleeve_ease = 0.012,
                                     .sleeve_narrowing = 0.12,
                                     .neck_width = 0.44,
                                     .neck_front = 0.12,
                                     .neck_back = 0.025,
                                     .strap = 0.0};
constexpr UpperCut kTankTop{.hem = 0.06,
                            .hem_to_knee = 0.0,
                            .trunk_ease = 0.008,
                            .trunk_narrowing = 0.16,
                            .trunk_widening = 0.3,
                            .flare = 0.0,
                            .sleeve = 0.0,
                            .sleeve_ease = 0.0,
                            .sleeve_narrowing = 0.0,
                            .neck_width = 0.52,
                            .neck_front = 0.20,
                            .neck_back = 0.06,
                            .strap = 0.80};
constexpr UpperCut kDress{.hem = 0.0,
                          .hem_to_knee = 1.0,
                          .trunk_ease = 0.006,
                          .trunk_narrowing = 0.3,
                          .trunk_widening = 0.5,
                          .flare = 0.24,
                          .sleeve = 0.0,
                          .sleeve_ease = 0.0,
                          .sleeve_narrowing = 0.0,
                          .neck_width = 0.54,
                          .neck_front = 0.16,
                          .neck_back = 0.06,
                          .strap = 0.82};

class Tailor {
 public:
  Tailor(const std::string& name,
         const TPoseBody& body,
         const AuthoredGarmentOptions& options)
      : name_(name),
        body_(body),
        options_(options),
        skin_(body.vertices, body.faces) {}

  Garment Upper(const UpperCut& cut);
  Garment Trousers();

 private:
  Vector3d Joint(int j) const { return body_.joints.col(j); }
  Vector3d Middle(int left) const {
    return 0.5 * (Joint(left) + Joint(left + 1));
  }
  // The solid grown from the body by the ease.
  Field Skin() const {
    return [this](const Vector3d& x) {
      return skin_.Nearest(x).signed_distance - options_.ease;
    };
  }
  SectionTube Tube(const std::vector<int>& joints,
                   const Vector3d& start,
                   const Vector3d& end) const {
    return SectionTube(body_.vertices,
                       body_.faces,
                       FacesOf(body_, joints),
                       start,
                       end,
                       kSectionSpacing);
  }
  void Sample(const Field& solid, const Vector3d& low, const Vector3d& high);
  // How far it is from a point inside the solid to its surface.
  double Reach(const Vector3d& from, const Vector3d& direction) const;

  void AddNeck(const UpperCut& cut);
  void AddArmhole(int side, const UpperCut& cut);
  // An opening across a limb from joint a to joint b, `share` of the way.
  void AddCuff(int a, int b, double share);
  void AddCut(const Field& keep) { cuts_.push_back(keep); }

  Garment Sew(const Vector3d& inside);

  std::string name_;
  const TPoseBody& body_;
  AuthoredGarmentOptions options_;
  SurfaceIndex skin_;
  ScalarGrid grid_{Vector3d::Zero(), Vector3d::Ones(), 1.0};
  std::vector<Field> cuts_;
};

void Tailor::Sample(const Field& solid,
                    const Vector3d& low,
                    const Vector3d& high) {
  const double height =
      body_.vertices.row(1).maxCoeff() - body_.vertices.row(1).minCoeff();
  const double cell = 0.0045 * height, sigma = 1.2 * cell;
  grid_ = ScalarGrid(low, high, cell);
  grid_.Fill(solid, 3.0 * sigma + 3.0 * cell);
  grid_.Smooth(sigma);
}

double Tailor::Reach(const Vector3d& from, const Vector3d& direction) const {
  const double step = 0.5 * grid_.cell();
  double near = 0.0;
  while (grid_.Sample(from + near * direction) < 0.0) {
    near += step;
    if (near > 2.0)
      throw InputError("cannot make a " + name_ +
                       " for this body: a tube has no side");
  }
  double low = std::max(near - step, 0.0), high = near;
  for (int k = 0; k < 20; ++k) {
    const double middle = 0.5 * (low + high);
    (grid_.Sample(from + middle * direction) < 0.0 ? low : high) = middle;
  }
  return low;
}

void Tailor::AddNeck(const UpperCut& cut) {
  const Vector3d neck = Joint(kNeck), shoulders = Middle(kLeftShoulder);
  const double torso = neck[1] - Middle(kLeftHip)[1];
  // Room for a neck that has grown by the ease.
  const double width = cut.neck_width * std::abs(Joint(kLeftShoulder)[0]) +
                       std::max(0.0, options_.ease - 0.01);
  const Vector3d up(0, 1, 0), front(0, 0, 1);
  // The side of the neck is where the shoulder line is `width` from the
  // middle; the other heights are counted from there.
  Vector3d inside = shoulders;
  inside[0] = width;
  inside[1] -= 0.05 * torso;
  const double side = inside[1] + Reach(inside, up);
  const Vector3d centre(0, side, neck[2]);
  const double low = -cut.neck_front * torso, back = -cut.neck_back * torso;
  AddCut([c = ConeCut(centre,
                      up,
                      front,
                      {{{low, Reach(centre + low * up, front)},
                        {0.0, width},
                        {back, Reach(centre + back * up, -front)},
                        {0.0, width}}},
                      1.0)](const Vector3d& x) { return c.Value(x); });
}

void Tailor::AddArmhole(int side, const UpperCut& cut) {
  const Vector3d shoulder = Joint(kLeftShoulder + side);
  const double torso = Joint(kNeck)[1] - Middle(kLeftHip)[1];
  const double breadth = std::abs(shoulder[0]);
  const Vector3d out(side == 0 ? 1.0 : -1.0, 0, 0), up(0, 1, 0);
  const Vector3d second = out.cross(up);
  const Vector3d centre(0, shoulder[1] - 0.03 * torso, shoulder[2]);
  const double depth = 0.23 * torso;
  const Vector3d top = centre + cut.strap * breadth * out;
  const Vector3d middle = centre + (cut.strap + 0.02) * breadth * out;
  AddCut(
      [c = ConeCut(centre,
                   out,
                   up,
                   {{{cut.strap * breadth, Reach(top, up)},
                     {(cut.strap + 0.02) * breadth, Reach(middle, second)},
                     {Reach(centre - depth * up, out), depth},
                     {(cut.strap + 0.02) * breadth, Reach(middle, -second)}}},
                   1.0)](const Vector3d& x) { return c.Value(x); });
}

void Tailor::AddCuff(int a, int b, double share) {
  const Vector3d from = Joint(a), axis = (Joint(b) - from).normalized();
  const Vector3d first = axis.cross(Vector3d(0, 0, 1)).normalized();
  const Vector3d second = axis.cross(first);
  const double at = share * (Joint(b) - from).norm();
  const Vector3d p = from + at * axis;
  AddCut([c = ConeCut(from,
                      axis,
                      first,
                      {{{at, Reach(p, first)},
                        {at, Reach(p, second)},
                        {at, Reach(p, -first)},
                        {at, Reach(p, -second)}}},
                      0.25)](const Vector3d& x) { return c.Value(x); });
}

Garment Tailor::Upper(const UpperCut& cut) {
  const Vector3d neck = Joint(kNeck), hips = Middle(kLeftHip);
  const double torso = neck[1] - hips[1];
  const double shoulder = Joint(kLeftShoulder)[1];
  const double hem = hips[1] - cut.hem * torso +
                     cut.hem_to_knee * (Middle(kLeftKnee)[1] - hips[1]);
  const double z = 0.5 * (neck[2] + hips[2]);
  SectionTube trunk = Tube({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 14},
                           Vector3d(0, shoulder, z),
                           Vector3d(0, hem - 0.05, z));
  trunk.Hang(cut.trunk_narrowing, cut.trunk_widening);
  if (cut.flare > 0.0) trunk.Flare(shoulder - hips[1], cut.flare);
  std::vector<SectionTube> sleeves;
  for (int side = 0; cut.sleeve > 0.0 && side < 2; ++side) {
    sleeves.push_back(Tube({kLeftShoulder + side,
                            kLeftElbow + side,
                            kLeftWrist + side,
                            kLeftHand + side},
                           Joint(kLeftShoulder + side),
                           Joint(kLeftWrist + side)));
    sleeves.back().Hang(cut.sleeve_narrowing, 0.1);
  }
  // Cloth lies on neck and shoulders; the trunk's tube emerges below them, and
  // the sleeves' towards the cuffs.
  const double ease = options_.ease;
  const Field solid = [&, skin = Skin()](const Vector3d& x) {
    const double below = (shoulder - x[1]) / torso;
    const double wider = ease + SmoothStep(below / 0.3) * cut.trunk_ease -
                         SmoothStep(1.0 - below / 0.15) * kSunk;
    double value = std::min(skin(x), trunk.Value(x) - wider);
    for (const SectionTube& s : sleeves) {
      const double out = SmoothStep(s.Along(x) / (0.4 * s.length()));
      value =
          SmoothMin(value, s.Value(x) - ease - out * cut.sleeve_ease, kBlend);
    }
    return value;
  };

  const double arm = (Joint(kLeftWrist) - Joint(kLeftShoulder)).norm();
  const double skirt = cut.flare * (hips[1] - hem) + 0.1;
  const double reach =
      Joint(kLeftShoulder)[0] +
      std::max(cut.sleeve > 0.0 ? cut.sleeve * arm + 0.05 : 0.1, skirt);
  Sample(solid,
         Vector3d(-reach, hem - 0.03, body_.vertices.row(2).minCoeff() - skirt),
         Vector3d(reach,
                  neck[1] + 0.15 * torso,
                  body_.vertices.row(2).maxCoeff() + skirt));
  AddNeck(cut);
  AddCut([hem](const Vector3d& x) { return x[1] - hem; });
  for (int side = 0; side < 2; ++side) {
    if (cut.sleeve > 0.0) {
      AddCuff(kLeftShoulder + side, kLeftWrist + side, cut.sleeve);
    } else {
      AddArmhole(side, cut);
    }
  }
  return Sew(Joint(kSpine3));
}

// Knee to hip of the trunk, two legs, and what the body itself adds.
Garment Tailor::Trousers() {
  const Vector3d hips = Middle(kLeftHip);
  const double waist = Joint(kSpine1)[1], ankles = Middle(kLeftAnkle)[1];
  // The crotch: the lowest point of the body in the middle.
  double crotch = hips[1];
  for (int f = 0; f < body_.faces.cols(); ++f)
    for (int c = 0; c < 3; ++c) {
      const Vector3d a = body_.vertices.col(body_.faces(c, f));
      const Vector3d b = body_.vertices.col(body_.faces((c + 1) % 3, f));
      if (a[0] * b[0] <= 0.0) crotch = std::min({crotch, a[1], b[1]});
    }
  const SectionTube seat = Tube({0, 1, 2, 3, 6, 9},
                                Vector3d(0, waist + 0.05, hips[2]),
                                Vector3d(0, crotch, hips[2]));
  std::vector<SectionTube> legs;
  for (int side = 0; side < 2; ++side) {
    Vector3d top = Joint(kLeftHip + side);
    top[1] = crotch + 0.05;
    legs.push_back(
        Tube({1 + side, 4 + side, 7 + side}, top, Joint(kLeftAnkle + side)));
    legs.back().Hang(0.07, 0.15);
  }
  const double ease = options_.ease;
  const Field solid = [&, skin = Skin()](const Vector3d& x) {
    // The seat spans the cleft behind and gives way to the legs at the crotch.
    const double down = SmoothStep((hips[1] - x[1]) / (hips[1] - crotch));
    const double span = seat.Value(x) - ease + kLegBlend * down;
    double value = std::min(skin(x), std::max(span, crotch - ease - x[1]));
    for (const SectionTube& leg : legs) {
      const double out = SmoothStep(leg.Along(x) / (0.5 * leg.length()));
      value = SmoothMin(value, leg.Value(x) - ease - 0.008 * out, kLegBlend);
    }
    return value;
  };
  const double side = body_.vertices.row(2).maxCoeff() + 0.1;
  Sample(solid,
         Vector3d(-2.5 * side, ankles - 0.03, -side),
         Vector3d(2.5 * side, waist + 0.04, side));
  AddCut([waist](const Vector3d& x) { return waist - x[1]; });
  for (int s = 0; s < 2; ++s) AddCuff(kLeftKnee + s, kLeftAnkle + s, 0.96);
  return Sew(Joint(kPelvis));
}

Garment Tailor::Sew(const Vector3d& inside) {
  const TriangleMesh mesh = SewGarment({name_,
                                        grid_,
                                        cuts_,
                                        inside,
                                        skin_,
                                        name_ == "trousers" ? 3 : 4,
                                        options_.edge_length,
                                        options_.ease});
  Garment garment = GarmentFromRestMesh(mesh.vertices, mesh.faces);
  garment.rest_angles_from_placed = false;
  return garment;
}

void CheckOptions(const AuthoredGarmentOptions& options) {
  const auto check =
      [](const char* what, double value, double low, double high) {
        if (value >= low && value <= high) return;
        char text[120];
        std::snprintf(text,
                      sizeof(text),
                      "garment %s is %g m, expected %g to %g m",
                      what,
                      value,
                      low,
                      high);
        throw UsageError(text);
      };
  check("edge length", options.edge_length, 0.008, 0.08);
  check("ease", options.ease, 0.004, 0.03);
}

}  // namespace

const std::vector<std::string>& AuthoredGarmentNames() {
  static const std::vector<std::string> names = {
      "tshirt", "long_sleeved_shirt", "tank_top", "dress", "trousers"};
  return names;
}

Garment AuthoredGarment(const std::string& name,
                        const TPoseBody& body,
                        const AuthoredGarmentOptions& options) {
  CheckOptions(options);
  const auto& names = AuthoredGarmentNames();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw UsageError(UnknownName("garment", name, names));
  ValidateTPoseBody(body);
  Tailor tailor(name, body, options);
  if (name == "tshirt") return tailor.Upper(kTShirt);
  if (name == "long_sleeved_shirt") return tailor.Upper(kLongSleevedShirt);
  if (name == "tank_top") return tailor.Upper(kTankTop);
  if (name == "dress") return tailor.Upper(kDress);
  return tailor.Trousers();
}

}  // namespace invsim
