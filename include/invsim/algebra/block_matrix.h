// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_ALGEBRA_BLOCK_MATRIX_H_
#define INVSIM_ALGEBRA_BLOCK_MATRIX_H_

// A square sparse matrix of 3x3 blocks with a fixed pattern: one block row per
// cloth vertex. The pattern is made once from the stencils of the scene's
// effects; every step only refills the values, so that the symbolic analysis
// of the factorisation is kept for the whole sequence.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

// Which blocks may be non-zero. Symmetric, diagonal always present, columns
// ascending within a row.
struct BlockPattern {
  int size = 0;                // block rows
  std::vector<int> row_start;  // size + 1
  std::vector<int> column;     // row_start.back()

  int num_blocks() const { return static_cast<int>(column.size()); }
  // Position of block (i, j) in `column`, or -1.
  int Find(int i, int j) const;
  // Whether every pair within a tuple of vertices has its block.
  bool Holds(std::span<const int> vertices) const;
};

// Collects vertex tuples; every pair within a tuple becomes a block.
class BlockPatternBuilder {
 public:
  explicit BlockPatternBuilder(int size) : neighbours_(size) {}
  // Starts with the blocks of `pattern`.
  explicit BlockPatternBuilder(const BlockPattern& pattern);
  void AddStencil(std::span<const int> vertices);
  std::shared_ptr<const BlockPattern> Build() const;

 private:
  std::vector<std::vector<int>> neighbours_;
};

class BlockMatrix {
 public:
  BlockMatrix() = default;
  explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern);

  const BlockPattern& pattern() const { return *pattern_; }
  std::shared_ptr<const BlockPattern> shared_pattern() const {
    return pattern_;
  }
  int size() const { return pattern_ ? pattern_->size : 0; }

  void SetZero();
  // The values of `a`, whose pattern is this one or a part of it; zero where
  // `a` has no block.
  void Assign(const BlockMatrix& a);
  // Block number `k` of the pattern. Blocks are stored one after the other,
  // each column-major.
  Eigen::Map<Matrix3d> block(int k) {
    return Eigen::Map<Matrix3d>(values_.data() + 9 * k);
  }
  Eigen::Map<const Matrix3d> block(int k) const {
    return Eigen::Map<const Matrix3d>(values_.data() + 9 * k);
  }
  Eigen::Map<Matrix3d> diagonal(int i) { return block(diagonal_[i]); }
  Eigen::Map<const Matrix3d> diagonal(int i) const {
    return block(diagonal_[i]);
  }

  // y = A x, y = A^T x for one or many columns (3 size x m).
  void Multiply(const Columns& x, Columns* y) const;
  void MultiplyTransposed(const Columns& x, Columns* y) const;
  VectorXd operator*(const VectorXd& x) const;
  void AddScaled(double scale, const BlockMatrix& other);

 private:
  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<int> diagonal_;
  std::vector<double> values_;
};

// The blocks of a list of equal-sized stencils, found once: slot(s, a, b) is
// the block of rows of stencil vertex a and columns of stencil vertex b.
template <int kVertices>
class StencilSlots {
 public:
  StencilSlots() = default;
  StencilSlots(const BlockPattern& pattern,
               const std::vector<std::array<int, kVertices>>& stencils) {
    slots_.reserve(stencils.size() * kVertices * kVertices);
    for (const auto& s : stencils)
      for (int a = 0; a < kVertices; ++a)
        for (int b = 0; b < kVertices; ++b)
          slots_.push_back(pattern.Find(s[a], s[b]));
  }
  int slot(size_t stencil, int a, int b) const {
    return slots_[(stencil * kVertices + a) * kVertices + b];
  }

 private:
  std::vector<int> slots_;
};

}  // namespace invsim

#endif  // INVSIM_ALGEBRA_BLOCK_MATRIX_H_
