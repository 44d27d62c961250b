// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_FRAME_MESH_H_
#define INVSIM_REPORT_FRAME_MESH_H_

// One frame as PLY meshes with what is known per vertex. `quality` is what
// MeshLab and others colour by.

#include "invsim/cloth/effect.h"
#include "invsim/io/ply.h"
#include "invsim/sim/fields.h"

namespace invsim {

// vx vy vz (m/s), fx fy fz (contact force, N), strain, stress (N/m; see
// ClothFields), quality = stress.
PlyMesh ClothFrame(const ClothState& cloth,
                   const Faces& faces,
                   const Points& contact_force,
                   const ClothFields& fields);

// pressure (Pa), quality = pressure.
PlyMesh BodyFrame(const Points& body,
                  const Faces& faces,
                  const VectorXd& pressure);

}  // namespace invsim

#endif  // INVSIM_REPORT_FRAME_MESH_H_
