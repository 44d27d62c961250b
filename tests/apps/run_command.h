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

// A line for a shell, with what it prints.
inline CommandResult RunShell(const std::string& commands) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string stem = ::testing::TempDir() + "invsim_" +
                           info->test_suite_name() + "_" + info->name();
  const std::string line =
      "{ " + commands + "; } >'" + stem + ".out' 2>'" + stem + ".err'";
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

// `arguments` as for a shell.
inline CommandResult RunCommand(const std::string& arguments) {
  return RunShell("'" INVSIM_COMMAND "' " + arguments);
}

// Sends `signal` as soon as the shell finds `when` to be true, or after four
// minutes.
inline CommandResult RunAndSignal(const std::string& arguments,
                                  const std::string& when,
                                  const std::string& signal) {
  return RunShell("'" INVSIM_COMMAND "' " + arguments +
                  " & pid=$!; n=0; while [ $n -lt 12000 ] && ! " + when +
                  "; do sleep 0.02; n=$((n+1)); done; kill -" + signal +
                  " $pid; wait $pid");
}

}  // namespace invsim

#endif  // INVSIM_TESTS_APPS_RUN_COMMAND_H_
