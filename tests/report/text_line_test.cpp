// SPDX-License-Identifier: Apache-2.0
#include "../../src/report/text_line.h"

#include <gtest/gtest.h>

namespace invsim {
namespace {

TEST(TextLine, ALongCellKeepsTheEndOfItsLine) {
  const std::string cell(1000, 'x');
  EXPECT_EQ(Line("%s|%3d\n", cell.c_str(), 7), cell + "|  7\n");
}

}  // namespace
}  // namespace invsim
