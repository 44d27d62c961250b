// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_POINT_FILTERS_H_
#define INVSIM_IO_POINT_FILTERS_H_

// Thinning and cleaning of measured points, by PCL. PCL computes in single
// precision; points are handed over relative to their centroid, so that what
// is lost is 1e-7 of the cloud's size and not of its distance from the origin.

#include "invsim/base/options.h"
#include "invsim/base/types.h"

namespace invsim {

struct PointFilterOptions {
  // Side of a cube, in metres, whose points are replaced by their mean; 0: off.
  double voxel = 0;
  // Points whose mean distance d to their `outlier_neighbours` nearest is
  // above mean(d) + outlier_deviations std(d) are dropped; 0: off.
  int outlier_neighbours = 0;
  double outlier_deviations = 2;
};

void Describe(OptionTable* table, PointFilterOptions* options);

// Outliers first, then voxels. The points must be finite and in metres. Throws
// UsageError if the voxel is so small that the cloud spans more than 2^31 of
// them.
Points FilterPoints(const PointFilterOptions& options, const Points& points);

// The points but for strays: those further outside the box of the middle 98 %
// (along each axis) than that box is long. A person's own are never, a single
// reflection metres away is; so the extent of the rest is the person's.
Points WithoutStrays(const Points& points);

}  // namespace invsim

#endif  // INVSIM_IO_POINT_FILTERS_H_
