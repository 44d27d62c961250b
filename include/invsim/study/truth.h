// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_TRUTH_H_
#define INVSIM_STUDY_TRUTH_H_

// What no scanner sees of a clothed person: the body under the cloth and the
// cloth itself, as an npz. It is a motion (see ReadMotion) with two more
// arrays, 32-bit, vertices in the order of the garment:
//
//   cloth (T,N,3), metres      cloth_velocities (T,N,3), m/s

#include <string>
#include <vector>

#include "invsim/body/motion.h"

namespace invsim {

struct Truth {
  Motion body;
  std::vector<Points> cloth;             // one per frame, or none known
  std::vector<Points> cloth_velocities;  // likewise
};

// Throws InputError naming file and array.
Truth ReadTruth(const std::string& path);

// Arrays that are not known are left out.
void WriteTruth(const std::string& path, const Truth& truth);

}  // namespace invsim

#endif  // INVSIM_STUDY_TRUTH_H_
