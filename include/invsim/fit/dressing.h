// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_FIT_DRESSING_H_
#define INVSIM_FIT_DRESSING_H_

// Where the cloth of a fit comes from: the garment, made round the T-posed
// body of shape zero, put on the body of the first frame.
//
// Points do not say how somebody dressed, and friction remembers it: trousers
// put on a body of its final shape hang centimetres higher than those in which
// the body grew stout. So both ways are tried,
//
//   carried  the garment is carried to the estimated shape first
//            (cloth/carry.h), and then led to the pose
//   grown    it is led to the pose as it is, while the body takes on its shape
//
// (sim/relaxation.h), and the one whose cloth is nearer to what was measured
// is worn. On a body of shape zero both are the same, and one is tried.

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "invsim/fit/cloth_rollout.h"
#include "invsim/sim/relaxation.h"

namespace invsim {

enum class DressingWay { kCarried, kGrown };
const char* Name(DressingWay way);

// One way, tried.
struct DressingTry {
  DressingWay way;
  std::string refused;  // why the garment cannot be carried; else empty
  std::optional<RelaxationResult> relaxation;
  // Of its cloth against the points; infinite if there is none.
  double cost = std::numeric_limits<double>::infinity();
};

struct Dressing {
  std::vector<DressingTry> tries;
  int worn = -1;  // of the tries; -1: none came to an end, or none was needed
  std::optional<ClothReference> reference;
  bool cut_short = false;  // by `stop`: not all was tried or compared
};

// The cost of starting from this cloth.
using DressingCost = std::function<double(const ClothReference&)>;

// `scene.garment` is the one made for shape zero, and scene.motion begins with
// the body to be dressed. Ends early, with nothing worn, if
// InterruptRequested(); and with what is worn until then, if anything, once
// `stop` says so.
Dressing Dress(const RelaxationScene& scene,
               const RelaxationOptions& options,
               Simulator* simulator,
               const DressingCost& cost,
               const RelaxationCallback& on_frame = {},
               const StopPredicate& stop = {});

}  // namespace invsim

#endif  // INVSIM_FIT_DRESSING_H_
