// SPDX-License-Identifier: Apache-2.0

// Hard scenes: cloth from gossamer to sheet metal.

#include <utility>

#include "hard_cases.h"

namespace invsim {
namespace {

HardScene WithMaterial(const Material& material) {
  HardScene scene = SheetOverBall();
  scene.material = material;
  return scene;
}

Material Cloth(double membrane, double bending, double density) {
  return {"cloth",
          density,
          IsotropicStretch{membrane, 0.3},
          IsotropicBending{bending}};
}

HardScene Weave() {
  Material weave = Cloth(200, 1e-5, 0.2);
  weave.stretch = OrthotropicStretch{10, 0, 1e4, 10};
  return WithMaterial(weave);
}

HardScene With(const char* effect, const char* key, const char* value) {
  HardScene scene = SheetOverBall();
  scene.options.effects.push_back(effect);
  SetOption(&scene, key, value);
  return scene;
}

// A flag swinging from two corners for ten seconds, nothing to collide with.
HardScene Undamped() {
  HardScene scene = SceneOf(SheetMesh(8, 0.3), {});
  scene.body.faces.resize(3, 0);
  for (int corner : {0, 8})
    scene.pins.push_back({corner, scene.garment.placed.col(corner)});
  scene.frames = 600;
  return scene;
}

}  // namespace

void AddMaterialCases(std::vector<HardCase>* cases) {
  const auto add = [&](const char* name,
                       const char* shows,
                       std::function<HardScene()> make) {
    cases->push_back({std::string("material/") + name, shows, std::move(make)});
  };
  const auto material =
      [&](const char* name, const char* shows, const Material& m) {
        add(name, shows, [m] { return WithMaterial(m); });
      };
  material("membrane_1", "1 N/m: gives way to its weight", Cloth(1, 1e-5, 0.2));
  material("membrane_1e4", "10,000 N/m", Cloth(1e4, 1e-5, 0.2));
  material(
      "membrane_1e6", "1,000,000 N/m: hardly stretches", Cloth(1e6, 1e-5, 0.2));
  material("bending_0", "no bending stiffness", Cloth(200, 0, 0.2));
  material("bending_1", "1 N m: a board", Cloth(200, 1, 0.2));
  material("density_0.01", "0.01 kg/m^2: gossamer", Cloth(200, 1e-5, 0.01));
  material("density_10", "10 kg/m^2: a lead apron", Cloth(200, 1e-5, 10));
  add("weave_1_to_1000", "stiffness 1:1000 between the axes", Weave);
  add("undamped", "ten seconds of swinging without damping", Undamped);
  add("mass_damping_1e4", "mass damping of 10,000 1/s", [] {
    HardScene scene =
        With("mass_damping", "effects.mass_damping.rate", "10000");
    // It sinks by a millimetre in a second: to where it touches.
    scene.garment.placed.row(1).array() -= 0.001;
    return scene;
  });
  add("stiffness_damping_1", "damping of stretch with a constant of 1 s", [] {
    return With("stiffness_damping", "effects.stiffness_damping.membrane", "1");
  });
}

}  // namespace invsim
