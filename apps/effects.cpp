// SPDX-License-Identifier: Apache-2.0
#include "effects.h"

#include <vector>

#include "invsim/base/logging.h"
#include "invsim/body/motion.h"

namespace invsim {
namespace {

void Decide(const Garment& garment,
            const Material& material,
            const SceneMotion& motion,
            SceneOptions* options) {
  options->decisions = DecideEffects(*options, garment, material, motion);
  for (const EffectDecision& d : options->decisions)
    LOG(INFO) << "effect " << d.name << (d.on ? " on: " : " off: ") << d.reason;
}

bool IsAuto(const SceneOptions& options) {
  return options.effects == std::vector<std::string>{kAutoEffects};
}

}  // namespace

void DecideSceneEffects(const RelaxationScene& scene,
                        const Material& material,
                        const RelaxationOptions& relaxation,
                        SceneOptions* options) {
  SceneMotion motion;
  if (IsAuto(*options))
    motion = MeasureMotion(scene, relaxation, LayerThickness(*options));
  Decide(scene.garment, material, motion, options);
}

void DecideFitEffects(const FitData& data,
                      double frames_per_second,
                      const RelaxationOptions& relaxation,
                      SceneOptions* options) {
  if (!data.start) {
    SceneMotion motion;
    if (IsAuto(*options))
      motion = MeasureMotion(data.clouds, frames_per_second);
    Decide(data.garment, data.material, motion, options);
    return;
  }
  Motion motion;
  motion.shape = data.start->shape;
  motion.poses = data.start->poses;
  motion.translations = data.start->translations;
  const std::vector<BodyParameters> frames = motion.Frames();
  DecideSceneEffects({data.body, data.garment, frames, frames_per_second},
                     data.material,
                     relaxation,
                     options);
}

}  // namespace invsim
