// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_APPS_RUN_COMMAND_H_
#define INVSIM_TESTS_APPS_RUN_COMMAND_H_

// Runs the built `invsim` as a user would.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "invsim/io/file.h"

namespace invsim {

struct CommandResult {
  int exit_code = -1;  // -1: ended by a signal
  std::string out;
  std::string err;
};

// A directory of the running test's own, made empty.
inline std::filesystem::path TestDirectory() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path directory =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("invsim_") + info->test_suite_name() + "_" + info->name());
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  return directory;
}

// `arguments` as for a shell.
inline CommandResult RunCommand(const std::string& arguments) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string stem = ::testing::TempDir() + "invsim_" +
                           info->test_suite_name() + "_" + info->name();
  const std::string line = std::string("'" INVSIM_COMMAND "' ") + arguments +
                           " >'" + stem + ".out' 2>'" + stem + ".err'";
  const int status = std::system(line.c_str());
  CommandResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  for (auto [suffix, text] :
       {std::pair(".out", &result.out), std::pair(".err", &result.err)}) {
    *text = ReadFileBytes(stem + suffix);
    std::filesystem::remove(stem + suffix);
  }
  return result;
}

}  // namespace invsim

#endif  // INVSIM_TESTS_APPS_RUN_COMMAND_H_
