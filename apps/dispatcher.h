// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_DISPATCHER_H_
#define INVSIM_APPS_DISPATCHER_H_

#include <memory>
#include <vector>

#include "command.h"

namespace invsim {

// Runs the command that the arguments name and returns the exit code of the
// process. Whatever goes wrong becomes one line on standard error:
//
//   invsim: FILE or key: value: expectation
int Dispatch(const std::vector<std::unique_ptr<Command>>& commands,
             int argc,
             char** argv);

}  // namespace invsim

#endif  // INVSIM_APPS_DISPATCHER_H_
