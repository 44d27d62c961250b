// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_FUZZ_MEND_RECORDS_H_
#define INVSIM_TESTS_FUZZ_MEND_RECORDS_H_

#include <string>

namespace invsim {

// Puts the right checksum into every record of a file of evaluations
// (fit/remembered_term.h), so that a change inside a record reaches its reader.
void MendRecords(std::string* bytes);

}  // namespace invsim

#endif  // INVSIM_TESTS_FUZZ_MEND_RECORDS_H_
