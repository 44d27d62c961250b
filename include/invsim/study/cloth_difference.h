// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_CLOTH_DIFFERENCE_H_
#define INVSIM_STUDY_CLOTH_DIFFERENCE_H_

// How far the cloth of two simulations is apart: vertex by vertex where both
// have the same mesh, and as surfaces where one is finer or round another body.

#include <string>
#include <vector>

namespace invsim {

struct ClothDifference {
  // Per frame: the mean distance from the vertices of each to the surface of
  // the other, averaged over both directions.
  std::vector<double> surface_mm;
  double mean_surface_mm() const;

  // The rest only of the same faces; else `rms_mm` is empty.
  std::vector<double> rms_mm;  // per frame, over its vertices
  double mean_mm = 0;          // over all frames and vertices
  double max_mm = 0;
  bool vertex_by_vertex() const { return !rms_mm.empty(); }
  // Root of the mean over frames of the squares above.
  double total_rms_mm() const;
};

// Of cloth/%06d.ply in two run folders. Throws InputError if there is no frame
// in either, they have not as many frames, or cloth has no faces.
ClothDifference CompareClothFolders(const std::string& run,
                                    const std::string& reference);

}  // namespace invsim

#endif  // INVSIM_STUDY_CLOTH_DIFFERENCE_H_
