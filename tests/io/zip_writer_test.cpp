// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/zip_writer.h"

#include <gmock/gmock.h>

#include "invsim/io/zip.h"

namespace invsim {
namespace {

using ::testing::ElementsAre;

// Text that deflates well, and bytes that do not.
std::vector<ZipMember> Members() {
  std::string noise;
  unsigned state = 1;
  for (int i = 0; i < 5000; ++i) {
    state = state * 1664525u + 1013904223u;
    noise.push_back(static_cast<char>(state >> 24));
  }
  return {{"zeros.npy", std::string(300000, '\0')},
          {"noise.npy", noise},
          {"empty.npy", ""}};
}

class ZipWriting : public ::testing::TestWithParam<ZipOptions> {};

TEST_P(ZipWriting, GivesBackWhatWasPacked) {
  const auto zip = ZipArchive::Parse(BuildZip(Members(), GetParam()), "a.npz");
  EXPECT_THAT(zip.Names(), ElementsAre("zeros.npy", "noise.npy", "empty.npy"));
  for (const ZipMember& member : Members()) {
    EXPECT_EQ(zip.Extract(member.name), member.bytes) << member.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         ZipWriting,
                         ::testing::Values(ZipOptions{false, false},
                                           ZipOptions{true, false},
                                           ZipOptions{false, true},
                                           ZipOptions{true, true}));

TEST(ZipWriter, DeflateMakesZerosSmall) {
  EXPECT_LT(BuildZip({{"z", std::string(300000, '\0')}}).size(), 1000u);
}

TEST(ZipWriter, EqualMembersGiveEqualBytes) {
  EXPECT_EQ(BuildZip(Members()), BuildZip(Members()));
}

}  // namespace
}  // namespace invsim
