// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/digest.h"

#include <gtest/gtest.h>

#include <set>

namespace invsim {
namespace {

template <typename... Values>
std::string Of(const Values&... values) {
  Digest digest;
  (digest.Add(values), ...);
  return digest.text();
}

TEST(Digest, IsTheSameForTheSameAndAnotherForAnother) {
  using std::string_view;
  const Eigen::Matrix2d m{{1, 2}, {3, 4}};
  EXPECT_EQ(Of(m), Of(Eigen::MatrixXd(m)));
  std::set<std::string> seen;
  for (const std::string& text : {Of(),
                                  Of(0.0),
                                  Of(-0.0),
                                  Of(1e-300),
                                  Of(1),
                                  Of(1, 1),
                                  Of(string_view("ab")),
                                  Of(string_view("ba")),
                                  Of(string_view("a"), string_view("b")),
                                  Of(m),
                                  Of(m.transpose()),
                                  Of(Eigen::RowVector4d(1, 3, 2, 4)),
                                  Of(Eigen::Vector4d(1, 3, 2, 4))}) {
    EXPECT_EQ(text.size(), 16u);
    EXPECT_TRUE(seen.insert(text).second) << text;
  }
}

// Files hold it: it must not change.
TEST(Digest, IsThatOfEarlierVersions) { EXPECT_EQ(Of(), "cbf29ce484222325"); }

}  // namespace
}  // namespace invsim
