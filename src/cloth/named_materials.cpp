// SPDX-License-Identifier: Apache-2.0
#include "invsim/cloth/named_materials.h"

#include <cmath>

#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "invsim/cloth/material_file.h"

namespace invsim {
namespace {

// Weft, warp, shear in N/m; `poisson` is the geometric mean of the ratios
// under a pull along either.
OrthotropicStretch Woven(double weft,
                         double warp,
                         double shear,
                         double poisson) {
  return FromEngineeringConstants(
      weft, warp, shear, poisson * std::sqrt(weft / warp));
}

std::vector<Material> MakeMaterials() {
  std::vector<Material> all;
  const auto add = [&](const std::string& name,
                       double density,
                       const OrthotropicStretch& stretch,
                       double bending,
                       const std::string& doc) {
    Material m;
    m.name = name;
    m.density = density;
    m.stretch = stretch;
    m.bending = IsotropicBending{bending};
    m.doc = doc;
    all.push_back(m);
  };
  add("cotton",
      0.150,
      Woven(3700.0, 5900.0, 55.0, 0.24),
      8e-6,
      "plain woven shirting");
  add("denim",
      0.324,
      Woven(6600.0, 6600.0, 110.0, 0.2),
      17e-6,
      "11 oz cotton denim");
  add("jersey",
      0.187,
      {.c11 = 50.0, .c12 = 20.0, .c22 = 290.0, .c33 = 33.0},
      5.2e-6,
      "cotton and polyester interlock knit of a T-shirt");
  add("polyester",
      0.113,
      {.c11 = 105.0, .c12 = 95.0, .c22 = 480.0, .c33 = 22.0},
      4.7e-6,
      "light polyester jacket knit");
  add("silk",
      0.069,
      Woven(3700.0, 5900.0, 20.0, 0.2),
      1.5e-6,
      "habotai, 16 momme");
  add("wool",
      0.235,
      Woven(2200.0, 5700.0, 32.0, 0.28),
      8e-6,
      "worsted suiting");
  return all;
}

}  // namespace

const std::vector<Material>& NamedMaterials() {
  static const std::vector<Material> materials = MakeMaterials();
  return materials;
}

Material FindMaterial(const std::string& name_or_path) {
  if (name_or_path.ends_with(".json")) return ReadMaterial(name_or_path);
  std::vector<std::string> names;
  for (const Material& material : NamedMaterials()) {
    if (material.name == name_or_path) return material;
    names.push_back(material.name);
  }
  throw UsageError(UnknownName("material", name_or_path, names));
}

}  // namespace invsim
