// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/block_matrix.h"

#include <algorithm>

namespace invsim {

int BlockPattern::Find(int i, int j) const {
  const auto first = column.begin() + row_start[i];
  const auto last = column.begin() + row_start[i + 1];
  const auto it = std::lower_bound(first, last, j);
  return it != last && *it == j ? static_cast<int>(it - column.begin()) : -1;
}

bool BlockPattern::Holds(std::span<const int> vertices) const {
  for (const int i : vertices)
    for (const int j : vertices)
      if (Find(i, j) < 0) return false;
  return true;
}

BlockPatternBuilder::BlockPatternBuilder(const BlockPattern& pattern)
    : neighbours_(pattern.size) {
  for (int i = 0; i < pattern.size; ++i)
    neighbours_[i].assign(pattern.column.begin() + pattern.row_start[i],
                          pattern.column.begin() + pattern.row_start[i + 1]);
}

void BlockPatternBuilder::AddStencil(std::span<const int> vertices) {
  for (int i : vertices)
    for (int j : vertices)
      if (i != j) neighbours_[i].push_back(j);
}

std::shared_ptr<const BlockPattern> BlockPatternBuilder::Build() const {
  auto pattern = std::make_shared<BlockPattern>();
  pattern->size = static_cast<int>(neighbours_.size());
  pattern->row_start.push_back(0);
  for (int i = 0; i < pattern->size; ++i) {
    std::vector<int> row = neighbours_[i];
    row.push_back(i);
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    pattern->column.insert(pattern->column.end(), row.begin(), row.end());
    pattern->row_start.push_back(static_cast<int>(pattern->column.size()));
  }
  return pattern;
}

BlockMatrix::BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)) {
  values_.assign(9 * static_cast<size_t>(pattern_->num_blocks()), 0.0);
  diagonal_.resize(pattern_->size);
  for (int i = 0; i < pattern_->size; ++i) diagonal_[i] = pattern_->Find(i, i);
}

void BlockMatrix::SetZero() { std::fill(values_.begin(), values_.end(), 0.0); }

void BlockMatrix::Assign(const BlockMatrix& a) {
  if (pattern_ == a.pattern_) {
    values_ = a.values_;
    return;
  }
  SetZero();
  const BlockPattern& from = *a.pattern_;
  for (int i = 0; i < from.size; ++i) {
    int to = pattern_->row_start[i];
    for (int k = from.row_start[i]; k < from.row_start[i + 1]; ++k) {
      while (pattern_->column[to] != from.column[k]) ++to;
      std::copy_n(a.values_.data() + 9 * k, 9, values_.data() + 9 * to);
    }
  }
}

void BlockMatrix::Multiply(const Columns& x, Columns* y) const {
  y->setZero(x.rows(), x.cols());
  for (int i = 0; i < size(); ++i) {
    for (int k = pattern_->row_start[i]; k < pattern_->row_start[i + 1]; ++k) {
      const auto b = block(k);
      const int j = 3 * pattern_->column[k];
      for (int r = 0; r < 3; ++r)
        y->row(3 * i + r) += b(r, 0) * x.row(j) + b(r, 1) * x.row(j + 1) +
                             b(r, 2) * x.row(j + 2);
    }
  }
}

void BlockMatrix::MultiplyTransposed(const Columns& x, Columns* y) const {
  y->setZero(x.rows(), x.cols());
  for (int i = 0; i < size(); ++i) {
    for (int k = pattern_->row_start[i]; k < pattern_->row_start[i + 1]; ++k) {
      const auto b = block(k);
      const int j = 3 * pattern_->column[k];
      for (int r = 0; r < 3; ++r)
        y->row(j + r) += b(0, r) * x.row(3 * i) + b(1, r) * x.row(3 * i + 1) +
                         b(2, r) * x.row(3 * i + 2);
    }
  }
}

VectorXd BlockMatrix::operator*(const VectorXd& x) const {
  VectorXd y(x.size());
  for (int i = 0; i < size(); ++i) {
    Vector3d sum = Vector3d::Zero();
    for (int k = pattern_->row_start[i]; k < pattern_->row_start[i + 1]; ++k)
      sum.noalias() += block(k) * x.segment<3>(3 * pattern_->column[k]);
    y.segment<3>(3 * i) = sum;
  }
  return y;
}

void BlockMatrix::AddScaled(double scale, const BlockMatrix& other) {
  for (size_t k = 0; k < values_.size(); ++k)
    values_[k] += scale * other.values_[k];
}

}  // namespace invsim
