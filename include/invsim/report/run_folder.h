// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_RUN_FOLDER_H_
#define INVSIM_REPORT_RUN_FOLDER_H_

// The folder in which a run leaves its results:
//
//   report.json  report.html  solver.txt  iterations.csv
//   config.resolved.toml  body.npz  cloth.pc2  scene.glb
//   body/000000.ply ...  cloth/000000.ply ...  checkpoint/
//
// Every file appears complete or not at all. While a RunFolder, or a copy of
// it, lives no other one can be made there, in this process or another one.

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "invsim/io/folder_lock.h"

namespace invsim {

class RunFolder {
 public:
  // The folder of a run that is to be resumed, as it is. Throws UsageError if
  // it has no checkpoint or another one is writing there.
  static RunFolder Reopen(const std::string& path);

  // Makes the folder, with those above it. Throws UsageError if there is
  // something else of that name, or files in it and not `force`, or another run
  // writing there; InputError if it cannot be made or written to. With `force`
  // the files of an earlier run, those named above, are removed, so that no
  // frame of it is left among the new ones; anything else stays. UsageError,
  // and all stays, if there is no config.resolved.toml in it (write that first:
  // without it the folder is taken for the user's own), or if one of `inputs`,
  // the paths that the run reads, would be removed (io/earlier_results.h).
  RunFolder(const std::string& path,
            bool force,
            const std::vector<std::string>& inputs = {});

  const std::string& path() const { return path_; }
  // "PATH/name".
  std::string File(const std::string& name) const;
  // "PATH/checkpoint", made if it is not there. Throws InputError.
  std::string Checkpoint() const;
  // "PATH/kind/000012.ply"; makes the sub-folder `kind`, "body" or "cloth".
  std::string Frame(const std::string& kind, int frame) const;
  // Throws InputError.
  void Write(const std::string& name, std::string_view bytes) const;

 private:
  explicit RunFolder(const std::string& path)
      : path_(path), lock_(std::make_shared<FolderLock>(path)) {}

  std::string path_;
  std::shared_ptr<const FolderLock> lock_;
};

}  // namespace invsim

#endif  // INVSIM_REPORT_RUN_FOLDER_H_
