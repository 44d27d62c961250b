// SPDX-License-Identifier: Apache-2.0
// Point clouds of the formats that have no reader of their own: xyz (and txt,
// the same), npy of shape (N, 3).

#include "fuzz_target.h"
#include "invsim/io/point_cloud.h"

namespace invsim {
namespace {

void ReadAs(const std::string& extension, std::string_view bytes) {
  for (const bool drop : {false, true}) {
    int dropped = 0;
    const auto points = ReadOrRefuse([&] {
      return ParsePoints(
          bytes, extension, kFuzzName, {.drop_non_finite = drop}, &dropped);
    });
    if (!points) continue;
    Require(points->cols() > 0, "there is a point");
    Require(points->allFinite(), "points are finite");
    Require(drop || dropped == 0, "none dropped unless asked for");
  }
}

void Read(std::string_view bytes) {
  ReadAs("xyz", bytes);
  ReadAs("npy", bytes);
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
