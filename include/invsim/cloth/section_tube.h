// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_CLOTH_SECTION_TUBE_H_
#define INVSIM_CLOTH_SECTION_TUBE_H_

// How cloth hangs round a trunk or a limb: a tube along an axis whose cross
// sections are the convex hulls of the body's. Cloth spans hollows (between
// the legs, behind the knee, under the chest), so the hull of a section, and
// not the section, is what a loose garment follows.
//
// Sections are kept as support functions: h(t, n) is how far the section at
// distance t along the axis reaches in direction n, for 64 directions n. Then
//
//   f(x) = max_n (n . q - h(t, n)),   q = x's offset from the axis,
//
// is negative inside the tube and close to the distance outside it; f - e is
// the tube wider by e all round.

#include <array>
#include <vector>

#include "invsim/base/types.h"

namespace invsim {

class SectionTube {
 public:
  // The sections, every `spacing`, of the chosen faces by planes across the
  // axis from `start` to `end`. A place without a section takes the nearest
  // one. Throws InputError if there is none at all.
  SectionTube(const Points& vertices,
              const Faces& faces,
              const std::vector<char>& chosen,
              const Vector3d& start,
              const Vector3d& end,
              double spacing);

  // Cloth that hangs from the start does not follow a body that gets narrower,
  // nor one that suddenly gets wider: a section reaches at least as far as any
  // nearer to the start, less `narrowing` times the distance between them, and
  // as any farther from it, less `widening` times that distance.
  void Hang(double narrowing, double widening);

  // Beyond t the tube widens by `rate` per metre, like a skirt.
  void Flare(double t, double rate);

  // Negative inside. The tube ends at the start of its axis and goes on for
  // ever, as it is there, beyond the end.
  double Value(const Vector3d& x) const;

  // Distance along the axis from its start, and the whole length.
  double Along(const Vector3d& x) const;
  double length() const { return length_; }

 private:
  static constexpr int kDirections = 64;

  void Cut(const Points& vertices, const Faces& faces, int f);
  void FillGaps();
  // Makes a section reach as far as a neighbour and `rate` per metre more.
  void Follow(int section, int neighbour, double rate);

  Vector3d start_, axis_, u_, v_;
  double length_, spacing_;
  // kDirections x sections.
  MatrixXd reach_;
  std::array<double, kDirections> cosine_, sine_;
};

}  // namespace invsim

#endif  // INVSIM_CLOTH_SECTION_TUBE_H_
