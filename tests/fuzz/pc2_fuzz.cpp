// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/io/pc2.h"

namespace invsim {
namespace {

void Read(std::string_view bytes) {
  const auto cache = ReadOrRefuse([&] { return ParsePc2(bytes, kFuzzName); });
  if (!cache) return;
  for (const Points& sample : cache->samples) {
    Require(sample.allFinite(), "coordinates are finite");
  }
  Require(FormatPc2(*cache) == bytes, "written as the bytes read");
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
