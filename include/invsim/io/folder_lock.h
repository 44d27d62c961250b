// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_FOLDER_LOCK_H_
#define INVSIM_IO_FOLDER_LOCK_H_

// A folder for one writer at a time. The lock is the operating system's own:
// it leaves no file and ends with the process, however that ends. On a file
// system without such locks there is none.

#include <string>

namespace invsim {

class FolderLock {
 public:
  // Throws UsageError if somebody else holds the lock of this folder, which
  // must exist.
  explicit FolderLock(const std::string& path);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace invsim

#endif  // INVSIM_IO_FOLDER_LOCK_H_
