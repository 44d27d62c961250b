// SPDX-License-Identifier: Apache-2.0
#include "invsim/study/disturbance.h"

#include <cmath>

#include "invsim/base/random.h"
#include "invsim/body/rotation.h"

namespace invsim {
namespace {

Vector3d RandomNormal(Random* random) {
  Vector3d v;
  for (double& value : v) value = random->Normal();
  return v;
}

}  // namespace

void Describe(OptionTable* table, DisturbanceOptions* o) {
  table->Add("turn",
             &o->turn,
             {.doc = "every joint's turn, root mean square",
              .unit = "rad",
              .at_least = 0});
  table->Add("shift",
             &o->shift,
             {.doc = "the body's shift", .unit = "m", .at_least = 0});
  table->Add("shape",
             &o->shape,
             {.doc = "share of the shape that is taken away",
              .at_least = 0,
              .at_most = 1});
}

BodySequence Disturb(const BodySequence& truth,
                     const DisturbanceOptions& options,
                     std::uint64_t seed) {
  Random random(seed);
  BodySequence x = truth;
  x.shape *= 1 - options.shape;
  for (int j = 0; j < kNumJoints; ++j) {
    const Vector3d turn = options.turn / std::sqrt(3.0) * RandomNormal(&random);
    for (PoseVector& pose : x.poses)
      pose.segment<3>(3 * j) = Log(Exp(pose.segment<3>(3 * j)) * Exp(turn));
  }
  const Vector3d shift = options.shift * RandomNormal(&random).normalized();
  for (Vector3d& translation : x.translations) translation += shift;
  return x;
}

}  // namespace invsim
