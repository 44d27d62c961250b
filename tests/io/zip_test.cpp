// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/zip.h"

#include <gmock/gmock.h>

#include "invsim/base/error.h"
#include "invsim/io/zip_writer.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ZipPacking : public ::testing::TestWithParam<ZipOptions> {};

TEST_P(ZipPacking, EveryTruncationIsAnError) {
  const std::string bytes =
      BuildZip({{"a", "some text"}, {"b", ""}}, GetParam());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(ZipArchive::Parse(bytes.substr(0, size), "a.npz"), InputError)
        << size;
  }
}

TEST_P(ZipPacking, DamageIsAnErrorOrHarmless) {
  const std::string text = "some text that is long enough to be deflated";
  const std::string bytes = BuildZip({{"a", text}}, GetParam());
  int caught = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      try {
        const auto zip = ZipArchive::Parse(damaged, "a.npz");
        if (zip.Has("a")) {
          EXPECT_EQ(zip.Extract("a"), text) << i;
        }
      } catch (const InputError&) {
        ++caught;
      }
    }
  }
  EXPECT_GT(caught, 100);
}

INSTANTIATE_TEST_SUITE_P(All,
                         ZipPacking,
                         ::testing::Values(ZipOptions{false, false},
                                           ZipOptions{true, false},
                                           ZipOptions{false, true},
                                           ZipOptions{true, true}));

TEST(Zip, MissingMemberIsNamed) {
  const auto zip = ZipArchive::Parse(BuildZip({{"a", "1"}}), "x.npz");
  EXPECT_THAT([&] { zip.Extract("b"); },
              ThrowsMessage<InputError>("x.npz: has no member b"));
}

TEST(Zip, WrongChecksumIsNamed) {
  std::string bytes = BuildZip({{"a", "payload"}}, {.deflate = false});
  bytes.replace(bytes.find("payload"), 7, "PAYLOAD");
  const auto zip = ZipArchive::Parse(bytes, "x.npz");
  EXPECT_THAT([&] { zip.Extract("a"); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("x.npz: a"), HasSubstr("CRC-32"))));
}

// A member of a hundred bytes cannot unpack to 3 GB: refused before any memory
// is asked for.
TEST(Zip, ImpossibleSizeIsRefused) {
  std::string bytes = BuildZip({{"a", std::string(1000, 'x')}});
  const std::size_t size_field = bytes.rfind("PK\x01\x02") + 24;
  bytes.replace(size_field, 4, std::string("\x00\x00\x00\xc0", 4));
  const auto zip = ZipArchive::Parse(bytes, "x.npz");
  EXPECT_THAT([&] { zip.Extract("a"); },
              ThrowsMessage<InputError>(HasSubstr("3221225472 bytes stated")));
}

TEST(Zip, UnknownMethodAndEncryptionAreNamed) {
  const std::string bytes = BuildZip({{"a", "payload"}});
  const std::size_t entry = bytes.rfind("PK\x01\x02");
  std::string lzma = bytes;
  lzma[entry + 10] = 14;
  EXPECT_THAT([&] { ZipArchive::Parse(lzma, "x").Extract("a"); },
              ThrowsMessage<InputError>(HasSubstr("method 14")));
  std::string secret = bytes;
  secret[entry + 8] = 1;
  EXPECT_THAT([&] { ZipArchive::Parse(secret, "x").Extract("a"); },
              ThrowsMessage<InputError>(HasSubstr("encrypted")));
}

TEST(Zip, TwoMembersOfOneNameAreRefused) {
  const std::string bytes = BuildZip({{"a", "1"}, {"a", "2"}});
  EXPECT_THAT([&] { ZipArchive::Parse(bytes, "x"); },
              ThrowsMessage<InputError>(HasSubstr("two members named 'a'")));
}

TEST(Zip, OtherFilesAreRefused) {
  EXPECT_THAT([] { ZipArchive::Parse("", "x"); },
              ThrowsMessage<InputError>(HasSubstr("is empty")));
  EXPECT_THAT([] { ZipArchive::Parse("ply\nformat ascii 1.0\n", "x"); },
              ThrowsMessage<InputError>(HasSubstr("not a complete zip")));
}

}  // namespace
}  // namespace invsim
