// SPDX-License-Identifier: Apache-2.0
#include "invsim/algebra/cholesky_preconditioner.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "cholmod_analysis.h"
#include "supernodes.h"

namespace invsim {
namespace {

using Eigen::MatrixXf;
using Eigen::VectorXf;
using FloatPanel = Eigen::Map<MatrixXf>;

}  // namespace

struct CholeskyPreconditioner::Impl {
  explicit Impl(std::shared_ptr<const BlockPattern> pattern);
  FloatPanel panel(const Supernode& s) {
    return FloatPanel(values.data() + s.offset, s.height, s.width);
  }
  bool Load(const BlockMatrix& a);
  void Update(const Supernode& target, const Supernode& source, int i1);
  bool Finish(const Supernode& s);

  CholmodAnalysis analysis;
  Supernodes supernodes;
  // Eigen's, for their alignment: products round by it.
  VectorXf values;
  // Value k of the lower triangle goes to values[slot[k]].
  std::vector<size_t> slot;
  std::vector<int> position;  // of a row in the current supernode
  MatrixXf product;           // workspace of Update
  VectorXf y, z;              // of Solve
};

CholeskyPreconditioner::Impl::Impl(std::shared_ptr<const BlockPattern> pattern)
    : analysis(std::move(pattern)),
      supernodes(analysis),
      values(supernodes.num_values()),
      position(supernodes.num_columns()),
      y(supernodes.num_columns()),
      z(supernodes.num_columns()) {
  const cholmod_sparse* lower = analysis.lower();
  const int* start = static_cast<const int*>(lower->p);
  const int* row = static_cast<const int*>(lower->i);
  slot.resize(start[supernodes.num_columns()]);
  for (int column = 0; column < supernodes.num_columns(); ++column) {
    for (int k = start[column]; k < start[column + 1]; ++k) {
      const int a = supernodes.inverse(column);
      const int b = supernodes.inverse(row[k]);
      const int j = std::min(a, b), i = std::max(a, b);
      const Supernode& s = supernodes.nodes()[supernodes.owner(j)];
      const int* found = std::lower_bound(s.rows, s.rows + s.height, i);
      slot[k] = s.offset + static_cast<size_t>(j - s.first) * s.height +
                (found - s.rows);
    }
  }
}

bool CholeskyPreconditioner::Impl::Load(const BlockMatrix& a) {
  if (!analysis.Load(a)) return false;
  const double* from = static_cast<const double*>(analysis.lower()->x);
  values.setZero();
  for (size_t k = 0; k < slot.size(); ++k)
    values[slot[k]] = static_cast<float>(from[k]);
  return true;
}

// Subtracts from `target` what the eliminated columns of `source`, whose rows
// from i1 on begin within target, contribute.
void CholeskyPreconditioner::Impl::Update(const Supernode& target,
                                          const Supernode& source,
                                          int i1) {
  const int m = source.height - i1;
  const int width = source.RowsBefore(i1, target.end()) - i1;
  const FloatPanel l = panel(source);
  product.resize(m, width);
  product.noalias() = l.bottomRows(m) * l.middleRows(i1, width).transpose();
  for (int c = 0; c < width; ++c) {
    float* to =
        values.data() + target.offset +
        static_cast<size_t>(source.rows[i1 + c] - target.first) * target.height;
    const float* from = product.col(c).data();
    for (int r = c; r < m; ++r) to[position[source.rows[i1 + r]]] -= from[r];
  }
}

bool CholeskyPreconditioner::Impl::Finish(const Supernode& s) {
  FloatPanel l = panel(s);
  Eigen::Ref<MatrixXf> diagonal = l.topRows(s.width);
  const Eigen::LLT<Eigen::Ref<MatrixXf>> llt(diagonal);
  if (llt.info() != Eigen::Success) return false;
  if (s.below() > 0) {
    auto rest = l.bottomRows(s.below());
    diagonal.triangularView<Eigen::Lower>()
        .transpose()
        .solveInPlace<Eigen::OnTheRight>(rest);
  }
  return true;
}

CholeskyPreconditioner::CholeskyPreconditioner(
    std::shared_ptr<const BlockPattern> pattern)
    : impl_(std::make_unique<Impl>(std::move(pattern))) {}
CholeskyPreconditioner::~CholeskyPreconditioner() = default;
CholeskyPreconditioner::CholeskyPreconditioner(
    CholeskyPreconditioner&&) noexcept = default;
CholeskyPreconditioner& CholeskyPreconditioner::operator=(
    CholeskyPreconditioner&&) noexcept = default;

bool CholeskyPreconditioner::Factor(const BlockMatrix& a) {
  Impl& s = *impl_;
  if (!s.Load(a)) return false;
  return s.supernodes.ForEach(
      [&](const Supernode& target) {
        for (int r = 0; r < target.height; ++r) s.position[target.rows[r]] = r;
      },
      [&](const Supernode& target, const Supernode& source, int i1) {
        s.Update(target, source, i1);
      },
      [&](const Supernode& target) { return s.Finish(target); });
}

void CholeskyPreconditioner::Solve(VectorXd* x) const {
  Impl& s = *impl_;
  const int n = s.supernodes.num_columns();
  for (int j = 0; j < n; ++j)
    s.y[j] = static_cast<float>((*x)[s.supernodes.permutation(j)]);
  const auto& nodes = s.supernodes.nodes();
  for (const Supernode& node : nodes) {
    const FloatPanel l = s.panel(node);
    auto own = s.y.segment(node.first, node.width);
    l.topRows(node.width).triangularView<Eigen::Lower>().solveInPlace(own);
    if (node.below() == 0) continue;
    auto rest = s.z.head(node.below());
    rest.noalias() = l.bottomRows(node.below()) * own;
    const int* rows = node.rows + node.width;
    for (int r = 0; r < node.below(); ++r) s.y[rows[r]] -= rest[r];
  }
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    const FloatPanel l = s.panel(*node);
    auto own = s.y.segment(node->first, node->width);
    if (node->below() > 0) {
      auto rest = s.z.head(node->below());
      const int* rows = node->rows + node->width;
      for (int r = 0; r < node->below(); ++r) rest[r] = s.y[rows[r]];
      own.noalias() -= l.bottomRows(node->below()).transpose() * rest;
    }
    l.topRows(node->width)
        .triangularView<Eigen::Lower>()
        .transpose()
        .solveInPlace(own);
  }
  for (int j = 0; j < n; ++j) (*x)[s.supernodes.permutation(j)] = s.y[j];
}

}  // namespace invsim
