// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_STUDY_HARD_SCENE_H_
#define INVSIM_STUDY_HARD_SCENE_H_

// Hard cases for the simulator, each defined once: the tests, `invsim gallery`
// and the soak all run what is listed here.
//
// An optimiser that moves a body meets every bad state there is, because it
// goes and looks for it. Each scene is one such state, small enough to run in
// seconds, and says which limits hold in it:
//
//   finite       no step ends in anything that is not a number
//   converged    every step reaches the contact tolerance; a step that does
//                not must be counted (StepStats::missed), never hidden
//   penetration  no vertex deeper than 1 mm inside the body, where the body
//                does not overlap itself
//   energy       nothing but the body gives energy to the cloth. Implicit
//                Euler with K >= the Hessian of E obeys
//                  T_1 + E_1 <= T_0 + E_0 + dt sum_i r_i . v_i ,
//                r_i the contact forces; the largest rise above the least so
//                far is reported relative to the energy that went about
//   crossing     with self-contact, no faces cross that did not at the start
//   derivative   d(cloth)/d(body) of the last frame in which a column can be
//                compared agrees with differences, for columns whose contacts
//                stay as they are
//
// and, where a scene has them, limits of its own (creep at rest, vertices that
// end on the wrong side of a wall), and that it came to what it is there for
// (contacts at all, sticking as well as sliding).

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"
#include "invsim/geometry/mesh.h"
#include "invsim/sim/scene.h"

namespace invsim {

struct HardLimits {
  double penetration = 1e-3;  // m
  double energy = 1e-2;       // relative
  double derivative = 1e-5;   // relative, at the best step of differences
  double creep = std::numeric_limits<double>::infinity();  // m
  int missed = 0;                                          // steps
  // Contacts with the body in a step, at the most, at least: a scene without
  // shows nothing.
  int contacts = 0;
  // Of the derivative, compared at least, where one is asked for.
  int columns = 1;
};

struct HardScene {
  TriangleMesh body;  // at frame 0; no faces: none
  Garment garment;
  Material material;
  SceneOptions options;
  std::vector<Pin> pins;
  ClothState start;  // empty: as placed, at rest
  // The body's vertices at a frame; empty: it stands still.
  std::function<Points(int frame)> body_at;
  int frames = 30;
  double frames_per_second = 60;
  // Frames that the cloth has to get out of a bad start (or out of a sudden
  // move) before penetration and creep count.
  int grace = 0;
  // How vertices of the body move, for the derivative: 3 x V each. Empty:
  // three shifts, three turns and a swelling about its middle.
  std::vector<Points> directions;
  // Of the differences that the derivative is held against, m; empty: the
  // usual ones.
  std::vector<double> difference_steps;
  // How many vertices are where no physics takes them; empty: not asked.
  std::function<int(const Points& cloth, const Points& body)> misplaced;
  // What the scene is there for and did not come to; empty: it did.
  std::function<std::string(const StepStats&)> check;
  HardLimits limits;
};

// A limit that does not hold.
struct Breach {
  std::string limit;  // one word: "penetration"
  std::string text;   // by how much
};

// What running a scene showed.
struct HardOutcome {
  bool refused = false;  // the scene could not be made; why: `refusal`
  std::string refusal;
  int frames = 0;  // done
  StepStats step;
  double penetration = 0;  // m, the deepest after the grace
  double overlap = 0;      // m, of vertices where the body overlaps itself
  double energy = 0;       // the largest breach, relative
  double creep = 0;        // m, from the end of the grace on
  double speed = 0;        // m/s, the largest of any vertex
  int misplaced = 0;
  int closed = 0;     // times that a face was where bending has no angle
  int crossings = 0;  // pairs of faces, at any frame, if none did at first
  // Of the derivative; NaN: none was compared.
  double derivative = std::numeric_limits<double>::quiet_NaN();
  int columns = 0, switched = 0;
  bool differentiated = false;  // whether columns could be looked for
  double seconds = 0;
  std::vector<Breach> broken;  // empty: the scene holds
  std::vector<Breach> beyond;  // of a case at a border: of its ceiling
};

// Runs the scene and holds it against its limits. `derivative`: also the
// derivative of a frame, which simulates it some tens of times.
HardOutcome RunHardScene(const HardScene& scene, bool derivative = true);

// A scene by name.
struct HardCase {
  std::string name;   // "contact/cube_corner"
  std::string shows;  // one line
  std::function<HardScene()> make;
  // What is known not to hold, in words, and the limits that do hold there;
  // empty: all limits hold.
  std::string border = {};
  HardLimits ceiling = {};
  // The scene is bad input: making it throws InputError.
  bool refused = false;
};

// In the order of the gallery: geometry, material, time, contact, parameters.
const std::vector<HardCase>& HardCases();

// Makes and runs a case; of one that is to be refused, whether it is.
HardOutcome RunHardCase(const HardCase& hard, bool derivative = true);

}  // namespace invsim

#endif  // INVSIM_STUDY_HARD_SCENE_H_
