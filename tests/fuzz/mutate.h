// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_FUZZ_MUTATE_H_
#define INVSIM_TESTS_FUZZ_MUTATE_H_

#include <string>
#include <vector>

#include "invsim/base/random.h"

namespace invsim {

// A file of `corpus` (one at least) with one to four changes, of the kinds that
// break readers: bits flipped, sizes and counts made huge, zero or negative,
// text that is no number, pieces left out, doubled, moved or taken from another
// file, the end cut off.
std::string Mutate(const std::vector<std::string>& corpus, Random* random);

}  // namespace invsim

#endif  // INVSIM_TESTS_FUZZ_MUTATE_H_
