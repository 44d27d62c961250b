// SPDX-License-Identifier: Apache-2.0
#include "invsim/sim/penetration.h"

#include <algorithm>
#include <vector>

#include "invsim/base/threads.h"

namespace invsim {

void Penetration::KeepWorst(const Penetration& other) {
  deepest = std::max(deepest, other.deepest);
  inside = std::max(inside, other.inside);
  deepest_overlap = std::max(deepest_overlap, other.deepest_overlap);
  overlap = std::max(overlap, other.overlap);
}

Penetration MeasurePenetration(const SurfaceIndex& body, const Points& x) {
  struct Depth {
    int winding = 0;
    double depth = 0;
  };
  std::vector<Depth> depths(x.cols());
  ParallelFor(static_cast<int>(x.cols()), 64, [&](int i) {
    depths[i].winding = body.WindingNumber(x.col(i));
    if (depths[i].winding > 0)
      depths[i].depth = body.Nearest(x.col(i)).distance;
  });
  Penetration result;
  for (const Depth& d : depths) {
    if (d.winding == 1) {
      ++result.inside;
      result.deepest = std::max(result.deepest, d.depth);
    } else if (d.winding > 1) {
      ++result.overlap;
      result.deepest_overlap = std::max(result.deepest_overlap, d.depth);
    }
  }
  return result;
}

}  // namespace invsim
