// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_POINT_CLOUD_H_
#define INVSIM_IO_POINT_CLOUD_H_

// Point clouds from whatever file they come in, told by the extension:
//
//   ply        vertices (ply.h); faces and further properties are passed over
//   pcd        the Point Cloud Library's (pcd.h)
//   obj        the `v` lines (obj.h)
//   xyz, txt   three or more numbers a line, parted by blanks; '#' comments
//   npy        an array (N, 3)
//
// The numbers are in the file's own unit and axes; input_frame.h converts.

#include <string>
#include <string_view>
#include <vector>

#include "invsim/base/options.h"
#include "invsim/base/types.h"

namespace invsim {

// The extensions above, in that order.
const std::vector<std::string>& PointExtensions();

struct PointReadOptions {
  // Drop points that are not finite (a scanner's mark for "no return") instead
  // of refusing the file.
  bool drop_non_finite = false;
};

void Describe(OptionTable* table, PointReadOptions* options);

// At least one point, all finite. Throws InputError naming the file: unknown
// extension, no (finite) point, non-finite points with their number and the
// first of them, and all that the format's own reader refuses. `num_dropped`,
// unless null, gets the number of points dropped.
Points ParsePoints(std::string_view bytes,
                   const std::string& extension,
                   const std::string& name,
                   const PointReadOptions& options = {},
                   int* num_dropped = nullptr);
Points ReadPoints(const std::string& path,
                  const PointReadOptions& options = {},
                  int* num_dropped = nullptr);

}  // namespace invsim

#endif  // INVSIM_IO_POINT_CLOUD_H_
