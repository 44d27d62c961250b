// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_HARD_TEST_NAME_H_
#define INVSIM_TESTS_HARD_TEST_NAME_H_

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace invsim {

// The name of a case as a test's: letters and digits.
template <typename Case>
std::string TestName(const testing::TestParamInfo<Case>& info) {
  std::string name = info.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

}  // namespace invsim

#endif  // INVSIM_TESTS_HARD_TEST_NAME_H_
