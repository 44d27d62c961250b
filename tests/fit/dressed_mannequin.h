// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_FIT_DRESSED_MANNEQUIN_H_
#define INVSIM_TESTS_FIT_DRESSED_MANNEQUIN_H_

// Points of a dressed person without a simulation: the embedded body, its
// trunk hidden by a garment that is the trunk's skin moved out along its
// normals.

#include <vector>

#include "invsim/body/mannequin.h"
#include "invsim/cloth/garment.h"
#include "invsim/geometry/mesh.h"
#include "invsim/geometry/sampling.h"

namespace invsim {

class DressedMannequin {
 public:
  explicit DressedMannequin(double gap) : body_(Mannequin()), gap_(gap) {
    const Faces& faces = body_.faces();
    std::vector<int> trunk, rest;
    for (int f = 0; f < faces.cols(); ++f) {
      double share = 0;
      for (int k = 0; k < 3; ++k)
        for (const int joint : {0, 3, 6, 9})  // pelvis and spine
          share += body_.data().weights(faces(k, f), joint) / 3;
      (share > 0.6 ? trunk : rest).push_back(f);
    }
    trunk_ = faces(Eigen::all, trunk);
    bare_ = faces(Eigen::all, rest);
  }

  const BodyModel& body() const { return body_; }

  // The garment around the T pose; vertices it does not use are dropped.
  Garment MakeGarment() const {
    const Points cloth = Cloth(body_.data().v_template);
    std::vector<int> number(cloth.cols(), -1), used;
    Faces faces = trunk_;
    for (int& i : faces.reshaped()) {
      if (number[i] < 0) {
        number[i] = static_cast<int>(used.size());
        used.push_back(i);
      }
      i = number[i];
    }
    return GarmentFromRestMesh(cloth(Eigen::all, used), faces);
  }

  // `count` points of cloth and bare skin together.
  Points Scan(const BodyParameters& p, int count, std::uint64_t seed) const {
    const Points skin = body_.Vertices(p);
    Points all(3, 2 * skin.cols());
    all << skin, Cloth(skin);
    Faces faces(3, bare_.cols() + trunk_.cols());
    faces << bare_, (trunk_.array() + static_cast<int>(skin.cols())).matrix();
    Random random(seed);
    return SamplePositions(
        all, faces, SampleSurface(all, faces, count, &random));
  }

 private:
  Points Cloth(const Points& skin) const {
    return skin + gap_ * VertexNormals(skin, body_.faces());
  }

  BodyModel body_;
  double gap_;
  Faces trunk_, bare_;
};

}  // namespace invsim

#endif  // INVSIM_TESTS_FIT_DRESSED_MANNEQUIN_H_
