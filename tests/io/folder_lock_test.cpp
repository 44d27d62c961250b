// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/folder_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "invsim/base/error.h"

namespace invsim {
namespace {

using ::testing::StartsWith;
using ::testing::ThrowsMessage;

TEST(FolderLock, IsHeldByOneAtATimeAndLeavesNothing) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "invsim_folder_lock";
  std::filesystem::create_directories(folder);
  auto first = std::make_unique<FolderLock>(folder.string());
  EXPECT_THAT([&] { FolderLock second(folder.string()); },
              ThrowsMessage<UsageError>(
                  StartsWith(folder.string() + ": another run is writing")));
  first.reset();
  EXPECT_NO_THROW(FolderLock(folder.string()));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove(folder);
}

}  // namespace
}  // namespace invsim
