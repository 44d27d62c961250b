// SPDX-License-Identifier: Apache-2.0
// The `main` of every test program. CTest runs each test in a process of its
// own, several at a time: each process gets its own empty testing::TempDir(),
// so that a test may give its files any name, and none are left behind.

#include <gmock/gmock.h>
#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <string>

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  std::string directory =
      std::filesystem::temp_directory_path() / "invsim-test-XXXXXX";
  if (!mkdtemp(directory.data())) {
    std::perror(directory.c_str());
    return 1;
  }
  setenv("TEST_TMPDIR", directory.c_str(), 1);
  setenv("TMPDIR", directory.c_str(), 1);
  const int result = RUN_ALL_TESTS();
  std::filesystem::remove_all(directory);
  return result;
}
