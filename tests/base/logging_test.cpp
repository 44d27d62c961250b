// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/logging.h"

#include <gtest/gtest.h>

#include <string>

namespace invsim {
namespace {

// What reaches standard error at a verbosity, one letter per kind.
std::string Heard(int verbosity) {
  InitLogging("logging_test", verbosity);
  testing::internal::CaptureStderr();
  LOG(ERROR) << "<E>";
  LOG(WARNING) << "<W>";
  LOG(INFO) << "<I>";
  VLOG(1) << "<1>";
  VLOG(2) << "<2>";
  const std::string text = testing::internal::GetCapturedStderr();
  InitLogging("logging_test", 0);
  std::string heard;
  for (const char kind : std::string("EWI12"))
    if (text.find(std::string("<") + kind + ">") != std::string::npos)
      heard += kind;
  return heard;
}

TEST(LoggingTest, VerbositySelectsWhatIsHeard) {
  EXPECT_EQ(Heard(-1), "E");
  EXPECT_EQ(Heard(0), "EW");
  EXPECT_EQ(Heard(1), "EWI1");
  EXPECT_EQ(Heard(2), "EWI12");
}

}  // namespace
}  // namespace invsim
