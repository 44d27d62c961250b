// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "invsim/base/error.h"

namespace invsim {

FolderLock::FolderLock(const std::string& path)
    : descriptor_(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) return;
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    return;
  close(descriptor_);
  throw UsageError(path +
                   ": another run is writing there; wait for its end, or "
                   "choose another folder");
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace invsim
