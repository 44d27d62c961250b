// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_NAMES_H_
#define INVSIM_BASE_NAMES_H_

// "Did you mean ...?": the known name nearest to a mistyped one.

#include <string>
#include <string_view>
#include <vector>

namespace invsim {

// Least number of inserted, deleted, replaced or swapped neighbouring
// characters that turn `a` into `b`; letters compare without case, '-' as '_'.
int EditDistance(std::string_view a, std::string_view b);

// The name in `names` nearest to `name`, or "" if none is near. A dotted name
// also matches by its last part: "substeps" finds "step.substeps". The first
// of equally near names wins.
std::string NearestName(std::string_view name,
                        const std::vector<std::string>& names);

// One line for an error: "unknown effect 'membran'; did you mean 'membrane'?",
// or, when nothing is near, "...; known: bending, gravity, membrane".
std::string UnknownName(std::string_view kind,
                        std::string_view name,
                        const std::vector<std::string>& names);

// "a, b, c".
std::string Join(const std::vector<std::string>& parts);

}  // namespace invsim

#endif  // INVSIM_BASE_NAMES_H_
