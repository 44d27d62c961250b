// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_PCD_H_
#define INVSIM_IO_PCD_H_

// The Point Cloud Library's PCD files: `DATA ascii`, `binary` and
// `binary_compressed`, fields x, y and z of any number type, every other field
// passed over. The sensor's VIEWPOINT is not applied, as in PCL.
//
// Read by ourselves and not by PCL, whose reader takes a header's sizes on
// trust, reads beyond the end of a short file, and turns an unreadable number
// into 0 and a double x into nothing.

#include <string>
#include <string_view>

#include "invsim/base/types.h"

namespace invsim {

// The points as they are, non-finite ones (PCL's mark for "no return")
// included. Throws InputError naming file, line and value: a field without
// size or type, counts that do not agree, fewer bytes than promised (expected
// and actual), a damaged compressed block.
Points ParsePcd(std::string_view bytes, const std::string& name);

}  // namespace invsim

#endif  // INVSIM_IO_PCD_H_
