// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/logging.h"

#include <algorithm>

namespace invsim {

void InitLogging(const char* program, int verbosity) {
  FLAGS_logtostderr = true;
  FLAGS_v = std::max(verbosity, 0);
  FLAGS_minloglevel = verbosity > 0    ? google::GLOG_INFO
                      : verbosity == 0 ? google::GLOG_WARNING
                                       : google::GLOG_ERROR;
  if (!google::IsGoogleLoggingInitialized()) google::InitGoogleLogging(program);
}

}  // namespace invsim
