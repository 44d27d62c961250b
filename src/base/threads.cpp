// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/threads.h"

#include <dlfcn.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

#include <algorithm>
#include <memory>
#include <string>

#include "invsim/base/error.h"

namespace invsim {
namespace {

// The library that hands the pieces out is not compiled for the thread
// sanitizer, which therefore does not see that a piece begins after the call
// and ends before its return. These two say it; else they do nothing.
class HandOver {
 public:
  void Give() {
#ifdef __SANITIZE_THREAD__
    __tsan_release(this);
#endif
  }
  void Take() {
#ifdef __SANITIZE_THREAD__
    __tsan_acquire(this);
#endif
  }

 private:
  char place_ = 0;
};

void CallIfLoaded(const char* function, int argument) {
  using Function = void (*)(int);
  const auto f = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, function));
  if (f) f(argument);
}

}  // namespace

// OpenBLAS is linked by the layers that factorise, or stands behind the
// system's BLAS, or is not there at all; only the running program knows. The
// same holds for OpenMP, of which CHOLMOD asks for four threads whatever the
// machine has: no parallel region may become active.
void HoldLinearAlgebraToOneThread() {
  CallIfLoaded("openblas_set_num_threads", 1);
  CallIfLoaded("omp_set_max_active_levels", 0);
}

void SetThreads(int threads) {
  if (threads < 0)
    throw UsageError("threads = " + std::to_string(threads) +
                     ": expected an integer >= 0");
  const int wanted = threads == 0 ? tbb::info::default_concurrency() : threads;
  // TBB honours the smallest limit alive: end the old one first.
  static std::unique_ptr<tbb::global_control> control;
  control.reset();
  control = std::make_unique<tbb::global_control>(
      tbb::global_control::max_allowed_parallelism, wanted);
  HoldLinearAlgebraToOneThread();
}

int NumThreads() {
  return static_cast<int>(tbb::global_control::active_value(
      tbb::global_control::max_allowed_parallelism));
}

void ParallelForPieces(int n,
                       int grain,
                       const std::function<void(int, int)>& body) {
  if (n <= 0) return;
  const int pieces = (n - 1) / grain + 1;
  HandOver started, done;
  const auto run = [&](int piece) {
    started.Take();
    const int begin = piece * grain;
    body(begin, begin + std::min(grain, n - begin));
    done.Give();
  };
  started.Give();
  if (pieces == 1) {
    run(0);
    return;
  }
  tbb::parallel_for(0, pieces, run);
  done.Take();
}

}  // namespace invsim
