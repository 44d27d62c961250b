// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_SAMPLING_H_
#define INVSIM_GEOMETRY_SAMPLING_H_

// Random points on a surface, uniform by area: what a scanner would see.

#include <vector>

#include "invsim/base/random.h"
#include "invsim/base/types.h"

namespace invsim {

struct SurfaceSample {
  int face = 0;
  Vector3d weights = Vector3d::Zero();  // barycentric
};

// A face with probability proportional to its area, then a uniform point in
// it: weights (1 - s, s (1 - u), s u) with s = sqrt(uniform) (Osada et al.,
// Shape distributions, 2002, section 4.1). Throws InputError if the mesh has
// no area.
std::vector<SurfaceSample> SampleSurface(const Points& vertices,
                                         const Faces& faces,
                                         int count,
                                         Random* random);

// Where the samples are (3 x count) on the surface with these positions.
Points SamplePositions(const Points& vertices,
                       const Faces& faces,
                       const std::vector<SurfaceSample>& samples);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_SAMPLING_H_
