// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_STUDY_SCENE_DRAW_H_
#define INVSIM_SRC_STUDY_SCENE_DRAW_H_

// What random scenes of every kind have in common (study/random_scene.h): how
// figures are drawn from their ranges and put into words, the cloth's material,
// the effects, and how far all that is from the known borders.

#include <Eigen/Geometry>
#include <cstdint>
#include <sstream>
#include <string>

#include "hard_cases.h"
#include "invsim/base/random.h"
#include "invsim/study/random_scene.h"

namespace invsim {

class SceneDraw {
 protected:
  explicit SceneDraw(std::uint64_t seed);

  bool Chance(double share) { return random_.Uniform() < share; }
  // Between them, as likely in every decade.
  double Log(double low, double high);
  Vector3d Direction();
  Matrix3d Turn();
  void Say(auto... parts) {
    if (words_.tellp() > 0) words_ << ", ";
    (words_ << ... << parts);
  }

  void DrawMaterial();
  void DrawEffects();
  // The scene, its words, and where it lies to the borders.
  void Finish(RandomScene* drawn);

  Random random_;
  HardScene scene_;

 private:
  void Effect(const char* name, const char* key, double value);

  std::ostringstream words_;
};

// A scene of a person (random_person.cpp).
RandomScene DrawPerson(std::uint64_t seed);

}  // namespace invsim

#endif  // INVSIM_SRC_STUDY_SCENE_DRAW_H_
