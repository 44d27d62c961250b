// SPDX-License-Identifier: Apache-2.0

// What hard fits are made of: the mannequin in a tank top, simulated and
// measured.

#include <algorithm>
#include <stdexcept>

#include "hard_fit_cases.h"
#include "invsim/base/config.h"
#include "invsim/base/options.h"
#include "invsim/body/mannequin.h"
#include "invsim/cloth/authored_garment.h"
#include "invsim/cloth/named_materials.h"
#include "invsim/study/disturbance.h"
#include "invsim/study/measurement.h"

namespace invsim {
namespace {

constexpr double kSceneRate = 30;

const Garment& TankTop() {
  static const Garment garment = [] {
    const BodyModel& body = Mannequin();
    return AuthoredGarment(
        "tank_top",
        {body.Vertices({}), body.faces(), body.Joints({}), body.data().weights},
        {.edge_length = 0.08});
  }();
  return garment;
}

// The shortest that still dresses.
RelaxationOptions ShortRelaxation() {
  RelaxationOptions options;
  options.settle_seconds = options.hold_seconds = 0.1;
  options.move_seconds = 0.3;
  return options;
}

}  // namespace

BodySequence HardFitTruth(int frames, double shape) {
  BodySequence truth;
  truth.shape[0] = shape;
  for (int t = 0; t < frames; ++t) {
    BodyParameters p;
    p.pose[1] = 0.1 + 0.02 * t;
    p.pose[3 * kLeftShoulder + 2] = -0.9 + 0.02 * t;
    p.pose[3 * (kLeftShoulder + 1) + 2] = 0.9;
    p.translation = Vector3d(0.01 * t, 0.02, 0);
    truth.Append(p);
  }
  return truth;
}

std::vector<Points> HardFitClouds(const BodySequence& truth) {
  const BodyModel& body = Mannequin();
  SceneOptions scene;
  scene.step.substeps = 1;
  Simulator simulator(
      MakeSetup(scene, body, TankTop(), FindMaterial(scene.material)));
  std::vector<BodyParameters> motion;
  for (int t = 0; t < truth.num_frames(); ++t) motion.push_back(truth.Frame(t));
  RelaxationResult dressed = Relax(
      {body, TankTop(), motion, kSceneRate}, ShortRelaxation(), &simulator);
  MeasurementOptions measurement;
  measurement.points = 400;
  const Scanner scanner(body.faces(), TankTop().faces, measurement, 3);
  std::vector<Points> clouds;
  const RolloutResult result = SimulateSequence(
      &simulator,
      [&](int t) { return body.Vertices(motion[t]); },
      truth.num_frames(),
      kSceneRate,
      &dressed.cloth,
      [&](const SimulatedFrame& f) {
        clouds.push_back(scanner.Measure(f.frame, f.body, f.cloth.x).points);
      });
  if (result.status != RunStatus::kComplete)
    throw std::logic_error("the person of the hard fits cannot be simulated");
  return clouds;
}

HardFit PlainFit(int frames) {
  static const std::vector<Points> clouds = HardFitClouds(HardFitTruth(3));
  HardFit fit;
  fit.garment = TankTop();
  fit.truth = HardFitTruth(frames);
  fit.clouds = frames == 3 ? clouds : HardFitClouds(*fit.truth);
  fit.start = Disturb(*fit.truth, {.turn = 0.05, .shift = 0.02}, 4);
  fit.scene.step.substeps = 1;
  fit.fit.relaxation = ShortRelaxation();
  fit.fit.init.headings = 2;
  fit.fit.init.anchors = 1;
  fit.fit.init.iterations = 3;
  SetOption(&fit, "lm.iterations", "4");
  return fit;
}

void MeasureFromPointsAlone(HardFit* fit) {
  fit->fit.data.cloth_to_points = fit->fit.data.skin_to_points = 0;
}

void SetOption(HardFit* fit, const std::string& key, const std::string& value) {
  OptionTable table;
  Describe(&table, &fit->scene);
  Describe(&table, &fit->fit);
  Config config;
  config.Set(key, value, "hard fit");
  table.Read(config);
}

}  // namespace invsim
