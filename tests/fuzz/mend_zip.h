// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_FUZZ_MEND_ZIP_H_
#define INVSIM_TESTS_FUZZ_MEND_ZIP_H_

#include <string>

namespace invsim {

// Puts the right checksum of every stored member into the archive's directory,
// so that a change inside a member reaches the reader of its contents. What is
// too damaged for that stays as it is.
void MendZip(std::string* bytes);

}  // namespace invsim

#endif  // INVSIM_TESTS_FUZZ_MEND_ZIP_H_
