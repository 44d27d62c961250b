// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_EARLIER_RESULTS_H_
#define INVSIM_IO_EARLIER_RESULTS_H_

// What --force may remove: files of results that we wrote, and nothing that
// is the user's.

#include <filesystem>
#include <string>
#include <vector>

namespace invsim {

// In every folder of ours, written before any other file: the options the
// results were made with. A folder without it is not ours.
inline constexpr char kResolvedConfig[] = "config.resolved.toml";

// Removes `files`, files or folders somewhere in `folder`, so far as they are
// there. Throws UsageError, and removes nothing, if
//
//   - `folder` does not hold kResolvedConfig, or
//   - one of `inputs` is among the files, lies in one of them, or is the
//     folder that one of them lies in: the run would lose what it reads.
//
// `inputs` are paths as the user gave them; names of what is embedded and
// empty ones do no harm. Throws std::filesystem::filesystem_error.
void RemoveEarlierResults(const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& files,
                          const std::vector<std::string>& inputs);

}  // namespace invsim

#endif  // INVSIM_IO_EARLIER_RESULTS_H_
