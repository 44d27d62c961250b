// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_GEOMETRY_ELEMENT_PAIR_H_
#define INVSIM_GEOMETRY_ELEMENT_PAIR_H_

// The two kinds of pairs through which triangle meshes first touch: a vertex
// and a face, or two edges. Their distance, and when moving ones come near.

#include <array>

#include "invsim/base/types.h"

namespace invsim {

enum class PairKind { kVertexFace, kEdgeEdge };

// Vertex numbers: (p, a, b, c) of vertex p and face abc, or (p, q, a, b) of
// edges pq and ab.
struct ElementPair {
  PairKind kind;
  std::array<int, 4> vertex;
  auto operator<=>(const ElementPair&) const = default;
};

// Where the four vertices are; columns in the order of ElementPair.
using PairPoints = Eigen::Matrix<double, 3, 4>;

PairPoints Corners(const Points& x, const ElementPair& pair);

// The nearest points of the two elements as weighted sums of their vertices:
// offset = x * weights leads from the second to the first. Weights of the
// first element are positive, those of the second negative, off the nearest
// points' own vertices exactly zero.
struct NearestPoints {
  Eigen::Vector4d weights;
  Vector3d offset;
  double distance;
};
NearestPoints Nearest(PairKind kind, const PairPoints& x);

// The first time in [0, 1] at which the distance of elements that move on
// straight lines from x0 to x1 may have come down to `gap` > 0 (but for
// one part in ten thousand), or 2 if that never happens. Conservative
// advancement: with all moves taken about their mean, nothing comes nearer by
// more than the longest move on either side, so time may go on by the distance
// over their sum (Li, Kaufman & Jiang, Codimensional Incremental Potential
// Contact, 2021, sec. 5). Never late; early if the elements slide past each
// other at a distance near `gap`.
inline constexpr double kNever = 2;
double FirstTimeWithin(double gap,
                       PairKind kind,
                       const PairPoints& x0,
                       const PairPoints& x1);

}  // namespace invsim

#endif  // INVSIM_GEOMETRY_ELEMENT_PAIR_H_
