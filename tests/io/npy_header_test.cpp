// SPDX-License-Identifier: Apache-2.0
// The head of an npy file, tested through the parser it belongs to.
#include <gmock/gmock.h>

#include "invsim/base/error.h"
#include "invsim/io/npy.h"
#include "npy_bytes.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(NpyHeader, ObjectsAreRefusedWithTheRemedy) {
  EXPECT_THAT(
      [] { ParseNpy(NpyBytes(NpyHead("|O", "()"), "\x80\x04."), "a.npy"); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("a.npy: holds Python objects"),
                                      HasSubstr("python3 -c"))));
}

TEST(NpyHeader, HugeShapesAreRefusedWithoutMemory) {
  for (const char* shape : {"(1000000000000,)",
                            "(3037000500, 3037000500)",
                            "(4294967296, 4294967296, 4294967296)"}) {
    EXPECT_THAT(
        [&] { ParseNpy(NpyBytes(NpyHead("<f8", shape), "12345678"), "a.npy"); },
        ThrowsMessage<InputError>(HasSubstr("does not match the 8 bytes")))
        << shape;
  }
  EXPECT_THROW(
      ParseNpy(NpyBytes(NpyHead("<U0", "(1000000000000,)"), ""), "a.npy"),
      InputError);
}

TEST(NpyHeader, TooManyDimensionsAreRefused) {
  const auto ones = [](int count) {
    std::string shape = "(";
    for (int i = 0; i < count; ++i) shape += "1,";
    return shape + ")";
  };
  const auto parse = [&](int count) {
    return ParseNpy(NpyBytes(NpyHead("<i2", ones(count), true), "ab"), "a.npy");
  };
  EXPECT_EQ(parse(64).size(), 1u);
  EXPECT_THAT([&] { parse(65); },
              ThrowsMessage<InputError>(
                  HasSubstr("a.npy: array of more than 64 dimensions")));
}

TEST(NpyHeader, DamagedHeadersAreRefused) {
  const std::string good = NpyBytes(NpyHead("<f8", "(1,)"), "12345678");
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_THROW(ParseNpy(good.substr(0, size), "a"), InputError) << size;
  }
  for (const std::string& header :
       {NpyHead("<f8", "(-1,)"),
        NpyHead("<c16", "(1,)"),
        NpyHead("", "(1,)"),
        NpyHead("<f16", "(1,)"),
        NpyHead("<i4x", "(1,)"),
        std::string("{}"),
        std::string("{'descr': [('a', '<f8')], 'fortran_order': False, "
                    "'shape': (1,), }"),
        std::string("{'descr': '<f8', 'shape': (1,), }"),
        std::string("{'descr': '<f8', 'fortran_order': Maybe}")}) {
    EXPECT_THROW(ParseNpy(NpyBytes(header, "12345678"), "a"), InputError)
        << header;
  }
}

TEST(NpyHeader, Python2ShapeIsRead) {
  const auto array = ParseNpy(NpyBytes(NpyHead("|u1", "(2L,)"), "ab"), "a.npy");
  EXPECT_THAT(array.shape(), ElementsAre(2));
}

TEST(NpyHeader, DataStartAt64Bytes) {
  for (const std::int64_t n : {1, 10, 100, 1000, 1000000}) {
    const auto array = NpyArray::Bools({n}, std::vector<bool>(n));
    EXPECT_EQ((FormatNpy(array).size() - n) % 64, 0u) << n;
  }
}

}  // namespace
}  // namespace invsim
