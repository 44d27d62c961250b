// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_KD_TREE_H_
#define INVSIM_GEOMETRY_KD_TREE_H_

// Nearest neighbours in a fixed set of points, in double precision (nanoflann
// behind it). Queries may run concurrently.

#include <memory>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

struct Neighbour {
  int index = -1;                 // column of the points
  double squared_distance = 0.0;  // m^2
};

class KdTree {
 public:
  // Keeps its own copy of the points. Throws InputError if there are none or
  // one is not finite.
  explicit KdTree(const Points& points);
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  const Points& points() const;
  int size() const { return static_cast<int>(points().cols()); }

  Neighbour Nearest(const Vector3d& query) const;
  // The min(k, size()) nearest, nearest first.
  std::vector<Neighbour> NearestK(const Vector3d& query, int k) const;
  // One result per column, threaded.
  std::vector<Neighbour> NearestAll(const Points& queries) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_KD_TREE_H_
