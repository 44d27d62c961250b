// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_STUDY_HARD_CASES_H_
#define INVSIM_SRC_STUDY_HARD_CASES_H_

// The parts of HardCases(), and what they are made of.

#include <string>
#include <vector>

#include "invsim/study/hard_scene.h"

namespace invsim {

void AddGeometryCases(std::vector<HardCase>* cases);
void AddMaterialCases(std::vector<HardCase>* cases);
void AddTimeCases(std::vector<HardCase>* cases);
void AddContactCases(std::vector<HardCase>* cases);
void AddParameterCases(std::vector<HardCase>* cases);

// Closed bodies round the origin, outward.
TriangleMesh BallMesh(double radius, int levels = 3);
TriangleMesh BoxMesh(const Vector3d& half);
// Bodies beside or in each other.
TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b);
TriangleMesh Shifted(TriangleMesh mesh, const Vector3d& by);
TriangleMesh Turned(TriangleMesh mesh, const Matrix3d& rotation);

// A horizontal sheet about the origin, cells x cells, seen from above.
TriangleMesh SheetMesh(int cells, double side);
// A sheet with grid lines at these x and z.
TriangleMesh GridMesh(const std::vector<double>& x,
                      const std::vector<double>& z);
// The same hung upright in the plane x = 0, its side z seen from +x.
TriangleMesh Upright(TriangleMesh sheet);
// A ring of tube: cloth without a boundary.
TriangleMesh RingMesh(double radius, double tube, int around, int across);

// A sheet of jersey-like cloth over a ball of 12 cm, touching at the top: what
// most scenes change in one respect.
HardScene SheetOverBall(int cells = 10, double side = 0.35);
// Two boards close on an upright sheet, faster than it falls, to a gap (the
// cloth and its two clearances need 4 mm); then one slides along by 5 cm.
HardScene SheetBetweenBoards(double gap);
// Two boards in a V, touching at the apex, that closes from 80 degrees on an
// upright sheet that falls into it.
HardScene SheetInV(double degrees);
// A garment with the placed shape as the rest shape.
Garment AsGarment(const TriangleMesh& mesh);
// Cloth and body of a scene.
HardScene SceneOf(const TriangleMesh& cloth, TriangleMesh body);

// Sets an option of the scene by its key ("effects.mass_damping.rate").
void SetOption(HardScene* scene,
               const std::string& key,
               const std::string& value);

}  // namespace invsim

#endif  // INVSIM_SRC_STUDY_HARD_CASES_H_
