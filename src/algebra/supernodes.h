// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_ALGEBRA_SUPERNODES_H_
#define INVSIM_SRC_ALGEBRA_SUPERNODES_H_

// The supernodes of a CHOLMOD analysis, and the order of a left-looking
// factorisation over them, which the factorisations of our own share.
//
// Supernode s owns the columns [first, first + width) of the permuted matrix
// and the rows listed in `rows`, of which the first `width` are its own. Its
// panel of values is height x width, by columns, at `offset`.

#include <cstddef>
#include <utility>
#include <vector>

#include "cholmod_analysis.h"

namespace invsim {

struct Supernode {
  int first;
  int width;
  int height;
  const int* rows;
  size_t offset;

  int below() const { return height - width; }
  int end() const { return first + width; }
  // The first of the rows from `begin` on that is not before column `column`.
  int RowsBefore(int begin, int column) const {
    while (begin < height && rows[begin] < column) ++begin;
    return begin;
  }
};

class Supernodes {
 public:
  explicit Supernodes(const CholmodAnalysis& analysis) {
    const cholmod_factor* f = analysis.factor();
    const int* super = static_cast<const int*>(f->super);
    const int* row_start = static_cast<const int*>(f->pi);
    const int* rows = static_cast<const int*>(f->s);
    permutation_ = static_cast<const int*>(f->Perm);
    owner_.resize(f->n);
    for (size_t s = 0; s < f->nsuper; ++s) {
      nodes_.push_back({super[s],
                        super[s + 1] - super[s],
                        row_start[s + 1] - row_start[s],
                        rows + row_start[s],
                        num_values_});
      num_values_ +=
          static_cast<size_t>(nodes_.back().width) * nodes_.back().height;
      for (int j = super[s]; j < super[s + 1]; ++j)
        owner_[j] = static_cast<int>(s);
    }
    inverse_.resize(f->n);
    for (size_t j = 0; j < f->n; ++j)
      inverse_[permutation_[j]] = static_cast<int>(j);
  }

  const std::vector<Supernode>& nodes() const { return nodes_; }
  size_t num_values() const { return num_values_; }  // of all panels
  int num_columns() const { return static_cast<int>(owner_.size()); }
  int owner(int column) const { return owner_[column]; }
  // Column j of the permuted matrix is column permutation(j) of the original.
  int permutation(int j) const { return permutation_[j]; }
  int inverse(int column) const { return inverse_[column]; }

  // Calls, target after target, begin(target), update(target, source, i1) for
  // every earlier source whose rows from i1 on begin in target, and
  // finish(target), which ends it all by returning false.
  template <typename Begin, typename Update, typename Finish>
  bool ForEach(const Begin& begin,
               const Update& update,
               const Finish& finish) const {
    std::vector<std::vector<std::pair<int, int>>> pending(nodes_.size());
    const auto wait = [&](int source, int i1) {
      const Supernode& s = nodes_[source];
      if (i1 < s.height) pending[owner_[s.rows[i1]]].emplace_back(source, i1);
    };
    for (int t = 0; t < static_cast<int>(nodes_.size()); ++t) {
      const Supernode& target = nodes_[t];
      begin(target);
      for (const auto& [source, i1] : pending[t]) {
        update(target, nodes_[source], i1);
        wait(source, nodes_[source].RowsBefore(i1, target.end()));
      }
      pending[t].clear();
      if (!finish(target)) return false;
      wait(t, target.width);
    }
    return true;
  }

 private:
  std::vector<Supernode> nodes_;
  std::vector<int> owner_;
  const int* permutation_ = nullptr;
  std::vector<int> inverse_;
  size_t num_values_ = 0;
};

}  // namespace invsim

#endif  // INVSIM_SRC_ALGEBRA_SUPERNODES_H_
