// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/box_overlap.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "embree_device.h"

namespace invsim {
namespace {

struct Search {
  Points low, high;  // about the centre of all
  std::vector<std::array<int, 2>> pairs;
  std::mutex mutex;  // Embree reports from several threads
};

float Below(double x) {
  return std::nextafter(static_cast<float>(x),
                        -std::numeric_limits<float>::infinity());
}
float Above(double x) {
  return std::nextafter(static_cast<float>(x),
                        std::numeric_limits<float>::infinity());
}

void Bounds(const RTCBoundsFunctionArguments* args) {
  const auto& s = *static_cast<const Search*>(args->geometryUserPtr);
  RTCBounds* box = args->bounds_o;
  const unsigned i = args->primID;
  box->lower_x = Below(s.low(0, i));
  box->lower_y = Below(s.low(1, i));
  box->lower_z = Below(s.low(2, i));
  box->upper_x = Above(s.high(0, i));
  box->upper_y = Above(s.high(1, i));
  box->upper_z = Above(s.high(2, i));
}

// Every pair comes in either order or both; (i < j) are kept.
void Report(void* user, RTCCollision* found, unsigned count) {
  auto& s = *static_cast<Search*>(user);
  std::vector<std::array<int, 2>> pairs;
  for (unsigned k = 0; k < count; ++k) {
    const int a = static_cast<int>(found[k].primID0);
    const int b = static_cast<int>(found[k].primID1);
    const int i = std::min(a, b), j = std::max(a, b);
    if (i != j && (s.low.col(i).array() <= s.high.col(j).array()).all() &&
        (s.low.col(j).array() <= s.high.col(i).array()).all())
      pairs.push_back({i, j});
  }
  const std::lock_guard lock(s.mutex);
  s.pairs.insert(s.pairs.end(), pairs.begin(), pairs.end());
}

}  // namespace

std::vector<std::array<int, 2>> OverlappingBoxes(const Points& low,
                                                 const Points& high) {
  if (low.cols() < 2) return {};
  const Vector3d centre =
      0.5 * (low.rowwise().minCoeff() + high.rowwise().maxCoeff());
  Search search;
  search.low = low.colwise() - centre;
  search.high = high.colwise() - centre;
  RTCScene scene = rtcNewScene(EmbreeDevice());
  RTCGeometry geometry = rtcNewGeometry(EmbreeDevice(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(low.cols()));
  rtcSetGeometryUserData(geometry, &search);
  rtcSetGeometryBoundsFunction(geometry, Bounds, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  rtcCollide(scene, scene, Report, &search);
  rtcReleaseScene(scene);
  std::sort(search.pairs.begin(), search.pairs.end());
  search.pairs.erase(std::unique(search.pairs.begin(), search.pairs.end()),
                     search.pairs.end());
  return search.pairs;
}

}  // namespace invsim
