// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_GLB_H_
#define INVSIM_IO_GLB_H_

// Animated meshes as one binary glTF 2.0 file (.glb), which browsers, Blender
// and most viewers open: the result of a run to look at, not to measure.
//
// glTF has no per-frame vertices. A mesh here is its first pose and a morph
// target (a displacement of every vertex) for each further pose; the animation
// brings the targets in one after the other, linearly between two of them.
// Every target costs 12 bytes a vertex, so of a long sequence at most
// `most_poses` evenly spaced frames are kept: these are exact (in single
// precision), those between are interpolated. No normals are written, because
// normals would have to be morphed too; viewers then shade flat, Blender
// computes its own.

#include <string>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

// One mesh over time. One frame: a mesh at rest.
struct GlbMesh {
  std::string name;
  Faces faces;
  std::vector<Points> frames;        // metres, y up, as glTF has it
  Vector3d color = {0.6, 0.6, 0.6};  // linear red, green, blue in [0, 1]
};

struct GlbOptions {
  double frames_per_second = 30;
  int most_poses = 60;
};

// Throws Error (internal) if arrays do not fit together or are not finite,
// InputError if the file cannot be written.
std::string FormatGlb(const std::vector<GlbMesh>& meshes,
                      const GlbOptions& options = {});
void WriteGlb(const std::string& path,
              const std::vector<GlbMesh>& meshes,
              const GlbOptions& options = {});

// The frames kept of `num_frames`: evenly spaced, the first and the last among
// them.
std::vector<int> GlbPoses(int num_frames, int most_poses);

}  // namespace invsim

#endif  // INVSIM_IO_GLB_H_
