// SPDX-License-Identifier: Apache-2.0
#include "cholmod_analysis.h"

#include <cmath>
#include <mutex>
#include <utility>

#include "invsim/base/threads.h"

namespace invsim {
namespace {

// METIS draws from the one random sequence of the C library, which it begins
// anew in each call: two at the same time would take each other's numbers, and
// the ordering, by it every last bit, would change from run to run.
bool OrderByMetis(cholmod_sparse* graph, int* order, cholmod_common* common) {
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  return cholmod_metis(graph, nullptr, 0, 1, order, common);
}

// The fill-reducing ordering is found on the graph of vertices, nine times
// smaller than that of scalars, and written out for the three coordinates.
std::vector<int> Ordering(const BlockPattern& p, cholmod_common* common) {
  cholmod_sparse* graph = cholmod_allocate_sparse(
      p.size, p.size, p.num_blocks(), 1, 1, -1, CHOLMOD_PATTERN, common);
  int* start = static_cast<int*>(graph->p);
  int* row = static_cast<int*>(graph->i);
  int count = 0;
  for (int j = 0; j < p.size; ++j) {
    start[j] = count;
    for (int k = p.row_start[j]; k < p.row_start[j + 1]; ++k)
      if (p.column[k] >= j) row[count++] = p.column[k];
  }
  start[p.size] = count;
  std::vector<int> order(p.size);
  if (!OrderByMetis(graph, order.data(), common)) {
    common->status = CHOLMOD_OK;
    cholmod_amd(graph, nullptr, 0, order.data(), common);
  }
  cholmod_free_sparse(&graph, common);
  std::vector<int> scalar;
  scalar.reserve(3 * order.size());
  for (int i : order)
    for (int c = 0; c < 3; ++c) scalar.push_back(3 * i + c);
  return scalar;
}

}  // namespace

CholmodAnalysis::CholmodAnalysis(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)) {
  HoldLinearAlgebraToOneThread();
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  const BlockPattern& p = *pattern_;
  const int n = 3 * p.size;
  lower_ = cholmod_allocate_sparse(
      n, n, 9 * p.num_blocks(), 1, 1, -1, CHOLMOD_REAL, &common_);
  int* start = static_cast<int*>(lower_->p);
  int* row = static_cast<int*>(lower_->i);
  int count = 0;
  for (int j = 0; j < p.size; ++j) {
    for (int c = 0; c < 3; ++c) {
      start[3 * j + c] = count;
      for (int k = p.row_start[j]; k < p.row_start[j + 1]; ++k) {
        const int i = p.column[k];
        if (i < j) continue;
        // Entry (3i+r, 3j+c) of the lower triangle is read, by symmetry, from
        // block (j, i), whose row c, column r is stored at 3 r + c.
        for (int r = i == j ? c : 0; r < 3; ++r) {
          row[count++] = 3 * i + r;
          source_.push_back(9 * k + 3 * r + c);
        }
      }
    }
  }
  start[n] = count;
  std::vector<int> order = Ordering(p, &common_);
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;
  common_.postorder = 1;
  factor_ = cholmod_analyze_p(lower_, order.data(), nullptr, 0, &common_);
}

CholmodAnalysis::~CholmodAnalysis() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_free_sparse(&lower_, &common_);
  cholmod_finish(&common_);
}

bool CholmodAnalysis::Load(const BlockMatrix& a) {
  const double* from = a.block(0).data();
  double* to = static_cast<double*>(lower_->x);
  double sum = 0;
  for (size_t k = 0; k < source_.size(); ++k) {
    to[k] = from[source_[k]];
    sum += to[k];
  }
  return std::isfinite(sum);
}

}  // namespace invsim
