// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/cloth/material_file.h"

namespace invsim {
namespace {

void Read(std::string_view bytes) {
  const auto material =
      ReadOrRefuse([&] { return ParseMaterial(bytes, kFuzzName); });
  if (!material) return;
  Require(material->density > 0, "density is positive");
  Require(std::holds_alternative<MeasuredStretch>(material->stretch) &&
              std::holds_alternative<MeasuredBending>(material->bending),
          "both tables are there");
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
