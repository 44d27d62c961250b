// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "error_matcher.h"

namespace invsim {
namespace {

TEST(FileTest, ReadsBackWhatWasWritten) {
  const std::string path = ::testing::TempDir() + "file_test.bin";
  std::string bytes(3000000, 'x');
  bytes[1000000] = '\0';
  WriteFileBytes(path, bytes);
  EXPECT_EQ(ReadFileBytes(path), bytes);
  WriteFileBytes(path, "");
  EXPECT_EQ(ReadFileBytes(path), "");
  std::filesystem::remove(path);
}

TEST(FileTest, NamesThePathAndTheReason) {
  EXPECT_THAT([] { ReadFileBytes("/nowhere/a"); },
              ThrowsInputError("/nowhere/a: cannot be opened: No such file"));
  EXPECT_THAT([] { ReadFileBytes(::testing::TempDir()); },
              ThrowsInputError("is a directory: expected a file"));
  EXPECT_THAT([] { WriteFileBytes("/nowhere/a", "x"); },
              ThrowsInputError("/nowhere/a: cannot be written: No such file"));
}

TEST(FileTest, LowersTheExtension) {
  EXPECT_EQ(LowerExtension("a.b/C.PLY"), "ply");
  EXPECT_EQ(LowerExtension("a.b/c"), "");
  EXPECT_EQ(LowerExtension("x.npy.OBJ"), "obj");
}

}  // namespace
}  // namespace invsim
