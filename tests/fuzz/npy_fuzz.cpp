// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/io/npy.h"
#include "npy_checks.h"

namespace invsim {
namespace {

void Read(std::string_view bytes) {
  const auto array = ReadOrRefuse([&] { return ParseNpy(bytes, kFuzzName); });
  if (array) CheckArray(*array);
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
