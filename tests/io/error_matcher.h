// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_IO_ERROR_MATCHER_H_
#define INVSIM_TESTS_IO_ERROR_MATCHER_H_

#include <gmock/gmock.h>

#include <string>

#include "invsim/base/error.h"

namespace invsim {

// Matches a callable that throws InputError with `text` in its message, which
// must be one printable line.
inline auto ThrowsInputError(const std::string& text) {
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  using ::testing::Not;
  return ::testing::ThrowsMessage<InputError>(
      AllOf(HasSubstr(text), Not(HasSubstr("\n")), Not(HasSubstr("\r"))));
}

}  // namespace invsim

#endif  // INVSIM_TESTS_IO_ERROR_MATCHER_H_
