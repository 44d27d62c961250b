// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_RANDOM_SCENE_H_
#define INVSIM_STUDY_RANDOM_SCENE_H_

// Hard scenes at random: small ones (some tens of vertices, some frames) whose
// every figure is drawn from the ranges of the gallery (study/hard_scene.h),
// so that bad states meet that nobody thought of together. A seed is a scene:
// what fails once is made again from its seed alone.
//
//   cloth      a sheet, slivers down to 1:10,000, a ring, a triangle, two
//              layers; level or turned; 3 to 40 cm
//   material   membrane 1 to 1e6 N/m, isotropic or up to 1:1000 between the
//              axes, bending 0 or 1e-7 to 1 N m, density 0.01 to 10 kg/m^2
//   effects    damping of mass (0.1 to 1e4 1/s), of stretch (1e-4 to 1 s), air,
//              contact with itself; without gravity, bending or inertia
//   time       frames of 1/10 to 1/2000 s in one to four steps
//   contact    friction 0 to 5, thickness 0.5 to 4 mm
//   body       ball, cube, octahedron, blade, two capsules that may cross,
//              closing boards, a closing V, or none
//   motion     still, shaken at up to 5 m/s, turning at up to 10 rad/s, a jump
//              of up to 20 cm; the cloth starts at up to 10 m/s, up to 3 cm
//              inside, pinned, or 14 km away
//
// One seed in 32 is a person: the mannequin in any of the authored garments (6
// cm triangles) and named fabrics, with effects as above, goes from the T-pose
// to
//
//   shape      coefficients of up to 5 and -5
//   pose       every joint turned by up to a radian and more, one by 180
//              degrees, arms pressed to the trunk, the root by up to 2 pi
//   place      up to a metre away
//
// its fastest vertex at 0.2 to 5 m/s, for 24 frames at most.
//
// A step that misses the contact tolerance and is counted breaks no limit here;
// how many there are is the soak's to report.

#include <cstdint>
#include <string>

#include "invsim/study/hard_scene.h"

namespace invsim {

struct RandomScene {
  std::uint64_t seed = 0;
  std::string words;  // the scene in words, one line
  HardScene scene;
  bool derivative = false;  // the share whose derivative is to be checked
  // How stiff the cloth is for the length of a step, which decides whether the
  // scene is beyond the border of rounding: Y dt^2 / (rho h^2), Y the
  // membrane's larger stiffness, h the smallest height of a face. Fits are
  // below 1e4.
  double stiffness = 0;
};

RandomScene DrawScene(std::uint64_t seed);
// Whether the scene of the seed is of a person.
bool IsPerson(std::uint64_t seed);

// Runs the scene. An exception is a breach of "throws".
HardOutcome RunRandomScene(const RandomScene& drawn);

// Why the breach is beyond what the simulator promises, in words; empty: the
// simulator is to hold there.
std::string KnownBorder(const RandomScene& drawn,
                        const HardOutcome& outcome,
                        const Breach& breach);

}  // namespace invsim

#endif  // INVSIM_STUDY_RANDOM_SCENE_H_
