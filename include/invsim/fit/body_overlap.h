// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_BODY_OVERLAP_H_
#define INVSIM_FIT_BODY_OVERLAP_H_

// How deep parts of a body are in each other: a forearm in the chest, a shin
// in the other. A bone is a capsule, the segment between two joints and a
// radius; two of them overlap by
//
//   d = r_a + r_b - |p_a - p_b|,
//
// p_a and p_b the nearest points of the segments. Only pairs count that are
// clear of each other in the T-pose; neighbours along the skeleton, and an
// upper arm beside the chest, touch always.

#include <memory>
#include <vector>

#include "invsim/body/body_model.h"

namespace invsim {

class BodyOverlap {
 public:
  // A bone goes from a joint's parent to the joint. Its radius is the median
  // distance to it of the vertices that hang on the parent and are nearest to
  // this bone, in the T-pose of shape zero; bones without any are left out.
  explicit BodyOverlap(const BodyModel& body);

  struct Bone {
    int from, to;  // joints
    double radius;
  };
  struct Pair {
    int a, b;  // bones
  };
  const std::vector<Bone>& bones() const { return bones_; }
  const std::vector<Pair>& pairs() const { return pairs_; }

  // Depth of every pair, 0 where there is none, m; and its derivative by the
  // 72 joint coordinates (rows of pairs), unless null.
  VectorXd Depths(const Points& joints, VertexRows* by_joints) const;

 private:
  std::vector<Bone> bones_;
  std::vector<Pair> pairs_;
};

// The nearest points of segments a0 a1 and b0 b1 as shares of their lengths.
struct SegmentShares {
  double a, b;
};
SegmentShares NearestOfSegments(const Vector3d& a0,
                                const Vector3d& a1,
                                const Vector3d& b0,
                                const Vector3d& b1);

}  // namespace invsim

#endif  // INVSIM_FIT_BODY_OVERLAP_H_
