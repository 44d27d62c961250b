// SPDX-License-Identifier: Apache-2.0
#include "scene_draw.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

namespace invsim {
namespace {

double SmallestHeight(const TriangleMesh& mesh) {
  const VectorXd areas = FaceAreas(mesh.vertices, mesh.faces);
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < mesh.faces.cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const double side = (mesh.vertices.col(mesh.faces(k, f)) -
                           mesh.vertices.col(mesh.faces((k + 1) % 3, f)))
                              .norm();
      smallest = std::min(smallest, 2 * areas[f] / side);
    }
  return smallest;
}

// Along the axis that stretches least, N/m.
double Stiffest(const StretchModel& stretch) {
  if (const auto* same = std::get_if<IsotropicStretch>(&stretch))
    return same->stiffness;
  const auto& woven = std::get<OrthotropicStretch>(stretch);
  return std::max(woven.c11, woven.c22);
}

}  // namespace

SceneDraw::SceneDraw(std::uint64_t seed) : random_(seed) {
  words_.precision(3);
  scene_.limits.missed = std::numeric_limits<int>::max();
  // Where many halvings follow each other differences are good to no more.
  scene_.limits.derivative = 1e-4;
  scene_.limits.columns = 0;  // cloth may never meet the body
}

double SceneDraw::Log(double low, double high) {
  return std::exp(random_.Uniform(std::log(low), std::log(high)));
}

Vector3d SceneDraw::Direction() {
  const Vector3d v(random_.Normal(), random_.Normal(), random_.Normal());
  return v.normalized();
}

Matrix3d SceneDraw::Turn() {
  return Eigen::AngleAxisd(random_.Uniform(0, EIGEN_PI), Direction())
      .toRotationMatrix();
}

void SceneDraw::DrawMaterial() {
  Material& material = scene_.material;
  material.name = "cloth";
  const double membrane = Log(1, 1e6);
  if (Chance(0.2)) {
    const double ratio = Log(1, 1e3), other = std::max(1.0, membrane / ratio);
    material.stretch = OrthotropicStretch{membrane, 0, other, other};
    Say("membrane ", membrane, " and ", other, " N/m");
  } else {
    material.stretch = IsotropicStretch{membrane, random_.Uniform(0, 0.45)};
    Say("membrane ", membrane, " N/m");
  }
  const double bending = Chance(0.1) ? 0 : Log(1e-7, 1);
  material.bending = IsotropicBending{bending};
  material.density = Log(0.01, 10);
  Say("bending ", bending, " N m");
  Say(material.density, " kg/m^2");
}

void SceneDraw::Effect(const char* name, const char* key, double value) {
  scene_.options.effects.push_back(name);
  std::ostringstream text;
  text.precision(17);
  text << value;
  SetOption(&scene_, std::string("effects.") + name + "." + key, text.str());
  Say(name, " ", key, " ", value);
}

void SceneDraw::DrawEffects() {
  std::vector<std::string>& effects = scene_.options.effects;
  const auto leave_out = [&](const char* name) {
    std::erase(effects, name);
    Say("without ", name);
  };
  if (Chance(0.05)) leave_out("gravity");
  if (Chance(0.05)) leave_out("bending");
  if (Chance(0.03)) {
    // Then nothing but damping holds loose cloth, and its speed is no energy.
    leave_out("inertia");
    Effect("mass_damping", "rate", Log(10, 1e4));
    scene_.limits.energy = std::numeric_limits<double>::infinity();
  } else if (Chance(0.2)) {
    Effect("mass_damping", "rate", Log(0.1, 1e4));
  }
  if (Chance(0.2)) Effect("stiffness_damping", "membrane", Log(1e-4, 1));
  if (Chance(0.2)) Effect("air_drag", "normal", Log(0.1, 5));
  if (Chance(0.3)) Effect("self_contact", "friction", Log(0.01, 5));
  BodyContactOptions& contact = scene_.options.contact;
  contact.friction = Chance(0.1) ? 0 : Chance(0.1) ? 5 : Log(0.01, 5);
  contact.thickness = Log(0.0005, 0.004);
  Say("mu ", contact.friction);
  Say("thickness ", contact.thickness, " m");
}

void SceneDraw::Finish(RandomScene* drawn) {
  const double dt = 1 / scene_.frames_per_second /
                    static_cast<double>(scene_.options.step.substeps);
  const double height =
      SmallestHeight({scene_.garment.placed, scene_.garment.faces});
  drawn->stiffness = Stiffest(scene_.material.stretch) * dt * dt /
                     (scene_.material.density * height * height);
  drawn->words = words_.str();
  drawn->scene = std::move(scene_);
}

}  // namespace invsim
