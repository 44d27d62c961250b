// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_FUZZ_NPY_CHECKS_H_
#define INVSIM_TESTS_FUZZ_NPY_CHECKS_H_

// What must hold of an array that was read.

#include <string>
#include <vector>

#include "fuzz_target.h"
#include "invsim/io/npy.h"

namespace invsim {

inline void CheckConversions(const NpyArray& array) {
  if (const auto x = ReadOrRefuse([&] { return array.ToDoubles(kFuzzName); })) {
    Require(x->size() == array.size(), "a double for each value");
  }
  if (const auto x =
          ReadOrRefuse([&] { return array.ToIntegers(kFuzzName); })) {
    Require(x->size() == array.size(), "an integer for each value");
  }
  const auto texts = ReadOrRefuse([&] { return array.ToStrings(kFuzzName); });
  if (!texts) return;
  Require(texts->size() == array.size(), "a text for each value");
  const NpyArray again = NpyArray::Text(array.shape(), *texts);
  Require(again.ToStrings(kFuzzName) == *texts, "texts are UTF-8");
}

inline void CheckArray(const NpyArray& array) {
  CheckConversions(array);
  const std::string written = FormatNpy(array);
  const NpyArray again = MustRead([&] { return ParseNpy(written, kFuzzName); });
  Require(again.type() == array.type() &&
              again.item_size() == array.item_size() &&
              again.shape() == array.shape() && again.size() == array.size(),
          "an array written is read back with its type and shape");
  Require(FormatNpy(again) == written, "written again as the same bytes");
}

}  // namespace invsim

#endif  // INVSIM_TESTS_FUZZ_NPY_CHECKS_H_
