// SPDX-License-Identifier: Apache-2.0
// An OBJ read as a garment: its mesh and its pattern are checked.

#include "fuzz_target.h"
#include "invsim/cloth/garment.h"

namespace invsim {
namespace {

void Read(std::string_view bytes) {
  const auto garment =
      ReadOrRefuse([&] { return ParseGarment(bytes, kFuzzName); });
  if (!garment) return;
  Require(garment->num_faces() > 0, "there is a face");
  const VectorXd areas = VertexAreas(*garment);
  Require(areas.allFinite() && areas.minCoeff() > 0,
          "every vertex has a positive area");
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
