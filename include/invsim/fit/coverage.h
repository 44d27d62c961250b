// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_COVERAGE_H_
#define INVSIM_FIT_COVERAGE_H_

// Which of the body's vertices the garment hides: those whose outward normal
// meets the cloth within a short way.

#include <vector>

#include "invsim/geometry/surface_index.h"

namespace invsim {

// A ray this long decides; longer ones would let a skirt hide the hands.
inline constexpr double kCoverRay = 0.15;  // m

// The ray starts `inside` the skin and ends `reach` outside it.
struct CoverRay {
  double inside = 0.005;  // m: cloth that lies on the skin is met too
  double reach = kCoverRay;
};

// One entry per body vertex.
std::vector<bool> CoveredVertices(const Points& body_vertices,
                                  const Points& body_normals,
                                  const SurfaceIndex& cloth,
                                  const CoverRay& ray = {});

}  // namespace invsim

#endif  // INVSIM_FIT_COVERAGE_H_
