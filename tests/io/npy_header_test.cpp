// SPDX-License-Identifier: Apache-2.0
// The head of an npy file, tested through the parser it belongs to.
#include <gmock/gmock.h>

#include "invsim/base/error.h"
#include "invsim/io/npy.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// A version-1 file with the head and data given.
std::string NpyBytes(std::string header, const std::string& data) {
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  return bytes + header + data;
}

std::string Header(const std::string& descr,
                   const std::string& shape,
                   bool fortran = false) {
  return "{'descr': '" + descr +
         "', 'fortran_order': " + (fortran ? "True" : "False") +
         ", 'shape': " + shape + ", }";
}

TEST(NpyHeader, ObjectsAreRefusedWithTheRemedy) {
  EXPECT_THAT(
      [] { ParseNpy(NpyBytes(Header("|O", "()"), "\x80\x04."), "a.npy"); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("a.npy: holds Python objects"),
                                      HasSubstr("python3 -c"))));
}

TEST(NpyHeader, HugeShapesAreRefusedWithoutMemory) {
  for (const char* shape : {"(1000000000000,)",
                            "(3037000500, 3037000500)",
                            "(4294967296, 4294967296, 4294967296)"}) {
    EXPECT_THAT(
        [&] { ParseNpy(NpyBytes(Header("<f8", shape), "12345678"), "a.npy"); },
        ThrowsMessage<InputError>(HasSubstr("does not match the 8 bytes")))
        << shape;
  }
  EXPECT_THROW(
      ParseNpy(NpyBytes(Header("<U0", "(1000000000000,)"), ""), "a.npy"),
      InputError);
}

TEST(NpyHeader, TooManyDimensionsAreRefused) {
  const auto ones = [](int count) {
    std::string shape = "(";
    for (int i = 0; i < count; ++i) shape += "1,";
    return shape + ")";
  };
  const auto parse = [&](int count) {
    return ParseNpy(NpyBytes(Header("<i2", ones(count), true), "ab"), "a.npy");
  };
  EXPECT_EQ(parse(64).size(), 1u);
  EXPECT_THAT([&] { parse(65); },
              ThrowsMessage<InputError>(
                  HasSubstr("a.npy: array of more than 64 dimensions")));
}

TEST(NpyHeader, DamagedHeadersAreRefused) {
  const std::string good = NpyBytes(Header("<f8", "(1,)"), "12345678");
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_THROW(ParseNpy(good.substr(0, size), "a"), InputError) << size;
  }
  for (const std::string& header :
       {Header("<f8", "(-1,)"),
        Header("<c16", "(1,)"),
        Header("", "(1,)"),
        Header("<f16", "(1,)"),
        Header("<i4x", "(1,)"),
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
  const auto array = ParseNpy(NpyBytes(Header("|u1", "(2L,)"), "ab"), "a.npy");
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
