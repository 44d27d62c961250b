// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_ALGEBRA_CHOLMOD_ANALYSIS_H_
#define INVSIM_SRC_ALGEBRA_CHOLMOD_ANALYSIS_H_

// What the Cholesky and the LU factorisation share: the pattern of a
// BlockMatrix as CHOLMOD sees it (lower triangle, scalar entries) and its
// supernodal symbolic analysis.

#include <cholmod.h>

#include <memory>
#include <vector>

#include "invsim/algebra/block_matrix.h"

namespace invsim {

class CholmodAnalysis {
 public:
  explicit CholmodAnalysis(std::shared_ptr<const BlockPattern> pattern);
  ~CholmodAnalysis();
  CholmodAnalysis(const CholmodAnalysis&) = delete;
  CholmodAnalysis& operator=(const CholmodAnalysis&) = delete;

  // The lower triangle of `a` copied into lower(); false if not finite.
  bool Load(const BlockMatrix& a);

  const BlockPattern& pattern() const { return *pattern_; }
  cholmod_common* common() const { return &common_; }
  cholmod_sparse* lower() const { return lower_; }
  cholmod_factor* factor() const { return factor_; }

 private:
  std::shared_ptr<const BlockPattern> pattern_;
  mutable cholmod_common common_;
  cholmod_sparse* lower_ = nullptr;
  cholmod_factor* factor_ = nullptr;
  std::vector<int> source_;  // value k of lower() = block entry source_[k]
};

}  // namespace invsim

#endif  // INVSIM_SRC_ALGEBRA_CHOLMOD_ANALYSIS_H_
