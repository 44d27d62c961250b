// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/earlier_results.h"

#include <algorithm>

#include "invsim/base/error.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

// Whether `path` is `folder` or somewhere below it; both canonical.
bool IsWithin(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end())
             .first == folder.end();
}

// Whether a run that reads `input` reads `file`, or something in it; both
// canonical.
bool Needs(const fs::path& input, const fs::path& file) {
  return IsWithin(input, file) || file.parent_path() == input;
}

}  // namespace

void RemoveEarlierResults(const fs::path& folder,
                          const std::vector<fs::path>& files,
                          const std::vector<std::string>& inputs) {
  if (!fs::exists(folder / kResolvedConfig))
    throw UsageError(folder.string() +
                     ": is not a folder of earlier results (" +
                     kResolvedConfig +
                     " is not in it), and --force replaces nothing else; "
                     "choose another folder");
  for (const std::string& input : inputs) {
    if (input.empty()) continue;
    const fs::path read = fs::weakly_canonical(fs::absolute(input));
    for (const fs::path& file : files)
      if (fs::exists(file) && Needs(read, fs::canonical(file)))
        throw UsageError(input + ": is to be read, but --force would remove " +
                         file.string() + "; choose another folder");
  }
  for (const fs::path& file : files) fs::remove_all(file);
}

}  // namespace invsim
