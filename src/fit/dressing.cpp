// SPDX-License-Identifier: Apache-2.0
#include "invsim/fit/dressing.h"

#include "invsim/base/error.h"
#include "invsim/base/interrupt.h"
#include "invsim/cloth/carry.h"

namespace invsim {
namespace {

Garment Carried(const RelaxationScene& scene) {
  BodyParameters from, to;
  to.shape = scene.motion.front().shape;
  return CarryGarment(scene.garment,
                      scene.body.Vertices(from),
                      scene.body.Vertices(to),
                      scene.body.faces(),
                      "the garment");
}

bool CutShort(const StopPredicate& stop, Dressing* dressing) {
  if (stop && stop()) dressing->cut_short = true;
  return dressing->cut_short;
}

}  // namespace

const char* Name(DressingWay way) {
  return way == DressingWay::kCarried ? "carried" : "grown";
}

Dressing Dress(const RelaxationScene& scene,
               const RelaxationOptions& options,
               Simulator* simulator,
               const DressingCost& cost,
               const RelaxationCallback& on_frame,
               const StopPredicate& stop) {
  Dressing dressing;
  for (const DressingWay way : {DressingWay::kCarried, DressingWay::kGrown}) {
    // Neither carried nor grown: the first way was both.
    if (dressing.reference && scene.motion.front().shape.isZero(0)) break;
    if (CutShort(stop, &dressing)) break;
    DressingTry& tried = dressing.tries.emplace_back();
    tried.way = way;
    Garment garment = scene.garment;
    RelaxationScene dressed = {
        scene.body, garment, scene.motion, scene.frames_per_second};
    if (way == DressingWay::kCarried) {
      try {
        garment = Carried(scene);
      } catch (const InputError& error) {
        tried.refused = error.what();
        continue;
      }
      dressed.garment_shape = scene.motion.front().shape;
    }
    tried.relaxation = Relax(dressed, options, simulator, on_frame, stop);
    if (InterruptRequested()) return {};
    if (CutShort(stop, &dressing) &&
        tried.relaxation->status == RunStatus::kInterrupted)
      break;
    if (tried.relaxation->status != RunStatus::kComplete) continue;
    const ClothReference reference = {scene.body.Vertices(scene.motion.front()),
                                      tried.relaxation->cloth};
    tried.cost = cost(reference);
    if (InterruptRequested()) return {};  // nothing was compared
    const bool judged = !CutShort(stop, &dressing);
    if (dressing.reference &&
        !(judged && tried.cost < dressing.tries[dressing.worn].cost))
      continue;
    dressing.worn = static_cast<int>(dressing.tries.size()) - 1;
    dressing.reference = reference;
  }
  return dressing;
}

}  // namespace invsim
