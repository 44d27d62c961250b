// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <link.h>

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

namespace {

// Who allocates memory and who frees it must agree on how, and the libraries
// we link were built to do it otherwise than we do (cmake/Dependencies.cmake).

TEST(EigenMemory, IsAlignedForTheLargestVectors) {
  std::vector<Eigen::VectorXf> kept;
  for (int n = 1; n < 200; ++n) {
    kept.emplace_back(Eigen::VectorXf::Zero(n));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(kept.back().data()) % 64, 0u)
        << n << " numbers";
  }
}

// Linked statically, its compiled Eigen functions would go by the names of
// ours.
TEST(EigenMemory, CeresKeepsItsFunctionsInALibraryOfItsOwn) {
  bool shared = false;
  dl_iterate_phdr(
      [](dl_phdr_info* library, size_t, void* found) {
        const std::string_view name = library->dlpi_name;
        if (name.find("/libceres.so") != name.npos)
          *static_cast<bool*>(found) = true;
        return 0;
      },
      &shared);
  EXPECT_TRUE(shared);
}

}  // namespace
