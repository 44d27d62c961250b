// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "invsim/base/error.h"
#include "invsim/geometry/mesh.h"

namespace invsim {

std::vector<SurfaceSample> SampleSurface(const Points& vertices,
                                         const Faces& faces,
                                         int count,
                                         Random* random) {
  const VectorXd areas = FaceAreas(vertices, faces);
  std::vector<double> sum(areas.size());
  std::partial_sum(areas.begin(), areas.end(), sum.begin());
  if (sum.empty() || !(sum.back() > 0.0))
    throw InputError("surface has no area to sample");
  std::vector<SurfaceSample> samples(count);
  for (SurfaceSample& s : samples) {
    // The first face whose sum exceeds the target has an area.
    const double target = random->Uniform() * sum.back();
    s.face = static_cast<int>(std::upper_bound(sum.begin(), sum.end(), target) -
                              sum.begin());
    s.face = std::min(s.face, static_cast<int>(sum.size()) - 1);
    const double r = std::sqrt(random->Uniform()), u = random->Uniform();
    s.weights = Vector3d(1.0 - r, r * (1.0 - u), r * u);
  }
  return samples;
}

Points SamplePositions(const Points& vertices,
                       const Faces& faces,
                       const std::vector<SurfaceSample>& samples) {
  Points p(3, samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    const SurfaceSample& s = samples[i];
    p.col(i) = s.weights[0] * vertices.col(faces(0, s.face)) +
               s.weights[1] * vertices.col(faces(1, s.face)) +
               s.weights[2] * vertices.col(faces(2, s.face));
  }
  return p;
}

}  // namespace invsim
