// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_CLOTH_DIFFERENCE_H_
#define INVSIM_STUDY_CLOTH_DIFFERENCE_H_

// How far the cloth of two simulations is apart, vertex by vertex.

#include <string>
#include <vector>

namespace invsim {

struct ClothDifference {
  std::vector<double> rms_mm;  // per frame, over its vertices
  double mean_mm = 0;          // over all frames and vertices
  double max_mm = 0;
  // Root of the mean over frames of the squares above.
  double total_rms_mm() const;
};

// Of cloth/%06d.ply in two run folders. Throws InputError if there is no frame
// in either, or frames or vertices do not match.
ClothDifference CompareClothFolders(const std::string& run,
                                    const std::string& reference);

}  // namespace invsim

#endif  // INVSIM_STUDY_CLOTH_DIFFERENCE_H_
