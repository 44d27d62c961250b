// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_APPS_EVALUATION_INPUTS_H_
#define INVSIM_APPS_EVALUATION_INPUTS_H_

// Runs and truths as they lie on disk, for `invsim eval` and `sweep`.

#include <memory>
#include <string>

#include "invsim/study/metrics.h"

namespace invsim {

// A truth and what lies beside it.
struct LoadedReference {
  std::string garment;  // its name, for tables
  std::unique_ptr<BodyModel> body;
  std::unique_ptr<Reference> reference;
};

// `truth`: a sequence's folder (truth.npz, garment.obj, points/, scene.json),
// or the path of a truth.npz, of which what lies beside it is used if it is
// there. `body`: mannequin or an SMPL-layout npz; "": the one in the folder.
// Throws InputError or UsageError.
LoadedReference LoadReference(const std::string& truth,
                              const std::string& body);

// The run in a folder: body.npz, cloth/%06d.ply (with fx fy fz if they are
// there), friction from report.json.
Estimate LoadEstimate(const std::string& run);

}  // namespace invsim

#endif  // INVSIM_APPS_EVALUATION_INPUTS_H_
