// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SIM_FRAME_RECORD_H_
#define INVSIM_SIM_FRAME_RECORD_H_

// What a simulated frame leaves behind for its derivative, in the notation of
// cloth/effect.h.

#include <vector>

#include "invsim/algebra/block_matrix.h"
#include "invsim/cloth/effect.h"
#include "invsim/contact/body_contact.h"
#include "invsim/contact/cloth_contact.h"
#include "invsim/contact/contact.h"
#include "invsim/contact/friction_solver.h"

namespace invsim {

// One solved linear problem A v1 = b + r with frictional contact.
struct LinearizationRecord {
  ClothState y;         // the state linearised about
  BlockMatrix a;        // M/dt + dt K(y) + D(y)
  BlockMatrix damping;  // D(y); empty if no effect depends on velocity
  VectorXd b;
  VectorXd v;                    // the solution
  std::vector<Vector3d> forces;  // one per contact, N
};

// One sub-step. The first linearisation is about the start, each later one
// about the result of the one before.
struct SubstepRecord {
  double dt = 0;
  // The body's position at the start and the end of the sub-step is
  // (1 - s) body0 + s body1 of the frame.
  double s0 = 0, s1 = 1;
  ClothState start;
  // Body contacts first, then pins, then contacts of the cloth with itself.
  std::vector<Contact> contacts;
  std::vector<BodyContact> sources;
  std::vector<ClothContact> cloth_sources;
  std::vector<LinearizationRecord> linearizations;
  // The share of the solution's velocity that each vertex kept because cloth
  // was in its way; empty if all kept all.
  VectorXd kept;
};

struct FrameRecord {
  Points body0, body1;
  std::vector<SubstepRecord> substeps;
};

// Whether two runs of a frame met the same contacts (vertex, face, feature) in
// the same modes, so that they lie on one smooth piece of the scheme.
bool SameContacts(const FrameRecord& a, const FrameRecord& b);

}  // namespace invsim

#endif  // INVSIM_SIM_FRAME_RECORD_H_
