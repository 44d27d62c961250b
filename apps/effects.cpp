// SPDX-License-Identifier: Apache-2.0
#include "effects.h"

#include <vector>

#include "invsim/base/logging.h"

namespace invsim {
namespace {

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
  options->decisions = DecideEffects(*options, scene.garment, material, motion);
  for (const EffectDecision& d : options->decisions)
    LOG(INFO) << "effect " << d.name << (d.on ? " on: " : " off: ") << d.reason;
}

std::unique_ptr<Simulator> MakeFitSimulator(const FitData& data,
                                            const BodySequence& start,
                                            double frames_per_second,
                                            const RelaxationOptions& relaxation,
                                            SceneOptions* options) {
  std::vector<BodyParameters> frames;
  for (int t = 0; t < start.num_frames(); ++t) frames.push_back(start.Frame(t));
  DecideSceneEffects({data.body, data.garment, frames, frames_per_second},
                     data.material,
                     relaxation,
                     options);
  return std::make_unique<Simulator>(
      MakeSetup(*options, data.body, data.garment, data.material));
}

}  // namespace invsim
