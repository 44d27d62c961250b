// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_LOGGING_H_
#define INVSIM_BASE_LOGGING_H_

// Logging is glog's, to standard error and never to files. The library only
// uses VLOG(1) (per step or iteration) and VLOG(2) (inside one), so it says
// nothing unless asked. Included by .cpp files only: glog's macros have short
// names.

#include <glog/logging.h>

namespace invsim {

// What -q, nothing, -v and -vv select.
//   -1  errors
//    0  warnings too
//    1  information and VLOG(1) too
//    2  VLOG(2) too
// May be called again to change the verbosity.
void InitLogging(const char* program, int verbosity);

}  // namespace invsim

#endif  // INVSIM_BASE_LOGGING_H_
