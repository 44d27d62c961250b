// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BENCHMARKS_BENCHMARKS_H_
#define INVSIM_BENCHMARKS_BENCHMARKS_H_

// The list of what is measured: one function per bench_NAME.cpp, which adds
// its rows, their names beginning with "NAME/".

#include "harness.h"

namespace invsim {

void BenchIo(Bench* bench);
void BenchStep(Bench* bench);

inline void RunAllBenchmarks(Bench* bench) {
  BenchIo(bench);
  BenchStep(bench);
}

}  // namespace invsim

#endif  // INVSIM_BENCHMARKS_BENCHMARKS_H_
