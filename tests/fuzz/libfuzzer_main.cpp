// SPDX-License-Identifier: Apache-2.0
// A target under libFuzzer, which brings the `main`.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "fuzz_target.h"

extern "C" {

size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

__attribute__((visibility("default"))) int LLVMFuzzerTestOneInput(
    const uint8_t* data, size_t size) {
  invsim::kFuzzTarget.read({reinterpret_cast<const char*>(data), size});
  return 0;
}

__attribute__((visibility("default"))) size_t LLVMFuzzerCustomMutator(
    uint8_t* data, size_t size, size_t max_size, unsigned int) {
  size = LLVMFuzzerMutate(data, size, max_size);
  if (invsim::kFuzzTarget.mend == nullptr) return size;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  invsim::kFuzzTarget.mend(&bytes);
  size = std::min(bytes.size(), max_size);
  std::memcpy(data, bytes.data(), size);
  return size;
}
}
