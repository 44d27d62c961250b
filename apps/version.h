// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_VERSION_H_
#define INVSIM_APPS_VERSION_H_

#include <string>

namespace invsim {

// Our version and those of the libraries on which the steps taken depend, a
// line each; not the BLAS, which chooses its code by the processor.
std::string ProgramVersion();

// Our version and those of the libraries on which the numbers depend, a line
// each.
std::string VersionText();

}  // namespace invsim

#endif  // INVSIM_APPS_VERSION_H_
