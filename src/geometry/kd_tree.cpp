// SPDX-License-Identifier: Apache-2.0
#include "invsim/geometry/kd_tree.h"

#include <algorithm>
#include <nanoflann.hpp>
#include <string>

#include "invsim/base/error.h"
#include "invsim/base/threads.h"

namespace invsim {
namespace {

// What nanoflann wants to know about the points.
struct PointSource {
  const Points& points;
  size_t kdtree_get_point_count() const { return points.cols(); }
  double kdtree_get_pt(int i, size_t c) const { return points(c, i); }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, PointSource, double, int>,
    PointSource,
    3,
    int>;

const Points& Checked(const Points& points) {
  if (points.cols() == 0)
    throw InputError("no points to search, expected one at least");
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (!points.col(i).allFinite())
      throw InputError("point " + std::to_string(i) +
                       " is not finite, expected numbers");
  return points;
}

}  // namespace

struct KdTree::Impl {
  explicit Impl(const Points& p) : points(Checked(p)), source{points} {}
  Points points;
  PointSource source;
  Tree tree{3, source, nanoflann::KDTreeSingleIndexAdaptorParams(10)};
};

KdTree::KdTree(const Points& points) : impl_(std::make_unique<Impl>(points)) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

const Points& KdTree::points() const { return impl_->points; }

Neighbour KdTree::Nearest(const Vector3d& query) const {
  Neighbour r;
  impl_->tree.knnSearch(query.data(), 1, &r.index, &r.squared_distance);
  return r;
}

std::vector<Neighbour> KdTree::NearestK(const Vector3d& query, int k) const {
  k = std::min(k, size());
  std::vector<int> index(k);
  std::vector<double> squared(k);
  impl_->tree.knnSearch(query.data(), k, index.data(), squared.data());
  std::vector<Neighbour> r(k);
  for (int i = 0; i < k; ++i) r[i] = {index[i], squared[i]};
  return r;
}

std::vector<Neighbour> KdTree::NearestAll(const Points& queries) const {
  std::vector<Neighbour> r(queries.cols());
  ParallelFor(static_cast<int>(queries.cols()), 256, [&](int i) {
    r[i] = Nearest(queries.col(i));
  });
  return r;
}

}  // namespace invsim
