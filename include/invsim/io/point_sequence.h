// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_POINT_SEQUENCE_H_
#define INVSIM_IO_POINT_SEQUENCE_H_

// A sequence of point clouds: a directory with one file per frame, numbered by
// the last digits of the name, such as 000000.ply, 000001.ply or scan_7.pcd,
// scan_8.pcd.

#include <cstdint>
#include <string>
#include <vector>

namespace invsim {

struct PointSequence {
  std::string directory;
  std::vector<std::string> files;  // paths, one per frame, in order
  std::int64_t first = 0;          // the number in the first file's name
  std::int64_t step = 1;           // from one number to the next
};

// Looks at names and sizes only; what is in the files shows when they are
// read. Hidden files and files that are no point clouds are passed over.
// Numbers may start anywhere and may all be `step` apart (every fifth frame of
// a recording). Throws InputError naming the directory and the file: not a
// directory, no point cloud, two extensions, two namings, a name without
// number, a number twice, a missing frame (which one, between which), an empty
// file.
PointSequence ScanPointSequence(const std::string& directory);

}  // namespace invsim

#endif  // INVSIM_IO_POINT_SEQUENCE_H_
