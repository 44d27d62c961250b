// SPDX-License-Identifier: Apache-2.0
#include "fuzz_target.h"
#include "invsim/io/pcd.h"

namespace invsim {
namespace {

void Read(std::string_view bytes) {
  ReadOrRefuse([&] { return ParsePcd(bytes, kFuzzName); });
}

}  // namespace

const FuzzTarget kFuzzTarget = {Read};

}  // namespace invsim
