// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_THREADS_H_
#define INVSIM_BASE_THREADS_H_

// Parallel loops whose result does not depend on the number of threads: work
// is cut into pieces by size alone, a piece writes only what is its own, and
// sums are taken piece by piece in order.

#include <functional>
#include <vector>

namespace invsim {

// Sets how many threads the loops below may use; 0 means one per core. Also
// holds the dense linear algebra (OpenBLAS, if it is linked) to one thread:
// on matrices of our size two were slower than one, and the loops outside it
// are the better place for the second core. Throws UsageError if negative.
void SetThreads(int threads);

// Keeps BLAS and the OpenMP loops of sparse libraries to the calling thread:
// at the sizes of cloth their threads cost more than they bring, and on a busy
// machine their barriers cost twenty times the work (docs/performance.md). For
// the whole process; whoever factorises calls it first.
void HoldLinearAlgebraToOneThread();

// What SetThreads chose; one per core before.
int NumThreads();

// Calls body(begin, end) for the pieces of 0 .. n - 1, `grain` long each (the
// last one shorter). An exception of a piece comes out here.
void ParallelForPieces(int n,
                       int grain,
                       const std::function<void(int, int)>& body);

// Calls body(i) for i in 0 .. n - 1. `grain` indices run one after the other
// in one thread: choose it so that they take 10 microseconds or more.
template <typename Body>
void ParallelFor(int n, int grain, const Body& body) {
  ParallelForPieces(n, grain, [&body](int begin, int end) {
    for (int i = begin; i < end; ++i) body(i);
  });
}

// zero + sum of body(begin, end) over the pieces, in their order. For T with
// operator+=, such as a double or an Eigen matrix.
template <typename T, typename Body>
T ParallelSum(int n, int grain, const T& zero, const Body& body) {
  if (n <= 0) return zero;
  std::vector<T> parts((n - 1) / grain + 1, zero);
  ParallelForPieces(n, grain, [&](int begin, int end) {
    parts[begin / grain] = body(begin, end);
  });
  T sum = zero;
  for (const T& part : parts) sum += part;
  return sum;
}

}  // namespace invsim

#endif  // INVSIM_BASE_THREADS_H_
