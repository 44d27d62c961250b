// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/coverage.h"

#include "invsim/base/threads.h"

namespace invsim {
namespace {

constexpr int kGrain = 64;

}  // namespace

std::vector<bool> CoveredVertices(const Points& body_vertices,
                                  const Points& body_normals,
                                  const SurfaceIndex& cloth,
                                  const CoverRay& ray) {
  const int n = static_cast<int>(body_vertices.cols());
  std::vector<char> hit(n);
  ParallelFor(n, kGrain, [&](int i) {
    const Vector3d normal = body_normals.col(i);
    if (normal.isZero()) return;
    hit[i] = cloth.AnyHit(body_vertices.col(i) - ray.inside * normal,
                          normal,
                          ray.reach + ray.inside);
  });
  return {hit.begin(), hit.end()};
}

}  // namespace invsim
