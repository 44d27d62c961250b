// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/frame_mesh.h"

namespace invsim {

PlyMesh ClothFrame(const ClothState& cloth,
                   const Faces& faces,
                   const Points& contact_force,
                   const ClothFields& fields) {
  PlyMesh mesh;
  mesh.vertices = cloth.x;
  mesh.faces = faces;
  mesh.AddVector({"vx", "vy", "vz"}, cloth.v);
  mesh.AddVector({"fx", "fy", "fz"}, contact_force);
  mesh.AddScalar("strain", fields.strain);
  mesh.AddScalar("stress", fields.stress);
  mesh.AddScalar("quality", fields.stress);
  return mesh;
}

PlyMesh BodyFrame(const Points& body,
                  const Faces& faces,
                  const VectorXd& pressure) {
  PlyMesh mesh;
  mesh.vertices = body;
  mesh.faces = faces;
  mesh.AddScalar("pressure", pressure);
  mesh.AddScalar("quality", pressure);
  return mesh;
}

}  // namespace invsim
