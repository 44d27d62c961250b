// SPDX-License-Identifier: Apache-2.0

// Hard scenes: long and short steps, fast and sudden motion, long rest.

#include <algorithm>
#include <cmath>

#include "hard_cases.h"

namespace invsim {
namespace {

// Moves the scene's body along x by `shift(frame)`.
template <typename Shift>
void MoveBody(HardScene* scene, Shift shift) {
  const Points start = scene->body.vertices;
  scene->body_at = [start, shift](int frame) {
    return Points(start.colwise() + Vector3d(shift(frame), 0, 0));
  };
}

HardScene Steps(double per_second, int frames) {
  HardScene scene = SheetOverBall();
  scene.frames_per_second = per_second;
  scene.options.step.substeps = 1;
  scene.frames = frames;
  return scene;
}

// To and fro by 25 cm, at 5 m/s in the middle, in a sheet too large to fall
// off at once.
HardScene FastMotion() {
  HardScene scene = SheetOverBall(16, 0.9);
  scene.frames = 60;
  MoveBody(&scene,
           [](int frame) { return 0.25 * std::sin(20 * frame / 60.0); });
  return scene;
}

HardScene Teleport() {
  HardScene scene = SheetOverBall();
  scene.frames = 40;
  MoveBody(&scene, [](int frame) { return frame < 10 ? 0.0 : 0.2; });
  return scene;
}

// After two seconds of swaying, and as many to calm down.
HardScene Pause() {
  HardScene scene = SceneOf(Shifted(SheetMesh(8, 0.3), Vector3d(0, 0.153, 0)),
                            BoxMesh(Vector3d::Constant(0.15)));
  scene.options.contact.friction = 0.5;
  scene.grace = 240;
  scene.frames = scene.grace + 1000;
  scene.limits.creep = 1e-4;
  MoveBody(&scene, [](int frame) {
    const double t = std::min(frame, 120) / 120.0;
    return 0.05 * std::pow(std::sin(2 * EIGEN_PI * t), 3);
  });
  return scene;
}

}  // namespace

void AddTimeCases(std::vector<HardCase>* cases) {
  const auto add = [&](const char* name,
                       const char* shows,
                       std::function<HardScene()> make) {
    cases->push_back({std::string("time/") + name, shows, std::move(make)});
  };
  add("dt_1_10", "steps of 1/10 s", [] { return Steps(10, 20); });
  add("dt_1_2000", "steps of 1/2000 s", [] { return Steps(2000, 400); });
  add("motion_5_mps", "a body shaken at 5 m/s", FastMotion);
  add("teleport_20_cm", "a body that jumps by 20 cm in a frame", Teleport);
  add("pause_1000_frames", "a pause of 1,000 frames without drift", Pause);
}

}  // namespace invsim
