// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_CUBE_TOY_H_
#define INVSIM_STUDY_CUBE_TOY_H_

// The smallest inverse simulation (the paper's Fig. 5): a sheet of cloth falls
// on a cube whose tilt phi about the z axis is the only unknown. From where the
// cloth x(phi) lies after a while the tilt is found again:
//
//   L(phi) = 1/N sum_i |x_i(phi) - x_i*|^2,   x* = x(0),
//   dL/dphi = 2/N sum_i (x_i - x_i*) . dx_i/dphi ,
//
// dx/dphi taken through all frames of the fall, contacts and friction included.

#include "invsim/body/body_model.h"
#include "invsim/cloth/garment.h"
#include "invsim/sim/scene.h"

namespace invsim {

// A cube of 30 cm round the origin that follows the root joint of its body and
// nothing else.
BodyModel CubeBody();

// A horizontal square of cloth of 45 cm with cells x cells cells whose middle
// is `gap` above the highest of `points`.
Garment SheetAbove(const Points& points, int cells, double gap);

class CubeToy {
 public:
  // Scene: effects, contact and steps.
  CubeToy(const SceneOptions& scene, int cells, int frames);

  struct Fall {
    Points cloth;  // at the end, metres
    Points slope;  // d cloth / d phi, metres per radian
    bool usable = true;
  };
  Fall Run(double tilt);

  struct Loss {
    double value;  // m^2
    double slope;  // m^2 / rad
  };
  // Against the cloth of the upright cube. Throws InputError if the fall
  // cannot be simulated or differentiated.
  Loss Evaluate(double tilt);

 private:
  BodyModel cube_;
  Garment sheet_;
  Simulator simulator_;
  int frames_;
  Points target_;
};

}  // namespace invsim

#endif  // INVSIM_STUDY_CUBE_TOY_H_
