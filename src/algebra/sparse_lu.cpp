// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/sparse_lu.h"

#include <Eigen/LU>
#include <cmath>
#include <utility>
#include <vector>

#include "cholmod_analysis.h"

namespace invsim {
namespace {

using Panel = Eigen::Map<MatrixXd>;

}  // namespace

// Supernode s owns the columns [first(s), first(s+1)) of the permuted matrix
// and the rows listed in `rows`, of which the first `width` are its own. Its
// two panels are rows x width: `lower` holds L (with the dense LU of the
// diagonal block on top) and `upper` the transpose of U's block row.
struct SparseLu::Impl {
  struct Supernode {
    int first;
    int width;
    int height;
    const int* rows;
    size_t offset;  // of both panels
  };

  explicit Impl(std::shared_ptr<const BlockPattern> pattern);
  Panel lower(const Supernode& s) {
    return Panel(lower_values.data() + s.offset, s.height, s.width);
  }
  Panel upper(const Supernode& s) {
    return Panel(upper_values.data() + s.offset, s.height, s.width);
  }
  void Assemble(const BlockMatrix& a);
  void Update(const Supernode& target, const Supernode& source, int i1);
  bool FactorDiagonal(int index);
  void Permute(const Columns& x, Columns* y) const;
  void PermuteBack(const Columns& y, Columns* x) const;
  Columns Gather(const Columns& y, const Supernode& s) const;
  void SubtractScattered(const Columns& z, const Supernode& s, Columns* y);

  CholmodAnalysis analysis;
  std::vector<Supernode> supernodes;
  std::vector<int> supernode_of;  // per permuted column
  const int* permutation;         // permuted -> original
  std::vector<int> inverse;       // original -> permuted
  std::vector<double> lower_values, upper_values;
  std::vector<int> transposition;  // row exchanges, per permuted column
  std::vector<int> position;       // of a row in the current supernode
  MatrixXd product;                // workspace of Update
};

SparseLu::Impl::Impl(std::shared_ptr<const BlockPattern> pattern)
    : analysis(std::move(pattern)) {
  const cholmod_factor* f = analysis.factor();
  const int* super = static_cast<const int*>(f->super);
  const int* row_start = static_cast<const int*>(f->pi);
  const int* rows = static_cast<const int*>(f->s);
  permutation = static_cast<const int*>(f->Perm);
  const int n = static_cast<int>(f->n);
  supernode_of.resize(n);
  size_t offset = 0;
  for (size_t s = 0; s < f->nsuper; ++s) {
    Supernode node{super[s],
                   super[s + 1] - super[s],
                   row_start[s + 1] - row_start[s],
                   rows + row_start[s],
                   offset};
    offset += static_cast<size_t>(node.width) * node.height;
    for (int j = super[s]; j < super[s + 1]; ++j)
      supernode_of[j] = static_cast<int>(s);
    supernodes.push_back(node);
  }
  lower_values.resize(offset);
  upper_values.resize(offset);
  transposition.resize(n);
  position.assign(n, -1);
  inverse.resize(n);
  for (int j = 0; j < n; ++j) inverse[permutation[j]] = j;
}

// Scatters every scalar a(i, j) into the panel that owns it: the lower panel
// of column j if the row is not above j's supernode, else the upper panel of
// the row.
void SparseLu::Impl::Assemble(const BlockMatrix& a) {
  std::fill(lower_values.begin(), lower_values.end(), 0.0);
  std::fill(upper_values.begin(), upper_values.end(), 0.0);
  const BlockPattern& p = a.pattern();
  for (const Supernode& s : supernodes) {
    for (int r = 0; r < s.height; ++r) position[s.rows[r]] = r;
    for (int c = 0; c < s.width; ++c) {
      const int column = permutation[s.first + c];
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
          const int row = inverse[3 * i + r];
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
  int i2 = i1;
  const int end = target.first + target.width;
  while (i2 < source.height && source.rows[i2] < end) ++i2;
  const int m = source.height - i1;
  const int width = i2 - i1;
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

bool SparseLu::Impl::FactorDiagonal(int index) {
  const Supernode& s = supernodes[index];
  Panel l = lower(s);
  Panel u = upper(s);
  const int below = s.height - s.width;
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
  const int count = static_cast<int>(s.supernodes.size());
  // pending[t]: supernodes whose next row to update lies in t.
  std::vector<std::vector<std::pair<int, int>>> pending(count);
  for (int t = 0; t < count; ++t) {
    const Impl::Supernode& target = s.supernodes[t];
    for (int r = 0; r < target.height; ++r) s.position[target.rows[r]] = r;
    for (const auto& [d, i1] : pending[t]) {
      const Impl::Supernode& source = s.supernodes[d];
      s.Update(target, source, i1);
      int next = i1;
      while (next < source.height &&
             source.rows[next] < target.first + target.width)
        ++next;
      if (next < source.height)
        pending[s.supernode_of[source.rows[next]]].emplace_back(d, next);
    }
    pending[t].clear();
    if (!s.FactorDiagonal(t)) return false;
    if (target.width < target.height)
      pending[s.supernode_of[target.rows[target.width]]].emplace_back(
          t, target.width);
  }
  return true;
}

void SparseLu::Impl::Permute(const Columns& x, Columns* y) const {
  y->resize(x.rows(), x.cols());
  for (Eigen::Index j = 0; j < x.rows(); ++j) y->row(j) = x.row(permutation[j]);
}

void SparseLu::Impl::PermuteBack(const Columns& y, Columns* x) const {
  for (Eigen::Index j = 0; j < y.rows(); ++j) x->row(permutation[j]) = y.row(j);
}

Columns SparseLu::Impl::Gather(const Columns& y, const Supernode& s) const {
  Columns z(s.height - s.width, y.cols());
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
  Columns y, z;
  s.Permute(*x, &y);
  for (const Impl::Supernode& node : s.supernodes) {
    auto own = y.middleRows(node.first, node.width);
    const Columns before = own;
    for (int c = 0; c < node.width; ++c)
      own.row(s.transposition[node.first + c]) = before.row(c);
    const Panel l = s.lower(node);
    l.topRows(node.width).triangularView<Eigen::UnitLower>().solveInPlace(own);
    if (node.height > node.width) {
      z.noalias() = l.bottomRows(node.height - node.width) * own;
      s.SubtractScattered(z, node, &y);
    }
  }
  for (auto it = s.supernodes.rbegin(); it != s.supernodes.rend(); ++it) {
    auto own = y.middleRows(it->first, it->width);
    if (it->height > it->width)
      own.noalias() -=
          s.upper(*it).bottomRows(it->height - it->width).transpose() *
          s.Gather(y, *it);
    s.lower(*it).topRows(it->width).triangularView<Eigen::Upper>().solveInPlace(
        own);
  }
  s.PermuteBack(y, x);
}

void SparseLu::SolveTransposed(Columns* x) const {
  Impl& s = *impl_;
  Columns y, z;
  s.Permute(*x, &y);
  for (const Impl::Supernode& node : s.supernodes) {
    auto own = y.middleRows(node.first, node.width);
    s.lower(node)
        .topRows(node.width)
        .transpose()
        .triangularView<Eigen::Lower>()
        .solveInPlace(own);
    if (node.height > node.width) {
      z.noalias() = s.upper(node).bottomRows(node.height - node.width) * own;
      s.SubtractScattered(z, node, &y);
    }
  }
  for (auto it = s.supernodes.rbegin(); it != s.supernodes.rend(); ++it) {
    auto own = y.middleRows(it->first, it->width);
    const Panel l = s.lower(*it);
    if (it->height > it->width)
      own.noalias() -=
          l.bottomRows(it->height - it->width).transpose() * s.Gather(y, *it);
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
