// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_PC2_H_
#define INVSIM_IO_PC2_H_

// Point caches (.pc2): the vertices of one mesh over time, as Blender's Mesh
// Cache modifier and 3ds Max read them beside an OBJ of the same vertex order.
// Little-endian:
//
//   char[12] "POINTCACHE2\0"    int32 version = 1    int32 number of points
//   float32 start frame         float32 frames per sample
//   int32 number of samples     then float32 x y z of every point, sample by
//                               sample
//
// Coordinates are written as they are, in metres with y up: in Blender's
// modifier choose forward +Z and up +Y.

#include <string>
#include <string_view>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

struct PointCache {
  std::vector<Points> samples;  // all of the same number of points
  double start_frame = 0;
  double frames_per_sample = 1;
};

// Throws InputError naming the file: not a point cache, another version,
// fewer or more bytes than the header promises (expected and actual), numbers
// that are not finite.
PointCache ParsePc2(std::string_view bytes, const std::string& name);
PointCache ReadPc2(const std::string& path);

// Throws Error (internal) if the samples differ in their number of points,
// InputError if the file cannot be written.
std::string FormatPc2(const PointCache& cache);
void WritePc2(const std::string& path, const PointCache& cache);

}  // namespace invsim

#endif  // INVSIM_IO_PC2_H_
