// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/sparse_lu.h"

#include <Eigen/LU>
#include <cmath>
#include <utility>
#include <vector>

#include "cholmod_analysis.h"
#include "supernodes.h"

namespace invsim {
namespace {

using Panel = Eigen::Map<MatrixXd>;

}  // namespace

// Each supernode (supernodes.h) has two panels of values: `lower` holds L (with
// the dense LU of the diagonal block on top) and `upper` the transpose of U's
// block row.
struct SparseLu::Impl {
  explicit Impl(std::shared_ptr<const BlockPattern> pattern);
  Panel lower(const Supernode& s) {
    return Panel(lower_values.data() + s.offset, s.height, s.width);
  }
  Panel upper(const Supernode& s) {
    return Panel(upper_values.data() + s.offset, s.height, s.width);
  }
  void Assemble(const BlockMatrix& a);
  void Update(const Supernode& target, const Supernode& source, int i1);
  bool FactorDiagonal(const Supernode& s);
  void Permute(const Columns& x, Columns* y) const;
  void PermuteBack(const Columns& y, Columns* x) const;
  Columns Gather(const Columns& y, const Supernode& s) const;
  void SubtractScattered(const Columns& z, const Supernode& s, Columns* y);

  CholmodAnalysis analysis;
  Supernodes supernodes;
  // Eigen's, for their alignment: products round by it.
  VectorXd lower_values, upper_values;
  std::vector<int> transposition;  // row exchanges, per permuted column
  std::vector<int> position;       // of a row in the current supernode
  MatrixXd product;                // workspace of Update
};

SparseLu::Impl::Impl(std::shared_ptr<const BlockPattern> pattern)
    : analysis(std::move(pattern)),
      supernodes(analysis),
      lower_values(supernodes.num_values()),
      upper_values(supernodes.num_values()),
      transposition(supernodes.num_columns()),
      position(supernodes.num_columns(), -1) {}

// Scatters every scalar a(i, j) into the panel that owns it: the lower panel
// of column j if the row is not above j's supernode, else the upper panel of
// the row.
void SparseLu::Impl::Assemble(const BlockMatrix& a) {
  lower_values.setZero();
  upper_values.setZero();
  const BlockPattern& p = a.pattern();
  for (const Supernode& s : supernodes.nodes()) {
    for (int r = 0; r < s.height; ++r) position[s.rows[r]] = r;
    for (int c = 0; c < s.width; ++c) {
      const int column = supernodes.permutation(s.first + c);
      const int j = column / 3, jc = column % 3;
      double* low =
          lower_values.data() + s.offset + static_cast<size_t>(c) * s.height;
      double* up =
          upper_values.data() + s.offset + static_cast<size_t>(c) * s.height;
      for (int k = p.row_start[j]; k < p.row_start[j + 1]; ++k) {
        const int i = p.column[k];
        // Row `column` of A: block (j, i). Column: block (i, j), found by the
        // symmetry of the pattern.
        const auto row_block = a.block(k);
        int transposed = -1;
        for (int r = 0; r < 3; ++r) {
          const int row = supernodes.inverse(3 * i + r);
          if (row < s.first) continue;
          if (transposed < 0) transposed = p.Find(i, j);
          low[position[row]] = a.block(transposed)(r, jc);
          up[position[row]] = row_block(jc, r);
        }
      }
    }
  }
}

// Subtracts from `target` what the eliminated columns of `source`, whose rows
// from i1 on begin within target, contribute.
void SparseLu::Impl::Update(const Supernode& target,
                            const Supernode& source,
                            int i1) {
  const int m = source.height - i1;
  const int width = source.RowsBefore(i1, target.end()) - i1;
  const Panel l = lower(source);
  const Panel u = upper(source);
  product.resize(m, 2 * width);
  product.leftCols(width).noalias() =
      l.bottomRows(m) * u.middleRows(i1, width).transpose();
  product.rightCols(width).noalias() =
      u.bottomRows(m) * l.middleRows(i1, width).transpose();
  Panel tl = lower(target);
  Panel tu = upper(target);
  for (int c = 0; c < width; ++c) {
    const int column = source.rows[i1 + c] - target.first;
    double* low = tl.col(column).data();
    double* up = tu.col(column).data();
    for (int r = 0; r < m; ++r) {
      const int row = position[source.rows[i1 + r]];
      low[row] -= product(r, c);
      up[row] -= product(r, width + c);
    }
  }
}

bool SparseLu::Impl::FactorDiagonal(const Supernode& s) {
  Panel l = lower(s);
  Panel u = upper(s);
  const int below = s.below();
  Eigen::Ref<MatrixXd> diagonal = l.topRows(s.width);
  Eigen::PartialPivLU<Eigen::Ref<MatrixXd>> lu(diagonal);
  // The exchanges as a permutation, kept per row for the solves.
  const auto& indices = lu.permutationP().indices();
  for (int c = 0; c < s.width; ++c) transposition[s.first + c] = indices[c];
  for (int c = 0; c < s.width; ++c)
    if (!std::isfinite(diagonal(c, c)) || diagonal(c, c) == 0) return false;
  if (below == 0) return true;
  // L21 U11 = A21;  (P A12)^T = U12^T L11^T.
  auto l21 = l.bottomRows(below);
  diagonal.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(l21);
  MatrixXd u12(below, s.width);
  for (int c = 0; c < s.width; ++c) u12.col(indices[c]) = u.col(c).tail(below);
  diagonal.triangularView<Eigen::UnitLower>()
      .transpose()
      .solveInPlace<Eigen::OnTheRight>(u12);
  u.bottomRows(below) = u12;
  return true;
}

SparseLu::SparseLu(std::shared_ptr<const BlockPattern> pattern)
    : impl_(std::make_unique<Impl>(std::move(pattern))) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::Factor(const BlockMatrix& a) {
  Impl& s = *impl_;
  s.Assemble(a);
  return s.supernodes.ForEach(
      [&](const Supernode& target) {
        for (int r = 0; r < target.height; ++r) s.position[target.rows[r]] = r;
      },
      [&](const Supernode& target, const Supernode& source, int i1) {
        s.Update(target, source, i1);
      },
      [&](const Supernode& target) { return s.FactorDiagonal(target); });
}

void SparseLu::Impl::Permute(const Columns& x, Columns* y) const {
  y->resize(x.rows(), x.cols());
  for (Eigen::Index j = 0; j < x.rows(); ++j)
    y->row(j) = x.row(supernodes.permutation(j));
}

void SparseLu::Impl::PermuteBack(const Columns& y, Columns* x) const {
  for (Eigen::Index j = 0; j < y.rows(); ++j)
    x->row(supernodes.permutation(j)) = y.row(j);
}

Columns SparseLu::Impl::Gather(const Columns& y, const Supernode& s) const {
  Columns z(s.below(), y.cols());
  for (int r = s.width; r < s.height; ++r)
    z.row(r - s.width) = y.row(s.rows[r]);
  return z;
}

void SparseLu::Impl::SubtractScattered(const Columns& z,
                                       const Supernode& s,
                                       Columns* y) {
  for (int r = s.width; r < s.height; ++r)
    y->row(s.rows[r]) -= z.row(r - s.width);
}

void SparseLu::Solve(Columns* x) const {
  Impl& s = *impl_;
  const auto& nodes = s.supernodes.nodes();
  Columns y, z;
  s.Permute(*x, &y);
  for (const Supernode& node : nodes) {
    auto own = y.middleRows(node.first, node.width);
    const Columns before = own;
    for (int c = 0; c < node.width; ++c)
      own.row(s.transposition[node.first + c]) = before.row(c);
    const Panel l = s.lower(node);
    l.topRows(node.width).triangularView<Eigen::UnitLower>().solveInPlace(own);
    if (node.below() > 0) {
      z.noalias() = l.bottomRows(node.below()) * own;
      s.SubtractScattered(z, node, &y);
    }
  }
  for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) {
    auto own = y.middleRows(it->first, it->width);
    if (it->below() > 0)
      own.noalias() -=
          s.upper(*it).bottomRows(it->below()).transpose() * s.Gather(y, *it);
    s.lower(*it).topRows(it->width).triangularView<Eigen::Upper>().solveInPlace(
        own);
  }
  s.PermuteBack(y, x);
}

void SparseLu::SolveTransposed(Columns* x) const {
  Impl& s = *impl_;
  const auto& nodes = s.supernodes.nodes();
  Columns y, z;
  s.Permute(*x, &y);
  for (const Supernode& node : nodes) {
    auto own = y.middleRows(node.first, node.width);
    s.lower(node)
        .topRows(node.width)
        .transpose()
        .triangularView<Eigen::Lower>()
        .solveInPlace(own);
    if (node.below() > 0) {
      z.noalias() = s.upper(node).bottomRows(node.below()) * own;
      s.SubtractScattered(z, node, &y);
    }
  }
  for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) {
    auto own = y.middleRows(it->first, it->width);
    const Panel l = s.lower(*it);
    if (it->below() > 0)
      own.noalias() -= l.bottomRows(it->below()).transpose() * s.Gather(y, *it);
    l.topRows(it->width)
        .transpose()
        .triangularView<Eigen::UnitUpper>()
        .solveInPlace(own);
    const Columns before = own;
    for (int c = 0; c < it->width; ++c)
      own.row(c) = before.row(s.transposition[it->first + c]);
  }
  s.PermuteBack(y, x);
}

}  // namespace invsim
